// The stated errors of the joint forces, from two integrations of the same motion: by how much they differ, when, and up to which time
// they agree.
// theory/time section 6.
#pragma once

#include <vector>

#include "pintle/trajectory.h"
#include "run/errors/ringing_loss.h"
#include "run/record/force_table.h"
#include "run/record/load_statistics.h"

namespace pintle {

/// Largest difference of each joint's force (and couple) between two passes, and the peaks of the finer one.
struct PassDifference {
  std::vector<double> force, couple, peak, peak_couple;
  double largest_load = 0, rounding = 0;  // of the finer pass: see ForceTable [N]
  double rounding_couple = 0;             // [N*m]
};

/// Over the rows up to time `until` [s]. `share` of it is the error of the finer pass. Rows where its steps are no shorter than the coarser
/// one's count in full: their difference is divided by `share`. theory/time Eq. (6.2).
template <class S>
PassDifference difference_of_passes(const BasicSystem<S>& system, const BasicForceTable<S>& coarse, const BasicForceTable<S>& fine, double until, double share);

/// Adds what the rows do not show: the fraction `part` of the peaks between them.
template <class S>
void include_peaks(const BasicLoadRecorder<S>& fine, double part, PassDifference& c);

/// Each joint's peak force [N] and couple [N*m] in one pass.
struct JointPeaks {
  std::vector<double> force, couple;
};

template <class S>
JointPeaks peaks_of(const BasicLoadRecorder<S>& pass, std::size_t joints);

/// Adds the difference of the passes' peaks, wherever they are: the passes must agree between the rows too. A difference that has not decreased
/// since the pass before these two counts in full, divided by `share`: nothing shows that the coarser pass caused it. `before` is empty if there
/// was no such pass. theory/time Eq. (6.2).
void include_peak_differences(const JointPeaks& before, const JointPeaks& coarse, const JointPeaks& fine, double share, PassDifference& c);

/// Each joint's largest difference relative to its peak force or couple [-]. For joints that carry almost nothing the reference is a
/// small part of the largest in the mechanism; for couples at least that part of the largest force at a radius of gyration.
/// The couple of a rubbing pin is a small part of what its force does: its error is stated, but calls for no finer pass.
template <class S>
std::vector<double> relative_differences(const BasicSystem<S>& system, const PassDifference& c);

/// The vibrations that the steps of a pass have damped, as such a relative difference; at most a few times the tolerance of the steps goes unnoticed. First
/// adds what they transmit to other joints: call once for each pass.
template <class S>
double largest_ringing_loss(const BasicSystem<S>& system, const PassDifference& difference, BasicRingingLoss<S>& ringing, double tolerance);

/// Longest distance of any body from its start; of centres and of points at the radius of gyration [m].
template <class S>
double longest_path(const BasicSystem<S>& system, const BasicForceTable<S>& table);
/// Largest difference of a body's position between two passes, relative to the longest distance of any body from its start [-]; for centres
/// and for points at the radius of gyration. theory/time Eq. (6.4).
template <class S>
double motion_difference(const BasicSystem<S>& system, const BasicForceTable<S>& coarse, const BasicForceTable<S>& fine);

/// Exponent with which errors fall with the tolerance. theory/time Eq. (6.2).
inline constexpr double kErrorPower = 0.8;
/// Fraction of the peak: larger differences no longer grow as small ones do, and do not show which part is the finer pass's error.
inline constexpr double kSaturated = 0.03;
/// The error of the finer of two passes as a share of their difference, if tolerances or steps reduce errors to the fraction `fall`; 1 for similar passes.
/// theory/time Eq. (6.2).
double share_of_finer(double fall);

/// Lower limits on a joint's error.
template <class S>
struct BasicLeastError {
  double of_peak = 0;                  // relative to the joint's peak force [-]
  const BasicRingingLoss<S>& ringing;  // what the steps have damped: at most `tolerance` of the peak goes unnoticed
  double tolerance = 0;                // of the steps [-]
};

/// States the errors of the joints and of the motors that are servos: `share` of the difference, and at least `least`. theory/time Eqs. (6.1), (6.12).
template <class S>
void state_errors(const BasicSystem<S>& system, const PassDifference& difference, double share, const BasicLeastError<S>& least, Trajectory& out);

/// The same for the joints, from the rows up to each joint's own time [s], where the motion cannot be promised beyond it.
template <class S>
void state_errors_until(const BasicSystem<S>& system, const BasicForceTable<S>& coarse, const BasicForceTable<S>& fine, const std::vector<double>& until, double share, const BasicLeastError<S>& least,
                        std::vector<LoadSummary>& joints);

/// A relative difference [-] as a function of time [s].
struct DifferenceCurve {
  std::vector<double> t, e;
};

/// In every common row, the largest relative difference of any joint, with the references of `relative_differences`.
template <class S>
DifferenceCurve force_difference_curve(const BasicSystem<S>& system, const BasicForceTable<S>& coarse, const BasicForceTable<S>& fine);
/// In every common row, the largest difference of a body's position relative to the longest distance.
template <class S>
DifferenceCurve motion_difference_curve(const BasicSystem<S>& system, const BasicForceTable<S>& coarse, const BasicForceTable<S>& fine);

/// For each joint the last time [s] such that in a run that ends there `share` times its difference is within `tolerance` of its peak.
/// theory/time Eq. (6.10).
template <class S>
std::vector<double> force_horizons(const BasicSystem<S>& system, const BasicForceTable<S>& coarse, const BasicForceTable<S>& fine, double share, double tolerance);

/// The last time up to which the curve stays within `tolerance`.
double curve_horizon(const DifferenceCurve& curve, double tolerance);

double largest_of(const std::vector<double>& x);

}  // namespace pintle
