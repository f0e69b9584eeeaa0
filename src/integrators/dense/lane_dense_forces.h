// Instances of DenseForces: one instant of a step per lane. Included by dense_forces.cpp alone.
#pragma once

#include <algorithm>
#include <cmath>
#include <variant>

#include "base/cubic_hermite.h"
#include "integrators/absolute/pose_blocks.h"
#include "integrators/dense/dense_forces.h"
#include "integrators/dense/gap_at_nodes.h"
#include "integrators/load_scale.h"
#include "integrators/radau/stage_lanes.h"
#include "integrators/radau/step_error.h"
#include "integrators/thresholds.h"
#include "simd/processor_registers.h"

namespace pintle {
namespace {

constexpr double kVisible = 1e-9;  // fraction of the largest force: gaps of redundant joints that follow the bodies count if they change one by more

// One instant per lane.
template <class S>
class LaneForces : public BasicDenseForces<S> {
 public:
  using Sampled = typename BasicDenseForces<S>::Sampled;
  explicit LaneForces(const BasicSystem<S>& system)
      : system_(system), loads_(system.has_loads()), bodies_(system.bodies.size() + 1), joints_(system.joints.size()),
        lu_(system.pattern(), symmetry_of_joints(system)), lu_of_openings_(lu_), pull_(system.bodies.size() + 1), loads_on_(system.bodies.size() + 1), motions_(system.bodies.size()), Q_(system.bodies.size()) {
    bodies_.back().stand_still();  // the ground
    for (std::size_t b = 0; b < n_bodies(); ++b)
      for (int k = 0; k < S::kDof; ++k) loads_on_[b][k] = L::all(system.bodies[b].gravity[k]);
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      const BasicJointData<S>& data = system.joints[j];
      joints_[j].map.functions = count_functions(data.displacement);
      joints_[j].linear = data.law.as_linear();
      joints_[j].pose = std::get_if<BasicSelection<S>>(&data.displacement);
      if (data.at.a != kGround && data.at.b != kGround) joints_[j].slot = system.pattern().slot(data.at.a, data.at.b);
    }
  }

 protected:
  void find_all(const BasicState<S>& begin, const BasicState<S>& end, const BasicStepNodes<S>& nodes, Sampled& sampled) {
    const double mu = nodes.table->real_eigenvalue / (end.t - begin.t);
    follow(begin, end, nodes);
    for (std::size_t j = 0; j < joints_.size(); ++j) find_weight(j, mu);
    const bool follows_geometry = gaps_follow_geometry(begin, end, nodes);
    factorize(mu, follows_geometry);
    if (follows_geometry) add_forces_of_geometry(begin, end, nodes);
    move_onto_rates();
    if (!begin.sliding.empty()) find_balanced_loads();
    else if (loads_) find_loads(begin);
    balance(mu, follows_geometry);
    sampled.front() = begin.force;
    sampled.back() = nodes.force[nodes.table->n];  // before an event at the end is crossed
    write(sampled);
  }

 private:
  static constexpr int kN = ForceSamples::kN;
  using L = Lanes<kN>;
  using Row = BlockVec<L, S::kDof>;
  struct Joint {
    L gap[S::kDof], rate[S::kDof], accel[S::kDof], force[S::kDof];  // on the curves
    L gap_of_force[S::kDof], rate_of_force[S::kDof];  // that `force` belongs to
    L off[S::kDof], rate_off[S::kDof];            // by which the bodies miss them
    L change[S::kDof];                            // of the force, so that it balances
    L weight[S::kDof * S::kDof];                            // K + mu C; its diagonal for a spring and damper in each component
    typename S::template GapMap<L> map;
    const typename BasicLaw<S>::Linear* linear = nullptr;
    const BasicSelection<S>* pose = nullptr;
    BlockPattern::Slot slot{};
  };

  std::size_t body(int index) const { return index == kGround ? bodies_.size() - 1 : static_cast<std::size_t>(index); }
  std::size_t n_bodies() const { return bodies_.size() - 1; }

  // Evaluates the curves at the instants.
  void follow(const BasicState<S>& begin, const BasicState<S>& end, const BasicStepNodes<S>& nodes) {
    const ForceSamples& samples = ForceSamples::of(*nodes.table);
    const int n = nodes.table->n + 1;
    const double h = end.t - begin.t;
    L x, hermite, once[RadauTable::kMaxNodes], twice[RadauTable::kMaxNodes];
    for (int s = 0; s < kN; ++s) {
      const double at = samples.x[s + 1];
      x.set(s, at);
      hermite.set(s, cubic_blend(at));
      t_.set(s, begin.t + at * h);
      for (int node = 0; node < n; ++node) {
        at_node_[node].set(s, samples.value[s + 1][node]);
        once[node].set(s, h * samples.once[s + 1][node]);
        twice[node].set(s, h * h * samples.twice[s + 1][node]);
      }
    }
    const auto combined = [&](const L* weight, const std::vector<VecsOf<S>>& of, std::size_t i, int k) {
      L sum = of[0][i][k] * weight[0];
      for (int node = 1; node < n; ++node) sum += of[node][i][k] * weight[node];
      return sum;
    };
    const auto whole = [&](const ForceSamples::AtNodes& weight, const std::vector<VecsOf<S>>& of, std::size_t i, int k) {
      double sum = 0;
      for (int node = 0; node < n; ++node) sum += weight[node] * of[node][i][k];
      return sum;
    };
    const auto rate = [&](const std::vector<VecsOf<S>>& of, const VecsOf<S>& v0, const VecsOf<S>& v1, std::size_t i, int k) {
      const double bend = v1[i][k] - v0[i][k] - h * whole(samples.once.back(), of, i, k);
      return L::all(v0[i][k]) + bend * x + combined(once, of, i, k);
    };
    const auto place = [&](const std::vector<VecsOf<S>>& of, const VecsOf<S>& x0, const VecsOf<S>& v0, const VecsOf<S>& x1, std::size_t i, int k) {
      const double way = h * v0[i][k], bend = x1[i][k] - x0[i][k] - way - h * h * whole(samples.twice.back(), of, i, k);
      return L::all(x0[i][k]) + way * x + bend * hermite + combined(twice, of, i, k);
    };
    for (std::size_t b = 0; b < n_bodies(); ++b) {
      auto& body = bodies_[b];
      for (int k = 0; k < S::kDof; ++k) {
        body.v[k] = rate(nodes.a, begin.v, end.v, b, k);
        if (!begin.sliding.empty()) body.a[k] = combined(at_node_, nodes.a, b, k);
      }
      if constexpr (S::kCurved) {
        L dq[S::kDof];
        for (int k = 0; k < S::kDof; ++k) dq[k] = combined(once, nodes.increment_rate, b, k) + nodes.increment_bend[b][k] * hermite;
        body.displace(begin.q[b], dq);
      } else {
        for (int k = 0; k < S::kDof; ++k) body.q[k] = place(nodes.a, begin.q, begin.v, end.q, b, k);
        body.check();
      }
    }
    for (int s = 0; s < kN && system_.n_law_states() > 0; ++s) {
      law_state_[s].assign(begin.law_state.size(), 0.0);
      for (int node = 0; node < n; ++node)
        for (std::size_t z = 0; z < law_state_[s].size(); ++z) law_state_[s][z] += at_node_[node][s] * nodes.law_state[node][z];
    }
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      Joint& joint = joints_[j];
      for (int k = 0; k < S::kDof; ++k) {
        joint.gap[k] = place(nodes.gap_accel, begin.gap, begin.gap_rate, end.gap, j, k);
        joint.rate[k] = rate(nodes.gap_accel, begin.gap_rate, end.gap_rate, j, k);
        joint.accel[k] = combined(at_node_, nodes.gap_accel, j, k);
        joint.force[k] = combined(at_node_, nodes.force, j, k);
      }
    }
  }

  // The map of joint j, the gap's rate from its bodies, and the convective acceleration; in a driven component minus its target's.
  void read(std::size_t j, L (&rate)[S::kDof], L (&bias)[S::kDof]) {
    const BasicJointData<S>& data = system_.joints[j];
    Joint& joint = joints_[j];
    const typename S::template BodyLanes<kN>&A = bodies_[body(data.at.a)], &B = bodies_[body(data.at.b)];
    const auto pose = S::template PoseGeometry<L>::between(A.view(), S::attachment(data.at.F), B.view(), S::attachment(data.at.M));
    joint.map.set(pose);
    if (joint.map.functions > 0) {
      for (int s = 0; s < kN; ++s) {
        const BasicJointKinematics<S> r = pintle::read(data.displacement, S::RelativePose::between(A.motion(s), data.at.F, B.motion(s), data.at.M));
        for (int k = 0; k < S::kDof; ++k) {
          for (int f = 0; f < joint.map.functions; ++f) joint.map.gradient[f][k].set(s, r.map.gradient[f][k]);
          rate[k].set(s, r.rate[k]);
          bias[k].set(s, r.bias[k]);
        }
      }
    } else {
      pose.rates(A.view(), B.view(), rate);
      pose.biases(bias);
    }
    if (data.driven < 0) return;
    for (int s = 0; s < kN; ++s) {
      const auto target = target_of(data, t_[s]);
      rate[data.driven].set(s, rate[data.driven][s] - target[1]);
      bias[data.driven].set(s, bias[data.driven][s] - target[2]);
    }
  }

  // mu^2 M + G' (K + mu C) G on the curves; leaves the required changes of the rates in `rate`. An instant at which it is singular
  // has forces that are not numbers.
  void factorize(double mu, bool follows_geometry) {
    lu_.set_diagonal([&](int b, int k) { return L::all(mu * mu * system_.bodies[b].mass[k]); });
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      Joint& joint = joints_[j];
      L rate[S::kDof], bias[S::kDof];
      read(j, rate, bias);
      for (int k = 0; k < S::kDof; ++k) joint.rate[k] -= rate[k];
      if (joint.linear && joint.map.functions == 0) PoseBlocks<S, L>::of(joint.map, joint.weight).add_to(lu_, system_.joints[j].at, joint.slot);
      else add_joint(j);
    }
    if (follows_geometry) {
      lu_of_openings_ = lu_;
      constexpr double less = 1 - kProjectionShare * kProjectionShare;
      for (std::size_t b = 0; b < n_bodies(); ++b)
        for (int k = 0; k < S::kDof; ++k) lu_of_openings_.diagonal(static_cast<int>(b))(k, k) -= L::all(less * mu * mu * system_.bodies[b].mass[k]);
      lu_of_openings_.factorize();
    }
    lu_.factorize();
  }

  void find_weight(std::size_t j, double mu) {
    Joint& joint = joints_[j];
    if (joint.linear) {
      for (int k = 0; k < S::kDof; ++k) joint.weight[k] = L::all(joint.linear->k[k] + mu * joint.linear->c[k]);
      return;
    }
    const BasicJointData<S>& data = system_.joints[j];
    for (int s = 0; s < kN; ++s) {
      typename S::Vec gap, rate;
      for (int k = 0; k < S::kDof; ++k) {
        gap[k] = joint.gap[k][s];
        rate[k] = joint.rate[k][s];
      }
      data.law.linearize({t_[s], gap, rate, law_state_[s].data() + data.first_state}, tangents_);
      impedance_.reserve(tangents_.n);
      impedance_.find_passive(tangents_, mu);
      for (int k = 0; k < S::kDof * S::kDof; ++k) joint.weight[k].set(s, impedance_.weight[k]);
    }
  }
  static void weigh(const Joint& joint, const L* gap, L* f) { pintle::weigh<S::kDof>(joint.linear != nullptr, joint.weight, gap, f); }

  // G' w G of any joint, one coordinate of a body at a time.
  void add_joint(std::size_t j) {
    const Joint& joint = joints_[j];
    const BasicPlacement<S>& at = system_.joints[j].at;
    BlockPattern::Slot ba = joint.slot;
    ba.upper = !ba.upper;
    constexpr int n = S::kDof;
    for (int c = 0; c < 2 * n; ++c) {
      Row unit[2] = {zero(), zero()}, on[2] = {zero(), zero()};
      unit[c / n][c % n] = L::all(1);
      L e[n], f[n];
      joint.map.gather(&unit[0][0], &unit[1][0], e);
      weigh(joint, e, f);
      joint.map.push(f, on[0], on[1]);
      const auto add = [&](Block<L, n>& block, int side) {
        for (int r = 0; r < n; ++r) block(r, c % n) += on[side][r];
      };
      const int column = c < n ? at.a : at.b, other = c < n ? at.b : at.a;
      if (column == kGround) continue;
      add(lu_.diagonal(column), c / n);
      if (other == kGround) continue;
      const BlockPattern::Slot slot = c < n ? ba : joint.slot;  // (row: the other body, column: this one)
      if (lu_.has(slot)) add(lu_.off_diagonal(slot), 1 - c / n);
    }
  }
  static Row zero() {
    Row row;
    for (int k = 0; k < S::kDof; ++k) row[k] = L::all(0);
    return row;
  }

  // The bodies' response to forces w gap of all joints, into pull_.
  template <class Gap>
  void find_response(Gap gap, BlockLu<L, S::kDof>& lu) {
    for (Row& x : pull_) x = zero();
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      const BasicPlacement<S>& at = system_.joints[j].at;
      L f[S::kDof];
      weigh(joints_[j], joints_[j].*gap, f);
      joints_[j].map.push(f, pull_[body(at.a)], pull_[body(at.b)]);
    }
    lu.solve(pull_);
    pull_.back() = zero();
  }

  void move_onto_rates() {
    find_response(&Joint::rate, lu_);
    for (std::size_t b = 0; b < n_bodies(); ++b)
      for (int k = 0; k < S::kDof; ++k) bodies_[b].v[k] += pull_[b][k];
    for (auto& body : bodies_) body.renew_rates();
  }

  // Whether at the end of the step gaps were taken from the bodies, Eq. (4.3), with a visible change of a force.
  bool gaps_follow_geometry(const BasicState<S>& begin, const BasicState<S>& end, const BasicStepNodes<S>& nodes) const {
    double largest = 0;
    for (const auto& f : end.force) largest = std::max(largest, f.cwiseAbs().maxCoeff());
    for (std::size_t j = 0; j < joints_.size(); ++j)
      for (int k = 0; k < S::kDof && joints_[j].pose; ++k) {
        const L& w = joints_[j].linear ? joints_[j].weight[k] : joints_[j].weight[(S::kDof + 1) * k];
        if (std::abs(w[kN - 1] * (end.gap[j][k] - GapAtNodes::of_last_stage(begin, end, nodes, j, k))) > kVisible * largest) return true;
      }
    return false;
  }

  // Where the bodies of a joint of poses are: its gap, with turns counted from the gap of its force, and its rate. In a driven component those of the force.
  void read_geometry(std::size_t j, L (&gap)[S::kDof], L (&rate)[S::kDof]) const {
    const BasicJointData<S>& data = system_.joints[j];
    const Joint& joint = joints_[j];
    const auto A = bodies_[body(data.at.a)].view(), B = bodies_[body(data.at.b)].view();
    const auto pose = S::template PoseGeometry<L>::between(A, S::attachment(data.at.F), B, S::attachment(data.at.M));
    if constexpr (S::kCurved) {
      pose.gaps(A, data.at.F, B, data.at.M, gap);
    } else {
      struct Marker { L angle; };
      pose.gaps(A, Marker{L::all(data.at.F.angle)}, B, Marker{L::all(data.at.M.angle)}, gap);
    }
    pose.rates(A, B, rate);
    for (int k = 0; k < S::kDof; ++k) gap[k] -= L::all(joint.pose->offset[k]);
    if constexpr (S::kCurved)
      for (int s = 0; s < kN; ++s) {
        typename S::Vec z;
        for (int k = 0; k < S::kDof; ++k) z[k] = gap[k][s];
        S::count_turns(lane(joint.gap_of_force, s), z);
        gap[S::kTurn].set(s, z[S::kTurn]);
      }
    if (data.driven < 0) return;
    gap[data.driven] = joint.gap_of_force[data.driven];
    rate[data.driven] = joint.rate_of_force[data.driven];
  }
  static typename S::Vec lane(const L (&x)[S::kDof], int s) {
    typename S::Vec y;
    for (int k = 0; k < S::kDof; ++k) y[k] = x[k][s];
    return y;
  }

  // Gaps that no motion can close, those of redundant joints, are as wrong as the stages' positions, and their forces by this times the stiffness. The
  // bodies, moved onto the gaps that the forces belong to by Eq. (4.2), leave the right ones. theory/time Eq. (5.2).
  void add_forces_of_geometry(const BasicState<S>& begin, const BasicState<S>& end, const BasicStepNodes<S>& nodes) {
    find_gaps_of_forces(begin, end, nodes);
    on_curves_ = bodies_;
    find_misfits();
    find_response(&Joint::off, lu_);
    for (std::size_t b = 0; b < n_bodies(); ++b) {
      bodies_[b].move(&pull_[b][0]);
      bodies_[b].renew_rates();
    }
    find_misfits();
    remove_closable_part(&Joint::off);
    remove_closable_part(&Joint::rate_off);
    const typename S::Vec turned = rounding_of_gaps<S>(end.q), near = S::Vec::Constant(kLastBits * largest_coordinate(end.q));
    for (std::size_t j = 0; j < joints_.size(); ++j)
      if (joints_[j].pose) add_force_of_geometry(j, joints_[j].linear ? turned : near);
    bodies_ = on_curves_;
  }

  // Takes away from gaps or rates what a motion of the bodies could close.
  template <class Gap>
  void remove_closable_part(Gap off) {
    find_response(off, lu_of_openings_);
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      Joint& joint = joints_[j];
      const BasicPlacement<S>& at = system_.joints[j].at;
      L closed[S::kDof];
      joint.map.gather(&pull_[body(at.a)][0], &pull_[body(at.b)][0], closed);
      for (int k = 0; k < S::kDof; ++k) (joint.*off)[k] -= closed[k];
    }
  }

  // By how much the bodies miss the gaps and the rates that the forces belong to.
  void find_misfits() {
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      Joint& joint = joints_[j];
      L gap[S::kDof], rate[S::kDof];
      if (joint.pose) read_geometry(j, gap, rate);
      for (int k = 0; k < S::kDof; ++k) {
        joint.off[k] = joint.pose ? joint.gap_of_force[k] - gap[k] : L::all(0);
        joint.rate_off[k] = joint.pose ? joint.rate_of_force[k] - rate[k] : L::all(0);
      }
    }
  }

  // Interpolated between the nodes as the forces are.
  void find_gaps_of_forces(const BasicState<S>& begin, const BasicState<S>& end, const BasicStepNodes<S>& nodes) {
    for (std::size_t j = 0; j < joints_.size(); ++j)
      for (int k = 0; k < S::kDof; ++k) {
        const auto at = GapAtNodes::of(begin, end, nodes, j, k);
        L &gap = joints_[j].gap_of_force[k], &rate = joints_[j].rate_of_force[k];
        gap = rate = L::all(0);
        for (int node = 0; node <= nodes.table->n; ++node) {
          gap += at.gap[node] * at_node_[node];
          rate += at.rate[node] * at_node_[node];
        }
      }
  }

  // Takes away from the force what its gap has too much; nothing at an instant at which this is not a number.
  void add_force_of_geometry(std::size_t j, const typename S::Vec& rounding) {
    const BasicJointData<S>& data = system_.joints[j];
    Joint& joint = joints_[j];
    for (int k = 0; k < S::kDof; ++k) {
      joint.off[k] = where_larger(sizes(joint.off[k]), L::all(rounding[k]), joint.off[k], L::all(0));
      joint.rate_off[k] = where_larger(sizes(joint.rate_off[k]), L::all(0), joint.rate_off[k], L::all(0));
    }
    if (joint.linear) {
      for (int k = 0; k < S::kDof; ++k) joint.force[k] += joint.linear->k[k] * joint.off[k] + joint.linear->c[k] * joint.rate_off[k];
      return;
    }
    for (int s = 0; s < kN; ++s) {
      const double* states = law_state_[s].data() + data.first_state;
      const typename S::Vec gap = lane(joint.gap_of_force, s), rate = lane(joint.rate_of_force, s);
      const typename S::Vec change = data.law.force({t_[s], gap - lane(joint.off, s), rate - lane(joint.rate_off, s), states}) - data.law.force({t_[s], gap, rate, states});
      for (int k = 0; k < S::kDof; ++k) joint.force[k].set(s, joint.force[k][s] + change[k]);
    }
  }

  // theory/time Eq. (4.5).
  void balance(double mu, bool follows_geometry) {
    pull_ = loads_on_;
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      const BasicPlacement<S>& at = system_.joints[j].at;
      joints_[j].map.push(joints_[j].force, pull_[body(at.a)], pull_[body(at.b)]);
    }
    for (std::size_t b = 0; b < n_bodies(); ++b)
      for (int k = 0; k < S::kDof; ++k) bodies_[b].a[k] = (1 / system_.bodies[b].mass[k]) * pull_[b][k];
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      Joint& joint = joints_[j];
      const BasicPlacement<S>& at = system_.joints[j].at;
      L rate[S::kDof], bias[S::kDof], e[S::kDof];
      read(j, rate, bias);
      joint.map.gather(bodies_[body(at.a)].a, bodies_[body(at.b)].a, e);
      for (int k = 0; k < S::kDof; ++k) joint.accel[k] -= bias[k] + e[k];
    }
    find_response(&Joint::accel, lu_);
    if (follows_geometry) {  // by changes that motions ask for: theory/time section 5
      for (std::size_t b = 0; b < n_bodies(); ++b)
        for (int k = 0; k < S::kDof; ++k) pull_[b][k] = system_.bodies[b].mass[k] * pull_[b][k];
      lu_of_openings_.solve(pull_);
      pull_.back() = zero();
    }
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      Joint& joint = joints_[j];
      const BasicPlacement<S>& at = system_.joints[j].at;
      L e[S::kDof];
      joint.map.gather(&pull_[body(at.a)][0], &pull_[body(at.b)][0], e);
      for (int k = 0; k < S::kDof && !follows_geometry; ++k) e[k] = joint.accel[k] - e[k];
      weigh(joint, e, joint.change);
      for (int k = 0; k < S::kDof && !follows_geometry; ++k) joint.change[k] = (1 / (mu * mu)) * joint.change[k];
    }
  }

  // While a motor is held at a jump: loads as the imbalance of the curves, since its ramp is too steep to be evaluated at their speeds.
  void find_balanced_loads() {
    for (std::size_t b = 0; b < n_bodies(); ++b)
      for (int k = 0; k < S::kDof; ++k) loads_on_[b][k] = system_.bodies[b].mass[k] * bodies_[b].a[k];
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      const BasicPlacement<S>& at = system_.joints[j].at;
      L against[S::kDof];
      for (int k = 0; k < S::kDof; ++k) against[k] = -joints_[j].force[k];
      joints_[j].map.push(against, loads_on_[body(at.a)], loads_on_[body(at.b)]);
    }
  }

  void find_loads(const BasicState<S>& begin) {
    for (int s = 0; s < kN; ++s) {
      for (std::size_t b = 0; b < n_bodies(); ++b) motions_[b] = bodies_[b].motion(s);
      system_.external(t_[s], motions_, Q_, begin.sliding);
      for (std::size_t b = 0; b < n_bodies(); ++b)
        for (int k = 0; k < S::kDof; ++k) loads_on_[b][k].set(s, Q_[b][k]);
    }
  }

  // Writes the forces that balance; at an instant at which one of them is not a number, those of the curves.
  void write(Sampled& sampled) const {
    L nothing = L::all(0);
    for (const Joint& joint : joints_)
      for (const L& change : joint.change) nothing += 0.0 * change;
    for (int s = 0; s < kN; ++s) {
      VecsOf<S>& to = sampled[s + 1];
      to.resize(joints_.size());
      for (std::size_t j = 0; j < joints_.size(); ++j)
        for (int k = 0; k < S::kDof; ++k) to[j][k] = nothing[s] == 0 ? joints_[j].force[k][s] + joints_[j].change[k][s] : joints_[j].force[k][s];
    }
  }

  const BasicSystem<S>& system_;
  const bool loads_;
  L t_;
  L at_node_[RadauTable::kMaxNodes];  // weights of the nodes in the curves
  std::vector<typename S::template BodyLanes<kN>> bodies_;  // and the ground
  std::vector<typename S::template BodyLanes<kN>> on_curves_;  // the same, while they are moved
  std::vector<Joint> joints_;
  BlockLu<L, S::kDof> lu_;
  BlockLu<L, S::kDof> lu_of_openings_;  // the same with a smaller mu, to resolve every motion that opens a gap
  std::vector<Row> pull_, loads_on_; // gravity and loads on the bodies, and the ground's row
  std::vector<typename S::Motion> motions_;     // of one instant
  VecsOf<S> Q_;
  std::array<std::vector<double>, kN> law_state_;  // at the instants
  BasicLawTangents<S> tangents_;               // of one law at one instant
  LawImpedance<double, S> impedance_;
};

}  // namespace
}  // namespace pintle
