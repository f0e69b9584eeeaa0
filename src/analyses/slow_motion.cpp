#include "analyses/slow_motion.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "analyses/curve_nodes.h"
#include "analyses/slow_start.h"

namespace pintle {
namespace {

using S = Planar;

constexpr int kNodes = CurveNodes::kN;
constexpr int kSweeps = 5;
constexpr double kDiverged = 1e300, kConverged = 1e-10;  // relative change of a sweep

using Nodes = CurveNodes;
using Curve = std::array<Vecs, kNodes>;  // one value per joint at every node

class SlowMotion {
 public:
  SlowMotion(const System& system, double span, const State& start)
      : system_(system), span_(span), start_(start), forces_(system) {
    for (auto* c : {&gap_, &rate_, &accel_})
      for (auto& x : *c) x.assign(system.joints.size(), S::Vec::Zero());
  }

  // One sweep: follow the motion with the present gap accelerations; gaps from the forces that it takes. Relative change.
  double sweep() {
    State at = start_;
    for (std::size_t j = 0; j < at.gap.size(); ++j) {
      at.gap[j] = gap_[0][j];
      at.gap_rate[j] = rate_[0][j];
      at.gap_accel[j] = accel_[0][j];
    }
    if (swept_) forces_.move_onto_gaps(at);
    double change = 0, size = 1e-300;
    for (int node = 0; node < kNodes; ++node) {
      if (node > 0) follow(at, nodes_.x[node - 1], nodes_.x[node]);
      set_accel(at, nodes_.x[node]);
      at.gap_rate = rate_[node];
      if (!forces_.find(at)) return kDiverged;
      forces_.carry(at);
      for (std::size_t j = 0; j < at.gap.size(); ++j) {
        const double moved = (weighted(j, at.gap[j]) - weighted(j, gap_[node][j])).norm();
        if (!std::isfinite(moved)) return kDiverged;
        change = std::max(change, moved);
        size = std::max(size, weighted(j, at.gap[j]).norm());
        next_[node].resize(at.gap.size());
        next_[node][j] = at.gap[j];
      }
    }
    gap_ = next_;
    differentiate();
    swept_ = true;
    return change / size;
  }

  void take(State& state) const {
    state.gap = gap_[0];
    state.gap_rate = rate_[0];
    state.gap_accel = accel_[0];
  }

 private:
  // A gap as the force it makes.
  S::Vec weighted(std::size_t j, const S::Vec& gap) const {
    return respond(system_.joints[j].law, start_.gap[j], start_.gap_rate[j]).stiffness * gap;
  }

  void set_accel(State& at, double s) const {
    const auto w = nodes_.weights(s);
    for (std::size_t j = 0; j < at.gap_accel.size(); ++j) {
      at.gap_accel[j].setZero();
      for (int k = 0; k < kNodes; ++k) at.gap_accel[j] += w[k] * accel_[k][j];
    }
  }

  // One classical Runge-Kutta step of the motion whose gap accelerations are given.
  void follow(State& at, double s0, double s1) {
    const double h = span_ * (s1 - s0);
    const State begin = at;
    std::array<Vecs, 4> kq, kv;
    constexpr std::array<double, 4> c{0, 0.5, 0.5, 1};
    for (int stage = 0; stage < 4; ++stage) {
      State now = begin;
      now.t = start_.t + span_ * s0 + c[stage] * h;
      if (stage > 0)
        for (std::size_t i = 0; i < now.q.size(); ++i) {
          now.q[i] += c[stage] * h * kq[stage - 1][i];
          now.v[i] += c[stage] * h * kv[stage - 1][i];
        }
      set_accel(now, s0 + c[stage] * (s1 - s0));
      forces_.find(now);
      kq[stage] = now.v;
      kv[stage] = now.a;
    }
    at.t = start_.t + span_ * s1;
    for (std::size_t i = 0; i < at.q.size(); ++i) {
      at.q[i] += h / 6 * (kq[0][i] + 2 * kq[1][i] + 2 * kq[2][i] + kq[3][i]);
      at.v[i] += h / 6 * (kv[0][i] + 2 * kv[1][i] + 2 * kv[2][i] + kv[3][i]);
    }
  }

  void differentiate() {
    for (std::size_t j = 0; j < system_.joints.size(); ++j)
      for (const auto& [from, to] : {std::pair{&gap_, &rate_}, std::pair{&rate_, &accel_}})
        for (int i = 0; i < kNodes; ++i) {
          S::Vec sum = S::Vec::Zero();
          for (int k = 0; k < kNodes; ++k) sum += nodes_.D(i, k) * (*from)[k][j];
          (*to)[i][j] = sum / span_;
        }
  }

  const System& system_;
  double span_;
  const State& start_;
  ForcesOfMotion forces_;
  Nodes nodes_;
  Curve gap_, rate_, accel_, next_;
  bool swept_ = false;
};

bool is_finite(const State& state) {
  const auto finite = [](const Vecs& x) { return std::all_of(x.begin(), x.end(), [](const S::Vec& y) { return y.allFinite(); }); };
  return finite(state.q) && finite(state.v) && finite(state.a) && finite(state.gap) && finite(state.force);
}

}  // namespace

double settle_on_slow_motion(const System& system, double span, State& state) {
  SlowMotion motion(system, span, state);
  double last = kDiverged;
  std::optional<State> best;
  for (int sweep = 0; sweep < kSweeps && last > kConverged; ++sweep) {
    const double change = motion.sweep();
    if (sweep > 0 && !(change < 0.5 * last)) break;
    if (sweep > 0) {
      State next = state;
      motion.take(next);
      ForcesOfMotion(system).move_onto_gaps(next);
      balance_start(system, next);
      if (!is_finite(next)) break;
      best = std::move(next);
    }
    last = change;
  }
  if (!best) return kDiverged;
  state = std::move(*best);
  return last;
}

}  // namespace pintle
