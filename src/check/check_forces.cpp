// The forces of a joint displacement on its two bodies: equal and opposite, in force and in moment; and what a common rigid motion
// must not change.
#include <cmath>

#include "check/check_batteries.h"
#include "check/check_differences.h"

namespace pintle {
namespace {

using S = Planar;

// The motion turned about the origin by `angle` and then shifted, including its velocity.
S::Motion displaced(const S::Motion& m, double angle, const S::Point& shift) {
  S::Motion turn;
  turn.c = std::cos(angle);
  turn.s = std::sin(angle);
  S::Motion out = m;
  out.p = turn.turned(m.p) + shift;
  out.v = turn.turned(m.v);
  out.angle = m.angle + angle;
  out.c = std::cos(out.angle);
  out.s = std::sin(out.angle);
  return out;
}

class LinkForces {
 public:
  void look(const CheckLink& link, const CheckState& state) {
    const S::Motion A = motion_of(link.at.a, state.m), B = motion_of(link.at.b, state.m);
    const RelativePose pose = RelativePose::between(A, link.at.F, B, link.at.M);
    if (!(link_steps(link, pose, state.length).length > 1e-12)) return;
    const JointKinematics r = read(link.displacement, pose);
    const CheckPlace place{link.kind, link.name, state.number};
    look_at_balance(link, r, A, B, state, place);
    look_at_rigid_motion(link, r, A, B, state, place);
  }
  void report(CheckBattery& battery) const {
    for (const Comparisons* c : {&force_, &moment_, &rigid_}) battery.items.push_back(c->item());
  }

 private:
  void look_at_balance(const CheckLink& link, const JointKinematics& r, const S::Motion& A, const S::Motion& B,
                       const CheckState& state, const CheckPlace& place) {
    const S::Vec f =
        std::holds_alternative<Selection>(link.displacement) ? S::Vec(0.9, -0.6, 0.3 * state.length) : S::Vec(1.2, 0, 0);
    const S::Vec on_a = r.GA().transpose() * f, on_b = r.GB().transpose() * f;
    force_.vanishes((on_a + on_b).head<2>().norm(), on_a.head<2>().norm() + on_b.head<2>().norm() + f.norm(), place);
    const S::Point about(0.3 * state.length, -0.7 * state.length);
    const double moment_a = on_a[2] + S::cross(A.p - about, on_a.head<2>()),
                 moment_b = on_b[2] + S::cross(B.p - about, on_b.head<2>());
    const double arms = (A.p - about).norm() + (B.p - about).norm() + state.length;
    moment_.vanishes(moment_a + moment_b, std::abs(on_a[2]) + std::abs(on_b[2]) + arms * f.norm(), place);
  }

  void look_at_rigid_motion(const CheckLink& link, const JointKinematics& r, const S::Motion& A, const S::Motion& B,
                            const CheckState& state, const CheckPlace& place) {
    const S::Point shift(2.1 * state.length, -1.3 * state.length);
    const JointKinematics moved = read(
        link.displacement, RelativePose::between(displaced(A, 0.8, shift), link.at.F, displaced(B, 0.8, shift), link.at.M));
    const double reach = A.p.norm() + B.p.norm() + shift.norm() + state.length;
    const double speed = A.v.norm() + B.v.norm() + (std::abs(A.w) + std::abs(B.w)) * reach;
    rigid_.vanishes((moved.gap - r.gap).norm(), reach + 10, place);
    rigid_.vanishes((moved.rate - r.rate).norm(), speed + (std::abs(A.w) + std::abs(B.w)), place);
    const auto swept = [](const S::Motion& m) { return S::Vec(0.4 - 0.9 * m.p.y(), -0.2 + 0.9 * m.p.x(), 0.9); };
    rigid_.vanishes((r.GA() * swept(A) + r.GB() * swept(B)).norm(), reach + 1 + r.GA().norm() + r.GB().norm(), place);
  }

  Comparisons force_{"equal and opposite forces", kIdentityTolerance},
      moment_{"equal and opposite moments", kIdentityTolerance},
      rigid_{"invariant under rigid motion", kIdentityTolerance};
};

}  // namespace

void check_link_forces(const System& system, const std::vector<CheckState>& states, CheckBattery& battery) {
  LinkForces forces;
  const std::vector<CheckLink> links = check_links(system);
  for (const CheckState& state : states)
    for (const CheckLink& link : links) forces.look(link, state);
  forces.report(battery);
}

}  // namespace pintle
