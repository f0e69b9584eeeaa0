#include "kinematics/guess.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>

#include "system/pose_joint.h"

namespace pintle {
namespace {

using S = Planar;

bool joins_angles(const JointData& joint) { return is_pose_joint(joint) && joint.held[2]; }

// The gap of an assembled joint.
S::Vec rest_gap(const JointData& joint) { return -joint.law.misfit(S::Vec::Zero()); }

// Attaches body `b` to the joint's other half, at the joint's rest gap; `other` is already placed.
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

// The joints of each body; those of the ground come last.
std::vector<std::vector<int>> joints_of_bodies(const System& system) {
  std::vector<std::vector<int>> joints(system.n_bodies() + 1);
  for (int j = 0; j < system.n_joints(); ++j)
    for (const int b : {system.joints[j].at.a, system.joints[j].at.b}) joints[b == kGround ? system.n_bodies() : b].push_back(j);
  return joints;
}

// Breadth-first walk from body to body along the joints that hold a pose.
class PoseWalk {
 public:
  explicit PoseWalk(const System& system) : system_(system), joints_of_(joints_of_bodies(system)), reached_(joints_of_.size(), false) {}

  bool reached(int body) const { return reached_[body]; }
  void begin_at_ground() { begin_at(system_.n_bodies()); }
  void begin_at(int body) {
    reached_[body] = true;
    queue_.push_back(body);
  }
  // Calls visit(joint, body) for every body reached.
  template <class Visit>
  void go_on(const Visit& visit) {
    const auto node = [this](int body) { return body == kGround ? system_.n_bodies() : body; };
    while (!queue_.empty()) {
      const int at = queue_.front();
      queue_.pop_front();
      for (const int j : joints_of_[at]) {
        const JointData& joint = system_.joints[j];
        const int a = node(joint.at.a), next = a == at ? node(joint.at.b) : a;
        if (reached_[next] || !is_pose_joint(joint)) continue;
        visit(joint, next);
        begin_at(next);
      }
    }
  }

 private:
  const System& system_;
  std::vector<std::vector<int>> joints_of_;
  std::vector<bool> reached_;
  std::deque<int> queue_;
};

// Sets the unstated velocities of the joint's body `b` from the motion of the other body.
void follow(const JointData& joint, int b, const Body& stated, const std::vector<S::Motion>& m, S::Vec& v) {
  if (stated.velocity) return;
  const bool is_second = joint.at.b == b;
  const int other = is_second ? joint.at.a : joint.at.b;
  const S::Motion still{}, &o = other == kGround ? still : m[other], &me = m[b];
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
  PoseWalk walk(system);
  walk.begin_at_ground();
  for (int i = 0; i < n; ++i)
    if (model.bodies[i].position && model.bodies[i].angle) walk.begin_at(i);
  std::vector<S::Motion> m;
  system.motions(q, Vecs(q.size(), S::Vec::Zero()), m);
  const auto place = [&](const JointData& joint, int body) {
    put(joint, body, model, m, q);
    m[body] = S::Motion::of(q[body], S::Vec::Zero());
  };
  walk.go_on(place);
  for (int i = 0; i < n; ++i) {
    if (walk.reached(i)) continue;
    walk.begin_at(i);
    walk.go_on(place);
  }
  return q;
}

Vecs guess_velocities(const Model& model, const System& system, const Vecs& q) {
  Vecs v = stated_velocities(model);
  std::vector<S::Motion> m;
  system.motions(q, v, m);
  const auto move = [&](const JointData& joint, int body) {
    follow(joint, body, model.bodies[body], m, v[body]);
    m[body].set_velocity(v[body]);
  };
  PoseWalk walk(system);
  walk.begin_at_ground();
  walk.go_on(move);
  // Bodies not connected to the ground: start where most is stated, independently of the order of the bodies.
  const auto begin_where = [&](const auto& is_stated) {
    for (int i = 0; i < system.n_bodies(); ++i) {
      if (walk.reached(i) || !is_stated(model.bodies[i])) continue;
      walk.begin_at(i);
      walk.go_on(move);
    }
  };
  begin_where([](const Body& body) { return body.velocity && body.spin; });
  begin_where([](const Body& body) { return body.velocity.has_value(); });
  begin_where([](const Body& body) { return body.spin.has_value(); });
  return v;
}

std::string loop_through(const System& system, const std::string& text) {
  const int n = system.n_bodies();
  int start = -1;
  for (int j = 0; j < system.n_joints() && start < 0; ++j)
    if (text.find(fmt::format("joint {} ", system.joints[j].name)) != std::string::npos) start = j;
  if (start < 0) return "-";
  const auto node = [n](int body) { return body == kGround ? n : body; };
  const std::vector<std::vector<int>> joints_of = joints_of_bodies(system);
  std::vector<int> by(n + 1, -1);  // joint by which a body was reached
  std::deque<int> queue{node(system.joints[start].at.a)};
  by[queue.front()] = start;
  const int goal = node(system.joints[start].at.b);
  while (!queue.empty()) {
    const int at = queue.front();
    queue.pop_front();
    for (const int j : joints_of[at]) {
      if (j == start || system.joints[j].servo >= 0) continue;  // a servo acts in parallel with its joint and closes no loop
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
