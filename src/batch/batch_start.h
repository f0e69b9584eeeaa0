// The start of variants on their joints' slow motion, from assembled positions and velocities. Does what start_forces and
// move_onto_slow_manifold do if no joint is soft, with a number of passes that does not depend on their results: theory/assembly
// sections 3 and 4.
#pragma once

#include <algorithm>

#include "batch/batch_projector.h"
#include "dynamics/inverse_dynamics.h"
#include "linalg/chebyshev_nodes.h"

namespace pintle::PINTLE_BATCH {

class BatchStart {
 public:
  explicit BatchStart(BatchMechanism& mechanism)
      : mechanism_(mechanism), projector_(mechanism), m_(mechanism.n_bodies() + 1), r_(mechanism.joints.size()),
        Q_(mechanism.n_bodies() + 1), wanted_(mechanism.joints.size()), dv_(mechanism.n_bodies() + 1),
        begin_(mechanism.n_bodies(), mechanism.joints.size()), now_(begin_) {
    for (Curve* c : {&gap_, &rate_, &accel_, &next_})
      for (VariantVecs& x : *c) x.resize(mechanism.joints.size());
    for (auto* k : {&kq_, &kv_})
      for (VariantVecs& x : *k) x.resize(mechanism.n_bodies() + 1);
  }

  /// Completes `state`, whose positions and velocities are given, at t = 0; gaps are smooth over `span`. `change`: the
  /// relative change that another sweep would make, about the square of that of the last one.
  void find(BatchState& state, const VariantLanes& span, int sweeps, VariantLanes& change) {
    preload(state);
    for (Curve* c : {&gap_, &rate_, &accel_})
      for (VariantVecs& x : *c) std::fill(x.begin(), x.end(), VariantVec{});
    for (int i = 0; i < sweeps; ++i) sweep(state, span, i > 0, change);
    put(0, state);
    move_onto_gaps(state);
    balance(state);
  }

 private:
  static constexpr int kNodes = ChebyshevNodes::kN;
  static constexpr int kPreloads = 2, kClosing = 2;
  using Curve = std::array<VariantVecs, kNodes>;

  void read(const BatchState& state) { PINTLE_BATCH::read(mechanism_, state.t, state.q, state.v, m_, r_); }

  // The frequency above which modes are held, under the loads Q_.
  PINTLE_LANES VariantLanes holding_frequency(const BatchState& state) const {
    VariantLanes slowest(1e300);
    for (std::size_t j = 0; j < r_.size(); ++j) {
      const BatchJoint& joint = mechanism_.joints[j];
      const GapMap<VariantLanes>& g = r_[j].map;
      const VariantLanes c2 = g.c * g.c, s2 = g.s * g.s;
      VariantVec mobility{};
      const auto add = [&](int body, const VariantLanes& x, const VariantLanes& y) {
        if (body == static_cast<int>(mechanism_.n_bodies())) return;
        const VariantVec& over = mechanism_.bodies[body].over_mass;
        const VariantLanes u = g.s * x - g.c * y, w = g.c * x + g.s * y;  // displacement with rotation, along and across
        mobility[0] += (c2 + s2) * over[0] + u * u * over[2];
        mobility[1] += (c2 + s2) * over[1] + w * w * over[2];
        mobility[2] += over[2];
      };
      add(joint.a, g.ax, g.ay);
      add(joint.b, g.bx, g.by);
      for (int k = 0; k < 3; ++k)
        if (joint.stiff[k]) slowest = smaller(slowest, joint.k[k] * mobility[k]);
    }
    VariantLanes mu;
    for (int lane = 0; lane < kVariantLanes; ++lane) {
      double load = 0, mass = 0, size = 1e-3;
      for (std::size_t i = 0; i < mechanism_.n_bodies(); ++i) {
        const VariantVec& over = mechanism_.bodies[i].over_mass;
        load += std::hypot(Q_[i][0][lane], Q_[i][1][lane]);
        mass += 1 / over[0][lane];
        size = std::max({size, std::abs(state.q[i][0][lane]), std::abs(state.q[i][1][lane]), std::sqrt(over[0][lane] / over[2][lane])});
      }
      mu.set(lane, held_above(std::sqrt(slowest[lane]), load / mass, size));
    }
    return mu;
  }

  // Accelerations and forces for which the gaps accelerate as given in the state. assembly Eqs. (3.1), (3.2).
  void find_forces(BatchState& state) {
    find_accelerations(state);
    for (int pass = 0; pass < kClosing; ++pass) projector_.improve_forces(Q_, state.a, state.force);
  }
  void find_accelerations(BatchState& state) {
    read(state);
    mechanism_.external(state.t, m_, Q_);
    projector_.prepare(r_, holding_frequency(state));
    for (std::size_t i = 0; i < mechanism_.n_bodies(); ++i)
      for (int k = 0; k < 3; ++k) state.a[i][k] = Q_[i][k] * mechanism_.bodies[i].over_mass[k];
    for (int pass = 0; pass < kClosing; ++pass) {
      find_missing(mechanism_, r_, state.accel, &BatchJointKinematics::bias, state.a, wanted_);
      projector_.close(wanted_, state.a);
    }
  }

  PINTLE_PART void find_gaps(BatchState& state) const {
    for (std::size_t j = 0; j < r_.size(); ++j) {
      const BatchJoint& joint = mechanism_.joints[j];
      for (int k = 0; k < 3; ++k)
        if (joint.stiff[k]) state.gap[j][k] = -(joint.over_k[k] * (state.force[j][k] + joint.c[k] * state.rate[j][k]));
    }
  }

  // Eq. (3.4).
  void move_onto_gaps(BatchState& state) {
    for (int pass = 0; pass < kClosing; ++pass) {
      read(state);
      if (pass == 0) {
        mechanism_.external(state.t, m_, Q_);
        projector_.prepare(r_, holding_frequency(state));
      }
      for (std::size_t j = 0; j < r_.size(); ++j)
        for (int k = 0; k < 3; ++k) wanted_[j][k] = state.gap[j][k] - r_[j].gap[k];
      projector_.close(wanted_, state.q);
    }
    read(state);
    std::fill(dv_.begin(), dv_.end(), VariantVec{});
    for (int pass = 0; pass < kClosing; ++pass) {
      find_missing(mechanism_, r_, state.rate, &BatchJointKinematics::rate, dv_, wanted_);
      projector_.close(wanted_, dv_);
    }
    for (std::size_t i = 0; i < mechanism_.n_bodies(); ++i)
      for (int k = 0; k < 3; ++k) state.v[i][k] += dv_[i][k];
  }

  // The laws' forces at the gaps, and all accelerations.
  void balance(BatchState& state) {
    read(state);
    mechanism_.external(state.t, m_, state.a);
    for (std::size_t j = 0; j < r_.size(); ++j) {
      const BatchJoint& joint = mechanism_.joints[j];
      for (int k = 0; k < 3; ++k) {
        if (joint.stiff[k]) continue;
        state.gap[j][k] = r_[j].gap[k];
        state.rate[j][k] = r_[j].rate[k];
      }
      state.force[j] = BatchMechanism::law_force(joint, state.gap[j], state.rate[j]);
      BatchMechanism::add_force(joint, r_[j].map, state.force[j], state.a);
    }
    for (std::size_t i = 0; i < mechanism_.n_bodies(); ++i)
      for (int k = 0; k < 3; ++k) state.a[i][k] *= mechanism_.bodies[i].over_mass[k];
    state.a.back() = {};
    for (std::size_t j = 0; j < r_.size(); ++j) {
      const VariantVec e = BatchMechanism::gap_change(mechanism_.joints[j], r_[j].map, state.a);
      for (int k = 0; k < 3; ++k) state.accel[j][k] = r_[j].bias[k] + e[k];
    }
  }

  void preload(BatchState& state) {
    state.t = VariantLanes(0.0);
    read(state);
    for (std::size_t j = 0; j < r_.size(); ++j) {
      state.gap[j] = r_[j].gap;
      state.force[j] = BatchMechanism::law_force(mechanism_.joints[j], r_[j].gap, r_[j].rate);
      state.rate[j] = state.accel[j] = {};
    }
    for (int pass = 0; pass < kPreloads; ++pass) {
      find_forces(state);
      find_gaps(state);
      move_onto_gaps(state);
    }
    balance(state);
  }

  void put(int node, BatchState& at) const {
    at.gap = gap_[node];
    at.rate = rate_[node];
    at.accel = accel_[node];
  }

  PINTLE_PART void set_accel(BatchState& at, double s) const {
    const auto w = nodes_.weights(s);
    for (std::size_t j = 0; j < at.accel.size(); ++j)
      for (int i = 0; i < 3; ++i) {
        VariantLanes sum(0.0);
        for (int k = 0; k < kNodes; ++k) sum += w[k] * accel_[k][j][i];
        at.accel[j][i] = sum;
      }
  }

  // The motion with the present gap accelerations, and the gaps from the forces that it requires. assembly Eqs. (4.1)-(4.4).
  void sweep(const BatchState& start, const VariantLanes& span, bool swept, VariantLanes& change) {
    begin_ = start;
    BatchState& at = begin_;
    put(0, at);
    if (swept) move_onto_gaps(at);
    for (int node = 0; node < kNodes; ++node) {
      if (node > 0) follow(at, start.t, span, nodes_.x[node - 1], nodes_.x[node]);
      at.accel = accel_[node];
      at.rate = rate_[node];
      find_forces(at);
      find_gaps(at);
      next_[node] = at.gap;
    }
    VariantLanes size(1e-300);
    change = VariantLanes(0.0);
    for (int node = 0; node < kNodes; ++node)
      for (std::size_t j = 0; j < at.gap.size(); ++j) {
        VariantLanes moved(0.0), whole(0.0);
        for (int k = 0; k < 3; ++k) {
          const VariantLanes f = mechanism_.joints[j].k[k] * next_[node][j][k], d = f - mechanism_.joints[j].k[k] * gap_[node][j][k];
          whole += f * f;
          moved += d * d;
        }
        change = larger(change, moved);
        size = larger(size, whole);
      }
    gap_.swap(next_);
    differentiate(span);
    change *= reciprocal(size);  // ratio of squares: a sweep's change over the previous one is about the previous relative change
  }

  // One classical Runge-Kutta step, from a node where forces are known.
  void follow(BatchState& at, const VariantLanes& t0, const VariantLanes& span, double s0, double s1) {
    constexpr std::array<double, 4> c{0, 0.5, 0.5, 1};
    const VariantLanes h = (s1 - s0) * span;
    const std::size_t n = mechanism_.n_bodies();
    kq_[0] = at.v;  // what was found at the node
    kv_[0] = at.a;
    for (int stage = 1; stage < 4; ++stage) {
      now_ = at;
      now_.t = t0 + (s0 + c[stage] * (s1 - s0)) * span;
      const VariantLanes d = c[stage] * h;
      for (std::size_t i = 0; i < n; ++i)
        for (int k = 0; k < 3; ++k) {
          now_.q[i][k] += d * kq_[stage - 1][i][k];
          now_.v[i][k] += d * kv_[stage - 1][i][k];
        }
      set_accel(now_, s0 + c[stage] * (s1 - s0));
      find_accelerations(now_);
      kq_[stage] = now_.v;
      kv_[stage] = now_.a;
    }
    at.t = t0 + s1 * span;
    const VariantLanes sixth = (1.0 / 6) * h;
    for (std::size_t i = 0; i < n; ++i)
      for (int k = 0; k < 3; ++k) {
        at.q[i][k] += sixth * (kq_[0][i][k] + 2 * kq_[1][i][k] + 2 * kq_[2][i][k] + kq_[3][i][k]);
        at.v[i][k] += sixth * (kv_[0][i][k] + 2 * kv_[1][i][k] + 2 * kv_[2][i][k] + kv_[3][i][k]);
      }
  }

  PINTLE_PART void differentiate(const VariantLanes& span) {
    const VariantLanes over = reciprocal(span);
    for (std::size_t j = 0; j < r_.size(); ++j)
      for (const auto& [from, to] : {std::pair{&gap_, &rate_}, std::pair{&rate_, &accel_}})
        for (int i = 0; i < kNodes; ++i)
          for (int c = 0; c < 3; ++c) {
            VariantLanes sum(0.0);
            for (int k = 0; k < kNodes; ++k) sum += nodes_.D(i, k) * (*from)[k][j][c];
            (*to)[i][j][c] = over * sum;
          }
  }

  BatchMechanism& mechanism_;
  BatchProjector projector_;
  std::vector<BatchMotion> m_;
  std::vector<BatchJointKinematics> r_;
  VariantVecs Q_, wanted_, dv_;
  ChebyshevNodes nodes_;
  Curve gap_, rate_, accel_, next_;
  BatchState begin_, now_;
  std::array<VariantVecs, 4> kq_, kv_;
};

}  // namespace pintle::PINTLE_BATCH
