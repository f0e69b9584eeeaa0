// Properties that every joint displacement must have, at any placement and motion of two bodies. The tests of src/system run the
// same checks over the joint types of the catalog.
#pragma once

#include <gtest/gtest.h>

#include <tuple>

#include "base/random_for_tests.h"
#include "joints/joint_displacement.h"

namespace pintle::sample {

using Vec6 = Eigen::Matrix<double, 6, 1>;

/// Two bodies with a frame each.
struct Couple {
  Planar::Frame F, M;
  Planar::Vec qA, qB, vA, vB;

  Planar::Motion A() const { return Planar::Motion::of(qA, vA); }
  Planar::Motion B() const { return Planar::Motion::of(qB, vB); }
  RelativePose pose() const { return RelativePose::between(A(), F, B(), M); }
  Vec6 v() const {
    Vec6 x;
    x << vA, vB;
    return x;
  }
  Couple moved(const Vec6& dq) const {
    Couple c = *this;
    c.qA += dq.head<3>();
    c.qB += dq.tail<3>();
    return c;
  }
};

/// Frames and motions at random, with the two markers at least `apart` from each other.
inline void place_at_random(Random& random, double apart, Couple& c) {
  do {
    c.qA = random.vector<Planar::Vec>(-2, 2);
    c.qB = random.vector<Planar::Vec>(-2, 2);
    c.vA = random.vector<Planar::Vec>(-5, 5);
    c.vB = random.vector<Planar::Vec>(-5, 5);
  } while (c.pose().z.head<2>().norm() < apart);
}
inline Couple random_couple(Random& random) {
  Couple c;
  c.F = Planar::Frame::at(random.vector<Planar::Point>(-1, 1), random.uniform(-3, 3));
  c.M = Planar::Frame::at(random.vector<Planar::Point>(-1, 1), random.uniform(-3, 3));
  place_at_random(random, 0.4, c);
  return c;
}

inline JointKinematics kinematics(const JointDisplacement& displacement, const Couple& c) { return read(displacement, c.pose()); }
inline Eigen::Matrix<double, 3, 6> jacobian(const JointKinematics& r) {
  Eigen::Matrix<double, 3, 6> G;
  G << r.GA(), r.GB();
  return G;
}

template <class M>
void expect_close(const M& found, const M& expected, double tolerance, const char* what) {
  const double size = 1 + expected.cwiseAbs().maxCoeff();
  EXPECT_LE((found - expected).cwiseAbs().maxCoeff(), tolerance * size) << what << "\n" << found << "\n\n" << expected;
}

/// Columns: derivatives of f as the couple is moved along each coordinate.
template <int Rows, class F>
Eigen::Matrix<double, Rows, 6> slopes(const Couple& c, F&& f) {
  Eigen::Matrix<double, Rows, 6> D;
  for (int k = 0; k < 6; ++k) D.col(k) = slope_at_zero(1e-3, [&](double x) { return f(c.moved(x * Vec6::Unit(k))); });
  return D;
}

inline void expect_derivatives(const JointDisplacement& displacement, const Couple& c, const Planar::Vec& force) {
  using Vec = Planar::Vec;
  const JointKinematics r = kinematics(displacement, c);
  Eigen::Matrix<double, 3, 6> of_gap = jacobian(r);
  if (has_slip(displacement)) of_gap.row(kSlip).setZero();  // it is not the rate of a function
  expect_close<Eigen::Matrix<double, 3, 6>>(of_gap, slopes<3>(c, [&](const Couple& x) { return Vec(kinematics(displacement, x).gap); }),
                                            1e-8, "Jacobian");
  expect_close<Vec>(r.rate, jacobian(r) * c.v(), 1e-13, "rate = G v");
  const Vec bias = slope_at_zero(1e-4, [&](double t) { return Vec(kinematics(displacement, c.moved(t * c.v())).rate); });
  expect_close<Vec>(r.bias, bias, 1e-7, "convective term");
  expect_close<Eigen::Matrix<double, 3, 6>>(rate_gradient(displacement, c.pose(), c.A(), c.B()),
                                            slopes<3>(c, [&](const Couple& x) { return Vec(kinematics(displacement, x).rate); }), 1e-7,
                                            "gradient of the rate");
  if (!has_slip(displacement)) {
    // The third derivative of a function of the pose is left out.
    const auto third = slopes<3>(c, [&](const Couple& x) {
      Vec bent = Vec::Zero();
      for_each_function(displacement, x.pose().z, [&](int k, const auto& g) { bent[k] = c.pose().rate.dot(g.hessian * c.pose().rate); });
      return bent;
    });
    expect_close<Eigen::Matrix<double, 3, 6>>(bias_gradient(displacement, c.pose(), c.A(), c.B()),
                                              slopes<3>(c, [&](const Couple& x) { return Vec(kinematics(displacement, x).bias); }) - third, 1e-6,
                                              "gradient of the convective term");
  }
  const auto geometric = geometric_stiffness(displacement, c.pose(), force);
  expect_close<Eigen::Matrix<double, 6, 6>>(
      geometric, slopes<6>(c, [&](const Couple& x) { return Vec6(jacobian(kinematics(displacement, x)).transpose() * force); }), 1e-7,
      "geometric stiffness");
  if (!has_slip(displacement)) expect_close<Eigen::Matrix<double, 6, 6>>(geometric, geometric.transpose(), 1e-13, "its symmetry");
}

/// The forces on both bodies cancel, as do their moments about `about`.
inline void expect_opposite_forces(const JointDisplacement& displacement, const Couple& c, const Planar::Vec& force, const Planar::Point& about) {
  const Vec6 Q = jacobian(kinematics(displacement, c)).transpose() * force;
  const Planar::Point FA = Q.segment<2>(0), FB = Q.segment<2>(3);
  const double size = 1 + Q.cwiseAbs().maxCoeff();
  EXPECT_LE((FA + FB).norm(), 1e-14 * size);
  const double moment = Planar::cross(c.qA.head<2>() - about, FA) + Q[2] + Planar::cross(c.qB.head<2>() - about, FB) + Q[5];
  EXPECT_NEAR(moment, 0, 1e-13 * size * (1 + about.norm()));
}

/// The force in the components of z is equivalent to the gap's force: the same forces on the bodies.
inline void expect_pose_force(const JointDisplacement& displacement, const Couple& c, const Planar::Vec& force) {
  const RelativePose pose = c.pose();
  const Planar::Vec f = to_pose_force(displacement, pose, force);
  const JointKinematics r = read(displacement, pose);
  expect_close<Planar::Vec>(pose.GA().transpose() * f, r.GA().transpose() * force, 1e-13, "force on A by way of z");
  expect_close<Planar::Vec>(pose.GB().transpose() * f, r.GB().transpose() * force, 1e-13, "force on B by way of z");
  const Planar::Point world = pose.world_force(f);
  EXPECT_LE((world - Planar::Point((r.GB().transpose() * force).head<2>())).norm(), 1e-13 * (1 + world.norm()));
}

/// Both bodies carried along by the same rigid motion (turn, shift; spin, speed): gap, rate and gap'' do not change.
inline void expect_indifferent_to_rigid_motion(const JointDisplacement& displacement, const Couple& c, Random& random) {
  const Planar::Vec move = random.vector<Planar::Vec>(-3, 3), velocity = random.vector<Planar::Vec>(-4, 4);
  const Planar::Motion carrier = Planar::Motion::of(move, velocity);
  const double w = carrier.w;
  Couple d = c;
  Vec6 acceleration;  // of bodies that do not accelerate in the carrier
  for (const auto& [q, v, first] : {std::tuple{&d.qA, &d.vA, 0}, std::tuple{&d.qB, &d.vB, 3}}) {
    const Planar::Point p = carrier.turned(q->head<2>()), u = carrier.turned(v->head<2>());
    q->head<2>() = carrier.p + p;
    (*q)[2] += carrier.angle;
    v->head<2>() = carrier.v + w * Planar::perp(p) + u;
    (*v)[2] += w;
    acceleration.segment<2>(first) = -w * w * p + 2 * w * Planar::perp(u);
    acceleration[first + 2] = 0;
  }
  const JointKinematics r = kinematics(displacement, c), s = kinematics(displacement, d);
  expect_close<Planar::Vec>(s.gap, r.gap, 1e-13, "gap under a common rigid motion");
  expect_close<Planar::Vec>(s.rate, r.rate, 1e-12, "rate under a common rigid motion");
  expect_close<Planar::Vec>(jacobian(s) * acceleration + s.bias, r.bias, 1e-12, "gap'' under a common rigid motion");
}

inline void expect_all(const JointDisplacement& displacement, const Couple& c, Random& random) {
  const Planar::Vec force = random.vector<Planar::Vec>(-10, 10);
  expect_derivatives(displacement, c, force);
  expect_opposite_forces(displacement, c, force, random.vector<Planar::Point>(-10, 10));
  expect_pose_force(displacement, c, force);
  expect_indifferent_to_rigid_motion(displacement, c, random);
}

}  // namespace pintle::sample
