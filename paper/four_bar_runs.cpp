#include "paper/four_bar_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pintle::paper {
namespace {

constexpr double kSpeed = 10;  // of the crank at the start [rad/s]

double at(const Trajectory& run, std::size_t row, const std::string& name) {
  return run.at(row, static_cast<std::size_t>(run.column(name)));
}

// By pin.
std::array<double, 4> errors_at(const Trajectory& run, std::size_t row, const IdealFourBar& ideal) {
  std::array<double, 4> errors{};
  for (std::size_t j = 0; j < 4; ++j) {
    const std::string pin = kFourBarPins[j];
    errors[j] = std::hypot(at(run, row, pin + ".fx[world]") - ideal.force[j].x, at(run, row, pin + ".fy[world]") - ideal.force[j].y) /
                ideal_peaks()[j];
  }
  return errors;
}

IdealFourBar ideal_at(const Trajectory& run, std::size_t row, double degrees) {
  return ideal_four_bar(at(run, row, "body.crank.angle"), degrees * kDegree, kSpeed);
}

}  // namespace

Model four_bar(const Bearing& bearing, double degrees) {
  Model model = mechanism("four_bar", {fmt::format("parameters.theta={} deg", degrees)});
  set_bearings(model, bearing);
  model.simulate.tolerance = 1e-6;
  return model;
}

const std::array<double, 4>& ideal_peaks() {
  static const std::array<double, 4> peaks = [] {
    std::array<double, 4> largest_force{};
    for (int i = 0; i < 3600; ++i) {
      const IdealFourBar ideal = ideal_four_bar(0.1 * i * kDegree, 60 * kDegree, kSpeed);
      for (std::size_t j = 0; j < 4; ++j)
        largest_force[j] = std::max(largest_force[j], std::hypot(ideal.force[j].x, ideal.force[j].y));
    }
    return largest_force;
  }();
  return peaks;
}

double force_error(const Trajectory& run, std::size_t row, double degrees) {
  const std::array<double, 4> errors = errors_at(run, row, ideal_at(run, row, degrees));
  return *std::max_element(errors.begin(), errors.end());
}

FromIdeal from_ideal(const Trajectory& run, double degrees, double from) {
  FromIdeal out;
  for (std::size_t row = 0; row < run.n_rows(); ++row) {
    if (run.at(row, 0) < from) continue;
    const IdealFourBar ideal = ideal_at(run, row, degrees);
    const std::array<double, 4> errors = errors_at(run, row, ideal);
    for (std::size_t j = 0; j < 4; ++j) out.by_pin[j] = std::max(out.by_pin[j], errors[j]);
    const double angle3 = std::remainder(at(run, row, "body.coupler.angle") - ideal.theta3, 360 * kDegree),
                 angle4 = std::remainder(at(run, row, "body.follower.angle") - ideal.theta4, 360 * kDegree);
    out.angle = std::max({out.angle, std::abs(angle3), std::abs(angle4)});
    out.speed = std::max({out.speed, std::abs(at(run, row, "body.coupler.spin") - ideal.omega3),
                          std::abs(at(run, row, "body.follower.spin") - ideal.omega4)});
  }
  out.force = *std::max_element(out.by_pin.begin(), out.by_pin.end());
  return out;
}

}  // namespace pintle::paper
