// The objects that the batteries check: every joint, servo, spring and motor as a joint displacement between two bodies, in a
// few states.
#pragma once

#include <string>
#include <vector>

#include "pintle/model.h"
#include "system/state.h"

namespace pintle {

/// A joint displacement between two bodies, whatever its force.
struct CheckLink {
  std::string_view kind, name;
  Placement at;
  JointDisplacement displacement;
  int joint = -1;  // of the system; -1: a load
  int slip = -1;   // component whose rate is not the derivative of its value; -1: none
};
std::vector<CheckLink> check_links(const System& system);

/// Reproducible pseudorandom numbers between -1 and 1.
class Noise {
 public:
  explicit Noise(unsigned long long seed) : state_(seed) {}
  double operator()();
  Planar::Vec vec() { return {(*this)(), (*this)(), (*this)()}; }

 private:
  unsigned long long state_;
};

/// An instant at which formulas are compared.
struct CheckState {
  int number = 0;  // 0: as assembled
  double t = 0;
  double length = 1, speed = 1;  // typical of the mechanism [m], [m/s]
  Vecs q, v;
  std::vector<Planar::Motion> m;
};
std::vector<CheckState> check_states(const Model& model, const System& system, const State& assembled);

/// Short difference steps for a link: of lengths [m] and angles [rad].
struct LinkSteps {
  double length, angle;
};
LinkSteps link_steps(const CheckLink& link, const RelativePose& pose, double arm);

/// A link in a state whose bodies can be disturbed, and its joint kinematics there.
class DisturbedLink {
 public:
  using Vec6 = Eigen::Matrix<double, 6, 1>;

  DisturbedLink(const System& system, const CheckLink& link, const CheckState& state,
                std::vector<Planar::Motion>& scratch)
      : system_(system), link_(link), state_(state), m_(scratch) {}
  ~DisturbedLink() { put(Vec6::Zero(), 0); }
  DisturbedLink(const DisturbedLink&) = delete;
  DisturbedLink& operator=(const DisturbedLink&) = delete;

  /// With the positions of both bodies moved by dq, then everything advanced by `dt` at constant velocities.
  JointKinematics kinematics(const Vec6& dq, double dt = 0);
  RelativePose pose() const { return system_.pose(link_.at, m_); }
  /// Velocities of both bodies; zero for the ground.
  Vec6 velocities() const;
  bool moves(int column) const { return (column < 3 ? link_.at.a : link_.at.b) != kGround; }

 private:
  void put(const Vec6& dq, double dt);

  const System& system_;
  const CheckLink& link_;
  const CheckState& state_;
  std::vector<Planar::Motion>& m_;
};

}  // namespace pintle
