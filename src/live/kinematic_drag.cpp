// A linkage moved by hand. theory/live section 2.
#include <algorithm>
#include <cmath>
#include <utility>

#include "kinematics/guess.h"
#include "kinematics/position_search.h"
#include "live/mouse_spring.h"
#include "pintle/live.h"
#include "system/build.h"

namespace pintle {
namespace {

using S = Planar;

constexpr double kSoft = 1e-2;         // stiffness of the hold, as a fraction of that of the stiffest joint: it yields to every joint
constexpr double kClosed = 1e-5;       // a joint is closed if its gap is below this fraction of the mechanism's size
constexpr double kLongestMove = 0.05;  // upper limit on the displacement in one search, as a fraction of the mechanism's size
constexpr double kReached = 1e-7;      // the target is reached if the distance is below this fraction of the mechanism's size
constexpr double kWorthwhile = 1e-3;   // as a fraction of a move: the search ends if the point moves less
constexpr int kMostMoves = 24;
constexpr int kHoldIterations = 30, kCloseIterations = 100;

// All stated positions are only starting points. Belts have the length of their path.
Model free_to_move(Model model) {
  for (Joint& joint : model.joints) joint.geometry.erase("stretch");
  for (Body& body : model.bodies) {
    body.hold = {false, false, false};
    body.position = Vec2{0, 0};  // stated, so that all bodies resist equally
    body.angle = 0;
  }
  return model;
}

// A complete system, and positions that close it as far as possible.
struct Closed {
  System system;
  Vecs q;
};

Closed close_from_guess(const Model& stated, const Model& free) {
  System system = build_system(free);
  Vecs q = guess_positions(stated, system);
  system = unwind(std::move(system), q);
  std::vector<bool> open;
  for (int j = 0; j < system.n_joints(); ++j) open.push_back(is_open(stated, system, j));
  PositionSearch(stated, system, open).run(q);
  std::vector<std::string> notes;
  system = fix_assembled_values(free, std::move(system), q, notes);
  return {std::move(system), std::move(q)};
}

}  // namespace

class KinematicDrag::Linkage {
 public:
  explicit Linkage(const Model& model) : Linkage(model, free_to_move(model)) {}


  bool assemble(const std::optional<Hold>& hold) {
    const Vecs before = q_;
    if (hold) follow(*hold);
    close();
    measure();
    const bool closed = open_joints().empty();
    if (closed) best_ = q_;
    else if (hold) {
      q_ = best_.empty() ? before : best_;
      measure();
    }
    return closed;
  }

  void set_poses(const std::vector<PlanarPose>& poses) {
    for (std::size_t i = 0; i < std::min(poses.size(), q_.size()); ++i) q_[i] = S::Vec(poses[i][0], poses[i][1], poses[i][2]);
    best_.clear();
  }

  std::vector<PlanarPose> poses() const { return rows(q_); }
  const std::vector<double>& gaps() const { return gaps_; }
  std::vector<std::string> open_joints() const {
    std::vector<std::string> names;
    const double size = mechanism_size(system_, q_);
    for (std::size_t j = 0; j < gaps_.size(); ++j)
      if (!(gaps_[j] <= kClosed * size)) names.push_back(system_.joints[j].name);
    return names;
  }

 private:
  Linkage(const Model& stated, const Model& free) : Linkage(close_from_guess(stated, free), free) {}
  Linkage(Closed closed, const Model& free) : model_(free), own_(std::move(closed.system)), q_(std::move(closed.q)) {
    for (const JointData& joint : own_.joints) open_.push_back(joint.servo >= 0);  // motors are released
    open_.push_back(true);
    const double stiffest = largest_stiffness(own_);
    hold_ = mouse_spring("hold", 0, {0, 0}, stiffest > 0 ? kSoft * stiffest : 1);
    system_ = with_joints(own_, {hold_});
    measure();
  }

  S::Point point_now(const Hold& hold) const { return in_world(q_[hold.body], hold.point); }

  bool is_alone(int body) const {
    return std::none_of(own_.joints.begin(), own_.joints.end(), [body](const JointData& joint) { return joint.at.a == body || joint.at.b == body; });
  }

  // Moves towards the target in steps short enough that the linkage does not switch branches, as long as they bring the
  // point nearer.
  void follow(const Hold& hold) {
    if (hold.body < 0 || hold.body >= own_.n_bodies()) return;
    Placement& at = hold_.at;
    at.b = hold.body;
    at.M = S::Frame::at({hold.point[0], hold.point[1]}, 0);
    system_ = with_joints(own_, {hold_});
    const S::Point target(hold.target[0], hold.target[1]);
    if (is_alone(hold.body)) {
      q_[hold.body].head<2>() += target - point_now(hold);
      return;
    }
    const double size = mechanism_size(system_, q_);
    double left = (target - point_now(hold)).norm();
    for (int i = 0; i < kMostMoves && left > kReached * size; ++i) {
      const double move = std::min(left, kLongestMove * size);
      const S::Point from = point_now(hold), to = from + (move / left) * (target - from);
      at.F = S::Frame::at({to.x(), to.y()}, 0);
      system_ = with_joints(own_, {hold_});
      const Vecs before = q_;
      open_.back() = false;
      PositionSearch(model_, system_, open_).run(q_, kHoldIterations);
      open_.back() = true;
      close();
      const S::Point reached = point_now(hold);
      const double now = (target - reached).norm();
      if (now > left) q_ = before;
      if (now > left || (reached - from).norm() < kWorthwhile * move) break;
      left = now;
    }
  }

  void close() { PositionSearch(model_, system_, open_).run(q_, kCloseIterations); }

  void measure() {
    kinematics_at(system_, 0, q_, Vecs(q_.size(), S::Vec::Zero()), m_, r_);
    const double size = mechanism_size(system_, q_);
    gaps_.assign(model_.joints.size(), 0);
    for (std::size_t j = 0; j < gaps_.size(); ++j) {
      const JointData& joint = system_.joints[j];
      const S::Vec stiff = joint.law.engaged_stiffness();
      S::Vec gap = gap_to_close(joint, r_[j]);
      for (int k = 0; k < 3; ++k)
        if (stiff[k] == 0) gap[k] = 0;
      gaps_[j] = std::hypot(gap[0], gap[1], size * gap[2]);
    }
  }

  Model model_;
  const System own_;  // without the hold
  JointData hold_;    // a pin between the world and the held body
  System system_;     // with the hold as its last joint
  Vecs q_, best_;     // best_: the last poses that closed the joints
  std::vector<bool> open_;
  std::vector<double> gaps_;
  std::vector<S::Motion> m_;
  std::vector<JointKinematics> r_;
};

KinematicDrag::KinematicDrag(const Model& model) : linkage_(std::make_unique<Linkage>(model)) {}
KinematicDrag::~KinematicDrag() = default;
KinematicDrag::KinematicDrag(KinematicDrag&&) noexcept = default;
KinematicDrag& KinematicDrag::operator=(KinematicDrag&&) noexcept = default;
bool KinematicDrag::assemble(const std::optional<Hold>& hold) { return linkage_->assemble(hold); }
void KinematicDrag::set_poses(const std::vector<PlanarPose>& poses) { linkage_->set_poses(poses); }
std::vector<PlanarPose> KinematicDrag::poses() const { return linkage_->poses(); }
const std::vector<double>& KinematicDrag::gaps() const { return linkage_->gaps(); }
std::vector<std::string> KinematicDrag::open_joints() const { return linkage_->open_joints(); }

}  // namespace pintle
