// theory/space section 3, at placements with tilts of all sizes.
#include "space/spatial_pose.h"

#include <gtest/gtest.h>

#include <numbers>

#include "base/random_for_tests.h"
#include "space/planar_joint_jacobian.h"
#include "space/planar_pose.h"

namespace pintle {
namespace {

using S = Spatial;
using Point = S::Point;
using Quaternion = Eigen::Quaterniond;
using Both = Eigen::Matrix<double, 12, 1>;
using sample::Random;
using sample::slope_at_zero;

constexpr double kTilts[] = {0, 1e-6, 0.3, 1.2, 2.0, 2.6, 3.0};  // [rad]; 2.6 rad is 149 degrees

Quaternion about(const Point& axis, double angle) { return Quaternion(Eigen::AngleAxisd(angle, axis)); }

// Two bodies and their frames.
struct Pair {
  S::Coordinates a, b;
  S::Vec va, vb;
  S::Frame F, M;

  S::RelativePose pose() const { return S::RelativePose::between(S::Motion::of(a, va), F, S::Motion::of(b, vb), M); }
  // Displaced by increments of both bodies.
  Pair displaced(const Both& by) const {
    Pair to = *this;
    S::move(to.a, by.head<6>());
    S::move(to.b, by.tail<6>());
    return to;
  }
  // After a time, at constant velocities.
  Pair after(double t) const {
    Both by;
    by << t * va, t * vb;
    return displaced(by);
  }
};

// At random positions, with M's z axis tilted by this angle against F's: turned by `before` about F's z axis, tilted, turned by `after` about M's.
Pair pair(Random& random, double tilt, double before, double after) {
  Pair p;
  const auto any = [&] { return rotation::quaternion(random.vector<Point>(-2, 2)); };
  p.a = {random.vector<Point>(-1, 1), any()};
  p.F = S::Frame::at(random.vector<Point>(-0.5, 0.5), any().toRotationMatrix());
  p.M = S::Frame::at(random.vector<Point>(-0.5, 0.5), any().toRotationMatrix());
  const Quaternion relative = about(Point::UnitZ(), before) * about(Point::UnitX(), tilt) * about(Point::UnitZ(), after);
  p.b = {random.vector<Point>(-1, 1), p.a.r * Quaternion(p.F.R) * relative * Quaternion(p.M.R).conjugate()};
  p.va = random.vector<S::Vec>(-2, 2);
  p.vb = random.vector<S::Vec>(-2, 2);
  return p;
}
Pair pair(Random& random, double tilt) { return pair(random, tilt, random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5)); }

// Growth of the turn's derivatives near a tilt of half a turn, where the turn is singular.
double steepness(double tilt) { return 2 / (1 + std::cos(tilt)); }

Both wrenches(const S::RelativePose& pose, const S::Vec& f) {
  Both on;
  pose.map.wrenches(f.data(), on.data(), on.data() + 6);
  return on;
}
Eigen::Matrix<double, 6, 12> jacobian(const S::RelativePose& pose) {
  Eigen::Matrix<double, 6, 12> G;
  G << pose.GA(), pose.GB();
  return G;
}

TEST(SpatialFrame, AlongHasItsAxisThere) {
  Random random(5);
  std::vector<Point> axes{{0, 0, 2}, {0, 0, -3}, {1e-9, 2e-9, -1}, {-1e-200, 0, -1}, {1e-7, 0, 1}, {0, -1, 0}};
  for (int i = 0; i < 20; ++i) axes.push_back(random.vector<Point>(-2, 2));
  for (const Point& axis : axes) {
    const Eigen::Matrix3d R = S::Frame::along({1, 2, 3}, axis).R;
    EXPECT_LT((R.col(2) - axis.normalized()).norm(), 2e-15) << axis.transpose();
    EXPECT_LT((R.transpose() * R - Eigen::Matrix3d::Identity()).norm(), 4e-15);
    EXPECT_NEAR(R.determinant(), 1, 4e-15);
  }
  EXPECT_EQ(S::Frame::along({1, 2, 3}, Point::Zero()).R, Eigen::Matrix3d::Identity());
}

TEST(SpatialPose, IsWhereTheFramesWerePut) {
  Random random(1);
  for (const double tilt : kTilts) {
    const double before = random.uniform(-1.5, 1.5), after = random.uniform(-1.5, 1.5);
    const Pair p = pair(random, tilt, before, after);
    const S::Vec z = p.pose().z;
    const Point d = p.b.p + p.b.r * p.M.p - p.a.p - p.a.r * p.F.p;
    EXPECT_LT((p.a.r * (p.F.R * z.head<3>()) - d).norm(), 3e-15);
    EXPECT_NEAR(z[3], std::sin(tilt) * std::cos(before), 3e-15);
    EXPECT_NEAR(z[4], std::sin(tilt) * std::sin(before), 3e-15);
    EXPECT_NEAR(z[5], before + after, 3e-15 * steepness(tilt)) << tilt;
  }
}

TEST(SpatialPose, RateIsTheSlopeOfThePose) {
  Random random(2);
  for (const double tilt : kTilts)
    for (int i = 0; i < 3; ++i) {
      const Pair p = pair(random, tilt);
      const S::Vec slope = slope_at_zero(1e-4, [&](double t) { return p.after(t).pose().z; });
      EXPECT_LT((p.pose().rate - slope).norm(), 1e-10 * std::pow(steepness(tilt), 2)) << tilt;
    }
}

TEST(SpatialPose, BiasIsTheSlopeOfTheRateAtZeroAccelerations) {
  Random random(3);
  for (const double tilt : kTilts)
    for (int i = 0; i < 3; ++i) {
      const Pair p = pair(random, tilt);
      const S::Vec slope = slope_at_zero(1e-4, [&](double t) { return p.after(t).pose().rate; });
      EXPECT_LT((p.pose().bias - slope).norm(), 1e-10 * std::pow(steepness(tilt), 2) * (1 + slope.norm())) << tilt;
    }
}

TEST(SpatialPose, JacobiansAreSlopesByIncrements) {
  Random random(4);
  for (const double tilt : kTilts) {
    const Pair p = pair(random, tilt);
    const auto G = jacobian(p.pose());
    for (int c = 0; c < 12; ++c) {
      const S::Vec slope = slope_at_zero(1e-4, [&](double x) { return p.displaced(x * Both::Unit(c)).pose().z; });
      EXPECT_LT((G.col(c) - slope).norm(), 1e-11 * std::pow(steepness(tilt), 2)) << tilt << " " << c;
    }
    Both v;
    v << p.va, p.vb;
    EXPECT_LT((G * v - p.pose().rate).norm(), 3e-15 * steepness(tilt) * v.norm());
  }
}

TEST(SpatialPose, PushIsTheTransposeOfGatherAlsoThroughAGradient) {
  Random random(5);
  for (const double tilt : kTilts)
    for (const bool function : {false, true}) {
      S::RelativePose pose = pair(random, tilt).pose();
      pose.map.functions = function;
      for (double& g : pose.map.gradient[0]) g = random.uniform(-1, 1);
      const S::Vec f = random.vector<S::Vec>(-3, 3);
      const Both x = random.vector<Both>(-1, 1), on = wrenches(pose, f);
      S::Vec e;
      pose.map.gather(x.data(), x.data() + 6, e.data());
      EXPECT_NEAR(f.dot(e), on.dot(x), 1e-14 * steepness(tilt) * f.norm() * x.norm());
      EXPECT_LT((jacobian(pose).transpose() * f - on).norm(), 1e-14 * steepness(tilt) * f.norm());
      if (function) {
        EXPECT_EQ(e.tail<5>(), (Eigen::Matrix<double, 5, 1>::Zero()));
      }
      // The magnitudes are those of the same wrenches.
      Both sizes = Both::Zero();
      double *on_a = sizes.data(), *on_b = on_a + 6;
      pose.map.push_magnitudes(f.data(), on_a, on_b);
      EXPECT_EQ(sizes, on.cwiseAbs());
    }
}

TEST(SpatialPose, ActionIsReaction) {
  Random random(6);
  for (const double tilt : kTilts) {
    const Pair p = pair(random, tilt);
    const S::Vec f = random.vector<S::Vec>(-3, 3);
    const auto pose = p.pose();
    const Both on = wrenches(pose, f);
    const Point force_a = on.segment<3>(0), force_b = on.segment<3>(6);
    const Point moment_a = p.a.r * Point(on.segment<3>(3)), moment_b = p.b.r * Point(on.segment<3>(9));
    EXPECT_EQ(force_a, Point(-force_b));
    EXPECT_LT((moment_a + p.a.p.cross(force_a) + moment_b + p.b.p.cross(force_b)).norm(), 1e-14 * steepness(tilt) * f.norm());
    // As in the results: a force and a couple on B at M's origin.
    EXPECT_LT((pose.world_force(f) - force_b).norm(), 1e-15 * f.norm());
    EXPECT_LT((pose.world_couple(f) + (p.b.r * p.M.p).cross(force_b) - moment_b).norm(), 1e-14 * steepness(tilt) * f.norm());
  }
}

TEST(SpatialPose, NothingChangesUnderACommonMotion) {
  Random random(7);
  for (const double tilt : kTilts) {
    const Pair p = pair(random, tilt);
    const Point shift = random.vector<Point>(-1, 1), v0 = random.vector<Point>(-2, 2), w0 = random.vector<Point>(-2, 2);
    const Quaternion turn = rotation::quaternion(random.vector<Point>(-2, 2));
    const S::Vec f = random.vector<S::Vec>(-3, 3);
    const double close = 1e-13 * std::pow(steepness(tilt), 2);
    // Displaced.
    Pair moved = p;
    for (auto* q : {&moved.a, &moved.b}) *q = {shift + turn * q->p, turn * q->r};
    moved.va.head<3>() = turn * Point(p.va.head<3>());
    moved.vb.head<3>() = turn * Point(p.vb.head<3>());
    const auto here = p.pose(), there = moved.pose();
    EXPECT_LT((here.z - there.z).norm(), close);
    EXPECT_LT((here.rate - there.rate).norm(), close);
    EXPECT_LT((here.bias - there.bias).norm(), 10 * close);
    EXPECT_LT((wrenches(here, f).segment<3>(3) - wrenches(there, f).segment<3>(3)).norm(), close);
    EXPECT_LT((turn * Point(wrenches(here, f).segment<3>(6)) - Point(wrenches(there, f).segment<3>(6))).norm(), close);
    // In a moving world: rates and z'' equal those of the world at rest.
    Pair carried = p;
    S::Vec aa = random.vector<S::Vec>(-2, 2), ab = random.vector<S::Vec>(-2, 2);
    const S::Vec second = here.GA() * aa + here.GB() * ab + here.bias;
    const auto carry = [&](const S::Coordinates& q, S::Vec& v, S::Vec& a) {
      const Point inner = v.head<3>(), spin = v.tail<3>(), w_body = q.r.conjugate() * w0;
      v.head<3>() += v0 + w0.cross(q.p);
      v.tail<3>() += w_body;
      a.head<3>() += 2 * w0.cross(inner) + w0.cross(w0.cross(q.p));
      a.tail<3>() -= spin.cross(w_body);
    };
    carry(p.a, carried.va, aa);
    carry(p.b, carried.vb, ab);
    const auto moving = carried.pose();
    EXPECT_LT((moving.rate - here.rate).norm(), close);
    EXPECT_LT((moving.GA() * aa + moving.GB() * ab + moving.bias - second).norm(), 100 * close) << tilt;
  }
}

TEST(SpatialPose, GeometricStiffnessIsTheSlopeOfTheWrenches) {
  Random random(8);
  for (const double tilt : kTilts) {
    const Pair p = pair(random, tilt);
    const S::Vec f = random.vector<S::Vec>(-3, 3);
    const auto N = p.pose().geometric(f);
    for (int c = 0; c < 12; ++c) {
      const Both slope = slope_at_zero(1e-4, [&](double x) { return wrenches(p.displaced(x * Both::Unit(c)).pose(), f); });
      EXPECT_LT((N.col(c) - slope).norm(), 1e-10 * std::pow(steepness(tilt), 3)) << tilt << " " << c;
    }
    // Rotations about two axes of a body do not commute: the moments on the body account for all of N's asymmetry.
    const Both on = wrenches(p.pose(), f);
    Eigen::Matrix<double, 12, 12> skew = Eigen::Matrix<double, 12, 12>::Zero();
    for (const int at : {3, 9})
      for (int c = 0; c < 3; ++c) skew.block<3, 1>(at, at + c) = Point(on.segment<3>(at)).cross(Point::Unit(c));
    EXPECT_LT((N - N.transpose() - skew).norm(), 1e-13 * std::pow(steepness(tilt), 2)) << tilt;
  }
}

TEST(SpatialPose, RateGradientIsTheSlopeOfTheRateByIncrements) {
  Random random(9);
  for (const double tilt : kTilts) {
    const Pair p = pair(random, tilt);
    const auto gradient = p.pose().rate_gradient(S::Motion::of(p.a, p.va), S::Motion::of(p.b, p.vb));
    for (int c = 0; c < 12; ++c) {
      const S::Vec slope = slope_at_zero(1e-4, [&](double x) { return p.displaced(x * Both::Unit(c)).pose().rate; });
      EXPECT_LT((gradient.col(c) - slope).norm(), 1e-10 * std::pow(steepness(tilt), 3)) << tilt << " " << c;
    }
  }
}

TEST(SpatialPose, SpringsInAllComponentsHaveAPotential) {
  Random random(10);
  const S::Vec k(S::Vec{{5.0, 7.0, 11.0, 2.0, 3.0, 1.0}});
  const auto potential = [&](const Pair& p) {
    const S::Vec z = p.pose().z;
    return 0.5 * z.dot(k.cwiseProduct(z));
  };
  for (const double tilt : kTilts) {
    const Pair p = pair(random, tilt);
    const auto pose = p.pose();
    const Both on = wrenches(pose, -k.cwiseProduct(pose.z));
    for (int c = 0; c < 12; ++c) {
      const double slope = slope_at_zero(1e-4, [&](double x) { return potential(p.displaced(x * Both::Unit(c))); });
      EXPECT_NEAR(on[c], -slope, 1e-10 * std::pow(steepness(tilt), 2)) << tilt << " " << c;
    }
  }
}

// z axes along the world's and motion in its plane: components (x, y, turn) are those of the planar pose, the others are zero.
TEST(SpatialPose, ThePlaneLiesInSpace) {
  Random random(11);
  constexpr int kOf[] = {0, 1, 5};
  const auto frame = [&](const Planar::Frame& F) { return S::Frame::at({F.p.x(), F.p.y(), 0}, about(Point::UnitZ(), F.angle).toRotationMatrix()); };
  const auto in_space = [&](const Planar::Vec& v) { return S::Vec{{v[0], v[1], 0.0, 0.0, 0.0, v[2]}}; };
  const auto placed = [&](const Planar::Vec& q) { return S::Coordinates{{q[0], q[1], 0}, about(Point::UnitZ(), q[2])}; };
  const auto pick = [&](const auto& m, int rows, int columns) {
    Eigen::MatrixXd r(rows, columns);
    for (int i = 0; i < rows; ++i)
      for (int j = 0; j < columns; ++j) r(i, j) = m(6 * (i / 3) + kOf[i % 3], 6 * (j / 3) + kOf[j % 3]);
    return r;
  };
  for (int i = 0; i < 20; ++i) {
    const Planar::Vec qa = random.vector<Planar::Vec>(-0.7, 0.7), qb = random.vector<Planar::Vec>(-0.7, 0.7);
    const Planar::Vec va = random.vector<Planar::Vec>(-2, 2), vb = random.vector<Planar::Vec>(-2, 2), f = random.vector<Planar::Vec>(-3, 3);
    const auto F = Planar::Frame::at(random.vector<Planar::Point>(-0.5, 0.5), random.uniform(-0.7, 0.7));
    const auto M = Planar::Frame::at(random.vector<Planar::Point>(-0.5, 0.5), random.uniform(-0.7, 0.7));
    const auto Ap = Planar::Motion::of(qa, va), Bp = Planar::Motion::of(qb, vb);
    const auto flat = PlanarRelativePose::between(Ap, F, Bp, M);
    const auto A = S::Motion::of(placed(qa), in_space(va)), B = S::Motion::of(placed(qb), in_space(vb));
    const auto pose = S::RelativePose::between(A, frame(F), B, frame(M));
    EXPECT_LT((pose.z - in_space(flat.z)).norm(), 1e-14);
    EXPECT_LT((pose.rate - in_space(flat.rate)).norm(), 1e-14);
    EXPECT_LT((pose.bias - in_space(flat.bias)).norm(), 3e-14);
    EXPECT_LT((pick(pose.GA(), 3, 3) - flat.GA()).norm(), 1e-14);
    EXPECT_LT((pick(pose.GB(), 3, 3) - flat.GB()).norm(), 1e-14);
    EXPECT_LT((pick(pose.geometric(in_space(f)), 6, 6) - flat.geometric(f)).norm(), 3e-14);
    EXPECT_LT((pick(pose.rate_gradient(A, B), 3, 6) - flat.rate_gradient(Ap, Bp)).norm(), 3e-14);
  }
}

// Bodies in lanes.
TEST(SpatialPose, LanesAreThePlainNumbers) {
  Random random(12);
  using L = Lanes<4>;
  Pair pairs[4];
  S::RelativePose poses[4];
  SpatialBodyView<L> A, B;
  const auto put = [](Vector3<L>& to, const Vector3<double>& from, int i) { to.x.set(i, from.x), to.y.set(i, from.y), to.z.set(i, from.z); };
  const auto put_body = [&](SpatialBodyView<L>& to, const SpatialBodyView<double>& from, int i) {
    put(to.p, from.p, i), put(to.v, from.v, i), put(to.w, from.w, i);
    const Matrix3<double>& R = from.R;
    L* at[] = {&to.R.xx, &to.R.xy, &to.R.xz, &to.R.yx, &to.R.yy, &to.R.yz, &to.R.zx, &to.R.zy, &to.R.zz};
    const double values[] = {R.xx, R.xy, R.xz, R.yx, R.yy, R.yz, R.zx, R.zy, R.zz};
    for (int k = 0; k < 9; ++k) at[k]->set(i, values[k]);
  };
  const auto one = pair(random, 0.4);
  for (int i = 0; i < 4; ++i) {
    pairs[i] = pair(random, kTilts[i + 2]);
    pairs[i].F = one.F;
    pairs[i].M = one.M;
    poses[i] = pairs[i].pose();
    put_body(A, poses[i].A, i);
    put_body(B, poses[i].B, i);
  }
  const auto F = S::attachment(one.F), M = S::attachment(one.M);
  const auto g = SpatialPoseGeometry<L>::between(A, F, B, M);
  L z[6], rate[6], bias[6], f[6], on_a[6], on_b[6], same_a[6], same_b[6], e[6];
  g.gaps(A, F, B, M, z);
  g.rates(A, B, rate);
  g.biases(bias);
  auto map = SpatialGapMap<L>::of(g);
  for (int k = 0; k < 6; ++k) {
    f[k] = L(0.0);
    for (int i = 0; i < 4; ++i) f[k].set(i, random.uniform(-1, 1)), map.gradient[0][k].set(i, random.uniform(-1, 1));
  }
  for (const bool function : {false, true}) {
    map.functions = function;
    map.wrenches(f, on_a, on_b);
    map.gather(on_b, on_a, e);
    for (int i = 0; i < 4; ++i) {
      SpatialGapMap<double> plain = poses[i].map;
      plain.functions = function;
      double force[6], wrench_a[6], wrench_b[6], change[6], lane_a[6], lane_b[6];
      for (int k = 0; k < 6; ++k) force[k] = f[k][i], plain.gradient[0][k] = map.gradient[0][k][i];
      plain.wrenches(force, wrench_a, wrench_b);
      plain.gather(wrench_b, wrench_a, change);
      map.lane(i).wrenches(force, lane_a, lane_b);
      SpatialGapMap<L>::same(plain).wrenches(f, same_a, same_b);
      for (int k = 0; k < 6; ++k) {
        EXPECT_EQ(z[k][i], poses[i].z[k]) << k;
        EXPECT_EQ(rate[k][i], poses[i].rate[k]) << k;
        EXPECT_EQ(bias[k][i], poses[i].bias[k]) << k;
        EXPECT_EQ(lane_a[k], wrench_a[k]) << k;
        EXPECT_EQ(lane_b[k], wrench_b[k]) << k;
        EXPECT_EQ(on_a[k][i], wrench_a[k]) << k;
        EXPECT_EQ(on_b[k][i], wrench_b[k]) << k;
        EXPECT_EQ(same_a[k][i], wrench_a[k]) << k;
        EXPECT_EQ(same_b[k][i], wrench_b[k]) << k;
        EXPECT_EQ(e[k][i], change[k]) << k;
      }
    }
  }
}

// M's z axis opposite to F's, exactly and within rounding: the turn is undefined, but everything is finite, and all other components are right.
TEST(SpatialPose, AtHalfATurnOfTiltNumbersStayNumbers) {
  for (const double n : {-1.0, std::nextafter(-1.0, -2.0), std::nextafter(-1.0, 0.0), -1 + 1e-11, 0.3})
    EXPECT_EQ(rotation::over_one_plus(Lanes<3>(n))[1], rotation::over_one_plus(n)) << n;
  Random random(14);
  const S::Vec held(S::Vec{{1.0, -2.0, 3.0, 0.0, 0.0, 0.0}});
  for (const double off : {0.0, 1e-300, 1e-20, 1e-9, 1e-7, 1e-5}) {
    Pair p = pair(random, 0.4);
    p.a.r = p.b.r = Quaternion::Identity();
    p.F.R = Eigen::Matrix3d::Identity();
    p.M.R = Eigen::Matrix3d(Point(1, -1, -1).asDiagonal());
    p.M.R.col(2) += Point(off, -off, 0);
    const auto pose = p.pose();
    const auto N = pose.geometric(held);
    EXPECT_TRUE(pose.z.allFinite() && pose.rate.allFinite() && pose.bias.allFinite()) << off;
    EXPECT_TRUE(jacobian(pose).allFinite() && N.allFinite()) << off;
    EXPECT_TRUE(pose.rate_gradient(S::Motion::of(p.a, p.va), S::Motion::of(p.b, p.vb)).allFinite()) << off;
    // Forces in the directions that a ball joint holds do not depend on the tilt.
    Pair level = p;
    level.M.R = Eigen::Matrix3d::Identity();
    EXPECT_EQ(wrenches(pose, held), wrenches(level.pose(), held)) << off;
    EXPECT_EQ(N, level.pose().geometric(held)) << off;
  }
}

TEST(SpatialPose, CountsWholeTurnsFromAReference) {
  constexpr double turn = 2 * std::numbers::pi;
  S::Vec reference = S::Vec::Zero(), z = S::Vec::Constant(0.25);
  reference[S::kTurn] = 7 * turn + 0.1;
  S::count_turns(reference, z);
  EXPECT_DOUBLE_EQ(z[S::kTurn], 7 * turn + 0.25);
  EXPECT_EQ(z[4], 0.25);
  reference[S::kTurn] = -3 * turn - 0.1;
  S::count_turns(reference, z);
  EXPECT_NEAR(z[S::kTurn], -3 * turn + 0.25, 1e-14);
  // A shaft that keeps turning is followed through every turn.
  Random random(13);
  Pair p = pair(random, 0.2, 0.3, 0.4);
  S::Vec last = p.pose().z;
  const double start = last[S::kTurn];
  for (int i = 0; i < 40; ++i) {
    p.M.R = p.M.R * about(Point::UnitZ(), 1).toRotationMatrix();
    S::Vec now = p.pose().z;
    S::count_turns(last, now);
    last = now;
  }
  EXPECT_NEAR(last[S::kTurn], start + 40, 1e-13);
}

}  // namespace
}  // namespace pintle
