#include "system/joint_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text/article.h"
#include "linalg/dense_factors.h"
#include "system/pose_joint.h"

namespace pintle {
namespace {

using S = Planar;

double offset(const JointData& joint, int component) { return std::get<Selection>(joint.displacement).offset[component]; }

// Motion of a body at the distance `arm` that follows a rigid motion of its parent. Eq. (2.2).
S::Vec carried(const S::Point& arm, const S::Vec& x) { return {x[0] - arm.y() * x[2], x[1] + arm.x() * x[2], x[2]}; }
// The same forces and moments, one per column, about a point shifted by -`arm`. Transpose of `carried`.
template <class Forces>
Eigen::Matrix<double, 3, Forces::ColsAtCompileTime> about_parent(const S::Point& arm, const Forces& f) {
  Eigen::Matrix<double, 3, Forces::ColsAtCompileTime> moved = f;
  moved.row(2) += arm.x() * f.row(1) - arm.y() * f.row(0);
  return moved;
}

}  // namespace

JointTree::JointTree(const System& system)
    : system_(system), link_(system.bodies.size()), reached_(system.bodies.size(), false), in_tree_(system.joints.size(), false) {
  std::vector<std::vector<int>> ideal_at(system.bodies.size() + 1);  // the ground's last
  const auto at = [&](int body) -> std::vector<int>& { return body == kGround ? ideal_at.back() : ideal_at[body]; };
  for (int j = 0; j < system.n_joints(); ++j) {
    const JointData& joint = system.joints[j];
    if (!joint.ideal || !is_pose_joint(joint)) continue;
    at(joint.at.a).push_back(j);
    at(joint.at.b).push_back(j);
  }
  grow(kGround, ideal_at);
  for (int body = 0; body < system.n_bodies(); ++body) {
    if (reached_[body]) continue;
    reached_[body] = true;
    link_[body].first = n_;
    n_ += 3;
    order_.push_back(body);
    grow(body, ideal_at);
  }
  for (int j = 0; j < system.n_joints(); ++j)
    if (!in_tree_[j]) laws_.push_back(j);
  open_the_rest();
}

// Breadth first: nearest bodies first, so that branches stay short and a loop is opened opposite to its start.
void JointTree::grow(int from, const std::vector<std::vector<int>>& ideal_at) {
  std::vector<int> queue{from};
  for (std::size_t next = 0; next < queue.size(); ++next) {
    const int parent = queue[next];
    for (const int j : parent == kGround ? ideal_at.back() : ideal_at[parent]) {
      const JointData& joint = system_.joints[j];
      const bool forward = joint.at.a == parent;
      const int body = forward ? joint.at.b : joint.at.a;
      if (body == kGround || reached_[body]) continue;
      reached_[body] = true;
      in_tree_[j] = true;
      Link link{parent, j, n_, 0, forward, -1, -1};
      if (joint.free_mask[0] > 0) link.slide = link.count++;
      if (joint.free_mask[2] > 0) link.turn = link.count++;
      n_ += link.count;
      link_[body] = link;
      order_.push_back(body);
      queue.push_back(body);
    }
  }
}

void JointTree::open_the_rest() {
  for (int j = 0; j < system_.n_joints(); ++j) {
    const JointData& joint = system_.joints[j];
    if (in_tree_[j] || !(joint.ideal || joint.opened)) continue;
    if (is_pose_joint(joint))
      opened_.push_back(fmt::format("joint {} is opened: it closes a loop with the ideal {}; its force law acts", joint.name, loop_of(j)));
    else
      opened_.push_back(fmt::format("joint {} is opened: {} has no free coordinates of its own; its force law acts", joint.name, with_article(joint.type)));
  }
}

// The tree's joints between the two bodies of a joint, in order from its first body to its second, with their verb.
std::string JointTree::loop_of(int joint) const {
  std::array<std::vector<int>, 2> path;  // bodies from each end to the root
  const Placement& at = system_.joints[joint].at;
  for (const auto& [body, to] : {std::pair{at.a, &path[0]}, std::pair{at.b, &path[1]}})
    for (int b = body; b != kGround; b = link_[b].parent) to->push_back(b);
  while (!path[0].empty() && !path[1].empty() && path[0].back() == path[1].back()) {
    path[0].pop_back();
    path[1].pop_back();
  }
  std::reverse(path[1].begin(), path[1].end());
  std::string names;
  for (const auto& part : path)
    for (const int b : part) names += (names.empty() ? "" : ", ") + system_.joints[link_[b].joint].name;
  const bool one = path[0].size() + path[1].size() == 1;
  return fmt::format("{} {}", one ? "joint" : "joints", names);
}

std::vector<std::string> JointTree::notes() const {
  std::vector<std::string> out = opened_;
  std::string names;
  int free = 0;
  for (const int body : order_) {
    const int j = link_[body].joint;
    if (j >= 0) names += (names.empty() ? "" : ", ") + system_.joints[j].name;
    else ++free;
  }
  std::string line = names.empty() ? fmt::format("no joint is eliminated by relative coordinates: {} coordinates", n_)
                                   : fmt::format("joints eliminated by relative coordinates: {}; {} coordinate{}", names, n_, n_ == 1 ? "" : "s");
  if (free > 0) line += fmt::format(", including all three of {} {}", free, free == 1 ? "body" : "bodies");
  out.push_back(std::move(line));
  return out;
}

void JointTree::read_positions(const Vecs& q, Eigen::VectorXd& y) const {
  y.resize(n_);
  std::vector<S::Motion> m;
  system_.motions(q, Vecs(q.size(), S::Vec::Zero()), m);
  for (const int body : order_) {
    const Link& link = link_[body];
    if (link.joint < 0) {
      y.segment<3>(link.first) = q[body];
      continue;
    }
    const RelativePose pose = system_.pose(system_.joints[link.joint].at, m);
    if (link.slide >= 0) y[link.first + link.slide] = pose.z[0];
    if (link.turn >= 0) y[link.first + link.turn] = pose.z[2];
  }
}

void JointTree::read_rates(const TreePose& pose, const Vecs& v, Eigen::VectorXd& u) const {
  Eigen::MatrixXd H;
  mass(pose, H);
  Vecs momentum(v.size());
  for (std::size_t i = 0; i < v.size(); ++i) momentum[i] = system_.bodies[i].mass.cwiseProduct(v[i]);
  gather(pose, momentum, u);
  Cholesky factors;
  factors.compute(H);
  u = factors.solve(u);
}

void JointTree::place(const Eigen::VectorXd& y, const Eigen::VectorXd& u, TreePose& pose) const {
  const std::size_t bodies = system_.bodies.size();
  pose.q.resize(bodies);
  pose.v.resize(bodies);
  pose.m.resize(bodies);
  pose.arm.resize(bodies);
  pose.S.resize(bodies);
  pose.c.resize(bodies);
  for (const int body : order_) {
    const Link& link = link_[body];
    if (link.joint >= 0) {
      place_on_parent(body, y, u, pose);
      continue;
    }
    pose.q[body] = y.segment<3>(link.first);
    pose.v[body] = u.segment<3>(link.first);
    pose.m[body] = S::Motion::of(pose.q[body], pose.v[body]);
    pose.arm[body].setZero();
    pose.S[body].setIdentity();
    pose.c[body].setZero();
  }
}

void JointTree::place_on_parent(int body, const Eigen::VectorXd& y, const Eigen::VectorXd& u, TreePose& pose) const {
  const Link& link = link_[body];
  const JointData& joint = system_.joints[link.joint];
  const S::Motion& P = motion_of(link.parent, pose.m);
  const S::Frame &F = joint.at.F, &M = joint.at.M;
  const auto coordinate = [&link](const Eigen::VectorXd& x, int column) { return column < 0 ? 0.0 : x[link.first + column]; };
  const double slide = link.slide < 0 ? offset(joint, 0) : y[link.first + link.slide];
  const double turn = link.turn < 0 ? offset(joint, 2) : y[link.first + link.turn];
  const double sign = link.forward ? 1 : -1;
  // Eq. (1.3): the angle first, then the position.
  S::Motion B;
  B.angle = P.angle + sign * (F.angle + turn - M.angle);
  B.c = std::cos(B.angle);
  B.s = std::sin(B.angle);
  const S::Motion& first = link.forward ? P : B;
  const S::Point axis = first.turned({F.c, F.s});
  const S::Point d = slide * axis + offset(joint, 1) * S::perp(axis);
  const S::Point pivot = link.forward ? S::Point(P.p + P.turned(F.p) + d) : S::Point(P.p + P.turned(M.p));  // M's origin
  B.p = link.forward ? S::Point(pivot - B.turned(M.p)) : S::Point(pivot - d - B.turned(F.p));
  const S::Point arm = B.p - P.p, lever = B.p - pivot;
  S::Mat& columns = pose.S[body];
  columns.setZero();
  if (link.slide >= 0) columns.col(link.slide) << sign * axis, 0;
  if (link.turn >= 0) columns.col(link.turn) << sign * S::perp(lever), sign;
  S::Vec v = carried(arm, {P.v.x(), P.v.y(), P.w});
  for (int k = 0; k < link.count; ++k) v += columns.col(k) * u[link.first + k];  // (2.1)
  B.v << v[0], v[1];
  B.w = v[2];
  // Eq. (2.4).
  const S::Point pivot_rate = link.forward ? S::Point(B.v - B.w * S::perp(lever)) : S::Point(P.v + P.w * S::perp(pivot - P.p));
  const S::Point c = P.w * S::perp(B.v - P.v) + sign * coordinate(u, link.turn) * S::perp(B.v - pivot_rate) +
                     sign * coordinate(u, link.slide) * (link.forward ? P.w : B.w) * S::perp(axis);
  pose.q[body] << B.p, B.angle;
  pose.v[body] = v;
  pose.m[body] = B;
  pose.arm[body] = arm;
  pose.c[body] << c, 0;
}

void JointTree::accelerate(const TreePose& pose, const Eigen::VectorXd& w, Vecs& a) const {
  a.resize(system_.bodies.size());
  for (const int body : order_) {
    const Link& link = link_[body];
    S::Vec x = pose.c[body];
    if (link.parent != kGround) x += carried(pose.arm[body], a[link.parent]);
    for (int k = 0; k < link.count; ++k) x += pose.S[body].col(k) * w[link.first + k];
    a[body] = x;
  }
}

template <int Columns>
void JointTree::gather_columns(const TreePose& pose, Eigen::Ref<Eigen::Matrix<double, Eigen::Dynamic, Columns>> on_bodies,
                               Eigen::Ref<Eigen::Matrix<double, Eigen::Dynamic, Columns>> on_coordinates) const {
  for (auto body = order_.rbegin(); body != order_.rend(); ++body) {
    const Link& link = link_[*body];
    const auto here = on_bodies.template middleRows<3>(3 * *body);
    for (int k = 0; k < link.count; ++k) on_coordinates.row(link.first + k) = pose.S[*body].col(k).transpose() * here;
    if (link.parent == kGround) continue;
    on_bodies.template middleRows<3>(3 * link.parent) += about_parent(pose.arm[*body], here);
  }
}

void JointTree::gather(const TreePose& pose, Vecs& on_bodies, Eigen::VectorXd& on_coordinates) const {
  on_coordinates.resize(n_);
  if (!on_bodies.empty()) gather_columns<1>(pose, Eigen::VectorXd::Map(on_bodies.front().data(), 3 * static_cast<Eigen::Index>(on_bodies.size())), on_coordinates);
}

void JointTree::gather(const TreePose& pose, Eigen::MatrixXd& on_bodies, Eigen::MatrixXd& on_coordinates) const {
  on_coordinates.resize(n_, on_bodies.cols());
  gather_columns<Eigen::Dynamic>(pose, on_bodies, on_coordinates);
}

void JointTree::mass(const TreePose& pose, Eigen::MatrixXd& H) const {
  H.setZero(n_, n_);
  std::vector<S::Mat> composite(system_.bodies.size());
  for (std::size_t i = 0; i < composite.size(); ++i) composite[i] = system_.bodies[i].mass.asDiagonal();
  for (auto body = order_.rbegin(); body != order_.rend(); ++body) {
    const Link& link = link_[*body];
    for (int k = 0; k < link.count; ++k) {
      const int row = link.first + k;
      S::Vec force = composite[*body] * pose.S[*body].col(k);  // (3.3)
      for (int b = *body; b != kGround; b = link_[b].parent) {
        const Link& at = link_[b];
        for (int i = 0; i < at.count; ++i) H(row, at.first + i) = H(at.first + i, row) = pose.S[b].col(i).dot(force);
        force = about_parent(pose.arm[b], force);
      }
    }
    if (link.parent == kGround) continue;
    S::Mat T = S::Mat::Identity();  // (2.2), (3.2)
    T(0, 2) = -pose.arm[*body].y();
    T(1, 2) = pose.arm[*body].x();
    composite[link.parent] += T.transpose() * composite[*body] * T;
  }
}

void JointTree::jacobian(const TreePose& pose, Eigen::MatrixXd& J) const {
  J.setZero(3 * static_cast<Eigen::Index>(link_.size()), n_);
  for (const int body : order_) {
    const Link& link = link_[body];
    auto rows = J.middleRows<3>(3 * body);
    if (link.parent != kGround) {
      rows = J.middleRows<3>(3 * link.parent);
      rows.row(0) -= pose.arm[body].y() * rows.row(2);
      rows.row(1) += pose.arm[body].x() * rows.row(2);
    }
    for (int k = 0; k < link.count; ++k) rows.col(link.first + k) += pose.S[body].col(k);
  }
}

// From the pivot of a body's turning coordinate to its centre of mass: the arm of (2.2) for S. Zero if there is no such coordinate.
S::Point JointTree::lever(const TreePose& pose, int body) const {
  const Link& link = link_[body];
  if (link.joint < 0 || link.turn < 0) return S::Point::Zero();
  const S::Vec turn = pose.S[body].col(link.turn);
  return turn[2] * S::Point(turn.y(), -turn.x());
}

void JointTree::motion_slopes(const TreePose& pose, const Vecs& a, TreeMotionSlopes& out) const {
  for (Eigen::MatrixXd* x : {&out.velocity, &out.acceleration, &out.acceleration_by_rate}) x->setZero(3 * static_cast<Eigen::Index>(link_.size()), n_);
  const auto at = [](int body, const Vecs& x) { return body == kGround ? S::Vec(S::Vec::Zero()) : x[body]; };
  // Velocity and acceleration of the point of a body at `arm` from its centre of mass.
  const auto velocity_of = [](const S::Vec& v, const S::Point& arm) { return S::Point(v.head<2>() + v[2] * S::perp(arm)); };
  const auto acceleration_of = [](const S::Vec& v, const S::Vec& x, const S::Point& arm) {
    return S::Point(x.head<2>() + x[2] * S::perp(arm) - v[2] * v[2] * arm);
  };
  struct Coordinate {
    bool turns;
    double sign;       // turning: of the angle
    S::Point v, a;     // turning: the pivot's; sliding: change everywhere per metre
    S::Point by_rate;  // sliding: change of accelerations per metre per second
  };
  std::vector<Coordinate> coordinate(static_cast<std::size_t>(n_));
  for (const int body : order_) {
    const Link& link = link_[body];
    for (int k = 0; k < link.count; ++k) {
      const S::Vec column = pose.S[body].col(k);
      Coordinate& c = coordinate[link.first + k];
      c.turns = column[2] != 0;
      c.sign = column[2];
      if (c.turns) {  // about a point of the body or, if the joint is traversed from its second body, of its parent
        const bool own = link.forward || link.joint < 0;
        const S::Point to_pivot = own ? S::Point(-lever(pose, body)) : S::Point(pose.arm[body] - lever(pose, body));
        const int carrier = own ? body : link.parent;
        c.v = velocity_of(at(carrier, pose.v), to_pivot);
        c.a = acceleration_of(at(carrier, pose.v), at(carrier, a), to_pivot);
        c.by_rate.setZero();
      } else {  // along an axis that turns with the parent, or with the body
        const int carrier = link.joint < 0 ? kGround : link.forward ? link.parent : body;
        const S::Point axis = column.head<2>();
        const double w = at(carrier, pose.v)[2];
        c.v = w * S::perp(axis);
        c.a = at(carrier, a)[2] * S::perp(axis) - w * w * axis;
        c.by_rate = 2 * w * S::perp(axis);
      }
    }
    for (int b = body; b != kGround; b = link_[b].parent)
      for (int k = link_[b].first; k < link_[b].first + link_[b].count; ++k) {
        const Coordinate& c = coordinate[k];
        const S::Point v = c.turns ? S::Point(c.sign * S::perp(pose.v[body].head<2>() - c.v)) : c.v;
        const S::Point x = c.turns ? S::Point(c.sign * S::perp(a[body].head<2>() - c.a)) : c.a;
        out.velocity.block<2, 1>(3 * body, k) = v;
        out.acceleration.block<2, 1>(3 * body, k) = x;
        out.acceleration_by_rate.block<2, 1>(3 * body, k) = c.turns ? S::Point(2 * v) : c.by_rate;
      }
  }
}

void JointTree::geometric_stiffness(const TreePose& pose, const Vecs& g, Eigen::MatrixXd& out) const {
  out.setZero(n_, n_);
  std::vector<S::Point> force(g.size());               // on a body and all that it carries
  std::vector<double> virial(g.size(), 0.0);           // sum over its forces: arm about the body's centre of mass times force
  for (std::size_t i = 0; i < g.size(); ++i) force[i] = g[i].head<2>();
  for (auto at = order_.rbegin(); at != order_.rend(); ++at) {
    const int body = *at;
    const Link& link = link_[body];
    const int turn = link.joint < 0 ? 2 : link.turn;
    const double about_pivot = virial[body] + lever(pose, body).dot(force[body]);
    // The coordinate nearer to the tips turns or moves its subtree; only turns before it in the tree are affected.
    const auto turns_before = [&](bool own, auto&& use) {
      if (own && turn >= 0) use(link.first + turn, pose.S[body](2, turn));
      for (int b = link.parent; b != kGround; b = link_[b].parent) {
        const int k = link_[b].joint < 0 ? 2 : link_[b].turn;
        if (k >= 0) use(link_[b].first + k, pose.S[b](2, k));
      }
    };
    if (turn >= 0)
      turns_before(true, [&](int k, double sign) { out(link.first + turn, k) = out(k, link.first + turn) = -pose.S[body](2, turn) * sign * about_pivot; });
    for (int slide = 0; slide < link.count; ++slide) {
      if (slide == turn) continue;
      const double across = S::perp(pose.S[body].col(slide).head<2>()).dot(force[body]);
      turns_before(!link.forward && link.joint >= 0, [&](int k, double sign) { out(link.first + slide, k) = out(k, link.first + slide) = sign * across; });
    }
    if (link.parent == kGround) continue;
    force[link.parent] += force[body];
    virial[link.parent] += virial[body] + pose.arm[body].dot(force[body]);
  }
}

void JointTree::reactions(const TreePose& pose, const Vecs& a, const Vecs& Q, Vecs& force) const {
  Vecs needed(Q.size());
  for (std::size_t i = 0; i < Q.size(); ++i) needed[i] = system_.bodies[i].mass.cwiseProduct(a[i]) - Q[i];  // (4.1)
  for (auto body = order_.rbegin(); body != order_.rend(); ++body) {
    const Link& link = link_[*body];
    if (link.parent != kGround) needed[link.parent] += about_parent(pose.arm[*body], needed[*body]);
    if (link.joint < 0) continue;
    // Eq. (4.2): with G the pose's Jacobian of the carried body, G' f = the required force; zero in free components.
    const JointData& joint = system_.joints[link.joint];
    const RelativePose z = system_.pose(joint.at, pose.m);
    const S::Point world = link.forward ? S::Point(needed[*body].head<2>()) : S::Point(-needed[*body].head<2>());
    const S::Point arm = link.forward ? z.arm_b : z.arm_a;
    const double moment = (link.forward ? needed[*body][2] : -needed[*body][2]) - S::cross(arm, world);
    S::Vec f(z.c * world.x() + z.s * world.y(), z.c * world.y() - z.s * world.x(), moment);
    for (int k = 0; k < 3; ++k)
      if (joint.free_mask[k] > 0) f[k] = 0;
    force[link.joint] = f;
  }
}

}  // namespace pintle
