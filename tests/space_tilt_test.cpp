// A ball joint at every tilt of its frames, also at half a turn, where the turn about their axes is undefined. theory/space section 3.6.
#include <gtest/gtest.h>

#include <vector>

#include "integrators/absolute/radau_stepper.h"
#include "start/start.h"

namespace pintle {
namespace {

using S = Spatial;
using Point = S::Point;

// State after one second of a body on a ball joint whose frames differ by `relative` at the start.
BasicState<S> swung(const Eigen::Matrix3d& relative) {
  BasicSystem<S> system;
  BasicBodyData<S> body;
  body.name = "body";
  body.mass << 2, 2, 2, 0.2, 0.5, 0.3;
  body.gravity << 0, 0, -2 * 9.81, 0, 0, 0;
  system.bodies.push_back(body);
  BasicJointData<S> ball;
  ball.name = "ball";
  ball.type = "spherical";
  ball.at = {kGround, 0, S::Frame{}, S::Frame::at({0, 0, -0.5}, relative)};
  BasicLinearLaw<S> law;
  for (int k = 0; k < S::kDof; ++k) {
    ball.held[k] = k < S::kDim;
    ball.free_mask[k] = k < S::kDim ? 0 : 1;
    law.k[k] = k < S::kDim ? 1e8 : 0;
    law.c[k] = k < S::kDim ? 1e4 : 0;
  }
  ball.law = law;
  system.joints.push_back(ball);
  system.finish();
  BasicState<S> start;
  const Point w(5, 1.5, 2), arm(0, 0, 0.5);
  start.q = {{arm, Eigen::Quaterniond::Identity()}};
  start.v.resize(1);
  start.v[0] << w.cross(arm), w;
  start_forces(system, true, start);
  BasicRadauStepper<S> stepper(system, 1e-6, 5);
  stepper.start(start, 1e-3);
  while (stepper.state().t < 1)
    if (!stepper.step(1)) {
      ADD_FAILURE() << stepper.failure();
      break;
    }
  return stepper.state();
}

TEST(SpaceTilt, ABallJointDoesNotKnowItsTilt) {
  const BasicState<S> level = swung(Eigen::Matrix3d::Identity());
  std::vector<Eigen::Matrix3d> tilts{Point(1, -1, -1).asDiagonal(), Point(-1, 1, -1).asDiagonal()};
  for (const double tilt : {1e-9, 1e-6, 1e-3}) tilts.push_back(Eigen::AngleAxisd(std::numbers::pi - tilt, Point(0.6, 0.8, 0)).toRotationMatrix());
  for (const Eigen::Matrix3d& relative : tilts) {
    const BasicState<S> state = swung(relative);
    EXPECT_LT((state.q[0].p - level.q[0].p).norm(), 1e-6);
    EXPECT_LT(state.q[0].r.angularDistance(level.q[0].r), 2e-6);
    EXPECT_LT((state.force[0].head<3>() - level.force[0].head<3>()).norm(), 1e-5 * level.force[0].norm());
  }
}

}  // namespace
}  // namespace pintle
