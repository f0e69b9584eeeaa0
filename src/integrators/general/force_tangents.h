// Derivatives of all forces on the bodies, including joints, by positions and by velocities: one block per coupled pair of
// bodies, on the system's pattern. theory/solvers Eqs. (1.2), (1.3).
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "integrators/general/constraint_forces.h"
#include "linalg/block_lu.h"
#include "system/system.h"

namespace pintle {

class ForceTangents {
 public:
  using Mat = Planar::Mat;

  explicit ForceTangents(const System& system);

  /// dF/dq and dF/dv of F = Q + G' law(gap, rate, states). The states are eliminated for a step of a method that advances them by
  /// dz = dz' / mu; at mu = infinity they are constant, and `states` has their effect. Ideal joints act as given by `constraints`.
  void find(double t, const Vecs& q, const Vecs& v, const std::vector<double>& law_state, double mu = std::numeric_limits<double>::infinity(), const ConstraintForces* constraints = nullptr);

  /// A joint whose law has states of its own, at the last `find`.
  struct StateTangents {
    int joint = 0;
    LawTangents law;
    std::array<Mat, 2> G, rate_by_q;  // of both bodies
  };
  const std::vector<StateTangents>& states() const { return states_; }

  /// Index of block (row, column) among those of the pattern, including the fill-in of its elimination.
  int place(int row, int column) const;
  const Mat& by_position(int place) const { return by_q_[place]; }
  const Mat& by_velocity(int place) const { return by_v_[place]; }

  /// lu = mass * M - by_q * dF/dq - by_v * dF/dv.
  void combine(double mass, double by_q, double by_v, BlockLu<double, Planar::kDof>& lu) const;

 private:
  void add_joint(int j, double t, const std::vector<double>& law_state, double mu, const ConstraintForces* constraints);

  const System& system_;
  std::vector<Planar::Motion> motions_;
  std::vector<std::array<int, 4>> joint_places_;  // (a, a), (a, b), (b, a), (b, b); -1: ground
  std::vector<Mat> by_q_, by_v_;                  // diagonal, upper, lower blocks
  std::vector<StateTangents> states_;
  LawTangents law_;                               // of one joint at a time
  LawImpedance<double> follows_;
};

}  // namespace pintle
