#include "run/errors/stated_error.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "integrators/thresholds.h"

namespace pintle {
namespace {

constexpr double kPeakOfRounding = 10;       // peak of roundoff over a whole run, as a multiple of that of one force. With 1 the rail of snap_through_truss states an error of a hundredth of what it carries
constexpr double kNegligibleOfMotor = 1e-3;  // lower limit on the reference of a motor's error, as a fraction of the largest force
constexpr double kManySteps = 1000;          // from this number of steps on, limits grow in proportion to it: a pass of 35,000 steps that has damped a vibration bit by bit agrees with one of 48 that has not seen it. With double this number gears-1-77 of the battery takes twice the steps, with half of it as many
constexpr double kMostRinging = 3;           // upper limit on vibrations damped unnoticed, as a multiple of the tolerance of the steps times the geometric mean of the joint's peak and the largest one. What thousands of steps lose of resolved vibrations shows in the difference of the passes
constexpr double kOfEqual = 3;               // factor of Eq. (6.2): share of the difference that would be the finer pass's error if it were as coarse

// The larger distance: of centres, or of points at `radius` from them across the axis of rotation. theory/time Eq. (6.4).
template <class S>
double distance(const typename S::Coordinates& a, const typename S::Coordinates& b, double radius) {
  const typename S::Vec way = S::difference(a, b);
  return std::max(linear_magnitude<S>(way), 2 * radius * std::abs(std::sin(0.5 * angular_magnitude<S>(way))));
}

double relative(double error, double peak, double least) { return error / std::max({peak, least, 1e-300}); }

// References for the errors of the joints. Where no joint carries anything, as in free fall, these are the loads on the bodies.
template <class S>
struct Measures {
  double force, couple;               // the largest in the mechanism [N], [N*m]
  double rounding, rounding_couple;  // roundoff of the forces and couples of a run [N], [N*m]
  const BasicSystem<S>& system;

  Measures(const BasicSystem<S>& of, const PassDifference& c)
      : force(largest_force(c)), couple(std::max(largest_of(c.peak_couple), force * of.largest_radius_of_gyration())),
        rounding(kPeakOfRounding * c.rounding), rounding_couple(kPeakOfRounding * c.rounding_couple), system(of) {}

  double of_joint(std::size_t j, double force_error, double peak, double couple_error, double peak_couple) const {
    const double least = system.joints[j].servo >= 0 ? kNegligibleOfMotor : kNegligible;
    const double of_force = is_rounding(force_error, peak, rounding, force) ? 0 : relative(force_error, peak, least * force);
    const bool of_couple = system.joints[j].law.lever() == 0 || system.joints[j].law.acts_without_reaction();
    if (!of_couple || is_rounding(couple_error, peak_couple, rounding_couple, couple)) return of_force;
    return std::max(of_force, relative(couple_error, peak_couple, least * couple));
  }

  double smallest_force(const PassDifference& c) const { return std::max(smallest_of(c.peak), kNegligible * force); }
  double smallest_couple(const PassDifference& c) const { return std::max(smallest_of(c.peak_couple), kNegligible * couple); }

 private:
  static double smallest_of(const std::vector<double>& x) { return x.empty() ? 0 : *std::min_element(x.begin(), x.end()); }
  // Whether a joint's force is roundoff alone, whose error no finer pass can reduce. Only where other joints carry more, or none carries anything.
  static bool is_rounding(double error, double peak, double rounding, double largest) {
    return std::max(error, peak) <= rounding && (largest > rounding || largest <= rounding / kPeakOfRounding);
  }
  static double largest_force(const PassDifference& c) {
    const double largest = largest_of(c.peak);
    return largest > c.rounding ? largest : c.largest_load / kNegligible;
  }
};

// Differences and peaks up to a row. Where the finer pass has no shorter steps, nothing shows that it is better: the whole difference is its
// error there, so it is kept divided by `share`.
template <class S>
class Growing {
 public:
  Growing(std::size_t joints, double share, const BasicForceTable<S>& fine) : all_(1 / share) {
    c_.largest_load = fine.largest_load;
    c_.rounding = fine.rounding;
    c_.rounding_couple = fine.rounding_couple;
    for (auto* x : {&c_.force, &c_.couple, &c_.peak, &c_.peak_couple}) x->assign(joints, 0.0);
  }
  void add_row(const BasicForceTable<S>& coarse, const BasicForceTable<S>& fine, std::size_t i) {
    const std::size_t joints = c_.force.size();
    for (std::size_t j = 0; j < joints; ++j) {
      const typename S::Vec& load = fine.world[i * joints + j];
      c_.peak[j] = std::max(c_.peak[j], linear_magnitude<S>(load));
      c_.peak_couple[j] = std::max(c_.peak_couple[j], angular_magnitude<S>(load));
      if (coarse.t[i] != fine.t[i]) continue;
      const typename S::Vec difference = (fine.step[i] < coarse.step[i] ? 1 : all_) * (coarse.world[i * joints + j] - load);
      c_.force[j] = std::max(c_.force[j], linear_magnitude<S>(difference));
      c_.couple[j] = std::max(c_.couple[j], angular_magnitude<S>(difference));
    }
  }
  const PassDifference& so_far() const { return c_; }

 private:
  double all_;  // 1 / share
  PassDifference c_;
};

// Force and couple of a joint's vibrations that the steps have damped. Steps are judged by the largest loads, and a lightly loaded joint may carry forces of
// another's vibrations: the limit on what it may lack unnoticed lies between its own peak and the largest.
template <class S>
std::array<double, 2> damped(const Measures<S>& measures, const BasicRingingLoss<S>& ringing, double tolerance, const PassDifference& difference, std::size_t j) {
  const auto most = [tolerance, many = std::max(ringing.n_steps() / kManySteps, 1.0)](double peak, double largest) { return kMostRinging * tolerance * many * std::sqrt(peak * std::max(peak, largest)); };
  return {std::min(ringing.force(j), most(difference.peak[j], measures.force)), std::min(ringing.couple(j), most(difference.peak_couple[j], measures.couple))};
}

template <class S>
void state_error(const Measures<S>& measures, const PassDifference& difference, double share, const BasicLeastError<S>& least, std::size_t j, LoadSummary& joint) {
  const double peak = difference.peak[j], peak_couple = difference.peak_couple[j];
  const auto [damped_force, damped_couple] = damped(measures, least.ringing, least.tolerance, difference, j);
  const double force = std::max(share * difference.force[j], damped_force), couple = std::max(share * difference.couple[j], damped_couple);
  joint.error_estimate = std::max({force, least.of_peak * peak, peak > kPeakOfRounding * difference.rounding ? 0 : peak});  // a force that is roundoff alone is not known at all
  joint.moment_error_estimate = couple;
  const bool carries_nothing = peak == 0 && peak_couple == 0 && force == 0 && couple == 0;
  joint.relative_error_estimate = carries_nothing ? 0 : std::max(measures.of_joint(j, force, peak, couple, peak_couple), least.of_peak);
}

template <class S>
std::size_t common_rows(const BasicForceTable<S>& coarse, const BasicForceTable<S>& fine) { return std::min(coarse.t.size(), fine.t.size()); }

}  // namespace

template <class S>
double largest_ringing_loss(const BasicSystem<S>& system, const PassDifference& difference, BasicRingingLoss<S>& ringing, double tolerance) {
  const Measures<S> measures(system, difference);
  ringing.add_transmitted(tolerance * measures.smallest_force(difference), tolerance * measures.smallest_couple(difference));
  double largest = 0;
  for (std::size_t j = 0; j < system.joints.size(); ++j) {
    const auto [force, couple] = damped(measures, ringing, tolerance, difference, j);
    largest = std::max(largest, measures.of_joint(j, force, difference.peak[j], couple, difference.peak_couple[j]));
  }
  return largest;
}

double largest_of(const std::vector<double>& x) { return x.empty() ? 0 : *std::max_element(x.begin(), x.end()); }

template <class S>
PassDifference difference_of_passes(const BasicSystem<S>& system, const BasicForceTable<S>& coarse, const BasicForceTable<S>& fine, double until, double share) {
  Growing<S> growing(system.joints.size(), share, fine);
  for (std::size_t i = 0; i < common_rows(coarse, fine) && fine.t[i] <= until; ++i) growing.add_row(coarse, fine, i);
  return growing.so_far();
}

template <class S>
void include_peaks(const BasicLoadRecorder<S>& fine, double part, PassDifference& c) {
  for (std::size_t j = 0; j < c.force.size(); ++j) {
    c.peak[j] = std::max(c.peak[j], part * fine.force(static_cast<int>(j)).peak);
    c.peak_couple[j] = std::max(c.peak_couple[j], part * fine.couple(static_cast<int>(j)).peak);
  }
}

template <class S>
JointPeaks peaks_of(const BasicLoadRecorder<S>& pass, std::size_t joints) {
  JointPeaks peaks;
  for (std::size_t j = 0; j < joints; ++j) {
    peaks.force.push_back(pass.force(static_cast<int>(j)).peak);
    peaks.couple.push_back(pass.couple(static_cast<int>(j)).peak);
  }
  return peaks;
}

void include_peak_differences(const JointPeaks& before, const JointPeaks& coarse, const JointPeaks& fine, double share, PassDifference& c) {
  const auto include = [share](const std::vector<double>& first, const std::vector<double>& second, const std::vector<double>& third, std::vector<double>& difference) {
    for (std::size_t j = 0; j < difference.size(); ++j) {
      const double now = std::abs(third[j] - second[j]);
      const bool decreased = first.empty() || now < std::abs(second[j] - first[j]);
      difference[j] = std::max(difference[j], decreased ? now : now / share);
    }
  };
  include(before.force, coarse.force, fine.force, c.force);
  include(before.couple, coarse.couple, fine.couple, c.couple);
}

template <class S>
std::vector<double> relative_differences(const BasicSystem<S>& system, const PassDifference& c) {
  const Measures<S> measures(system, c);
  std::vector<double> out(c.force.size());
  for (std::size_t j = 0; j < out.size(); ++j) out[j] = measures.of_joint(j, c.force[j], c.peak[j], c.couple[j], c.peak_couple[j]);
  return out;
}

template <class S>
double longest_path(const BasicSystem<S>& system, const BasicForceTable<S>& table) {
  const std::size_t bodies = system.bodies.size();
  double way = 0;
  for (std::size_t at = 0; at < table.place.size(); ++at) way = std::max(way, distance<S>(table.place[at], table.place[at % bodies], system.bodies[at % bodies].radius_of_gyration()));
  return way;
}

template <class S>
DifferenceCurve motion_difference_curve(const BasicSystem<S>& system, const BasicForceTable<S>& coarse, const BasicForceTable<S>& fine) {
  const std::size_t bodies = system.bodies.size();
  DifferenceCurve curve;
  const double way = longest_path(system, fine);
  for (std::size_t row = 0; row < common_rows(coarse, fine); ++row) {
    double difference = 0;
    for (std::size_t i = 0; i < bodies; ++i)
      if (coarse.t[row] == fine.t[row]) difference = std::max(difference, distance<S>(fine.place[row * bodies + i], coarse.place[row * bodies + i], system.bodies[i].radius_of_gyration()));
    curve.t.push_back(fine.t[row]);
    curve.e.push_back(difference);
  }
  for (double& e : curve.e) e = way > 0 ? e / way : 0;
  return curve;
}

template <class S>
double motion_difference(const BasicSystem<S>& system, const BasicForceTable<S>& coarse, const BasicForceTable<S>& fine) {
  return largest_of(motion_difference_curve(system, coarse, fine).e);
}

template <class S>
DifferenceCurve force_difference_curve(const BasicSystem<S>& system, const BasicForceTable<S>& coarse, const BasicForceTable<S>& fine) {
  const std::size_t joints = system.joints.size();
  const PassDifference whole = difference_of_passes(system, coarse, fine, fine.t.back(), 1.0);
  const Measures<S> measures(system, whole);
  DifferenceCurve curve;
  for (std::size_t i = 0; i < common_rows(coarse, fine); ++i) {
    if (coarse.t[i] != fine.t[i]) continue;
    double e = 0;
    for (std::size_t j = 0; j < joints; ++j) {
      const typename S::Vec apart = coarse.world[i * joints + j] - fine.world[i * joints + j];
      e = std::max(e, measures.of_joint(j, linear_magnitude<S>(apart), whole.peak[j], angular_magnitude<S>(apart), whole.peak_couple[j]));
    }
    curve.t.push_back(fine.t[i]);
    curve.e.push_back(e);
  }
  return curve;
}

template <class S>
std::vector<double> force_horizons(const BasicSystem<S>& system, const BasicForceTable<S>& coarse, const BasicForceTable<S>& fine, double share, double tolerance) {
  const std::size_t joints = system.joints.size();
  std::vector<double> horizon(joints, 0.0);
  Growing<S> growing(joints, share, fine);
  for (std::size_t i = 0; i < common_rows(coarse, fine); ++i) {
    growing.add_row(coarse, fine, i);
    const PassDifference& c = growing.so_far();
    const Measures<S> measures(system, c);
    for (std::size_t j = 0; j < joints; ++j) {
      const double apart = measures.of_joint(j, c.force[j], c.peak[j], c.couple[j], c.peak_couple[j]);
      if (share * apart <= tolerance && (share == 1 || apart <= kSaturated)) horizon[j] = fine.t[i];
    }
  }
  return horizon;
}

double curve_horizon(const DifferenceCurve& curve, double tolerance) {
  double horizon = 0;
  for (std::size_t i = 0; i < curve.t.size() && curve.e[i] <= tolerance; ++i) horizon = curve.t[i];
  return horizon;
}

double share_of_finer(double fall) { return std::min(1.0, kOfEqual * std::pow(fall, kErrorPower)); }

template <class S>
void state_errors(const BasicSystem<S>& system, const PassDifference& difference, double share, const BasicLeastError<S>& least, Trajectory& out) {
  const Measures<S> measures(system, difference);
  for (std::size_t j = 0, row = 0; j < system.joints.size(); ++j) {
    if (system.joints[j].servo < 0) {
      state_error(measures, difference, share, least, j, out.joints[row++]);
      continue;
    }
    LoadSummary servo;
    state_error(measures, difference, share, least, j, servo);
    for (MotorSummary& motor : out.motors)
      if (motor.name == system.joints[j].name) motor.effort_error = motor.unit == "N" ? servo.error_estimate : servo.moment_error_estimate;
  }
}

template <class S>
void state_errors_until(const BasicSystem<S>& system, const BasicForceTable<S>& coarse, const BasicForceTable<S>& fine, const std::vector<double>& until, double share, const BasicLeastError<S>& least,
                        std::vector<LoadSummary>& joints) {
  std::vector<std::pair<std::size_t, std::size_t>> order;  // joint, its row of the summary
  for (std::size_t j = 0; j < system.joints.size(); ++j)
    if (system.joints[j].servo < 0) order.emplace_back(j, order.size());
  std::sort(order.begin(), order.end(), [&](const auto& a, const auto& b) { return until[a.first] < until[b.first]; });
  Growing<S> growing(system.joints.size(), share, fine);
  std::size_t i = 0;
  for (const auto& [j, row] : order) {
    for (; i < common_rows(coarse, fine) && fine.t[i] <= until[j]; ++i) growing.add_row(coarse, fine, i);
    state_error(Measures<S>(system, growing.so_far()), growing.so_far(), share, least, j, joints[row]);
  }
}

template PassDifference difference_of_passes(const BasicSystem<Planar>& system, const BasicForceTable<Planar>& coarse, const BasicForceTable<Planar>& fine, double until, double share);
template void include_peaks(const BasicLoadRecorder<Planar>& fine, double part, PassDifference& c);
template JointPeaks peaks_of(const BasicLoadRecorder<Planar>& pass, std::size_t joints);
PINTLE_IN_SPACE(template JointPeaks peaks_of(const BasicLoadRecorder<Spatial>& pass, std::size_t joints);)
PINTLE_IN_SPACE(template void include_peaks(const BasicLoadRecorder<Spatial>& fine, double part, PassDifference& c);)
template std::vector<double> relative_differences(const BasicSystem<Planar>& system, const PassDifference& c);
template double longest_path(const BasicSystem<Planar>& system, const BasicForceTable<Planar>& table);
PINTLE_IN_SPACE(template double longest_path(const BasicSystem<Spatial>& system, const BasicForceTable<Spatial>& table);)
template double motion_difference(const BasicSystem<Planar>& system, const BasicForceTable<Planar>& coarse, const BasicForceTable<Planar>& fine);
template DifferenceCurve force_difference_curve(const BasicSystem<Planar>& system, const BasicForceTable<Planar>& coarse, const BasicForceTable<Planar>& fine);
template DifferenceCurve motion_difference_curve(const BasicSystem<Planar>& system, const BasicForceTable<Planar>& coarse, const BasicForceTable<Planar>& fine);
template double largest_ringing_loss(const BasicSystem<Planar>& system, const PassDifference& difference, BasicRingingLoss<Planar>& ringing, double tolerance);
template std::vector<double> force_horizons(const BasicSystem<Planar>& system, const BasicForceTable<Planar>& coarse, const BasicForceTable<Planar>& fine, double share, double tolerance);
PINTLE_IN_SPACE(template PassDifference difference_of_passes(const BasicSystem<Spatial>& system, const BasicForceTable<Spatial>& coarse, const BasicForceTable<Spatial>& fine, double until, double share);)
PINTLE_IN_SPACE(template std::vector<double> relative_differences(const BasicSystem<Spatial>& system, const PassDifference& c);)
PINTLE_IN_SPACE(template double motion_difference(const BasicSystem<Spatial>& system, const BasicForceTable<Spatial>& coarse, const BasicForceTable<Spatial>& fine);)
PINTLE_IN_SPACE(template DifferenceCurve force_difference_curve(const BasicSystem<Spatial>& system, const BasicForceTable<Spatial>& coarse, const BasicForceTable<Spatial>& fine);)
PINTLE_IN_SPACE(template DifferenceCurve motion_difference_curve(const BasicSystem<Spatial>& system, const BasicForceTable<Spatial>& coarse, const BasicForceTable<Spatial>& fine);)
PINTLE_IN_SPACE(template double largest_ringing_loss(const BasicSystem<Spatial>& system, const PassDifference& difference, BasicRingingLoss<Spatial>& ringing, double tolerance);)
PINTLE_IN_SPACE(template std::vector<double> force_horizons(const BasicSystem<Spatial>& system, const BasicForceTable<Spatial>& coarse, const BasicForceTable<Spatial>& fine, double share, double tolerance);)
template void state_errors(const BasicSystem<Planar>& system, const PassDifference& difference, double share, const BasicLeastError<Planar>& least, Trajectory& out);
template void state_errors_until(const BasicSystem<Planar>& system, const BasicForceTable<Planar>& coarse, const BasicForceTable<Planar>& fine, const std::vector<double>& until, double share, const BasicLeastError<Planar>& least, std::vector<LoadSummary>& joints);
PINTLE_IN_SPACE(template void state_errors_until(const BasicSystem<Spatial>& system, const BasicForceTable<Spatial>& coarse, const BasicForceTable<Spatial>& fine, const std::vector<double>& until, double share, const BasicLeastError<Spatial>& least, std::vector<LoadSummary>& joints);)
PINTLE_IN_SPACE(template void state_errors(const BasicSystem<Spatial>& system, const PassDifference& difference, double share, const BasicLeastError<Spatial>& least, Trajectory& out);)

}  // namespace pintle
