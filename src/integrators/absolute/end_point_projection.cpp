#include "integrators/absolute/end_point_projection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "integrators/absolute/joint_pack.h"
#include "integrators/load_scale.h"
#include "integrators/radau/joint_pull.h"
#include "integrators/radau/stage_lanes.h"
#include "integrators/radau/step_error.h"
#include "integrators/thresholds.h"
#include "simd/processor_registers.h"

namespace pintle {
namespace {

constexpr int kTautPasses = 2;  // passes after the first: what remains is the cube of what one pass leaves, Eq. (4.8)

constexpr double kMostOfRates = 1e-9;  // fraction of the largest velocity: upper limit on what may be left of rates in the shortest steps

// The carried value, or the geometry's where the two differ by more than rounding.
PINTLE_LANES Lanes<4> carried_or(const Lanes<4>& carried, const Lanes<4>& geometry, double rounding) {
  return where_larger(sizes(geometry - carried), Lanes<4>::all(rounding), geometry, carried);
}

PINTLE_LANES double largest_of(const Lanes<4>& x) {
  return std::max(std::max(x[0], x[1]), std::max(x[2], x[3]));
}

template <class S>
class LaneEndPointProjection : public BasicEndPointProjection<S> {
 public:
  explicit LaneEndPointProjection(const BasicSystem<S>& system)
      : system_(system), large_(system.bodies.size() > kLargeMechanism), joints_(pack_joints(system)), has_states_(system.n_law_states() > 0),
        state_loads_(has_states_ ? system.bodies.size() + 1 : 0), lu_(system.pattern(), symmetry_of_joints(system)), at_(system.bodies.size() + 1),
        corrections_(system.bodies.size() + 1), pulled_(system.bodies.size() + 1), rest_of_four_(system.bodies.size() + 1), rest_(system.bodies.size() + 1), accel_(system.bodies.size() + 1), rhs_(system.bodies.size() + 1), force_rhs_(system.bodies.size() + 1) {
    at_.back().set(kStill<typename S::Motion>);
  }

  const std::vector<RowOf4<S>>& corrections() const override { return corrections_; }

 protected:
  bool find_corrections(double t, double mu, const BasicStage<S>& last, BasicStageTails<S>& tails) {
    lu_.set_diagonal([&](int b, int k) { return mu * mu * system_.bodies[b].mass[k]; });
    std::fill(corrections_.begin(), corrections_.end(), RowOf4<S>{});
    clear(pulled_);
    load_motions(last.m);
    if (has_states_) clear(state_loads_);
    for (BasicJointPack<S>& joints : joints_) {
      if (large_) fetch_corrections(joints, last, tails);
      const Kinematics r = read(joints, t, last.m, joints.map, last);
      find_weight(joints, t, mu, last, tails);
      add_blocks(joints);
      add_pull(joints, last);
      L off[S::kDof];
      for (int k = 0; k < S::kDof; ++k) off[k] = joints.load(last.gap, k) - r.gap[k];
      for (int i = 0; i < joints.n; ++i) {
        RowOf4<S> &gap = tails.gaps[joints.first + i], with_off = gap, f;
        for (int k = 0; k < S::kDof; ++k) with_off[k].set(3, off[k][i]);
        gap = with_off;
        weigh_tails(joints, i, with_off, f);
        joints.map.lane(i).push(f.a.data(), corrections_[joints.a[i]], corrections_[joints.b[i]]);
      }
    }
    hold_taut(mu);
    if (!lu_.factorize_and_solve(corrections_)) return false;
    if (taut_) answer_rest(corrections_, rest_of_four_);
    return true;
  }

  // The gaps' own accelerations are second differences, over the stages, of what the forces require; where a joint is
  // neither stiff nor soft for this step, their error is that of the force.
  double find_error(const BasicStageTails<S>& tails, const BasicLoadScale<S>& scale) const {
    TailSize bodies, gaps, states;
    for (std::size_t b = 0; b < n_bodies(); ++b)
      for (int k = 0; k < S::kDof; ++k) {
        const double over = system_.bodies[b].mass[k] / scale.body[b][k];
        bodies.add(over * tails.bodies[b][k]);
        gaps.add(over * corrections_[b][k]);
      }
    for (std::size_t b = 0; has_states_ && b < n_bodies(); ++b)
      for (int k = 0; k < S::kDof; ++k) states.add((1 / scale.body[b][k]) * state_loads_[b][k]);
    return std::max({bodies.value(), kGapError * gaps.value(), kStateError * states.last()});
  }

  void project(const BasicStage<S>& last, double h, BasicState<S>& end, std::vector<typename S::Motion>& m, BasicLoadScale<S>& scale) {
    const double fastest = largest_coordinate(last.v);
    const auto of_rate = [h](const typename S::Vec& of_gap, const typename S::Vec& v) -> typename S::Vec { return (kLastBits * v).cwiseMax((of_gap / std::abs(h)).cwiseMin(kMostOfRates * v)); };
    rounding_[kNear] = S::Vec::Constant(kLastBits * largest_coordinate(last.q));
    rounding_[kTurned] = rounding_of_gaps<S>(last.q);
    typename S::Vec turning = S::Vec::Constant(fastest);
    for (int k = S::kDim; k < S::kDof; ++k)
      for (const typename S::Vec& v : last.v) turning[k] = std::max(turning[k], std::abs(v[k]));
    rounding_of_rate_[kNear] = of_rate(rounding_[kNear], S::Vec::Constant(fastest));
    rounding_of_rate_[kTurned] = of_rate(rounding_[kTurned], turning);
    for (std::size_t b = 0; b < n_bodies(); ++b)
      {
        typename S::Vec dq;
        for (int k = 0; k < S::kDof; ++k) dq[k] = corrections_[b][k][3];
        end.q[b] = S::moved(last.q[b], dq);
      }
    end.v = last.v;
    end.a = last.a;
    end.gap_accel = last.gap_accel;
    end.law_state = last.law_state;
    end.law_rate = last.law_rate;
    find_motions(end, m);
    if (!(assemble_rates_and_measure_gaps(last, end, m) < 1)) {  // the first pass has left more
      assemble_position_error(last, end, m);
      answer(rhs_);
      for (std::size_t b = 0; b < n_bodies(); ++b) S::move(end.q[b], Eigen::Map<const typename S::Vec>(rhs_[b].a.data()));
      find_motions(end, m);
      assemble_rates_and_measure_gaps(last, end, m);
    }
    move_velocities(end, m);
    if (!(assemble_force_balance(last, end, m) < 1)) {
      assemble_rates_and_measure_gaps(last, end, m);
      move_velocities(end, m);
      assemble_force_balance(last, end, m);
    }
    balance(last, end, scale);
  }

 private:
  using L = typename BasicJointPack<S>::L;
  using Kinematics = typename BasicJointPack<S>::Kinematics;

  std::size_t n_bodies() const { return system_.bodies.size(); }

  void load_motions(const std::vector<typename S::Motion>& m) {
    for (std::size_t b = 0; b < n_bodies(); ++b) at_[b].set(m[b]);
  }
  void find_motions(const BasicState<S>& end, std::vector<typename S::Motion>& m) {
    system_.motions(end.q, end.v, m);
    load_motions(m);
  }

  // In curved spaces the poses give angles only up to whole turns: their number comes from the carried gap, as do a belt's turns and surface slip.
  Kinematics read(const BasicJointPack<S>& joints, double t, const std::vector<typename S::Motion>& m, typename S::template GapMap<L>& map,
                  const BasicStage<S>& carried) const {
    Kinematics r;
    if (joints.pose) {
      joints.read_poses(at_, r, map);
      if constexpr (S::kCurved)
        for (int i = 0; i < 4; ++i) {
          typename S::Vec z;
          for (int k = 0; k < S::kDof; ++k) z[k] = r.gap[k][i];
          S::count_turns(carried.gap[joints.lane[i]], z);
          r.gap[S::kTurn].set(i, z[S::kTurn]);
        }
      return r;
    }
    BasicJointKinematics<S> one = system_.kinematics(joints.first, t, m);
    const BasicDisplacement<S>& displacement = system_.joints[joints.first].displacement;
    if (has_slip(displacement)) one.gap[kSlip] = carried.gap[joints.first][kSlip];
    count_turns(displacement, carried.gap[joints.first][0], one.gap);
    for (int k = 0; k < S::kDof; ++k) {
      r.gap[k] = L::all(one.gap[k]);
      r.rate[k] = L::all(one.rate[k]);
      r.bias[k] = L::all(one.bias[k]);
    }
    map = S::template GapMap<L>::same(one.map);
    return r;
  }

  // K + mu C.
  void find_weight(BasicJointPack<S>& joints, double t, double mu, const BasicStage<S>& last, const BasicStageTails<S>& tails) {
    if (joints.linear) {
      for (int k = 0; k < S::kDof; ++k) joints.weight[k] = joints.k[k] + mu * joints.c[k];
      return;
    }
    const BasicJointData<S>& joint = system_.joints[joints.first];
    joint.law.linearize({t, last.gap[joints.first], last.gap_rate[joints.first], last.law_state.data() + joint.first_state}, tangents_);
    impedance_.reserve(tangents_.n);
    if (tangents_.n > 0) joints.map.lane(0).push(tails.of_states[joints.first].a.data(), state_loads_[joints.a[0]], state_loads_[joints.b[0]]);
    impedance_.find_passive(tangents_, mu);
    for (int k = 0; k < S::kDof * S::kDof; ++k) joints.weight[k] = L::all(impedance_.weight[k]);
  }
  // For one of the joints, four sets of gaps.
  static void weigh_tails(const BasicJointPack<S>& joints, int i, const RowOf4<S>& gap, RowOf4<S>& f) {
    if (!joints.linear) weigh<S::kDof>(false, joints.weight, gap.a.data(), f.a.data());
    else
      for (int k = 0; k < S::kDof; ++k) f[k] = joints.weight[k][i] * gap[k];
  }

  void add_blocks(const BasicJointPack<S>& joints) {
    if (!joints.pose) {
      typename S::Mat w = S::Mat::Zero();
      for (int k = 0; k < S::kDof; ++k) {
        if (joints.linear) w(k, k) = joints.weight[k][0];
        else
          for (int c = 0; c < S::kDof; ++c) w(k, c) = joints.weight[S::kDof * k + c][0];
      }
      add_gap_blocks(lu_, system_.joints[joints.first].at, joints.slot[0], joints.map.lane(0), w);
      return;
    }
    const auto blocks = PoseBlocks<S, L>::of(joints.map, joints.weight);
    const auto body = [this](int place) { return place == static_cast<int>(n_bodies()) ? kGround : place; };
    for (int i = 0; i < joints.n; ++i) blocks.lane(i).add_to(lu_, body(joints.a[i]), body(joints.b[i]), joints.slot[i]);
  }

  // Adds to pulled_ the stiffness that the joints' forces at the last stage give against motions across them.
  void add_pull(const BasicJointPack<S>& joints, const BasicStage<S>& last) {
    if (joints.map.functions > 0) return add_pull_of(joints.first, system_, last.m, last.force[joints.first], pulled_);
    L force[S::kDof];
    for (int k = 0; k < S::kDof; ++k) force[k] = joints.load(last.force, k);
    const auto pull = PullAcross<S, L>::of(joints.map, force, joints.forbidden);
    for (int i = 0; i < joints.n; ++i) {
      pull.add_turn_of_first(i, pulled_[joints.a[i]]);
      pull.add_turn_of_second(i, pulled_[joints.b[i]]);
      if (!joints.slides) continue;
      add_slide(pull.slide[i], pull.arm_a[i], joints.a[i], system_, pulled_);
      add_slide(pull.slide[i], pull.arm_b[i], joints.b[i], system_, pulled_);
    }
  }

  // Adds the part of it that the step does not resolve to the matrix. Eq. (4.7).
  void hold_taut(double mu) {
    const double own = mu / kProjectionShare;
    taut_ = false;
    for (std::size_t b = 0; b < n_bodies(); ++b) {
      const typename S::Vec held = unresolved(pulled_[b], own, system_.bodies[b].mass);
      for (int k = 0; k < S::kDof; ++k) pulled_[b][k] = held[k];
      if (!(held.maxCoeff() > 0)) continue;
      taut_ = true;
      for (int k = 0; k < S::kDof; ++k) lu_.diagonal(static_cast<int>(b))(k, k) += held[k];
    }
  }

  // Where the matrix holds bodies its solution is too small: a few passes add the rest. Eq. (4.8).
  template <class Row>
  void answer_rest(std::vector<Row>& x, std::vector<Row>& rest) {
    rest = x;
    for (int pass = 0; pass < kTautPasses; ++pass) {
      for (std::size_t b = 0; b < n_bodies(); ++b)
        for (int k = 0; k < S::kDof; ++k) rest[b][k] = pulled_[b][k] * rest[b][k];
      lu_.solve(rest);
      for (std::size_t b = 0; b < n_bodies(); ++b)
        for (int k = 0; k < S::kDof; ++k) x[b][k] += rest[b][k];
    }
  }
  void answer(std::vector<BodyRow<S>>& x) {
    lu_.solve(x);
    if (taut_) answer_rest(x, rest_);
  }

  // rhs_ += G' W gap.
  void add_to_rhs(const BasicJointPack<S>& joints, const L (&gap)[S::kDof]) {
    L f[S::kDof];
    weigh<S::kDof>(joints.linear, joints.weight, gap, f);
    joints.push(f, rhs_);
  }
  template <class Row>
  static void clear(std::vector<Row>& x) { std::fill(x.begin(), x.end(), Row{}); }

  void assemble_position_error(const BasicStage<S>& last, const BasicState<S>& end, const std::vector<typename S::Motion>& m) {
    clear(rhs_);
    for (const BasicJointPack<S>& joints : joints_) {
      if (large_) fetch_kinematics(joints, last);
      typename S::template GapMap<L> map;
      const Kinematics r = read(joints, end.t, m, map, last);
      L off[S::kDof];
      for (int k = 0; k < S::kDof; ++k) off[k] = joints.load(last.gap, k) - r.gap[k];
      add_to_rhs(joints, off);
    }
  }

  // The right-hand side for the velocities, from the gaps' rates. Returns what is left of the gaps, over their rounding.
  double assemble_rates_and_measure_gaps(const BasicStage<S>& last, const BasicState<S>& end, const std::vector<typename S::Motion>& m) {
    clear(rhs_);
    L left = L::all(0);
    const auto over_rounding = inverses(rounding_);
    for (const BasicJointPack<S>& joints : joints_) {
      if (large_) fetch_kinematics(joints, last);
      typename S::template GapMap<L> map;
      const Kinematics r = read(joints, end.t, m, map, last);
      L off[S::kDof];
      for (int k = 0; k < S::kDof; ++k) {
        left = larger_size(left, joints.forbidden[k] * over_rounding[joints.linear][k] * (joints.load(last.gap, k) - r.gap[k]));
        off[k] = joints.load(last.gap_rate, k) - r.rate[k];
      }
      add_to_rhs(joints, off);
    }
    return largest_of(left);
  }

  void move_velocities(BasicState<S>& end, std::vector<typename S::Motion>& m) {
    const auto move = [&](int b, const BodyRow<S>& x) {
      typename S::Vec& v = end.v[b];
      for (int k = 0; k < S::kDof; ++k) v[k] += x[k];
      m[b].set_velocity(v);
      at_[b].set(m[b]);
    };
    if (taut_) {
      answer(rhs_);
      for (int b = 0; b < system_.n_bodies(); ++b) move(b, rhs_[b]);
      return;
    }
    lu_.solve(rhs_, [&](int b, const BodyRow<S>& x) {
      if (const int place = system_.pattern().position(b) - kSoon; large_ && place >= 0) {
        const int next = system_.pattern().row_at(place);
        fetch(end.v, next);
        fetch(m, next);
        fetch(at_, next);
        fetch(rhs_, next);
      }
      move(b, x);
    });
  }

  // Puts the joints' forces at their gaps into force_rhs_, by the matrix's map so that the balance removes all of their error; and the
  // right-hand side for their accelerations into rhs_. Returns what is left of the rates, over their rounding.
  double assemble_force_balance(const BasicStage<S>& last, BasicState<S>& end, const std::vector<typename S::Motion>& m) {
    for (std::size_t b = 0; b < n_bodies(); ++b)
      for (int k = 0; k < S::kDof; ++k) accel_[b][k] = last.a[b][k];
    clear(rhs_);
    clear(force_rhs_);
    L left = L::all(0);
    const auto over_rounding = inverses(rounding_of_rate_);
    for (const BasicJointPack<S>& joints : joints_) {
      if (large_) fetch_forces(joints, last, end);
      typename S::template GapMap<L> map;
      const Kinematics r = read(joints, end.t, m, map, last);
      L accel[S::kDof], gap[S::kDof], rate[S::kDof], force[S::kDof];
      joints.gather(map, accel_, accel);
      for (int k = 0; k < S::kDof; ++k) {
        const L carried = joints.load(last.gap_rate, k);
        left = larger_size(left, joints.forbidden[k] * over_rounding[joints.linear][k] * (carried - r.rate[k]));
        accel[k] = joints.load(last.gap_accel, k) - r.bias[k] - accel[k];
        gap[k] = carried_or(joints.load(last.gap, k), r.gap[k], rounding_[joints.linear][k]);
        rate[k] = carried_or(carried, r.rate[k], rounding_of_rate_[joints.linear][k]);
      }
      joints.store(gap, end.gap);
      joints.store(rate, end.gap_rate);
      add_to_rhs(joints, accel);
      find_force(joints, end, gap, rate, force);
      joints.store(force, end.force);
      joints.push(force, force_rhs_);
    }
    return largest_of(left);
  }

  void find_force(const BasicJointPack<S>& joints, const BasicState<S>& end, const L (&gap)[S::kDof], const L (&rate)[S::kDof], L (&force)[S::kDof]) const {
    if (joints.linear) {
      for (int k = 0; k < S::kDof; ++k) force[k] = -(joints.k[k] * gap[k] + joints.c[k] * rate[k]);
      return;
    }
    const BasicJointData<S>& joint = system_.joints[joints.first];
    typename S::Vec e, v;
    for (int k = 0; k < S::kDof; ++k) {
      e[k] = gap[k][0];
      v[k] = rate[k][0];
    }
    const typename S::Vec f = joint.law.force({end.t, e, v, end.law_state.data() + joint.first_state});
    for (int k = 0; k < S::kDof; ++k) force[k] = L::all(f[k]);
  }

  // At the end of the step positions and velocities are more accurate than anywhere inside, and so are the forces that
  // balance them. The magnitudes of the loads on each body go into rhs_.
  void balance(const BasicStage<S>& last, BasicState<S>& end, BasicLoadScale<S>& scale) {
    answer(rhs_);
    for (std::size_t b = 0; b < n_bodies(); ++b)
      for (int k = 0; k < S::kDof; ++k) {
        const double mass = system_.bodies[b].mass[k];
        force_rhs_[b][k] += last.Q[b][k] - mass * (last.a[b][k] + rhs_[b][k]);
        rhs_[b][k] = std::abs(last.Q[b][k]) + std::abs(mass * end.a[b][k]);
      }
    answer(force_rhs_);
    force_rhs_.back() = {};  // the ground's
    for (const BasicJointPack<S>& joints : joints_) {
      if (large_) fetch_balance(joints, end);
      L gap[S::kDof], force[S::kDof];
      joints.gather(joints.map, force_rhs_, gap);
      weigh<S::kDof>(joints.linear, joints.weight, gap, force);
      for (int k = 0; k < S::kDof; ++k) force[k] = joints.load(end.force, k) - force[k];
      joints.store(force, end.force);
      joints.push_magnitudes(force, rhs_);
    }
    for (std::size_t b = 0; b < n_bodies(); ++b) raise_scale(system_.bodies[b], typename S::Vec(Eigen::Map<const typename S::Vec>(rhs_[b].a.data())), scale.body[b]);
  }

  // Prefetches joints that come later, and returns those whose data are to be prefetched next; null after the last ones.
  PINTLE_LANES const BasicJointPack<S>* soon(const BasicJointPack<S>& joints) const {
    const std::size_t place = &joints - joints_.data();
    fetch(joints_, place + kLater);
    return place + kNext < joints_.size() ? &joints_[place + kNext] : nullptr;
  }
  PINTLE_LANES void fetch_corrections(const BasicJointPack<S>& joints, const BasicStage<S>& last, const BasicStageTails<S>& tails) const {
    const BasicJointPack<S>* next = soon(joints);
    if (!next) return;
    next->fetch_joints(last.gap);
    next->fetch_joints(tails.gaps);
    next->fetch_bodies(at_);
    next->fetch_bodies(corrections_);
    for (int i = 0; i < next->n; ++i)
      for (const int body : {next->a[i], next->b[i]})
        if (body < system_.n_bodies()) lu_.fetch_row(system_.pattern().position(body));
  }
  PINTLE_LANES const BasicJointPack<S>* fetch_kinematics(const BasicJointPack<S>& joints, const BasicStage<S>& last) const {
    const BasicJointPack<S>* next = soon(joints);
    if (!next) return next;
    next->fetch_joints(last.gap);
    next->fetch_joints(last.gap_rate);
    next->fetch_bodies(at_);
    next->fetch_bodies(rhs_);
    return next;
  }
  PINTLE_LANES void fetch_forces(const BasicJointPack<S>& joints, const BasicStage<S>& last, const BasicState<S>& end) const {
    const BasicJointPack<S>* next = fetch_kinematics(joints, last);
    if (!next) return;
    for (const VecsOf<S>* x : {&last.gap_accel, &end.gap, &end.gap_rate, &end.force}) next->fetch_joints(*x);
    next->fetch_bodies(accel_);
    next->fetch_bodies(force_rhs_);
  }
  PINTLE_LANES void fetch_balance(const BasicJointPack<S>& joints, const BasicState<S>& end) const {
    const BasicJointPack<S>* next = soon(joints);
    if (!next) return;
    next->fetch_joints(end.force);
    next->fetch_bodies(force_rhs_);
    next->fetch_bodies(rhs_);
  }

  static constexpr int kSoon = 16;                     // prefetch distance in bodies
  static constexpr std::size_t kNext = 2, kLater = 4;  // prefetch distances in packs: of their data; of the packs themselves

  const BasicSystem<S>& system_;
  const bool large_;
  std::vector<BasicJointPack<S>> joints_;
  const bool has_states_;               // some laws have states
  std::vector<RowOf4<S>> state_loads_;  // tails of what these laws add to the loads on bodies
  BasicLawTangents<S> tangents_;            // of one joint at a time
  LawImpedance<double, S> impedance_;
  BlockLu<double, S::kDof> lu_;
  std::vector<BodyAt<S>> at_;          // of bodies and the ground, like those below
  std::vector<RowOf4<S>> corrections_;
  std::vector<BodyPull<S>> pulled_;  // how taut joints hold each body: first as BodyPull, then as stiffnesses [N/m, N/m, N*m/rad]
  bool taut_ = false;            // a body is held
  std::vector<RowOf4<S>> rest_of_four_;
  std::vector<BodyRow<S>> rest_;
  std::vector<BodyRow<S>> accel_, rhs_, force_rhs_;
  using OfLaws = std::array<typename S::Vec, 2>;
  static OfLaws inverses(const OfLaws& x) { return {x[kNear].cwiseInverse(), x[kTurned].cwiseInverse()}; }
  // Rounding of gaps and their rates, from the positions and velocities of bodies: of joints whose laws may have borders, which are located in the bodies' gaps; and of linear ones.
  enum { kNear, kTurned };
  OfLaws rounding_, rounding_of_rate_;
};

// The same code for registers of every width.
#define PINTLE_END_POINT(Name, WIDTH)                                                                                                         \
  template <class S>                                                                                                                          \
  class Name final : public LaneEndPointProjection<S> {                                                                                          \
   public:                                                                                                                                    \
    using LaneEndPointProjection<S>::LaneEndPointProjection;                                                                                     \
    WIDTH bool prepare(double t, double mu, const BasicStage<S>& last, BasicStageTails<S>& tails) override { return this->find_corrections(t, mu, last, tails); }   \
    WIDTH double error(const BasicStageTails<S>& tails, const BasicLoadScale<S>& scale) const override { return this->find_error(tails, scale); }                   \
    WIDTH void finish(const BasicStage<S>& last, double h, BasicState<S>& end, std::vector<typename S::Motion>& m, BasicLoadScale<S>& scale) override { this->project(last, h, end, m, scale); } \
  };

PINTLE_END_POINT(NarrowEndPointProjection, )
PINTLE_END_POINT(WideEndPointProjection, PINTLE_WIDE)
PINTLE_END_POINT(WidestEndPointProjection, PINTLE_WIDEST)
#undef PINTLE_END_POINT

}  // namespace

template <class S>
std::unique_ptr<BasicEndPointProjection<S>> make_end_point_projection(const BasicSystem<S>& system) {
  using Widest = std::conditional_t<S::kCurved, WideEndPointProjection<S>, WidestEndPointProjection<S>>;
  return make_for_processor<BasicEndPointProjection<S>, NarrowEndPointProjection<S>, WideEndPointProjection<S>, Widest>(system);
}

template std::unique_ptr<BasicEndPointProjection<Planar>> make_end_point_projection(const BasicSystem<Planar>& system);
PINTLE_IN_SPACE(template std::unique_ptr<BasicEndPointProjection<Spatial>> make_end_point_projection(const BasicSystem<Spatial>& system);)

}  // namespace pintle
