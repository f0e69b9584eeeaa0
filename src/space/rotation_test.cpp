#include "space/rotation.h"

#include <gtest/gtest.h>

#include <numbers>

#include "base/random_for_tests.h"

namespace pintle {
namespace {

using SpacePoint = Eigen::Vector3d;
using sample::Random;
using sample::slope_at_zero;

Eigen::Matrix3d matrix_of(const SpacePoint& turn) {
  const auto v = components(turn);
  const auto R = rotation::matrix(v, rotation::functions(rotation::square_of(v)));
  Eigen::Matrix3d m;
  m << R.xx, R.xy, R.xz, R.yx, R.yy, R.yz, R.zx, R.zy, R.zz;
  return m;
}

// A rotation vector of this angle in a random direction.
SpacePoint turn_by(double angle, Random& random) {
  SpacePoint axis;
  do axis = random.vector<SpacePoint>(-1, 1);
  while (axis.norm() < 0.1);
  return angle * axis.normalized();
}

// The closed forms with more digits than double precision.
RotationFunctions<long double> closed_forms(long double x) {
  const long double half = x / 2, s = std::sin(half), c = std::cos(half);
  return {2 * s * c / x, 2 * s * s / (x * x), (1 - half * c / s) / (x * x)};
}

TEST(Rotation, SeriesMeetTheClosedFormsAtTheirBorder) {
  for (const double x : {0.5, 0.9, 0.999999, 1.0, 1.000001, 1.1}) {
    const auto exact = closed_forms(x);
    const auto series = rotation::of_small(x * x), used = rotation::functions(x * x);
    EXPECT_NEAR(series.once, static_cast<double>(exact.once), 3e-16) << x;
    EXPECT_NEAR(series.twice, static_cast<double>(exact.twice), 2e-16) << x;
    EXPECT_NEAR(series.inverse, static_cast<double>(exact.inverse), 1e-16) << x;
    EXPECT_NEAR(used.once, static_cast<double>(exact.once), 3e-16) << x;
    EXPECT_NEAR(used.twice, static_cast<double>(exact.twice), 2e-16) << x;
    EXPECT_NEAR(used.inverse, static_cast<double>(exact.inverse), 5e-16) << x;
  }
}

TEST(Rotation, SeriesBeginAsTheirLimits) {
  const auto at_rest = rotation::functions(0.0);
  EXPECT_EQ(at_rest.once, 1);
  EXPECT_EQ(at_rest.twice, 0.5);
  EXPECT_DOUBLE_EQ(at_rest.inverse, 1.0 / 12);
  const auto tiny = rotation::functions(1e-300);
  EXPECT_EQ(tiny.once, 1);
}

TEST(Rotation, MatricesAreRotationsAboutTheVectorByItsLength) {
  Random random(1);
  EXPECT_EQ(matrix_of(SpacePoint::Zero()), Eigen::Matrix3d::Identity());
  for (const double angle : {1e-160, 1e-9, 1e-3, 0.7, 0.9999, 1.0001, 2.0, 3.14, 4.5, 6.2, 12.0}) {
    const SpacePoint turn = turn_by(angle, random);
    const Eigen::Matrix3d R = matrix_of(turn);
    EXPECT_LT((R.transpose() * R - Eigen::Matrix3d::Identity()).norm(), 3e-15) << angle;
    EXPECT_NEAR(R.determinant(), 1, 3e-15);
    EXPECT_LT((R - Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix()).norm(), 4e-15) << angle;
    EXPECT_LT((rotation::quaternion(turn).toRotationMatrix() - R).norm(), 4e-15) << angle;
  }
}

TEST(Rotation, QuaternionsAndVectorsAreInversesUpToHalfATurn) {
  Random random(2);
  EXPECT_EQ(rotation::vector_of(Eigen::Quaterniond::Identity()), SpacePoint::Zero());
  for (const double angle : {1e-100, 1e-12, 1e-4, 0.5, 1.0, 2.0, 3.0, std::numbers::pi - 1e-9}) {
    const SpacePoint turn = turn_by(angle, random);
    const Eigen::Quaterniond r = rotation::quaternion(turn);
    EXPECT_NEAR(r.norm(), 1, 3e-16);
    EXPECT_LT((rotation::vector_of(r) - turn).norm(), 2e-15 * angle) << angle;
    // The sign of the quaternion does not change the rotation.
    EXPECT_LT((rotation::vector_of(Eigen::Quaterniond(-r.coeffs())) - turn).norm(), 2e-15 * angle) << angle;
  }
  // Beyond half a turn: the shorter way round.
  const SpacePoint far = turn_by(4, random);
  EXPECT_LT((rotation::vector_of(rotation::quaternion(far)) - far * (1 - 2 * std::numbers::pi / 4)).norm(), 4e-15);
}

// theory/space Eq. (1.4): a frame that turns at w in its own axes, seen from the axes in which the vector starts.
TEST(Rotation, RateIsTheSlopeOfTheRotationVector) {
  Random random(3);
  for (const double angle : {0.0, 1e-3, 0.6, 0.999, 1.001, 2.0, 3.0}) {
    const SpacePoint turn = turn_by(angle, random), w = random.vector<SpacePoint>(-2, 2);
    const Eigen::Quaterniond now = rotation::quaternion(turn);
    const SpacePoint slope = slope_at_zero(1e-3, [&](double t) { return SpacePoint(rotation::vector_of(now * rotation::quaternion(t * w))); });
    const auto v = components(turn);
    const SpacePoint rate = vector_of(rotation::rate(v, components(w), rotation::functions(rotation::square_of(v)).inverse));
    EXPECT_LT((rate - slope).norm(), 1e-10 * w.norm()) << angle;
  }
}

TEST(Rotation, AboutOneAxisRatesAreAngularVelocities) {
  const Vector3<double> turn{0, 0, 3.0}, w{0, 0, 7.0};
  const auto rate = rotation::rate(turn, w, rotation::functions(9.0).inverse);
  EXPECT_EQ(rate.x, 0);
  EXPECT_EQ(rate.y, 0);
  EXPECT_EQ(rate.z, 7);
}

// Lanes on both sides of the border between series and closed forms.
TEST(Rotation, LanesAreThePlainNumbers) {
  Random random(4);
  const SpacePoint turns[] = {turn_by(1e-5, random), turn_by(0.9, random), turn_by(1.1, random), turn_by(2.5, random), turn_by(4.4, random)};
  Vector3<Lanes<5>> turn, w;
  const SpacePoint spin(0.3, -2, 1.5);
  for (int i = 0; i < 5; ++i) {
    turn.x.set(i, turns[i].x());
    turn.y.set(i, turns[i].y());
    turn.z.set(i, turns[i].z());
  }
  w = {Lanes<5>(spin.x()), Lanes<5>(spin.y()), Lanes<5>(spin.z())};
  const auto f = rotation::functions(rotation::square_of(turn));
  const auto R = rotation::matrix(turn, f);
  const auto rate = rotation::rate(turn, w, f.inverse);
  for (int i = 0; i < 5; ++i) {
    const auto v = components(turns[i]);
    const auto g = rotation::functions(rotation::square_of(v));
    const auto plain = rotation::matrix(v, g);
    const auto one = rotation::rate(v, components(spin), g.inverse);
    EXPECT_EQ(f.once[i], g.once) << i;
    EXPECT_EQ(f.twice[i], g.twice) << i;
    EXPECT_EQ(f.inverse[i], g.inverse) << i;
    EXPECT_EQ(R.xx[i], plain.xx);
    EXPECT_EQ(R.xy[i], plain.xy);
    EXPECT_EQ(R.zx[i], plain.zx);
    EXPECT_EQ(R.zz[i], plain.zz);
    EXPECT_EQ(rate.x[i], one.x);
    EXPECT_EQ(rate.y[i], one.y);
    EXPECT_EQ(rate.z[i], one.z);
  }
}

}  // namespace
}  // namespace pintle
