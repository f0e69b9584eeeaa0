#include "run/limits/drive_limit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kinematics/position_search.h"
#include "mobility/constraint_rows.h"
#include "run/record/force_table.h"

namespace pintle {
namespace {

using S = Planar;

constexpr double kYielding = 1e-4;                                                         // fraction of the stiffest joint: softer components need not stay closed
constexpr double kHeld = 1e-9;                                                             // weight of the bodies' positions relative to the gaps: squares of smaller singular values count as zero
constexpr double kMisfits = 30, kLoosestRank = 1e-2;                                           // singular values up to this multiple of the joints' misfit count as zero; upper limit on them
constexpr double kStride = 0.02;                                                           // stride along the motion, as a fraction of the typical arm
constexpr double kNoticed = 1e-6;                                                          // in radians, or as a fraction of the arm: a drive that asks for less than this beyond a limit is at it
constexpr double kNothing = 1e-7;                                                          // if a projection leaves less than this of a direction, that is roundoff
constexpr int kMostStrides = 4000, kMostIterations = 30, kMostTurns = 20, kHalvings = 50;  // upper limits: strides along one way, iterations to close the joints, turns; bisections for a turning point

// The motion that closed joints allow while all drives but one stay where they are.
class RigidMotion {
 public:
  RigidMotion(const System& system, const Vecs& q, double t, int drive)
      : system_(system), t_(t), drive_(drive), still_(q.size(), S::Vec::Zero()), equations_(system), weight_(system.joints.size(), S::Vec::Zero()),
        wanted_(system.joints.size(), S::Vec::Zero()), gaps_(wanted_) {
    read(q);
    length_ = arm_length(system, r_);
    metric_ = S::Vec(1, 1, length_ * length_);
    held_.resize(q.size());
    hold(kHeld);
    choose_rows();
  }

  double length() const { return length_; }
  const std::vector<S::Motion>& motions() const { return m_; }
  // The coordinate minus the value that the drive asks for, at the positions last read.
  double gap() const { return r_[drive_].gap[component()]; }
  void read(const Vecs& q) { kinematics_at(system_, t_, q, still_, m_, r_); }

  // Gaps that joints asking for different lengths leave open make the rank of the Jacobian uncertain: motions up to this misfit count as free.
  void allow_misfit() {
    double misfit = 0;
    for (std::size_t j = 0; j < gaps_.size(); ++j) {
      const S::Vec gap = wanted_[j] - gap_to_close(system_.joints[j], r_[j]);
      misfit = std::max(misfit, std::sqrt(gap.dot(weight_[j].cwiseProduct(gap))));
    }
    const double tolerance = std::min(kMisfits * misfit / length_, kLoosestRank);
    hold(std::max(kHeld, tolerance * tolerance));
  }

  // Closes all joints, with `driven` the drive too, by the smallest change of q, and reads the result. Returns false if they do not close.
  bool close(Vecs& q, bool driven = false) {
    weight_[drive_][component()] = driven ? unit(component()) : 0;
    bool closed = false;
    for (int i = 0; i < kMostIterations && !closed; ++i) {
      for (std::size_t j = 0; j < gaps_.size(); ++j) gaps_[j] = wanted_[j] - gap_to_close(system_.joints[j], r_[j]);
      if (!equations_.prepare(r_, weight_, held_)) break;
      const Vecs& move = equations_.solve(equations_.pull(r_, weight_, gaps_));
      double step = 0;
      for (std::size_t b = 0; b < q.size(); ++b) {
        q[b] += move[b];
        step = std::max(step, size(move[b]));
      }
      read(q);
      if (!(step < length_)) break;
      closed = step < 1e-11 * length_;
    }
    weight_[drive_][component()] = 0;
    return closed;
  }

  // The gradient of the coordinate with respect to the bodies' motion, as a motion: s of theory/limits (1.2).
  Vecs gradient() const {
    Vecs s(still_);
    add_force(system_.joints[drive_].at, r_[drive_], S::Vec(S::Vec::Unit(component())), s);
    for (S::Vec& x : s) x = x.cwiseQuotient(metric_);
    return s;
  }
  double rate(const Vecs& n) const { return gap_change(system_.joints[drive_].at, r_[drive_], n)[component()]; }

  // Replaces `motion` by its part that leaves the joints closed, scaled by the body that moves most. Returns the fraction that was left. (1.3)
  double project(Vecs& motion) {
    const double before = largest(motion);
    if (!equations_.prepare(r_, weight_, held_)) return 0;
    for (int pass = 0; pass < 2; ++pass) {
      for (S::Vec& x : motion) x = share_ * x.cwiseProduct(metric_);
      motion = equations_.solve(motion);
    }
    const double after = largest(motion);
    if (after > 0)
      for (S::Vec& x : motion) x /= after;
    return before > 0 ? after / before : 0;
  }

  // The joint forces that balance a drive effort of 1 where nothing can move. (1.4)
  Vecs holding_forces() {
    Vecs f(wanted_);
    if (!equations_.prepare(r_, weight_, held_)) return f;
    Vecs rhs(still_);
    add_force(system_.joints[drive_].at, r_[drive_], S::Vec(S::Vec::Unit(component())), rhs);
    const Vecs& y = equations_.solve(rhs);
    for (std::size_t j = 0; j < f.size(); ++j) f[j] = weight_[j].cwiseProduct(gap_change(system_.joints[j].at, r_[j], y));
    return f;
  }

 private:
  void hold(double share) {
    share_ = share;
    for (S::Vec& weight : held_) weight = share * metric_;
  }
  int component() const { return system_.joints[drive_].driven; }
  double unit(int k) const { return k == 2 ? length_ * length_ : 1; }
  double size(const S::Vec& x) const { return std::sqrt(x.dot(metric_.cwiseProduct(x))); }
  double largest(const Vecs& x) const {
    double most = 0;
    for (const S::Vec& v : x) most = std::max(most, size(v));
    return most;
  }

  // Selects the components that joints hold firmly; of the drives, those other than this one.
  void choose_rows() {
    double stiffest = 0;
    Vecs stiffness(weight_);
    for (std::size_t j = 0; j < weight_.size(); ++j) {
      const JointData& joint = system_.joints[j];
      stiffness[j] = joint.ideal ? S::Vec::Zero().eval() : joint.law.engaged_stiffness();
      for (int k = 0; k < S::kDof; ++k)
        if (joint.servo < 0) stiffest = std::max(stiffest, stiffness[j][k] / unit(k));
    }
    for (std::size_t j = 0; j < weight_.size(); ++j) {
      const JointData& joint = system_.joints[j];
      for (int k = 0; k < S::kDof; ++k) {
        const bool other = joint.driven == k && static_cast<int>(j) != drive_;
        const bool firm = joint.ideal ? joint.held[k] && !joint.redundant[k] : stiffness[j][k] / unit(k) > kYielding * stiffest;
        if (joint.driven == k ? other : firm) weight_[j][k] = unit(k);
        if (other) wanted_[j][k] = gap_to_close(joint, r_[j])[k];
      }
    }
  }

  const System& system_;
  double t_;
  int drive_;
  Vecs still_;
  LeastSquares equations_;
  Vecs weight_, wanted_, gaps_;  // for the joints' gaps
  double length_ = 1;
  S::Vec metric_ = S::Vec::Ones();
  Vecs held_;  // weights of the bodies' positions
  double share_ = kHeld;
  std::vector<S::Motion> m_;
  std::vector<JointKinematics> r_;
};

// Follows the motion from the current position of the bodies to the one the drive asks for.
class LimitSearch {
 public:
  LimitSearch(const System& system, const Vecs& q, double t, int drive) : system_(system), t_(t), drive_(drive), q_(q), motion_(system, q, t, drive) {}

  std::optional<DriveLimit> run() {
    Vecs q = q_;
    if (motion_.close(q, true) && std::abs(motion_.gap()) < noticed()) return std::nullopt;
    motion_.read(q_);
    motion_.close(q_);
    motion_.allow_misfit();
    if (!motion_.close(q_)) return std::nullopt;
    ahead_ = motion_.gap() < 0 ? 1 : -1;
    for (int turn = 0; turn < kMostTurns; ++turn) {
      const Way way = follow();
      if (way == Way::kThere || way == Way::kLost) return std::nullopt;
      if (way == Way::kNowhere) return ahead_ * motion_.gap() < -noticed() ? std::optional(found()) : std::nullopt;
    }
    return std::nullopt;
  }

 private:
  enum class Way { kThere, kLost, kTurned, kNowhere };  // kLost: the joints do not close, or leave no motion

  double noticed() const { return kNoticed * (system_.joints[drive_].driven == 2 ? 1 : motion_.length()); }
  double climb(const Vecs& n) const { return ahead_ * motion_.rate(n); }

  // A motion that moves the coordinate ahead; if none does so at first, one that does so after a stride. Empty if there is none.
  Vecs way_ahead() {
    Vecs n = motion_.gradient();
    if (motion_.project(n) > kFlat) {
      if (climb(n) < 0) turn_round(n);
      return n;
    }
    for (std::size_t b = 0; b < n.size(); ++b) n[b] = S::Vec(1, 0.7 + 0.1 * static_cast<double>(b % 5), 0.3 - 0.05 * static_cast<double>(b % 7));
    rigid_ = motion_.project(n) < kNothing;
    const double before = ahead_ * motion_.gap();
    for (int side = 0; side < 2 && !rigid_; ++side, turn_round(n)) {
      Vecs q = q_;
      const bool gained = stride(q, n, kStride * motion_.length()) && ahead_ * motion_.gap() > before + 0.1 * noticed();
      motion_.read(q_);
      if (gained) return n;
    }
    return {};
  }
  static void turn_round(Vecs& n) {
    for (S::Vec& x : n) x = -x;
  }
  bool stride(Vecs& q, const Vecs& n, double h) {
    for (std::size_t b = 0; b < q.size(); ++b) q[b] += h * n[b];
    motion_.read(q);
    return motion_.close(q);
  }

  // Takes strides until the drive is where it should be, or its coordinate reverses.
  Way follow() {
    Vecs n = way_ahead();
    if (n.empty()) return rigid_ ? Way::kLost : Way::kNowhere;
    double h = kStride * motion_.length();
    for (int i = 0; i < kMostStrides && h > 1e-6 * motion_.length(); ++i) {
      Vecs q = q_, next = n;
      if (!stride(q, n, h) || motion_.project(next) < 0.5) {
        motion_.read(q_);
        h *= 0.5;
        continue;
      }
      if (ahead_ * motion_.gap() >= 0) return Way::kThere;
      if (climb(next) <= 0) return halve(n, h) ? Way::kTurned : Way::kLost;
      q_ = q;
      n = std::move(next);
    }
    return Way::kLost;
  }

  // Bisects for the turning point within a stride of h along n.
  bool halve(const Vecs& n, double h) {
    double low = 0, high = h;
    const Vecs from = q_;
    for (int i = 0; i < kHalvings; ++i) {
      const double x = 0.5 * (low + high);
      Vecs next = n;
      q_ = from;
      if (!stride(q_, n, x)) return false;
      motion_.project(next);
      (climb(next) > 0 ? low : high) = x;
    }
    return true;
  }

  DriveLimit found() {
    DriveLimit limit;
    limit.value = drive_value(system_.joints[drive_], motion_.gap(), t_);
    limit.ahead = ahead_;
    limit.q = q_;
    limit.in_line = pins_in_line();
    return limit;
  }

  struct Pin {
    int joint, a, b;
    S::Point p, force;
  };
  std::vector<Pin> loaded_pins() {
    const Vecs force = motion_.holding_forces();
    const std::vector<S::Motion>& m = motion_.motions();
    std::vector<Pin> pins;
    double largest = 0;
    for (int j = 0; j < system_.n_joints(); ++j) {
      const JointData& joint = system_.joints[j];
      if (joint.servo >= 0 || !joint.held[0] || !joint.held[1] || joint.held[2]) continue;
      const S::Motion& b = motion_of(joint.at.b, m);
      pins.push_back({j, joint.at.a, joint.at.b, b.p + b.turned(joint.at.M.p), joint_load(system_, j, m, force[j]).head<2>()});
      largest = std::max(largest, pins.back().force.norm());
    }
    std::erase_if(pins, [largest](const Pin& pin) { return !(pin.force.norm() > 1e-6 * largest); });
    return pins;
  }

  // Three pins in line on two bodies that share the middle one, whose force is along the line.
  std::vector<int> pins_in_line() {
    const std::vector<Pin> pins = loaded_pins();
    const auto shared = [](const Pin& x, const Pin& y) {
      for (const int body : {x.a, x.b})
        if (body != kGround && (body == y.a || body == y.b)) return body;
      return kGround;
    };
    const auto along = [](const S::Point& x, const S::Point& y) { return std::abs(S::cross(x, y)) < kInLine * x.norm() * y.norm(); };
    for (const Pin& middle : pins)
      for (const Pin& first : pins)
        for (const Pin& last : pins) {
          if (first.joint >= last.joint || first.joint == middle.joint || last.joint == middle.joint) continue;
          const int one = shared(first, middle), other = shared(middle, last);
          const S::Point to_first = middle.p - first.p, to_last = last.p - middle.p;
          if (one == kGround || other == kGround || one == other || std::min(to_first.norm(), to_last.norm()) < kApart * motion_.length()) continue;
          if (along(to_first, to_last) && along(to_first, middle.force)) return {first.joint, middle.joint, last.joint};
        }
    return {};
  }

  static constexpr double kFlat = 1e-5;    // slope of the drive's coordinate along the motion, below which it is at a turning point
  static constexpr double kApart = 1e-3;   // fraction of the typical arm: pins closer than this coincide
  static constexpr double kInLine = 1e-4;  // sine of the angle below which two lines count as one

  const System& system_;
  double t_;
  int drive_;
  Vecs q_;
  RigidMotion motion_;
  int ahead_ = 1;
  bool rigid_ = false;
};

}  // namespace

double drive_value(const JointData& drive, double gap, double t) { return gap + target_of(drive, t)[0]; }

std::optional<DriveLimit> find_drive_limit(const System& system, const Vecs& q, double t, int drive) { return LimitSearch(system, q, t, drive).run(); }

}  // namespace pintle
