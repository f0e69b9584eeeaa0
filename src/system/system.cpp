#include "system/system.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "system/speed_integral.h"

namespace pintle {

template <class S>
std::array<double, 3> target_of(const BasicJointData<S>& joint, double t) {
  if (joint.speed_integral) {
    const auto speed = joint.target.second_order(std::array{t}, 0);
    return {joint.start + joint.speed_integral->integral_to(t), speed[0], speed[1]};
  }
  auto target = joint.target.variables().empty() ? std::array<double, 3>{joint.target.value({}), 0, 0}
                                                 : joint.target.second_order(std::array{t}, 0);
  target[0] += joint.start + joint.speed * t;
  target[1] += joint.speed;
  return target;
}

template <class S>
void BasicSystem<S>::finish(const BasicSystem<S>* like) {
  n_law_states_ = 0;
  for (BasicJointData<S>& joint : joints) {
    joint.first_state = n_law_states_;
    n_law_states_ += joint.law.n_states();
  }
  coupled_.clear();
  const auto couple = [this](int a, int b) {
    if (a != kGround && b != kGround && a != b) coupled_.emplace_back(a, b);
  };
  for (const BasicJointData<S>& joint : joints) couple(joint.at.a, joint.at.b);
  for (const BasicLoadData<S>& load : loads) {
    couple(load.at.a, load.at.b);
    for (const BasicSignal<S>& signal : load.signals) {
      if (signal.is_time) continue;
      for (const int i : {load.at.a, load.at.b})
        for (const int j : {signal.at.a, signal.at.b}) couple(i, j);
    }
  }
  const bool same = like && like->n_bodies() == n_bodies() && like->coupled_ == coupled_;
  pattern_ = same ? like->pattern_ : std::make_shared<const BlockPattern>(n_bodies(), coupled_);
  list_switching();
}

// In the order in which evaluate_switching_functions writes their values.
template <class S>
void BasicSystem<S>::list_switching() {
  switching_.clear();
  const auto list = [this](SwitchingFunction::Owner owner, int index, int part, const Expression& e) {
    for (int border = 0; border < e.n_switches(); ++border) switching_.push_back({owner, index, part, border});
  };
  for (int j = 0; j < n_joints(); ++j) {
    for (int p = 0; const auto& part : joints[j].law.parts()) {
      for (int border = 0; border < part->n_borders(); ++border)
        switching_.push_back({SwitchingFunction::Owner::kLaw, j, p, border, part->border_direction(border), part->n_states() > 0, part->n_states() > 0 || part->reports_crossings()});
      ++p;
    }
    if (joints[j].driven >= 0) list(SwitchingFunction::Owner::kDrive, j, 0, joints[j].target);
  }
  for (int l = 0; l < static_cast<int>(loads.size()); ++l)
    if (loads[l].kind == LoadKind::kEffort) list(SwitchingFunction::Owner::kMotor, l, 0, loads[l].law);
  for (int f = 0; f < static_cast<int>(applied.size()); ++f)
    for (int c = 0; const Expression* e : applied[f].functions()) list(SwitchingFunction::Owner::kForce, f, c++, *e);
}

template <class S>
std::string BasicSystem<S>::name(const SwitchingFunction& function) const {
  using Owner = SwitchingFunction::Owner;
  const auto at = static_cast<std::size_t>(function.index);
  if (function.owner == Owner::kLaw)
    return fmt::format("border {} of law \"{}\" in joint {}", function.border + 1, joints[at].law.parts()[static_cast<std::size_t>(function.part)]->word(), joints[at].name);
  const auto kink = [&function](const std::string& of, const Expression& e) { return fmt::format("kink or jump {} of {} ({})", function.border + 1, of, e.text()); };
  if (function.owner == Owner::kDrive) return kink((joints[at].servo >= 0 ? "motor " : "the length of joint ") + joints[at].name, joints[at].target);
  if (function.owner == Owner::kMotor) return kink((loads[at].applied ? "force " : "motor ") + loads[at].name, loads[at].law);
  const BasicAppliedData<S>& force = applied[at];
  return kink("force " + force.name, *force.functions()[static_cast<std::size_t>(function.part)]);
}

template <class S>
void BasicSystem<S>::motions(const PositionsOf<S>& q, const VecsOf<S>& v, std::vector<typename S::Motion>& out) const {
  out.resize(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) out[i] = S::Motion::of(q[i], v[i]);
}

template <class S>
BasicJointKinematics<S> BasicSystem<S>::kinematics(int j, double t, const std::vector<typename S::Motion>& m) const {
  const BasicJointData<S>& joint = joints[j];
  BasicJointKinematics<S> r = read(joint.displacement, pose(joint.at, m));
  if (joint.driven < 0) return r;
  const auto target = target_of(joint, t);
  r.gap[joint.driven] -= target[0];
  r.rate[joint.driven] -= target[1];
  r.bias[joint.driven] -= target[2];
  return r;
}

template <class S>
typename BasicSystem<S>::Vec BasicSystem<S>::own_mobility(const BasicPlacement<S>& at, const BasicJointKinematics<S>& r) const {
  Vec mobility = Vec::Zero();
  if (at.a != kGround) mobility += r.GA().cwiseAbs2() * bodies[at.a].mass.cwiseInverse();
  if (at.b != kGround) mobility += r.GB().cwiseAbs2() * bodies[at.b].mass.cwiseInverse();
  return mobility;
}

// theory/joints Eqs. (4.5), (4.6).
template <class S>
double BasicSystem<S>::drive_power(const BasicJointData<S>& joint, double t, const std::vector<typename S::Motion>& m, const Vec& force) const {
  if (joint.servo >= 0) return force[joint.servo] * pose(joint.at, m).rate[joint.servo];
  if (joint.law.feeds() || joint.law.depends_on_reaction_alone()) {
    const BasicJointKinematics<S> r = read(joint.displacement, pose(joint.at, m));
    return joint.law.supply({t, r.gap, r.rate}, force);
  }
  return joint.driven >= 0 ? force[joint.driven] * target_of(joint, t)[1] : 0;
}

template <class S>
void BasicSystem<S>::joint_kinematics(double t, const std::vector<typename S::Motion>& m, std::vector<BasicJointKinematics<S>>& out) const {
  out.resize(joints.size());
  for (int j = 0; j < n_joints(); ++j) out[j] = kinematics(j, t, m);
}

template <class S>
void BasicSystem<S>::accelerations(double t, const PositionsOf<S>& q, const VecsOf<S>& v, VecsOf<S>& a, const double* law_state, double* law_rate) const {
  thread_local std::vector<typename S::Motion> m;
  motions(q, v, m);
  external(t, m, a);
  for (int j = 0; j < n_joints(); ++j) {
    const BasicJointKinematics<S> r = kinematics(j, t, m);
    const BasicLawPoint<S> at{t, r.gap, r.rate, law_state + joints[j].first_state};
    const Vec f = joints[j].law.force(at);
    add_force(joints[j].at, r, f, a);
    if (law_rate) joints[j].law.state_rates(at, law_rate + joints[j].first_state);
  }
  for (int i = 0; i < n_bodies(); ++i) a[i] = a[i].cwiseQuotient(bodies[i].mass);
}

template <class S>
double BasicSystem<S>::kinetic(const VecsOf<S>& v) const {
  double twice = 0;
  for (int i = 0; i < n_bodies(); ++i) twice += v[i].dot(bodies[i].mass.cwiseProduct(v[i]));
  return 0.5 * twice;
}

template <class S>
double BasicSystem<S>::largest_speed(const VecsOf<S>& v) const {
  double largest = 0;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const double turning = bodies[i].radius_of_gyration() * v[i].template tail<S::kDof - S::kDim>().norm();
    largest = std::max(largest, std::sqrt(std::max(v[i].template head<S::kDim>().squaredNorm(), turning * turning)));
  }
  return largest;
}

template <class S>
double BasicSystem<S>::largest_radius_of_gyration() const {
  double largest = 0;
  for (const BasicBodyData<S>& body : bodies) largest = std::max(largest, body.radius_of_gyration());
  return largest;
}

template std::array<double, 3> target_of(const BasicJointData<Planar>& joint, double t);
PINTLE_IN_SPACE(template std::array<double, 3> target_of(const BasicJointData<Spatial>& joint, double t);)

template class BasicSystem<Planar>;
PINTLE_IN_SPACE(template class BasicSystem<Spatial>;)

}  // namespace pintle
