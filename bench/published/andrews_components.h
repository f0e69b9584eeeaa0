// Andrews' squeezer in the coordinates of the Test Set for IVP Solvers: 7 angles, their rates and accelerations, 6 multipliers.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <stdexcept>

#include "integrators/methods.h"
#include "start/start.h"

namespace pintle::published {

/// A quarter of critical damping for the lightest body, as in the collection's file at 1e8 N/m [N*s/m].
inline double damping_at(double k) {
  return 300 * std::sqrt(k / 1e8);
}

/// The components of a state of mechanisms/andrews.toml.
using Components = std::array<double, 27>;
inline Components components(const System& system, const State& s) {
  Components out{};
  const auto put = [&out](std::size_t at, const Vecs& x) {
    const auto angle = [&x](int body) { return x[static_cast<std::size_t>(body - 1)][2]; };
    const std::array<double, 7> seven{angle(1), angle(2) - angle(1), angle(3), angle(4) - angle(5), angle(5), angle(6) - angle(7), angle(7)};
    std::copy(seven.begin(), seven.end(), out.begin() + static_cast<long>(at));
  };
  put(0, s.q);
  put(7, s.v);
  put(14, s.a);
  std::vector<Planar::Motion> m;
  system.motions(s.q, s.v, m);
  const std::array<int, 3> pins{2, 3, 4};  // E3, E4, E6
  for (std::size_t i = 0; i < 3; ++i) {
    const auto j = static_cast<std::size_t>(pins[i]);
    const Planar::Point force = system.pose(system.joints[j].at, m).world_force(s.force[j]);
    out[21 + 2 * i] = force.x();
    out[22 + 2 * i] = force.y();
  }
  return out;
}

/// Results at the end of the model's duration.
struct End {
  Components y{};
  std::uint64_t steps = 0;
};

inline End end_of(const Model& model, double tolerance) {
  const Assembly assembly = start_of_run(model);
  const System& system = assembly.system;
  const State& start = assembly.state;
  MethodChoice choice = resolve_method(model.simulate);
  choice.stages = 5;
  const auto stepper = make_stepper(system, choice, tolerance);
  const double end = model.simulate.duration;
  stepper->start(start, 1e-4 * end);
  while (stepper->state().t < end * (1 - 1e-14))
    if (!stepper->step(end)) throw std::runtime_error(stepper->failure());
  return {components(system, stepper->state()), stepper->counters().steps};
}

/// The error of compliance is proportional to 1/k: extrapolates from two stiffnesses, the second ten times the first.
inline Components extrapolated(const Components& soft, const Components& stiff) {
  Components out{};
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = (10 * stiff[i] - soft[i]) / 9;
  return out;
}

}  // namespace pintle::published
