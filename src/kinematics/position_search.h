// Positions that close the joints, from a guess: the minimum of the joints' potential energy. theory/assembly section 1.
#pragma once

#include <vector>

#include "linalg/block_lu.h"
#include "pintle/model.h"
#include "system/system.h"

namespace pintle {

/// Normal equations G' W G + D on the joint graph, D and W diagonal. One object serves positions and velocities.
class LeastSquares {
 public:
  explicit LeastSquares(const System& system);

  void hold(int body, int coordinate) { free_[body][coordinate] = 0; }

  bool prepare(const std::vector<JointKinematics>& r, const Vecs& joint_weight, const Vecs& body_weight);
  /// G' W gap. The results of pull and solve are valid until their next call.
  const Vecs& pull(const std::vector<JointKinematics>& r, const Vecs& joint_weight, const Vecs& gap);
  const Vecs& solve(const Vecs& rhs);

 private:
  using Row = BlockVec<double, Planar::kDof>;
  const System& system_;
  Vecs free_;  // 0 where a coordinate is held: its column of G is zero, so nothing moves it
  std::vector<BlockPattern::Slot> slots_;  // of each joint's bodies
  BlockLu<double, Planar::kDof> lu_;
  std::vector<Row> x_;
  Vecs pull_, solution_;
};

/// Kinematics of all joints at q, v.
void kinematics_at(const System& system, double t, const Vecs& q, const Vecs& v, std::vector<Planar::Motion>& m, std::vector<JointKinematics>& r);

/// The gap that assembly closes: a slack rope needs no closing.
Planar::Vec gap_to_close(const JointData& joint, const JointKinematics& r);

/// The largest coordinate of the mechanism [m].
double mechanism_size(const System& system, const Vecs& q);

/// The minimum of the joints' potential energy nearest to the guess, by Levenberg-Marquardt. theory/assembly Eqs. (1.1)-(1.4).
class PositionSearch {
 public:
  /// Joints in `open` are left out.
  PositionSearch(const Model& model, const System& system, const std::vector<bool>& open);

  void run(Vecs& q, int max_iterations = 500);

 private:
  Vecs body_weights(const Vecs& q) const;

  const Model& model_;
  const System& system_;
  LeastSquares equations_;
  Vecs weight_;
  std::vector<Planar::Motion> m_;
  std::vector<JointKinematics> r_;
};

}  // namespace pintle
