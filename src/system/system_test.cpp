// The equations of motion of a mechanism with everything in it, at random states: tangents, balance, independence of order.
#include "system/system.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "system/sample_systems_for_tests.h"

namespace pintle {
namespace {

using S = Planar;
using Vec = Planar::Vec;
using sample::Random;

constexpr int kStates = 30;

std::vector<S::Motion> motions(const System& system, const Vecs& q, const Vecs& v) {
  std::vector<S::Motion> m;
  system.motions(q, v, m);
  return m;
}

// A system in a random state, with its open values set there.
struct Instant {
  double t = 0.37;
  Vecs settled, q, v;
  const System system;

  Instant(const Model& model, Random& random) : system(settle(model, random)) {
    sample::random_state(random, model.bodies.size(), q, v);
  }
  Vecs external(int body, bool in_v, const Vec& move) const {
    Vecs x = q, y = v, Q;
    (in_v ? y : x)[body] += move;
    system.external(t, motions(system, x, y), Q);
    return Q;
  }

 private:
  System settle(const Model& model, Random& random) {
    sample::random_state(random, model.bodies.size(), settled, v);
    std::vector<std::string> notes;
    return fix_assembled_values(model, build_system(model), settled, notes);
  }
};

TEST(System, TangentsOfTheLoadsAreDifferences) {
  Random random(5);
  const Model model = sample::everything();
  for (int i = 0; i < kStates; ++i) {
    const Instant at(model, random);
    const int n = at.system.n_bodies();
    std::vector<std::array<S::Mat, 2>> stated(n * n, {S::Mat::Zero(), S::Mat::Zero()});
    at.system.external_tangents(at.t, motions(at.system, at.q, at.v), [&](int row, int column, const S::Mat& dq, const S::Mat& dv) {
      stated[row * n + column][0] += dq;
      stated[row * n + column][1] += dv;
    });
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < 3; ++k)
        for (const bool in_v : {false, true})
          for (int row = 0; row < n; ++row) {
            const Vec slope = sample::slope_at_zero(1e-3, [&](double x) { return at.external(j, in_v, x * Vec::Unit(k))[row]; });
            const Vec column = stated[row * n + j][in_v].col(k);
            EXPECT_LT((slope - column).norm(), 1e-7 * (1 + column.norm())) << row << " by " << (in_v ? "v" : "q") << k << " of " << j;
          }
    if (HasFailure()) return;
  }
}

TEST(System, PatternHoldsEveryTangentBlock) {
  Random random(6);
  const Instant at(sample::everything(), random);
  const BlockPattern& pattern = at.system.pattern();
  const auto is_there = [&](int i, int j) {
    const int a = std::min(pattern.position(i), pattern.position(j)), b = std::max(pattern.position(i), pattern.position(j));
    for (int k = pattern.first(a); k < pattern.first(a + 1); ++k)
      if (pattern.column(k) == b) return true;
    return i == j;
  };
  at.system.external_tangents(0, motions(at.system, at.q, at.v),
                              [&](int i, int j, const S::Mat&, const S::Mat&) { EXPECT_TRUE(is_there(i, j)) << i << " " << j; });
  for (const JointData& joint : at.system.joints)
    if (joint.at.a != kGround && joint.at.b != kGround) { EXPECT_TRUE(is_there(joint.at.a, joint.at.b)) << joint.name; }
}

// Stored energy: external loads, and the joints that are not servos.
double potential(const Instant& at, const Vecs& q) {
  const auto m = motions(at.system, q, at.v);
  double sum = at.system.external_work(at.t, q, m).potential;
  for (int j = 0; j < at.system.n_joints(); ++j) {
    const JointKinematics r = at.system.kinematics(j, at.t, m);
    if (at.system.joints[j].servo < 0) sum += respond(at.system.joints[j].law, r.gap, r.rate).energy;
  }
  return sum;
}

// d(kinetic + potential)/dt = supplied - lost, where all power of servos counts as supplied.
TEST(System, PowerIsBalanced) {
  Random random(7);
  const Model model = sample::everything();
  for (int i = 0; i < kStates; ++i) {
    const Instant at(model, random);
    const auto m = motions(at.system, at.q, at.v);
    Vecs a;
    at.system.accelerations(at.t, at.q, at.v, a);
    double kinetic_rate = 0;
    for (int b = 0; b < at.system.n_bodies(); ++b) kinetic_rate += at.v[b].dot(at.system.bodies[b].mass.cwiseProduct(a[b]));
    const double potential_rate = sample::slope_at_zero(1e-4, [&](double t) {
      Vecs q = at.q;
      for (std::size_t b = 0; b < q.size(); ++b) q[b] += t * at.v[b];
      return potential(at, q);
    });
    const ExternalWork work = at.system.external_work(at.t, at.q, m);
    double supplied = work.supplied, lost = work.lost;
    for (int j = 0; j < at.system.n_joints(); ++j) {
      const JointData& joint = at.system.joints[j];
      const JointKinematics r = at.system.kinematics(j, at.t, m);
      const Response response = respond(joint.law, r.gap, r.rate);
      if (joint.servo >= 0) supplied += response.force[joint.servo] * at.system.pose(joint.at, m).rate[joint.servo];
      else lost += response.loss;
    }
    EXPECT_GE(lost, 0);
    const double size = std::abs(kinetic_rate) + std::abs(potential_rate) + std::abs(supplied) + lost;
    EXPECT_NEAR(kinetic_rate + potential_rate, supplied - lost, 1e-8 * size);
  }
}

TEST(System, KineticEnergyIsHalfTheMassTimesTheSquare) {
  const System system = build_system(sample::pendulum(1e6, 500));
  EXPECT_DOUBLE_EQ(system.kinetic({{3, 4, 6}}), 0.5 * 25 + 0.5 * 36 / 12);
}

// Without ground, gravity and applied forces the momentum is constant, linear and about any point.
TEST(System, InternalForcesAndMomentsCancel) {
  Random random(8);
  const Model model = sample::everything(true);
  for (int i = 0; i < kStates; ++i) {
    const Instant at(model, random);
    Vecs a;
    at.system.accelerations(at.t, at.q, at.v, a);
    const S::Point about = random.vector<S::Point>(-5, 5);
    S::Point force = S::Point::Zero();
    double moment = 0, size = 0;
    for (int b = 0; b < at.system.n_bodies(); ++b) {
      const Vec Q = at.system.bodies[b].mass.cwiseProduct(a[b]);
      force += Q.head<2>();
      moment += S::cross(at.q[b].head<2>() - about, Q.head<2>()) + Q[2];
      size += Q.cwiseAbs().sum();
    }
    EXPECT_LT(force.norm(), 1e-13 * size);
    EXPECT_NEAR(moment, 0, 1e-12 * size);
  }
}

TEST(System, AccelerationsDoNotDependOnTheOrderOfBodies) {
  Random random(9);
  const Model model = sample::everything();
  Model shuffled = model;
  std::reverse(shuffled.bodies.begin(), shuffled.bodies.end());
  std::rotate(shuffled.bodies.begin(), shuffled.bodies.begin() + 2, shuffled.bodies.end());
  std::reverse(shuffled.joints.begin(), shuffled.joints.end());
  std::reverse(shuffled.springs.begin(), shuffled.springs.end());
  for (int i = 0; i < kStates; ++i) {
    const Instant at(model, random);
    const System open = build_system(shuffled);
    Vecs settled(at.q.size()), q(at.q.size()), v(at.q.size()), a, b;
    std::vector<std::size_t> place(at.q.size());
    for (std::size_t k = 0; k < place.size(); ++k)
      while (open.bodies[place[k]].name != at.system.bodies[k].name) ++place[k];
    for (std::size_t k = 0; k < place.size(); ++k) {
      settled[place[k]] = at.settled[k];
      q[place[k]] = at.q[k];
      v[place[k]] = at.v[k];
    }
    std::vector<std::string> notes;
    const System other = fix_assembled_values(shuffled, open, settled, notes);
    at.system.accelerations(at.t, at.q, at.v, a);
    other.accelerations(at.t, q, v, b);
    for (std::size_t k = 0; k < place.size(); ++k) EXPECT_LT((a[k] - b[place[k]]).norm(), 1e-12 * (1 + a[k].norm()));
  }
}

// The pendulum at rest, horizontal, unstretched: it falls freely.
TEST(System, UnstretchedPendulumFallsFreely) {
  const System system = build_system(sample::pendulum(1e8, 3000));
  Vecs a;
  system.accelerations(0, {{0.5, 0, 0}}, {{0, 0, 0}}, a);
  EXPECT_EQ(a[0], Vec(0, -9.81, 0));
}

// Stretched to carry a quarter of its weight it falls as on an ideal pin: alpha = -3 g / (2 l).
TEST(System, PendulumOnItsReactionFallsAsOnAPin) {
  const double k = 1e8, g = 9.81;
  const System system = build_system(sample::pendulum(k, 3000));
  Vecs a;
  system.accelerations(0, {{0.5, -g / 4 / k, 0}}, {{0, 0, 0}}, a);
  EXPECT_NEAR(a[0][1], -0.75 * g, 1e-6);
  EXPECT_NEAR(a[0][2], -1.5 * g, 1e-5);
}

// A servo's gap is its coordinate minus the target: rate and bias are the derivatives of that.
TEST(System, ServoKinematicsFollowTheTarget) {
  Random random(10);
  const Instant at(sample::everything(), random);
  for (int j = 0; j < at.system.n_joints(); ++j) {
    const int k = at.system.joints[j].servo;
    if (k < 0) continue;
    const auto at_time = [&](double dt) {
      Vecs q = at.q;
      for (std::size_t b = 0; b < q.size(); ++b) q[b] += dt * at.v[b];
      return at.system.kinematics(j, at.t + dt, motions(at.system, q, at.v));
    };
    const JointKinematics r = at_time(0);
    const double rate = sample::slope_at_zero(1e-4, [&](double dt) { return at_time(dt).gap[k]; });
    const double bias = sample::slope_at_zero(1e-4, [&](double dt) { return at_time(dt).rate[k]; });
    EXPECT_NEAR(r.rate[k], rate, 1e-9 * (1 + std::abs(rate))) << at.system.joints[j].name;
    EXPECT_NEAR(r.bias[k], bias, 1e-8 * (1 + std::abs(bias))) << at.system.joints[j].name;
  }
}

TEST(System, LoadsByHand) {
  Model model = sample::pendulum(1e6, 0);
  model.gravity = {0, 0};
  model.bodies[0].markers.push_back({"E", {0.5, 0}, 0});
  model.ground.push_back({"H", {1, 2}, 0});
  model.springs = {sample::spring("S", false, {"ground", "H"}, {"rod", "E"}, 10, 3), sample::spring("T", true, {"ground", "O"}, {"rod", "O"}, 5, 2)};
  model.springs[0].free_length = 1.5;
  model.springs[1].free_length = 0.2;
  const System system = build_system(model);
  Vecs Q;
  // E is at (1, 0), 2 m below H, and moves down at 4 m/s; the spring is stretched by 0.5 m: 5 N + 12 N up.
  const auto m = motions(system, {{0.5, 0, 0}}, {{0, -2, -4}});
  system.external(0, m, Q);
  // Torsion spring: -5 (0 - 0.2) - 2 (-4) = 9 N*m.
  EXPECT_LT((Q[0] - Vec(0, 17, 17 * 0.5 + 9)).norm(), 1e-13);
  EXPECT_NEAR(system.load_effort(system.loads[0], 0, m), -17, 1e-13);  // conjugate to the length: tension is negative
  const ExternalWork work = system.external_work(0, {{0.5, 0, 0}}, m);
  EXPECT_NEAR(work.potential, 0.5 * 10 * 0.25 + 0.5 * 5 * 0.04, 1e-13);
  EXPECT_NEAR(work.lost, 3 * 16 + 2 * 16, 1e-13);
}

TEST(System, AppliedForceInBodyAxesTurnsWithTheBody) {
  Model model = sample::pendulum(1e6, 0);
  model.gravity = {0, 0};
  AppliedForce force;
  force.name = "F";
  force.on = {"rod", "O"};
  force.force = {sample::expression("2*t"), Expression::constant(0)};
  force.torque = sample::expression("0.5");
  for (const bool body_axes : {false, true}) {
    force.body_axes = body_axes;
    model.forces = {force};
    const System system = build_system(model);
    Vecs Q;
    system.external(3, motions(system, {{0, 0, std::numbers::pi / 2}}, {{0, 0, 0}}), Q);
    const Vec expected = body_axes ? Vec(0, 6, 0.5) : Vec(6, 0, 0.5 + 3);  // O is at (0, -0.5)
    EXPECT_LT((Q[0] - expected).norm(), 1e-14) << body_axes;
  }
}

// The switching functions change sign where a rope goes taut or an expression jumps, and nowhere else.
TEST(System, SaysOnWhichSideOfItsKinksItIs) {
  Model model = sample::pendulum(1e6, 0);
  EXPECT_FALSE(build_system(model).has_branches());
  model.joints.push_back(sample::joint("rope", "rope", {"ground", "O"}, {"rod", "O"}, 1e4, 0));
  model.joints.back().geometry = {{"length", 0.2}};
  model.motors = {sample::motor("M", "pin", MotorKind::kEffort, sample::expression("if(t > 1, 2, 3)"))};
  const System system = build_system(model);
  ASSERT_TRUE(system.has_branches());
  const auto sides = [&system](double t, double lift) {
    const auto m = motions(system, {{0.5, lift, 0}}, {{0, 0, 0}});
    Vecs gap, rate;
    for (int j = 0; j < system.n_joints(); ++j) {
      const JointKinematics r = system.kinematics(j, t, m);
      gap.push_back(r.gap);
      rate.push_back(r.rate);
    }
    std::vector<double> value(system.switching_functions().size());
    system.evaluate_switching_functions(t, m, gap, rate, {}, {}, value.data());
    return value;
  };
  EXPECT_TRUE(same_sides(sides(0, 0.1), sides(0.9, 0.19)));
  EXPECT_FALSE(same_sides(sides(0, 0.1), sides(0, 0.21)));
  EXPECT_FALSE(same_sides(sides(0.9, 0.1), sides(1.1, 0.1)));
  EXPECT_FALSE(same_sides(sides(1.1, 0.1), sides(0.9, 0.21)));
  const std::vector<double> value = sides(0.25, 0.21);
  ASSERT_EQ(value.size(), 2u);
  EXPECT_NEAR(value[0], 0.01, 1e-15);
  EXPECT_NEAR(value[1], -0.75, 1e-15);
  EXPECT_EQ(system.name(system.switching_functions()[0]), "border 1 of law \"tension\" in joint rope");
  EXPECT_EQ(system.name(system.switching_functions()[1]), "kink or jump 1 of motor M (if(t > 1, 2, 3))");
}

}  // namespace
}  // namespace pintle
