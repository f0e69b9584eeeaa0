#include "system/state.h"

#include <algorithm>
#include <cmath>

namespace pintle {

void find_gap_accelerations(const System& system, const std::vector<JointKinematics>& r, State& state) {
  for (int j = 0; j < system.n_joints(); ++j) {
    state.gap_accel[j] = r[j].bias;
    add_gap(system.joints[j].at, r[j], state.a, state.gap_accel[j]);
  }
}

void find_law_rates(const System& system, State& state) {
  if (system.n_law_states() == 0) return;
  for (int j = 0; j < system.n_joints(); ++j)
    system.joints[j].law.state_rates(law_point(system, j, state), state.law_rate.data() + system.joints[j].first_state);
}

void rest_laws(const System& system, State& state) {
  state.law_state.assign(system.n_law_states(), 0.0);
  state.law_rate.assign(system.n_law_states(), 0.0);
  if (system.n_law_states() == 0) return;
  for (int j = 0; j < system.n_joints(); ++j)
    system.joints[j].law.rest(law_point(system, j, state), state.law_state.data() + system.joints[j].first_state);
  find_law_rates(system, state);
}

void find_accelerations(const System& system, const std::vector<Planar::Motion>& m, const std::vector<JointKinematics>& r, State& state) {
  system.external(state.t, m, state.a, state.sliding);
  for (int j = 0; j < system.n_joints(); ++j) add_force(system.joints[j].at, r[j], state.force[j], state.a);
  for (int i = 0; i < system.n_bodies(); ++i) state.a[i] = state.a[i].cwiseQuotient(system.bodies[i].mass);
  find_gap_accelerations(system, r, state);
}

double largest_coordinate(const Vecs& x) {
  double across = 1e-3, up = across;
  for (const auto& xi : x) {
    across = std::max(across, std::abs(xi[0]));
    up = std::max(up, std::abs(xi[1]));
  }
  return std::max(across, up);
}

double largest_force(const Vecs& force) {
  double largest = 0;
  for (const auto& f : force) largest = std::max(largest, f.head<2>().norm());
  return largest;
}

bool is_finite(const State& state) {
  const auto finite = [](const Vecs& x) { return std::all_of(x.begin(), x.end(), [](const Planar::Vec& y) { return y.allFinite(); }); };
  const bool laws = std::all_of(state.law_state.begin(), state.law_state.end(), [](double z) { return std::isfinite(z); });
  return std::isfinite(state.t) && laws && finite(state.q) && finite(state.v) && finite(state.a) && finite(state.gap) && finite(state.force);
}

}  // namespace pintle
