#include "run/pass_difference.h"

#include <algorithm>
#include <cmath>

namespace pintle {
namespace {

constexpr double kNegligible = 1e-4;         // a joint is measured at least by this part of the mechanism's largest force
constexpr double kNegligibleOfMotor = 1e-3;  // a motor by this

double distance(const double* a, const double* b, double radius) {
  return std::max(std::hypot(a[0] - b[0], a[1] - b[1]), 2 * radius * std::abs(std::sin(0.5 * (a[2] - b[2]))));
}

double relative(double error, double peak, double least) { return error / std::max({peak, least, 1e-300}); }

// What the joints of a mechanism are measured by.
struct Measures {
  double force, couple;  // the largest of the mechanism [N], [N*m]
  const System& system;

  Measures(const System& of, const std::vector<double>& peak, const std::vector<double>& peak_couple)
      : force(largest_of(peak)), couple(std::max(largest_of(peak_couple), force * of.largest_radius_of_gyration())), system(of) {}

  double of_joint(std::size_t j, double force_error, double peak, double couple_error, double peak_couple) const {
    const double least = system.joints[j].servo >= 0 ? kNegligibleOfMotor : kNegligible;
    const double of_force = relative(force_error, peak, least * force);
    return system.joints[j].law.lever() == 0 ? std::max(of_force, relative(couple_error, peak_couple, least * couple)) : of_force;
  }
};

// Differences and peaks up to a row.
class Growing {
 public:
  explicit Growing(std::size_t joints) {
    for (auto* x : {&c_.force, &c_.couple, &c_.peak, &c_.peak_couple}) x->assign(joints, 0.0);
  }
  void add_row(const ForceTable& coarse, const ForceTable& fine, std::size_t i) {
    const std::size_t joints = c_.force.size();
    for (std::size_t j = 0; j < joints; ++j) {
      const double *a = &coarse.world[3 * (i * joints + j)], *b = &fine.world[3 * (i * joints + j)];
      c_.peak[j] = std::max(c_.peak[j], std::hypot(b[0], b[1]));
      c_.peak_couple[j] = std::max(c_.peak_couple[j], std::abs(b[2]));
      if (coarse.t[i] != fine.t[i]) continue;
      c_.force[j] = std::max(c_.force[j], std::hypot(a[0] - b[0], a[1] - b[1]));
      c_.couple[j] = std::max(c_.couple[j], std::abs(a[2] - b[2]));
    }
  }
  const PassDifference& so_far() const { return c_; }

 private:
  PassDifference c_;
};

std::size_t common_rows(const ForceTable& coarse, const ForceTable& fine) { return std::min(coarse.t.size(), fine.t.size()); }

}  // namespace

double largest_of(const std::vector<double>& x) { return x.empty() ? 0 : *std::max_element(x.begin(), x.end()); }

PassDifference difference_of_passes(const System& system, const ForceTable& coarse, const ForceTable& fine, double until) {
  Growing growing(system.joints.size());
  for (std::size_t i = 0; i < common_rows(coarse, fine) && fine.t[i] <= until; ++i) growing.add_row(coarse, fine, i);
  return growing.so_far();
}

std::vector<double> relative_differences(const System& system, const PassDifference& c) {
  const Measures measures(system, c.peak, c.peak_couple);
  std::vector<double> out(c.force.size());
  for (std::size_t j = 0; j < out.size(); ++j) out[j] = measures.of_joint(j, c.force[j], c.peak[j], c.couple[j], c.peak_couple[j]);
  return out;
}

DifferenceCurve motion_difference_curve(const System& system, const ForceTable& coarse, const ForceTable& fine) {
  const std::size_t bodies = system.bodies.size();
  DifferenceCurve curve;
  double way = 0;
  for (std::size_t row = 0; row < common_rows(coarse, fine); ++row) {
    double difference = 0;
    for (std::size_t i = 0; i < bodies; ++i) {
      const double radius = system.bodies[i].radius_of_gyration();
      const double* here = &fine.place[3 * (row * bodies + i)];
      way = std::max(way, distance(here, &fine.place[3 * i], radius));
      if (coarse.t[row] == fine.t[row]) difference = std::max(difference, distance(here, &coarse.place[3 * (row * bodies + i)], radius));
    }
    curve.t.push_back(fine.t[row]);
    curve.e.push_back(difference);
  }
  for (double& e : curve.e) e = way > 0 ? e / way : 0;
  return curve;
}

double motion_difference(const System& system, const ForceTable& coarse, const ForceTable& fine) {
  return largest_of(motion_difference_curve(system, coarse, fine).e);
}

DifferenceCurve force_difference_curve(const System& system, const ForceTable& coarse, const ForceTable& fine) {
  const std::size_t joints = system.joints.size();
  const PassDifference whole = difference_of_passes(system, coarse, fine, fine.t.back());
  const Measures measures(system, whole.peak, whole.peak_couple);
  DifferenceCurve curve;
  for (std::size_t i = 0; i < common_rows(coarse, fine); ++i) {
    if (coarse.t[i] != fine.t[i]) continue;
    double e = 0;
    for (std::size_t j = 0; j < joints; ++j) {
      const double *a = &coarse.world[3 * (i * joints + j)], *b = &fine.world[3 * (i * joints + j)];
      e = std::max(e, measures.of_joint(j, std::hypot(a[0] - b[0], a[1] - b[1]), whole.peak[j], std::abs(a[2] - b[2]), whole.peak_couple[j]));
    }
    curve.t.push_back(fine.t[i]);
    curve.e.push_back(e);
  }
  return curve;
}

std::vector<double> force_horizons(const System& system, const ForceTable& coarse, const ForceTable& fine, double share, double tolerance) {
  const std::size_t joints = system.joints.size();
  std::vector<double> horizon(joints, 0.0);
  Growing growing(joints);
  for (std::size_t i = 0; i < common_rows(coarse, fine); ++i) {
    growing.add_row(coarse, fine, i);
    const PassDifference& c = growing.so_far();
    const Measures measures(system, c.peak, c.peak_couple);
    for (std::size_t j = 0; j < joints; ++j)
      if (share * measures.of_joint(j, c.force[j], c.peak[j], c.couple[j], c.peak_couple[j]) <= tolerance) horizon[j] = fine.t[i];
  }
  return horizon;
}

double curve_horizon(const DifferenceCurve& curve, double tolerance) {
  double horizon = 0;
  for (std::size_t i = 0; i < curve.t.size() && curve.e[i] <= tolerance; ++i) horizon = curve.t[i];
  return horizon;
}

}  // namespace pintle
