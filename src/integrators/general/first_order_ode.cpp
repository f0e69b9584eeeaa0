#include "integrators/general/first_order_ode.h"

#include <algorithm>
#include <cmath>

namespace pintle {

FirstOrderOde::FirstOrderOde(const System& system, Energies energies)
    : system_(system), energies_(energies == Energies::kAppended), force_evaluator_(system), tangents_(system), at_(zero_state(system)),
      couplings_(system.bodies.size()) {
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
  if (!energies_) return;
  y[2 * half] = state.dissipated;
  y[2 * half + 1] = state.supplied;
}

void FirstOrderOde::unflatten(double t, const double* y, State& state) const {
  const int half = motion_size() / 2;
  state.t = t;
  for (int i = 0; i < system_.n_bodies(); ++i)
    for (int k = 0; k < 3; ++k) {
      state.q[i][k] = y[3 * i + k];
      state.v[i][k] = y[half + 3 * i + k];
    }
  if (!energies_) return;
  state.dissipated = y[2 * half];
  state.supplied = y[2 * half + 1];
}

bool FirstOrderOde::rate(double t, const double* y, double* dy) {
  unflatten(t, y, at_);
  if (energies_) force_evaluator_.complete(at_);
  else system_.accelerations(t, at_.q, at_.v, at_.a);
  const int half = motion_size() / 2;
  double sum = 0;
  for (int i = 0; i < system_.n_bodies(); ++i)
    for (int k = 0; k < 3; ++k) {
      dy[3 * i + k] = at_.v[i][k];
      dy[half + 3 * i + k] = at_.a[i][k];
      sum += at_.v[i][k] + at_.a[i][k];
    }
  if (energies_) {
    dy[2 * half] = at_.loss_power;
    dy[2 * half + 1] = at_.supply_power;
    sum += at_.loss_power + at_.supply_power;
  }
  return std::isfinite(sum);
}

void FirstOrderOde::linearize(double t, const double* y) {
  unflatten(t, y, at_);
  tangents_.find(t, at_.q, at_.v);
}

}  // namespace pintle
