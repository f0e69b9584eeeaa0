#include "check/check_links.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "joints/belt.h"
#include "mobility/constraint_rows.h"
#include "system/load_displacement.h"

namespace pintle {
namespace {

using S = Planar;

constexpr int kManyBodies = 1000;  // fewer states are checked beyond this

std::string_view kind_of(const LoadData& load) {
  switch (load.kind) {
    case LoadKind::kSpring:
      return "spring";
    case LoadKind::kTorsionSpring:
      return "torsion spring";
    case LoadKind::kEffort:
      return load.applied ? "force" : "motor";
  }
  return "load";
}

// The smallest distance by which an end of a belt or rope is outside the other disc [m]; infinite: there are no discs.
double nearest_to_disc(const System& system, const CheckState& state) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const JointData& joint : system.joints) {
    const std::optional<Belt> belt = belt_of(joint.displacement);
    if (!belt || belt->w() == 0) continue;
    nearest = std::min(nearest, std::max(0.0, system.pose(joint.at, state.m).z.head<2>().norm() - std::abs(belt->w())));
  }
  return nearest;
}

// A state near enough for both ends of every belt to stay outside its discs, where a run between them exists.
CheckState disturbed(const CheckState& from, const System& system, double duration, int number) {
  constexpr double kShift = 0.02;        // as a fraction of the length; [rad]
  constexpr double kTowardsDiscs = 0.1;  // upper limit on the shift of a body, as a fraction of the distance from the end of a belt to a disc
  const double of_length = std::min(kShift, kTowardsDiscs * nearest_to_disc(system, from) / from.length);
  CheckState state = from;
  Noise noise(77u + static_cast<unsigned>(number));
  state.number = number;
  state.t = duration * (0.5 + 0.5 * noise());
  for (int i = 0; i < system.n_bodies(); ++i) {
    state.q[i] += noise.vec().cwiseProduct(S::Vec(of_length * state.length, of_length * state.length, of_length));
    state.v[i] += state.speed * noise.vec().cwiseProduct(S::Vec(1, 1, 1 / state.length));
  }
  system.motions(state.q, state.v, state.m);
  return state;
}

}  // namespace

std::vector<CheckLink> check_links(const System& system) {
  std::vector<CheckLink> links;
  for (int j = 0; j < system.n_joints(); ++j) {
    const JointData& joint = system.joints[j];
    links.push_back({joint.servo >= 0 ? "motor" : "joint", joint.name, joint.at, joint.displacement, j, has_slip(joint.displacement) ? kSlip : -1});
  }
  for (const LoadData& load : system.loads) links.push_back({kind_of(load), load.name, load.at, displacement_of(load), -1, acts_in_body_axes(load) ? 0 : -1});
  return links;
}

double Noise::operator()() {
  state_ =
      state_ * 6364136223846793005ULL + 1442695040888963407ULL;  // Knuth's linear congruential generator; its high bits are good
  return static_cast<double>(state_ >> 11) * 0x1p-52 - 1;
}

std::vector<CheckState> check_states(const Model& model, const System& system, const State& assembled) {
  CheckState first;
  first.t = assembled.t;
  first.q = assembled.q;
  first.v = assembled.v;
  system.motions(first.q, first.v, first.m);
  first.length = arm_length(system, kinematics_at_rest(system, first.q));
  for (const auto& v : first.v)
    first.speed = std::max({first.speed, v.head<2>().norm(), std::abs(v[2]) * first.length});
  std::vector<CheckState> states{first};
  const double duration = model.simulate.duration > 0 ? model.simulate.duration : 1;
  const int more = system.n_bodies() <= kManyBodies ? 3 : 1;
  for (int number = 1; number <= more; ++number) states.push_back(disturbed(first, system, duration, number));
  return states;
}

LinkSteps link_steps(const CheckLink& link, const RelativePose& pose, double arm) {
  constexpr double kShort = 1e-3;
  const std::optional<Belt> belt = belt_of(link.displacement);
  const bool direction_counts = std::holds_alternative<Distance>(link.displacement) || std::holds_alternative<Mesh>(link.displacement) || belt;
  const double reach = std::max({pose.arm_a.norm(), pose.arm_b.norm(), 1e-12});
  const double length = !direction_counts ? arm : belt ? belt->run(pose.z) : pose.z.head<2>().norm();
  return {kShort * length, kShort * (direction_counts ? std::min(1.0, length / reach) : 1.0)};
}

void DisturbedLink::put(const Vec6& dq, double dt) {
  const auto place = [&](int body, const S::Vec& d) {
    if (body == kGround) return;
    const S::Vec q = state_.q[body] + d + dt * state_.v[body];
    m_[body] = S::Motion::of(q, state_.v[body]);
  };
  place(link_.at.a, dq.head<3>());
  place(link_.at.b, dq.tail<3>());
}

JointKinematics DisturbedLink::kinematics(const Vec6& dq, double dt) {
  put(dq, dt);
  return link_.joint >= 0 ? system_.kinematics(link_.joint, state_.t + dt, m_) : read(link_.displacement, pose());
}

DisturbedLink::Vec6 DisturbedLink::velocities() const {
  Vec6 v = Vec6::Zero();
  if (link_.at.a != kGround) v.head<3>() = state_.v[link_.at.a];
  if (link_.at.b != kGround) v.tail<3>() = state_.v[link_.at.b];
  return v;
}

}  // namespace pintle
