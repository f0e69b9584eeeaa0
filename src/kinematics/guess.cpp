#include "kinematics/guess.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>

#include "system/pose_joint.h"

namespace pintle {
namespace {

using S = Planar;

bool joins_angles(const JointData& joint) { return is_pose_joint(joint) && joint.held[2]; }

// The gap of a joint that is put together.
S::Vec rest_gap(const JointData& joint) {
  S::Vec misfit = S::Vec::Zero();
  joint.law.keep_misfit(misfit);
  return -misfit;
}

// Puts body `b` onto the joint's other half, as far from it as the joint is at rest; `other` is placed already.
void put(const JointData& joint, int b, const Model& model, const std::vector<S::Motion>& m, Vecs& q) {
  const bool is_second = joint.at.b == b;
  const int other = is_second ? joint.at.a : joint.at.b;
  const S::Frame &mine = is_second ? joint.at.M : joint.at.F, &theirs = is_second ? joint.at.F : joint.at.M;
  const S::Motion still{}, &o = other == kGround ? still : m[other];
  const S::Vec rest = rest_gap(joint);
  if (!model.bodies[b].angle) q[b][2] = joins_angles(joint) ? o.angle + theirs.angle - mine.angle + (is_second ? rest[2] : -rest[2]) : 0;
  if (model.bodies[b].position) return;
  const S::Motion me = S::Motion::of({0, 0, q[b][2]}, S::Vec::Zero());
  S::Point p = o.p + o.turned(theirs.p) - me.turned(mine.p);
  if (const auto* pose = std::get_if<Selection>(&joint.displacement)) {
    const S::Point apart = S::Motion::of({0, 0, is_second ? o.angle + theirs.angle : q[b][2] + mine.angle}, S::Vec::Zero()).turned(pose->offset.head<2>() + rest.head<2>());
    p += is_second ? apart : S::Point(-apart);
  }
  q[b][0] = p.x();
  q[b][1] = p.y();
}

// The joints of each body; last those of the ground.
std::vector<std::vector<int>> joints_of_bodies(const System& system) {
  std::vector<std::vector<int>> joints(static_cast<std::size_t>(system.n_bodies()) + 1);
  for (int j = 0; j < system.n_joints(); ++j)
    for (const int b : {system.joints[j].at.a, system.joints[j].at.b}) joints[static_cast<std::size_t>(b == kGround ? system.n_bodies() : b)].push_back(j);
  return joints;
}

// What of the velocity of the joint's body `b` is not stated, from the motion of the other one.
void follow(const JointData& joint, int b, const Body& stated, const std::vector<S::Motion>& m, S::Vec& v) {
  if (stated.velocity) return;
  const bool is_second = joint.at.b == b;
  const int other = is_second ? joint.at.a : joint.at.b;
  const S::Motion still{}, &o = other == kGround ? still : m[static_cast<std::size_t>(other)], &me = m[static_cast<std::size_t>(b)];
  const auto moved_by = [](double spin, const S::Point& r) { return S::Point(-spin * r.y(), spin * r.x()); };
  const S::Point arm = me.turned((is_second ? joint.at.M : joint.at.F).p), at = me.p + arm;
  const double spin = stated.spin.value_or(o.w);
  const S::Point move = o.v + moved_by(o.w, at - o.p) - moved_by(spin, arm);
  v = {move.x(), move.y(), spin};
}

}  // namespace

bool all_positions_stated(const Model& model) {
  return std::all_of(model.bodies.begin(), model.bodies.end(), [](const Body& b) { return b.position && b.angle; });
}

Vecs stated_velocities(const Model& model) {
  Vecs v;
  for (const Body& body : model.bodies) {
    const Vec2 move = body.velocity.value_or(Vec2{0, 0});
    v.emplace_back(move[0], move[1], body.spin.value_or(0));
  }
  return v;
}

Vecs guess_positions(const Model& model, const System& system) {
  const int n = system.n_bodies();
  Vecs q;
  for (const Body& body : model.bodies) {
    const Vec2 p = body.position.value_or(Vec2{0, 0});
    q.emplace_back(p[0], p[1], body.angle.value_or(0));
  }
  const std::vector<std::vector<int>> joints_of = joints_of_bodies(system);
  std::vector<bool> placed(n + 1, false);
  std::deque<int> queue{n};
  placed[n] = true;
  for (int i = 0; i < n; ++i)
    if (model.bodies[i].position && model.bodies[i].angle) {
      placed[i] = true;
      queue.push_back(i);
    }
  std::vector<S::Motion> m;
  system.motions(q, Vecs(q.size(), S::Vec::Zero()), m);
  const auto spread = [&] {
    while (!queue.empty()) {
      const int at = queue.front();
      queue.pop_front();
      for (const int j : joints_of[at]) {
        const JointData& joint = system.joints[j];
        const int a = joint.at.a == kGround ? n : joint.at.a, b = joint.at.b == kGround ? n : joint.at.b;
        const int next = a == at ? b : a;
        if (placed[next] || !is_pose_joint(joint)) continue;
        put(joint, next, model, m, q);
        m[next] = S::Motion::of(q[next], S::Vec::Zero());
        placed[next] = true;
        queue.push_back(next);
      }
    }
  };
  spread();
  for (int i = 0; i < n; ++i)
    if (!placed[i]) {
      placed[i] = true;
      queue.push_back(i);
      spread();
    }
  return q;
}

Vecs guess_velocities(const Model& model, const System& system, const Vecs& q) {
  const int n = system.n_bodies();
  Vecs v = stated_velocities(model);
  std::vector<S::Motion> m;
  system.motions(q, v, m);
  const std::vector<std::vector<int>> joints_of = joints_of_bodies(system);
  std::vector<bool> known(static_cast<std::size_t>(n) + 1, false);
  const auto spread = [&](int from) {
    known[static_cast<std::size_t>(from)] = true;
    std::deque<int> queue{from};
    while (!queue.empty()) {
      const int at = queue.front();
      queue.pop_front();
      for (const int j : joints_of[static_cast<std::size_t>(at)]) {
        const JointData& joint = system.joints[j];
        const int a = joint.at.a == kGround ? n : joint.at.a, b = joint.at.b == kGround ? n : joint.at.b, next = a == at ? b : a;
        if (known[static_cast<std::size_t>(next)] || !is_pose_joint(joint)) continue;
        follow(joint, next, model.bodies[static_cast<std::size_t>(next)], m, v[static_cast<std::size_t>(next)]);
        m[static_cast<std::size_t>(next)].set_velocity(v[static_cast<std::size_t>(next)]);
        known[static_cast<std::size_t>(next)] = true;
        queue.push_back(next);
      }
    }
  };
  spread(n);
  for (int i = 0; i < n; ++i) {  // what does not hang on the ground
    const Body& body = model.bodies[static_cast<std::size_t>(i)];
    if (!known[static_cast<std::size_t>(i)] && (body.velocity || body.spin)) spread(i);
  }
  return v;
}

std::string loop_through(const System& system, const std::string& text) {
  const int n = system.n_bodies();
  int start = -1;
  for (int j = 0; j < system.n_joints() && start < 0; ++j)
    if (text.find(fmt::format("joint {} ", system.joints[j].name)) != std::string::npos) start = j;
  if (start < 0) return "-";
  const auto node = [n](int body) { return body == kGround ? n : body; };
  std::vector<std::vector<int>> joints_of(n + 1);
  for (int j = 0; j < system.n_joints(); ++j)
    if (system.joints[j].servo < 0)  // a servo acts along its joint, it closes nothing
      for (const int b : {system.joints[j].at.a, system.joints[j].at.b}) joints_of[node(b)].push_back(j);
  std::vector<int> by(n + 1, -1);  // joint by which a body was reached
  std::deque<int> queue{node(system.joints[start].at.a)};
  by[queue.front()] = start;
  const int goal = node(system.joints[start].at.b);
  while (!queue.empty()) {
    const int at = queue.front();
    queue.pop_front();
    for (const int j : joints_of[at]) {
      if (j == start) continue;
      const int a = node(system.joints[j].at.a), b = node(system.joints[j].at.b);
      if (by[a == at ? b : a] >= 0) continue;
      by[a == at ? b : a] = j;
      queue.push_back(a == at ? b : a);
    }
  }
  if (by[goal] < 0) return system.joints[start].name + " (no other path between its bodies)";
  std::string names = system.joints[start].name;
  for (int at = goal; at != node(system.joints[start].at.a);) {
    const int j = by[at];
    names += ", " + system.joints[j].name;
    const int a = node(system.joints[j].at.a), b = node(system.joints[j].at.b);
    at = a == at ? b : a;
  }
  return names;
}

}  // namespace pintle
