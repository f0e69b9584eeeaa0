#include "integrators/general/first_order_ode.h"

#include <algorithm>
#include <cmath>

namespace pintle {

FirstOrderOde::FirstOrderOde(const System& system, Energies energies)
    : system_(system), energies_(energies == Energies::kAppended), force_evaluator_(system), tangents_(system), at_(zero_state(system)),
      couplings_(system.bodies.size()) {
  const std::vector<SwitchingFunction>& functions = system.switching_functions();
  if (std::any_of(functions.begin(), functions.end(), [](const SwitchingFunction& f) { return f.law_has_states; })) n_roots_ = static_cast<int>(functions.size());
  const BlockPattern& p = system.pattern();
  for (int i = 0; i < system.n_bodies(); ++i) couplings_[i].push_back({i, tangents_.place(i, i)});
  for (int k = 0; k < p.n(); ++k)
    for (int a = p.first(k); a < p.first(k + 1); ++a) {
      const int i = p.row_at(k), j = p.row_at(p.column(a));
      couplings_[j].push_back({i, tangents_.place(i, j)});
      couplings_[i].push_back({j, tangents_.place(j, i)});
    }
  for (auto& column : couplings_)
    std::sort(column.begin(), column.end(), [](const Coupling& a, const Coupling& b) { return a.row < b.row; });
}

void FirstOrderOde::flatten(const State& state, double* y) const {
  const int half = motion_size() / 2;
  for (int i = 0; i < system_.n_bodies(); ++i)
    for (int k = 0; k < 3; ++k) {
      y[3 * i + k] = state.q[i][k];
      y[half + 3 * i + k] = state.v[i][k];
    }
  std::copy(state.law_state.begin(), state.law_state.end(), y + 2 * half);
  if (!energies_) return;
  y[state_size()] = state.dissipated;
  y[state_size() + 1] = state.supplied;
}

void FirstOrderOde::unflatten(double t, const double* y, State& state) const {
  const int half = motion_size() / 2;
  state.t = t;
  for (int i = 0; i < system_.n_bodies(); ++i)
    for (int k = 0; k < 3; ++k) {
      state.q[i][k] = y[3 * i + k];
      state.v[i][k] = y[half + 3 * i + k];
    }
  state.law_state.assign(y + 2 * half, y + state_size());
  if (!energies_) return;
  state.dissipated = y[state_size()];
  state.supplied = y[state_size() + 1];
}

void FirstOrderOde::find_roots(double t, const double* y, double* value) {
  unflatten(t, y, at_);
  force_evaluator_.find_roots(at_, value);
}

bool FirstOrderOde::rate(double t, const double* y, double* dy) {
  unflatten(t, y, at_);
  if (energies_) force_evaluator_.complete(at_);
  else system_.accelerations(t, at_.q, at_.v, at_.a, at_.law_state.data(), at_.law_rate.data());
  const int half = motion_size() / 2;
  double sum = 0;
  for (int i = 0; i < system_.n_bodies(); ++i)
    for (int k = 0; k < 3; ++k) {
      dy[3 * i + k] = at_.v[i][k];
      dy[half + 3 * i + k] = at_.a[i][k];
      sum += at_.v[i][k] + at_.a[i][k];
    }
  for (std::size_t z = 0; z < at_.law_rate.size(); ++z) sum += dy[2 * half + static_cast<int>(z)] = at_.law_rate[z];
  if (energies_) {
    dy[state_size()] = at_.loss_power;
    dy[state_size() + 1] = at_.supply_power;
    sum += at_.loss_power + at_.supply_power;
  }
  return std::isfinite(sum);
}

void FirstOrderOde::linearize(double t, const double* y) {
  unflatten(t, y, at_);
  tangents_.find(t, at_.q, at_.v, at_.law_state);
}

Eigen::MatrixXd FirstOrderOde::accelerations_by_state(const ForceTangents::StateTangents& at, int side) const {
  const Placement& place = system_.joints[at.joint].at;
  Eigen::MatrixXd by_state(3, at.law.n);
  for (int z = 0; z < at.law.n; ++z)
    for (int k = 0; k < 3; ++k) by_state(k, z) = at.law.force_by_state[k][z];
  return inverse_mass(side == 0 ? place.a : place.b) * (at.G[side].transpose() * by_state);
}

Eigen::MatrixXd FirstOrderOde::rates_by_motion(const ForceTangents::StateTangents& at, int side, bool velocities) {
  Eigen::MatrixXd by_gap(at.law.n, 3), by_rate(at.law.n, 3);
  for (int z = 0; z < at.law.n; ++z)
    for (int k = 0; k < 3; ++k) {
      by_gap(z, k) = at.law.by_gap[z][k];
      by_rate(z, k) = at.law.by_rate[z][k];
    }
  if (velocities) return by_rate * at.G[side];
  return by_gap * at.G[side] + by_rate * at.rate_by_q[side];
}

}  // namespace pintle
