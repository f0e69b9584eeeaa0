#include "start/slow_manifold.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "dynamics/inverse_dynamics.h"
#include "linalg/chebyshev_nodes.h"
#include "linalg/dense_factors.h"
#include "start/preload.h"

namespace pintle {
namespace {

constexpr int kNodes = ChebyshevNodes::kN;
constexpr int kOrders = 6;               // sweeps in which soft joints follow the motion
constexpr double kSmallForce = 0.05;     // as a fraction of the largest force: lower limit on the force that a change is compared with
constexpr double kMostMismatch = 0.04;   // upper limit, as a fraction of the largest force, on the difference between a law's force and the force that its gap was to carry. Starts of the collection differ by 3e-3 at most; 0.03 is still a good start (a beam whose play takes up a misfit), 0.046 is not (a shaft in a dry bush), oil films differ by 30 and more
constexpr int kHalvings = 30;            // upper limit on the halvings of the interval until the forces' curves are resolved
constexpr double kResolved = 1e-4;       // as a fraction of the forces: a curve is resolved if its last coefficients are below this
constexpr int kLeap = 4;                 // halvings at once if an interval is far from resolved
constexpr double kShortOfMotion = 0.25;  // fraction used of an interval that is just resolved
constexpr double kEager = 0.7;           // step of the motion, as a fraction of the time constant of the fastest resolved joint
constexpr double kMostSteps = 300;       // upper limit on steps of the motion from one node to the next

using Nodes = ChebyshevNodes;
template <class S>
using Curve = std::array<VecsOf<S>, kNodes>;  // one value per joint at every node

template <class S>
class BasicSlowManifold {
 public:
  BasicSlowManifold(const BasicSystem<S>& system, double span, const BasicState<S>& start, const BasicTimeScales<S>& time_scales)
      : system_(system), span_(span), start_(start), time_scales_(time_scales), soft_(time_scales.any_soft()), forces_(system) {
    for (auto* c : {&gap_, &rate_, &accel_})
      for (auto& x : *c) x.assign(system.joints.size(), S::Vec::Zero());
    share_.assign(system.joints.size(), S::Vec::Ones());
    forces_.linearize_nonlinear_laws();
    forces_.keep_states_of(start);
    for (std::size_t j = 0; j < system.joints.size(); ++j)
      if (begins_at_start(j)) put_at_start(j);
  }

  // All joints follow the motion, each by its `share`.
  void go_with_the_motion(const VecsOf<S>& share) {
    share_ = share;
    differentiate();
  }

  // Soft joints move from where they start: overdamped ones as fast as their damping permits, resolved ones by their laws.
  void release() {
    if (!soft_) return;
    released_ = true;
    if (time_scales_.any_resolved()) forces_.leave_to_laws(time_scales_.resolved);
    for (std::size_t j = 0; j < system_.joints.size(); ++j) {
      if (forces_.is_linearized(j)) put_at_start(j);
      else if (!begins_at_start(j))
        for (auto& gap : gap_) gap[j] = soft(j).cwiseProduct(start_.gap[j]);
    }
    differentiate();
    swept_ = true;
    for (std::size_t j = 0; j < start_.gap.size(); ++j) rate_[0][j] += time_scales_.overdamped[j].cwiseProduct(start_.gap_rate[j]);
  }

  // One sweep: follows the motion with the present gap accelerations, and takes new gaps from the forces that it needs. Returns their relative change.
  double sweep() {
    BasicState<S> at = start_;
    put(0, at);
    if (swept_) forces_.move_onto_gaps(at);
    for (int node = 0; node < kNodes; ++node) {
      if (node > 0) follow(at, nodes_.x[node - 1], nodes_.x[node]);
      set_accel(at, nodes_.x[node]);
      at.gap_rate = rate_[node];
      if (!forces_.find(at) || !forces_.find_gaps(at)) return kDiverged;
      next_[node] = at.gap;
      force_[node] = at.force;
    }
    if (released_) follow_overdamped();
    double change = 0, size = 1e-300;
    for (int node = 0; node < kNodes; ++node)
      for (std::size_t j = 0; j < at.gap.size(); ++j) {
        const double moved = (weighted(j, next_[node][j]) - weighted(j, gap_[node][j])).norm();
        if (!std::isfinite(moved)) return kDiverged;
        change = std::max(change, moved);
        size = std::max(size, weighted(j, next_[node][j]).norm());
      }
    gap_ = next_;
    carried_rate_ = rate_[0];
    differentiate();
    swept_ = true;
    return change / size;
  }

  // The start that the sweeps have found. The gap of an overdamped joint is given, so its rate carries the force.
  bool write_start(BasicState<S>& state) {
    put(0, state);
    for (std::size_t j = 0; released_ && j < state.gap.size(); ++j)
      for (int i = 0; i < S::kDof; ++i) {
        if (time_scales_.overdamped[j][i] == 0) continue;
        const BasicResponse<S> now = respond(system_.joints[j].law, state.gap[j], state.gap_rate[j]);
        if (now.damping(i, i) > 0) state.gap_rate[j][i] += (now.force[i] - force_[0][j][i]) / now.damping(i, i);
      }
    BasicInverseDynamics<S>(system_).move_onto_gaps(state);
    balance_start(system_, state);
    return is_finite(state) && mismatch(state) <= kMostMismatch;
  }

  // The gaps at the start and the rates with which they carry its forces.
  void take_carrying(BasicState<S>& state) const {
    put(0, state);
    state.gap_rate = carried_rate_;
  }

  // The largest difference between the forces of the laws and those that the sweeps have found for a start, relative to the largest of the latter. Components
  // that the sweeps leave free, such as the stroke of a fed cylinder, have no force in the sweeps and are not compared.
  double mismatch(const BasicState<S>& state) const {
    double most = 0;
    for (std::size_t j = 0; j < state.force.size(); ++j)
      for (int k = 0; k < S::kDim; ++k)
        if (force_[0][j][k] != 0 && !system_.joints[j].constrained) most = std::max(most, std::abs(state.force[j][k] - force_[0][j][k]));
    return most / std::max(largest_force(force_[0]), 1e-300);
  }

  // Relative size of the last two Chebyshev coefficients of the forces' curves; of the couples' curves where no joint carries a force.
  double unresolved() const {
    const auto part = [&](const auto& part_of) {
      double tail = 0, size = 1e-300;
      for (std::size_t j = 0; j < system_.joints.size(); ++j)
        for (const int end : {kNodes - 1, kNodes - 2}) {
          typename S::Vec sum = S::Vec::Zero();
          for (int n = 0; n < kNodes; ++n) {
            sum += chebyshev_weight(kNodes, end, n) * force_[n][j];
            size = std::max(size, part_of(force_[n][j]).norm());
          }
          tail = std::max(tail, 2.0 / (kNodes - 1) * part_of(sum).norm());
        }
      return tail / size;
    };
    const bool any_force = std::any_of(force_.begin(), force_.end(), [](const VecsOf<S>& force) { return largest_force(force) > 0; });
    return any_force ? part([](const typename S::Vec& f) { return f.template head<S::kDim>(); }) : part([](const typename S::Vec& f) { return f.template tail<S::kDof - S::kDim>(); });
  }

  const VecsOf<S>& gap(int node) const { return gap_[node]; }
  const VecsOf<S>& force(int node) const { return force_[node]; }
  const VecsOf<S>& rate() const { return rate_[0]; }

 private:
  // With a closed gap such a joint would not resist, and no gap could be found for its force.
  bool begins_at_start(std::size_t j) const { return system_.joints[j].law.starts_free(); }
  void put_at_start(std::size_t j) {
    for (auto& gap : gap_) gap[j] = start_.gap[j];
  }

  typename S::Vec soft(std::size_t j) const { return time_scales_.overdamped[j] + time_scales_.resolved[j]; }

  void put(int node, BasicState<S>& at) const {
    at.gap = gap_[node];
    at.gap_rate = rate_[node];
    at.gap_accel = accel_[node];
  }

  // A gap expressed as the force that it causes.
  typename S::Vec weighted(std::size_t j, const typename S::Vec& gap) const {
    return respond(system_.joints[j].law, start_.gap[j], start_.gap_rate[j]).stiffness * gap;
  }

  void set_accel(BasicState<S>& at, double s) const {
    const auto w = nodes_.weights(s);
    for (std::size_t j = 0; j < at.gap_accel.size(); ++j) {
      at.gap_accel[j].setZero();
      for (int k = 0; k < kNodes; ++k) at.gap_accel[j] += w[k] * accel_[k][j];
    }
  }

  // Overdamped gaps from their starting values, by collocation at the other nodes. theory/assembly Eq. (5.6).
  void follow_overdamped() {
    Lu factors;
    for (std::size_t j = 0; j < system_.joints.size(); ++j) {
      std::array<BasicResponse<S>, kNodes> now;
      for (int n = 0; n < kNodes; ++n) now[n] = respond(system_.joints[j].law, gap_[n][j], rate_[n][j]);
      for (int i = 0; i < S::kDof; ++i) {
        if (time_scales_.resolved[j][i] != 0)
          for (auto& gap : next_) gap[j][i] = start_.gap[j][i];
        if (time_scales_.overdamped[j][i] == 0) continue;
        Eigen::MatrixXd A = nodes_.D / span_;
        Eigen::VectorXd b(kNodes);
        for (int n = 0; n < kNodes; ++n) {
          const double k = now[n].stiffness(i, i), c = now[n].damping(i, i);
          A.row(n) *= c;
          A(n, n) += k;
          b[n] = k * gap_[n][j][i] + c * rate_[n][j][i] + now[n].force[i] - force_[n][j][i];
        }
        A.row(0).setZero();
        A(0, 0) = 1;
        b[0] = start_.gap[j][i];
        factors.compute(A);
        b = factors.solve(b);
        for (int n = 0; n < kNodes; ++n) next_[n][j][i] = b[n];
      }
    }
  }

  // Takes short steps where resolved joints follow their laws.
  void follow(BasicState<S>& at, double s0, double s1) {
    const double eager = released_ ? time_scales_.fastest * span_ * (s1 - s0) / kEager : 0;
    const int steps = static_cast<int>(std::clamp(std::ceil(eager), 1.0, kMostSteps));
    for (int i = 0; i < steps; ++i) {
      if (i > 0) accelerate(at, s0 + (s1 - s0) * i / steps);
      runge_kutta(at, s0 + (s1 - s0) * i / steps, s0 + (s1 - s0) * (i + 1) / steps);
    }
  }

  void accelerate(BasicState<S>& at, double s) {
    set_accel(at, s);
    forces_.find_accelerations(at);
  }

  // One classical Runge-Kutta step of the motion with given gap accelerations, from a state whose accelerations are known.
  void runge_kutta(BasicState<S>& at, double s0, double s1) {
    const double h = span_ * (s1 - s0);
    auto& [begin, now, kq, kv] = work_;
    begin = at;
    constexpr std::array<double, 4> c{0, 0.5, 0.5, 1};
    kq[0] = begin.v;
    kv[0] = begin.a;
    for (int stage = 1; stage < 4; ++stage) {
      now = begin;
      now.t = start_.t + span_ * s0 + c[stage] * h;
      for (std::size_t i = 0; i < now.q.size(); ++i) {
        now.q[i] = S::moved(begin.q[i], c[stage] * h * kq[stage - 1][i]);
        now.v[i] += c[stage] * h * kv[stage - 1][i];
      }
      accelerate(now, s0 + c[stage] * (s1 - s0));
      kq[stage].resize(now.v.size());
      for (std::size_t i = 0; i < now.v.size(); ++i) kq[stage][i] = S::rate_of_increment(c[stage] * h * kq[stage - 1][i], now.v[i]);
      kv[stage] = now.a;
    }
    at.t = start_.t + span_ * s1;
    for (std::size_t i = 0; i < at.q.size(); ++i) {
      at.q[i] = S::moved(begin.q[i], h / 6 * (kq[0][i] + 2 * kq[1][i] + 2 * kq[2][i] + kq[3][i]));
      at.v[i] += h / 6 * (kv[0][i] + 2 * kv[1][i] + 2 * kv[2][i] + kv[3][i]);
    }
  }

  void differentiate() {
    for (std::size_t j = 0; j < system_.joints.size(); ++j) {
      for (const auto& [from, to] : {std::pair{&gap_, &rate_}, std::pair{&rate_, &accel_}})
        for (int i = 0; i < kNodes; ++i) {
          typename S::Vec sum = S::Vec::Zero();
          for (int k = 0; k < kNodes; ++k) sum += nodes_.D(i, k) * (*from)[k][j];
          (*to)[i][j] = share_[j].cwiseProduct(sum) / span_;
        }
      if (!released_) continue;
      for (auto& rate : rate_) rate[j] += time_scales_.resolved[j].cwiseProduct(start_.gap_rate[j]);
    }
  }

  const BasicSystem<S>& system_;
  double span_;
  const BasicState<S>& start_;
  const BasicTimeScales<S>& time_scales_;
  bool soft_, released_ = false;
  BasicInverseDynamics<S> forces_;
  Nodes nodes_;
  Curve<S> gap_, rate_, accel_, next_, force_;
  VecsOf<S> share_, carried_rate_;
  struct {
    BasicState<S> begin, now;
    std::array<VecsOf<S>, 4> kq, kv;
  } work_;  // kept between steps: at 100,000 bodies fresh memory costs as much as the step
  bool swept_ = false;
};

// How far soft joints may follow the motion, theory/assembly Eq. (5.4): entirely where their own dynamics is faster
// than the changes of their force, not at all where it is slower. Fast ones follow it entirely.
template <class S>
VecsOf<S> shares(const BasicTimeScales<S>& time_scales, const BasicSlowManifold<S>& motion, const BasicSystem<S>& system) {
  const VecsOf<S> &force = motion.force(0), &gap = motion.gap(0), &rate = motion.rate();
  VecsOf<S> share(force.size());
  const double largest = largest_force(force), couple = std::max(largest_couple<S>(force), largest * system.largest_radius_of_gyration());
  for (std::size_t j = 0; j < share.size(); ++j) {
    const typename S::Mat K = respond(system.joints[j].law, gap[j], S::Vec::Zero()).stiffness;
    const typename S::Vec change = K * rate[j];
    const auto share_of = [&](double now, double least, double per_second, double own) {
      const double x = per_second / (own * std::max({now, kSmallForce * least, 1e-300}));
      return 1 / (1 + x * x * x * x);
    };
    const typename S::Vec &own = time_scales.slow_rate[j], soft = time_scales.overdamped[j] + time_scales.resolved[j];
    for (int i = 0; i < S::kDof; ++i) {
      share[j][i] = 1;
      if (soft[i] == 0) continue;
      share[j][i] = i < S::kDim ? share_of(force[j].template head<S::kDim>().norm(), largest, change.template head<S::kDim>().norm(), own[i])
                          : share_of(force[j].template tail<S::kDof - S::kDim>().norm(), couple, change.template tail<S::kDof - S::kDim>().norm(), own[i]);
    }
  }
  return share;
}

// How often to halve an interval whose curves have this unresolved part: each halving reduces it by about two to the power of the number of nodes.
int halvings_for(double unresolved) {
  return unresolved < 1 ? 1 + static_cast<int>(std::log2(unresolved / kResolved) / kNodes) : kLeap;
}

}  // namespace

template <class S>
double span_of_motion(const BasicSystem<S>& system, const BasicState<S>& state, double longest) {
  const BasicTimeScales<S> time_scales = all_fast(system);
  const double whole = std::exp2(std::ceil(std::log2(longest)));
  int too_long = -1, resolved = kHalvings;  // bounds on the number of halvings
  for (int next = 0; resolved - too_long > 1;) {
    BasicSlowManifold<S> motion(system, std::ldexp(whole, -next), state, time_scales);
    const double rest = motion.sweep() < kDiverged ? motion.unresolved() : kDiverged;
    (rest < kResolved ? resolved : too_long) = next;
    next = resolved < kHalvings ? (too_long + resolved) / 2 : std::min(too_long + halvings_for(rest), kHalvings - 1);
  }
  return resolved < kHalvings ? kShortOfMotion * std::ldexp(whole, -resolved) : 0;
}

template <class S>
BasicSoftStart<S> place_soft_joints(const BasicSystem<S>& system, const BasicTimeScales<S>& time_scales, double span, BasicState<S>& state) {
  BasicSlowManifold<S> motion(system, span, state, time_scales);
  BasicSoftStart<S> out;
  if (motion.sweep() >= kDiverged) return out;
  out.share = shares(time_scales, motion, system);
  motion.go_with_the_motion(out.share);
  std::optional<BasicState<S>> best;
  for (int sweep = 0; sweep < kOrders && out.change > kConverged; ++sweep) {
    const double change = motion.sweep();
    if (!(change < 0.5 * out.change)) break;
    BasicState<S> next = state;
    motion.take_carrying(next);
    BasicInverseDynamics<S>(system).move_onto_gaps(next);
    balance_start(system, next);
    if (!is_finite(next) || motion.mismatch(next) > kMostMismatch) break;
    best = std::move(next);
    out.change = change;
  }
  out.placed = best.has_value();
  if (best) state = std::move(*best);
  return out;
}

template <class S>
double move_onto_slow_manifold(const BasicSystem<S>& system, const BasicTimeScales<S>& time_scales, double span, BasicState<S>& state) {
  BasicSlowManifold<S> motion(system, span, state, time_scales);
  motion.release();
  return sweep_onto(motion, state);
}

template double span_of_motion(const BasicSystem<Planar>& system, const BasicState<Planar>& state, double longest);
template BasicSoftStart<Planar> place_soft_joints(const BasicSystem<Planar>& system, const BasicTimeScales<Planar>& time_scales, double span, BasicState<Planar>& state);
template double move_onto_slow_manifold(const BasicSystem<Planar>& system, const BasicTimeScales<Planar>& time_scales, double span, BasicState<Planar>& state);
PINTLE_IN_SPACE(template double span_of_motion(const BasicSystem<Spatial>& system, const BasicState<Spatial>& state, double longest);)
PINTLE_IN_SPACE(template BasicSoftStart<Spatial> place_soft_joints(const BasicSystem<Spatial>& system, const BasicTimeScales<Spatial>& time_scales, double span, BasicState<Spatial>& state);)
PINTLE_IN_SPACE(template double move_onto_slow_manifold(const BasicSystem<Spatial>& system, const BasicTimeScales<Spatial>& time_scales, double span, BasicState<Spatial>& state);)

}  // namespace pintle
