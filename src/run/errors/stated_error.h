// The stated errors of the joint forces: what two integrations of the same motion say about them, by how far they differ, when, and up to which time
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
  double largest_load = 0, rounding = 0;  // of the finer one: ForceTable [N]
  double rounding_couple = 0;             // [N*m]
};

/// Over the rows up to time `until` [s]. `share` of it is the error of the finer pass: rows where its steps are no shorter than the coarser
/// one's count all the more. theory/time Eq. (6.2).
template <class S>
PassDifference difference_of_passes(const BasicSystem<S>& system, const BasicForceTable<S>& coarse, const BasicForceTable<S>& fine, double until, double share);

/// Adds what the rows do not show: this part of the peaks between them.
template <class S>
void include_peaks(const BasicLoadRecorder<S>& fine, double part, PassDifference& c);

/// Adds by how much the passes' peaks differ, wherever they are: between the rows, too, they have to agree. theory/time Eq. (6.2).
template <class S>
void include_peak_differences(const BasicLoadRecorder<S>& coarse, const BasicLoadRecorder<S>& fine, PassDifference& c);

/// Each joint's largest difference over its peak force or couple [-]. Joints that carry next to nothing are measured by a
/// small part of the largest of the mechanism; couples at least by that of the largest force at a radius of gyration.
/// The couple of a pin that rubs is a small part of what its force does: its error is stated, and drives no pass.
template <class S>
std::vector<double> relative_differences(const BasicSystem<S>& system, const PassDifference& c);

/// What the steps of a pass have damped of vibrations, as one of these: no more of it than a few times the tolerance of the steps goes unnoticed. Adds what they
/// transmit to other joints first: once for each pass.
template <class S>
double largest_ringing_loss(const BasicSystem<S>& system, const PassDifference& difference, BasicRingingLoss<S>& ringing, double tolerance);

/// Largest difference of a body's place between two passes, over the longest way that one has gone from its start [-]; of centres
/// and of points at the radius of gyration. theory/time Eq. (6.4).
template <class S>
double motion_difference(const BasicSystem<S>& system, const BasicForceTable<S>& coarse, const BasicForceTable<S>& fine);

/// How errors fall with the tolerance: as its power to this. theory/time Eq. (6.2).
inline constexpr double kErrorPower = 0.8;
/// Of the peak: differences above it no longer grow as small ones do, and do not tell what the finer pass's part is.
inline constexpr double kSaturated = 0.03;
/// The error of the finer of two passes over their difference, where tolerances or steps let errors fall to this part: all of it where they are alike.
/// theory/time Eq. (6.2).
double share_of_finer(double fall);

/// What a joint's error is at least.
template <class S>
struct BasicLeastError {
  double of_peak = 0;                  // of the joint's peak force [-]
  const BasicRingingLoss<S>& ringing;  // what the steps have damped: no more of it than `tolerance` of the peak goes unnoticed
  double tolerance = 0;                // of the steps [-]
};

/// States the errors of the joints that are no servos: `share` of the difference, and at least `least`. theory/time Eqs. (6.1), (6.12).
template <class S>
void state_errors(const BasicSystem<S>& system, const PassDifference& difference, double share, const BasicLeastError<S>& least, std::vector<LoadSummary>& joints);

/// The same of the rows up to a time of each joint [s], where the motion cannot be promised beyond.
template <class S>
void state_errors_until(const BasicSystem<S>& system, const BasicForceTable<S>& coarse, const BasicForceTable<S>& fine, const std::vector<double>& until, double share, const BasicLeastError<S>& least,
                        std::vector<LoadSummary>& joints);

/// A relative difference [-] as a function of time [s].
struct DifferenceCurve {
  std::vector<double> t, e;
};

/// In every common row, the largest relative difference of any joint, by the measures of `relative_differences`.
template <class S>
DifferenceCurve force_difference_curve(const BasicSystem<S>& system, const BasicForceTable<S>& coarse, const BasicForceTable<S>& fine);
/// In every common row, the largest difference of a body's place over the longest way.
template <class S>
DifferenceCurve motion_difference_curve(const BasicSystem<S>& system, const BasicForceTable<S>& coarse, const BasicForceTable<S>& fine);

/// For each joint the last time [s] at which a run that ends there has `share` times its difference within `tolerance` of its peak.
/// theory/time Eq. (6.10).
template <class S>
std::vector<double> force_horizons(const BasicSystem<S>& system, const BasicForceTable<S>& coarse, const BasicForceTable<S>& fine, double share, double tolerance);

/// The last time up to which the curve stays within `tolerance`.
double curve_horizon(const DifferenceCurve& curve, double tolerance);

double largest_of(const std::vector<double>& x);

}  // namespace pintle
