// theory/space section 2: rotation vectors collocated with angular velocities.
#include "space/spatial_lanes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random_for_tests.h"

namespace pintle {
namespace {

using S = Spatial;
using Point = S::Point;
using Quaternion = Eigen::Quaterniond;
using L = Lanes<3>;
using Body = SpatialBodyLanes<3>;

// Radau IIA of order 5, with a step of length h: theory/time Eqs. (3.2), (3.5).
struct Step {
  L c;
  LaneMatrix<3> A, A2;

  explicit Step(double h) {
    const double r = std::sqrt(6.0);
    Eigen::Matrix3d a;
    a << (88 - 7 * r) / 360, (296 - 169 * r) / 1800, (-2 + 3 * r) / 225,
        (296 + 169 * r) / 1800, (88 + 7 * r) / 360, (-2 - 3 * r) / 225,
        (16 - r) / 36, (16 + r) / 36, 1.0 / 9;
    a *= h;
    const Eigen::Matrix3d twice = a * a;
    for (int i = 0; i < 3; ++i) {
      c.set(i, a.row(i).sum());
      for (int k = 0; k < 3; ++k) {
        A.column[k].set(i, a(i, k));
        A2.column[k].set(i, twice(i, k));
      }
    }
  }
  L place(const L& a, double x0, double v0, L& v) const {
    v = L(v0) + A * a;
    return L(x0) + v0 * c + A2 * a;
  }
};

// A body at an arbitrary start of a step, with angular accelerations b + 2 d t.
struct Start {
  S::Coordinates q{{0.3, -0.2, 0.9}, rotation::quaternion({0.4, -1.1, 0.7})};
  S::Vec v{{0.5, -0.3, 0.8, 1.3, -0.8, 0.9}};
  Point b{1.5, 2.5, -2}, d{-1, 0.7, 2};

  Body after(double h, int passes) const {
    const Step step(h);
    Body body;
    body.stand_still();
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 3; ++i) body.a[3 + k].set(i, b[k] + 2 * d[k] * step.c[i]);
    body.begin(step, q, v);
    for (int i = 1; i < passes; ++i) body.place(step, q, v);
    return body;
  }
  // The product of many short rotations, each at the angular velocity in its middle.
  Quaternion turned(double h) const {
    constexpr int n = 20000;
    Quaternion r = q.r;
    for (int i = 0; i < n; ++i) {
      const double t = h * (i + 0.5) / n, dt = h / n;
      const Point w = Point(v.tail<3>()) + t * b + t * t * d;
      // Magnus' series to fourth order; T = w'' / 2 of a quadratic.
      const Point mean = w + dt * dt / 12 * d, slope = b + 2 * t * d;
      r = r * rotation::quaternion(dt * mean + dt * dt * dt / 12 * w.cross(slope));
    }
    return r.normalized();
  }
};

TEST(SpatialLanes, RotationVectorsAreCollocated) {
  const Start start;
  const double h = 0.3;
  const Step step(h);
  const Body body = start.after(h, 3);
  const Vector3<L> spin{body.v[3], body.v[4], body.v[5]};
  const auto rate = rotation::rate(body.turn, spin, rotation::functions(rotation::square_of(body.turn)).inverse);
  const L x = step.A * rate.x, y = step.A * rate.y, z = step.A * rate.z;
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(body.turn.x[i], x[i], 1e-13);
    EXPECT_NEAR(body.turn.y[i], y[i], 1e-13);
    EXPECT_NEAR(body.turn.z[i], z[i], 1e-13);
    S::Vec written;
    body.write_increment_rate(i, written);
    EXPECT_NEAR(written[3], rate.x[i], 1e-13);
    EXPECT_NEAR(written[5], rate.z[i], 1e-13);
  }
  EXPECT_GT(body.turn.x[2] * body.turn.x[2] + body.turn.y[2] * body.turn.y[2] + body.turn.z[2] * body.turn.z[2], 0.25);
}

TEST(SpatialLanes, OrientationsHaveTheMethodsOrder) {
  const Start start;
  double last = 0;
  for (const double h : {0.4, 0.2, 0.1}) {
    const double error = start.turned(h).angularDistance(start.after(h, 4).coordinates(2, start.q).r);
    EXPECT_LT(error, 3e-4 * std::pow(h / 0.4, 5.5)) << h;
    if (last > 0) {
      EXPECT_GT(last / error, 40) << h;  // 2^6 in the limit: the local error of a method of order 5
    }
    last = error;
  }
}

TEST(SpatialLanes, ASteadyTurnIsExact) {
  const Step step(0.5);
  Body body;
  body.stand_still();
  const S::Coordinates q0{{1, 2, 3}, rotation::quaternion({0.2, 0.3, -0.6})};
  const Point axis = Point(1, -2, 2) / 3;
  const double speed = 8;
  S::Vec v;
  v << 1, 0, -1, speed * axis;
  body.begin(step, q0, v);
  for (int i = 0; i < 3; ++i) {
    const double t = step.c[i];
    const Quaternion r = q0.r * Quaternion(Eigen::AngleAxisd(speed * t, axis));
    EXPECT_LT((body.motion(i).R - r.toRotationMatrix()).norm(), 1e-14);
    EXPECT_LT(r.angularDistance(body.coordinates(i, q0).r), 3e-15);
    EXPECT_LT((body.coordinates(i, q0).p - (q0.p + t * Point(1, 0, -1))).norm(), 1e-15);
    EXPECT_LT((body.motion(i).w - q0.r * (speed * axis)).norm(), 1e-14);
    EXPECT_LT((body.motion(i).w_body - speed * axis).norm(), 1e-15);
  }
}

TEST(SpatialLanes, DisplacedBodiesAreWhereIncrementsMoveThem) {
  const Start start;
  Body body;
  body.stand_still();
  L dq[6];
  sample::Random random(1);
  for (L& x : dq)
    for (int i = 0; i < 3; ++i) x.set(i, random.uniform(-1, 1));
  for (int k = 3; k < 6; ++k) body.v[k] = L(start.v[k]);
  body.displace(start.q, dq);
  for (int i = 0; i < 3; ++i) {
    const S::Coordinates moved = S::moved(start.q, S::Vec{{dq[0][i], dq[1][i], dq[2][i], dq[3][i], dq[4][i], dq[5][i]}});
    const S::Motion m = S::Motion::of(moved, start.v);
    EXPECT_LT((body.motion(i).R - m.R).norm(), 2e-15);
    EXPECT_LT((body.motion(i).p - m.p).norm(), 1e-15);
    EXPECT_LT((body.motion(i).w - m.w).norm(), 3e-15);
    EXPECT_LT((S::moved(start.q, S::difference(moved, start.q)).r.angularDistance(moved.r)), 2e-15);
  }
}

// Half a turn and more within a step, about a moving axis: the next pass corrects the error that a pass leaves.
TEST(SpatialLanes, IterationsContractInLongSteps) {
  const Step step(1);
  Body body;
  body.stand_still();
  S::Vec v;
  v << 0, 0, 0, 2.4, 3.2, 0;
  for (int i = 0; i < 3; ++i) {
    body.a[3].set(i, -2);
    body.a[5].set(i, 2);
  }
  body.begin(step, {}, v);
  double last = 1;
  for (int pass = 0; pass < 4; ++pass) {
    double change = 0;
    for (int i = 0; i < 3; ++i) change = std::max(change, body.change[i]);
    EXPECT_LT(change, std::max(1e-13, 0.01 * last)) << pass;
    last = change;
    body.place(step, {}, v);
  }
  EXPECT_LT(last, 1e-11);
  EXPECT_GT(rotation::square_of(body.turn)[2], 3.2 * 3.2);
}

// A step in which a body turns through most of a whole turn is too long: it yields NaN.
TEST(SpatialLanes, TooLongATurnIsNoNumber) {
  const Step step(1);
  for (const double speed : {4.0, 5.0, 50.0}) {
    Body body;
    body.stand_still();
    S::Vec v;
    v << 0, 0, 0, 0, speed, 0;
    body.begin(step, {}, v);
    EXPECT_EQ(std::isfinite(body.v[3][2]), speed < 4.5) << speed;
    EXPECT_EQ(std::isfinite(body.motion(2).w.x()), speed < 4.5) << speed;
  }
}

}  // namespace
}  // namespace pintle
