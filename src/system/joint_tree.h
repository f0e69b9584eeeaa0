// Relative coordinates over the spanning tree of ideal joints, and the recursions that form their equations: outward for
// motion, inward for forces. theory/tree sections 1 to 4.
//
// The coordinates of a body are what the type of its tree joint leaves free (slide along x of F [m], angle of M against
// F [rad]), whichever of the two bodies is nearer to the ground. A body that no ideal joint connects to a body before
// it has its three own coordinates (x, y, angle).
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "system/system.h"

namespace pintle {

/// Where the bodies are for given coordinates, how they move, and how they move relative to their parents.
struct TreePose {
  Vecs q, v;
  std::vector<Planar::Motion> m;
  std::vector<Planar::Point> arm;  // from the parent's centre of mass to the body's, world axes [m]
  std::vector<Planar::Mat> S;      // its first columns: the body's velocity per unit rate of its coordinates
  Vecs c;                          // acceleration if neither the parent nor the coordinates accelerate
};

/// How the bodies' motion depends on coordinates y and rates u at constant u' = w: three rows for each body, one column for
/// each coordinate. The derivative of the velocities by the rates is the Jacobian.
struct TreeMotionSlopes {
  Eigen::MatrixXd velocity;              // dv/dy
  Eigen::MatrixXd acceleration;          // da/dy
  Eigen::MatrixXd acceleration_by_rate;  // da/du
};

class JointTree {
 public:
  using S = Planar;

  /// The tree of `system`'s joints that are marked ideal; `system` must outlive it.
  explicit JointTree(const System& system);

  int n() const { return n_; }  ///< coordinates
  /// Indices of the joints that remain force laws, servos included.
  const std::vector<int>& laws() const { return laws_; }
  bool in_tree(int joint) const { return in_tree_[joint]; }
  /// No joint is replaced by coordinates: the bodies' own coordinates are all there are.
  bool all_free() const { return laws_.size() == in_tree_.size(); }
  /// One line for each ideal joint that has been opened, with its loop or the reason; one for the joints replaced by coordinates.
  std::vector<std::string> notes() const;

  /// Coordinates of the bodies' positions. Eq. (1.2).
  void read_positions(const Vecs& q, Eigen::VectorXd& y) const;
  /// The rates with which the tree keeps most of the bodies' momentum: nearest to v in the mass norm. Eq. (2.6).
  void read_rates(const TreePose& pose, const Vecs& v, Eigen::VectorXd& u) const;

  /// Bodies from coordinates y and rates u. Eqs. (1.3), (2.1)-(2.4).
  void place(const Eigen::VectorXd& y, const Eigen::VectorXd& u, TreePose& pose) const;
  /// Accelerations of the bodies, u' = w. Eq. (2.3).
  void accelerate(const TreePose& pose, const Eigen::VectorXd& w, Vecs& a) const;
  /// on_coordinates = J' on_bodies; on_bodies becomes the total on each body and all it carries, about its centre of mass. Eq. (3.1).
  void gather(const TreePose& pose, Vecs& on_bodies, Eigen::VectorXd& on_coordinates) const;
  /// The same for several columns, with three rows for each body.
  void gather(const TreePose& pose, Eigen::MatrixXd& on_bodies, Eigen::MatrixXd& on_coordinates) const;
  /// The mass matrix of composite bodies. Eqs. (3.2), (3.3).
  void mass(const TreePose& pose, Eigen::MatrixXd& H) const;
  /// dv/du, three rows for each body. Eq. (2.5).
  void jacobian(const TreePose& pose, Eigen::MatrixXd& J) const;
  /// The slopes of the bodies' motion, at accelerations a. Eqs. (2.7), (2.8).
  void motion_slopes(const TreePose& pose, const Vecs& a, TreeMotionSlopes& out) const;
  /// d(J' g)/dy at constant forces g on the bodies; symmetric. Eq. (3.5).
  void geometric_stiffness(const TreePose& pose, const Vecs& g, Eigen::MatrixXd& out) const;
  /// Forces of the tree's joints: what their subtrees need for accelerations a under the forces Q. Eqs. (4.1), (4.2).
  /// The entries of other joints are not changed.
  void reactions(const TreePose& pose, const Vecs& a, const Vecs& Q, Vecs& force) const;

 private:
  struct Link {
    int parent = kGround, joint = -1;
    int first = 0, count = 3;   // coordinates
    bool forward = true;        // the parent is the joint's first body
    int slide = -1, turn = -1;  // column of S
  };
  S::Point lever(const TreePose& pose, int body) const;
  template <int Columns>
  void gather_columns(const TreePose& pose, Eigen::Ref<Eigen::Matrix<double, Eigen::Dynamic, Columns>> on_bodies,
                      Eigen::Ref<Eigen::Matrix<double, Eigen::Dynamic, Columns>> on_coordinates) const;
  void grow(int from, const std::vector<std::vector<int>>& ideal_at);
  void open_the_rest();
  std::string loop_of(int joint) const;
  void place_on_parent(int body, const Eigen::VectorXd& y, const Eigen::VectorXd& u, TreePose& pose) const;

  const System& system_;
  int n_ = 0;
  std::vector<Link> link_;   // per body
  std::vector<int> order_;   // parents before their children
  std::vector<bool> reached_, in_tree_;
  std::vector<int> laws_;
  std::vector<std::string> opened_;
};

}  // namespace pintle
