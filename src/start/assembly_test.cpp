// Assembly: positions from rough guesses, velocities from inconsistent ones, joint forces at the start.
#include "start/assembly.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "base/constants.h"
#include "integrators/general/dopri5.h"
#include "integrators/start_states_for_tests.h"
#include "pintle/simulate.h"
#include "start/slow_manifold.h"

namespace pintle {
namespace {

using sample::DenseEquations;
using sample::FourBarPose;
using sample::Random;

struct Assembled {
  const Assembly result;

  explicit Assembled(const Model& model) : result(assemble(model)) {}
  const System& system() const { return result.system; }
  const State& state() const { return result.state; }
  JointKinematics kinematics(int j) const {
    std::vector<Planar::Motion> m;
    system().motions(state().q, state().v, m);
    return system().kinematics(j, 0, m);
  }
  /// The largest gap of any joint, and in opening() its largest rate; revolute joints only.
  double open() const {
    double largest = 0;
    for (int j = 0; j < system().n_joints(); ++j) largest = std::max(largest, kinematics(j).gap.head<2>().norm());
    return largest;
  }
  double opening() const {
    double largest = 0;
    for (int j = 0; j < system().n_joints(); ++j) largest = std::max(largest, kinematics(j).rate.head<2>().norm());
    return largest;
  }
  Planar::Point world_force(int j) const {
    std::vector<Planar::Motion> m;
    system().motions(state().q, state().v, m);
    return system().pose(system().joints[j].at, m).world_force(state().force[j]);
  }
};

// Without preload, so that positions can be compared with those of ideal joints.
Model four_bar_at(double theta2 = kPi / 3, double k = 1e8) {
  Model model = sample::four_bar(k, 3000, theta2);
  model.simulate.start = Start::kUnloaded;
  return model;
}

void knock(Model& model, Random& random, double size) {
  for (Body& b : model.bodies) {
    (*b.position)[0] += random.uniform(-size, size);
    (*b.position)[1] += random.uniform(-size, size);
    *b.angle += random.uniform(-size, size) / 2;
  }
}

TEST(Assembly, ClosesTheLoopFromRoughGuesses) {
  Random random(1);
  for (int i = 0; i < 40; ++i) {
    Model model = four_bar_at(random.uniform(-kPi, kPi));
    knock(model, random, 0.4);
    EXPECT_LT(Assembled(model).open(), 1e-12) << i;
  }
}

TEST(Assembly, ClosesAtAnyStiffness) {
  Random random(2);
  for (const double k : {1e3, 1e6, 1e10, 1e12}) {
    Model model = four_bar_at(1, k);
    knock(model, random, 0.3);
    EXPECT_LT(Assembled(model).open(), 1e-12) << k;
  }
}

TEST(Assembly, LeavesAGoodStateAlone) {
  for (const double theta2 : {0.0, 0.7, kPi / 3, 2.0, 4.0}) {
    const Model model = four_bar_at(theta2);
    const Assembled at(model);
    EXPECT_LT(at.result.largest_move, 1e-13);
    for (std::size_t i = 0; i < model.bodies.size(); ++i) {
      const Body& b = model.bodies[i];
      EXPECT_LT((at.state().q[i] - Planar::Vec((*b.position)[0], (*b.position)[1], *b.angle)).norm(), 1e-13);
      EXPECT_LT((at.state().v[i] - Planar::Vec((*b.velocity)[0], (*b.velocity)[1], *b.spin)).norm(), 1e-12);
    }
    EXPECT_LT(at.open(), 1e-14);
  }
}

// Assembling twice gives the same result.
TEST(Assembly, IsAtRestInItsOwnResult) {
  Random random(3);
  Model model = four_bar_at();
  knock(model, random, 0.3);
  const Assembled first(model);
  for (std::size_t i = 0; i < model.bodies.size(); ++i) sample::put_at(model.bodies[i], first.state().q[i][0], first.state().q[i][1], first.state().q[i][2]);
  const Assembled second(model);
  for (std::size_t i = 0; i < model.bodies.size(); ++i) EXPECT_LT((second.state().q[i] - first.state().q[i]).norm(), 1e-13);
}

TEST(Assembly, KeepsTheBranchOfTheGuess) {
  Random random(4);
  for (int i = 0; i < 20; ++i)
    for (const bool above : {true, false}) {
      Model model = four_bar_at();
      if (!above)
        for (Body& b : model.bodies) {  // mirrored about the ground line: the other branch, with the crank at -60 degrees
          (*b.position)[1] *= -1;
          *b.angle *= -1;
        }
      knock(model, random, 0.2);
      model.bodies[0].hold = {true, true, true};
      sample::put_at(model.bodies[0], 0.25, (above ? 0.5 : -0.5) * std::sin(kPi / 3), above ? kPi / 3 : -kPi / 3);
      const Assembled at(model);
      const FourBarPose exact(kPi / 3);
      EXPECT_NEAR(at.state().q[1][2], above ? exact.theta3 : -exact.theta3, 1e-12);
      EXPECT_NEAR(at.state().q[2][2], above ? exact.theta4 : -exact.theta4, 1e-12);
    }
}

TEST(Assembly, DoesNotMoveWhatIsHeld) {
  Random random(5);
  Model model = four_bar_at();
  knock(model, random, 0.3);
  model.bodies[0].hold = {false, false, true};
  model.bodies[0].angle = 1.0;
  const Assembled at(model);
  EXPECT_NEAR(at.state().q[0][2], 1.0, 1e-12);
  EXPECT_LT(at.open(), 1e-12);
  EXPECT_NEAR(at.state().q[1][2], FourBarPose(1.0).theta3, 1e-11);
}

TEST(Assembly, FindsWhatIsNotStated) {
  Model model = four_bar_at();
  for (const int i : {1, 2}) {
    model.bodies[i].position.reset();
    model.bodies[i].velocity.reset();
    model.bodies[i].spin.reset();
  }
  model.bodies[1].angle = 0.5;
  model.bodies[2].angle = 2.0;
  const Assembled at(model);
  EXPECT_LT(at.open(), 1e-12);
  EXPECT_LT(at.opening(), 1e-9);
  Model pendulum = sample::pendulum(1e8, 3000);
  pendulum.simulate.start = Start::kUnloaded;
  pendulum.bodies[0].position.reset();
  EXPECT_LT(Assembled(pendulum).open(), 1e-15);
}

TEST(Assembly, ALoopThatCannotCloseIsNamed) {
  Model model = four_bar_at();
  for (Marker& marker : model.bodies[1].markers) marker.position[0] *= 0.1;  // a coupler of 0.4 m: 1 + 0.4 + 4 < 6
  try {
    static_cast<void>(assemble(model));
    FAIL() << "it was assembled";
  } catch (const AssemblyError& error) {
    const std::string text = error.what();
    const auto loop = text.find("loop: ");
    ASSERT_NE(loop, std::string::npos) << text;
    const std::string names = text.substr(loop, text.find('\n', loop) - loop);
    for (const char* joint : {"O2", "A", "B", "O4"}) EXPECT_NE(names.find(joint), std::string::npos) << text;
    EXPECT_NE(text.find("stays open by "), std::string::npos) << text;
    EXPECT_NE(text.find("leaving a gap of about 0.6 m"), std::string::npos) << text;  // 6 - (1 + 0.4 + 4)
  }
}

// v = v0 - M^-1 G' (G M^-1 G')^-1 G v0: the velocities after a plastic impact in all joints.
TEST(Assembly, InconsistentVelocitiesGoToTheNearestInTheMassNorm) {
  Random random(6);
  for (int i = 0; i < 10; ++i) {
    Model model = four_bar_at(random.uniform(0, 6));
    model.bodies[0].inertia = random.uniform(1, 10);
    Vecs stated;
    for (Body& b : model.bodies) {
      stated.push_back(random.vector<Planar::Vec>(-3, 3));
      b.velocity = Vec2{stated.back()[0], stated.back()[1]};
      b.spin = stated.back()[2];
    }
    const Assembled at(model);
    const DenseEquations e(at.system(), 0, at.state().q, at.state().v);
    Eigen::VectorXd v(9);
    for (int b = 0; b < 3; ++b) v.segment<3>(3 * b) = stated[b];
    const Eigen::MatrixXd MG = e.mass.cwiseInverse().asDiagonal() * e.G.transpose();
    v -= MG * (e.G * MG).ldlt().solve(e.G * v);
    for (int b = 0; b < 3; ++b) EXPECT_LT((at.state().v[b] - v.segment<3>(3 * b)).norm(), 1e-9) << i;
    EXPECT_LT(at.opening(), 1e-9);
  }
}

// The paper's start: the crank turns at 10 rad/s, coupler and follower stand still. The flywheel hardly slows down.
TEST(Assembly, CrankSpeedSurvivesAnInconsistentStart) {
  Model model = four_bar_at();
  for (const int i : {1, 2}) {
    model.bodies[i].velocity = Vec2{0, 0};
    model.bodies[i].spin = 0;
  }
  const Assembled at(model);
  EXPECT_NEAR(at.state().v[0][2], 10, 2e-3);
  const double share = at.state().v[0][2] / 10;
  EXPECT_NEAR(at.state().v[1][2], share * FourBarPose(kPi / 3).omega3, 1e-9);
  EXPECT_NEAR(at.state().v[2][2], share * FourBarPose(kPi / 3).omega4, 1e-9);
}

TEST(Assembly, UnstatedVelocitiesFollowTheCrankInFull) {
  Model model = four_bar_at();
  for (const int i : {1, 2}) {
    model.bodies[i].velocity.reset();
    model.bodies[i].spin.reset();
  }
  const Assembled at(model);
  EXPECT_NEAR(at.state().v[0][2], 10, 1e-6);
  EXPECT_NEAR(at.state().v[1][2], FourBarPose(kPi / 3).omega3, 1e-6);
  EXPECT_NEAR(at.state().v[2][2], FourBarPose(kPi / 3).omega4, 1e-6);
}

TEST(Assembly, ADriveGivesTheVelocities) {
  Model model = four_bar_at();
  for (Body& b : model.bodies) {
    b.velocity.reset();
    b.spin.reset();
  }
  model.motors = {sample::motor("M", "O2", MotorKind::kSpeed, Expression::constant(7))};
  model.motors[0].stiffness = 1e8;
  model.motors[0].damping = 1e3;
  const Assembled at(model);
  EXPECT_NEAR(at.state().v[0][2], 7, 1e-9);
  EXPECT_NEAR(at.state().v[2][2], 0.7 * FourBarPose(kPi / 3).omega4, 1e-9);
}

TEST(Assembly, ARawStartIsTakenAsStated) {
  Model model = four_bar_at();
  Random random(7);
  knock(model, random, 1e-4);
  model.simulate.start = Start::kRaw;
  model.bodies[1].velocity = Vec2{1, 2};
  const Assembled at(model);
  for (std::size_t i = 0; i < 3; ++i) {
    const Body& b = model.bodies[i];
    EXPECT_EQ(at.state().q[i], Planar::Vec((*b.position)[0], (*b.position)[1], *b.angle));
    EXPECT_EQ(at.state().v[i], Planar::Vec((*b.velocity)[0], (*b.velocity)[1], *b.spin));
  }
  for (int j = 0; j < 4; ++j) EXPECT_LT((at.state().force[j] - respond(at.system().joints[j].law, at.kinematics(j).gap, at.kinematics(j).rate).force).norm(), 1e-9);
}

// Horizontal and at rest: a quarter of the weight, upwards.
TEST(StartForces, PendulumCarriesAQuarterOfItsWeight) {
  for (const double k : {1e6, 1e8, 1e12}) {
    const Assembled at(sample::pendulum(k, 3000));
    EXPECT_NEAR(at.world_force(0).x(), 0, 50 / k + 1e-7) << k;
    EXPECT_NEAR(at.world_force(0).y(), 9.81 / 4, 50 / k + 1e-7) << k;
    EXPECT_NEAR(at.state().a[0][2], -1.5 * 9.81, 300 / k + 1e-6) << k;
    EXPECT_LT((at.kinematics(0).gap - at.state().gap[0]).head<2>().norm(), 1e-15);
  }
}

// Ideal joints, crank at 60 degrees and 10 rad/s: from the one-coordinate form with 30 digits, checked against
// multipliers to 1e-12 N.
constexpr double kIdeal[4][2] = {{-439.9043451218468, -420.9514120063343},
                                 {-414.9050833784453, -377.64971558446655},
                                 {-135.2791778125028, -68.54711731888109},
                                 {-44.34968077983344, -67.34869525923321}};

TEST(StartForces, FourBarCarriesTheIdealReactions) {
  for (const double k : {1e7, 1e8, 1e10, 1e12}) {
    const Assembled at(sample::four_bar(k, 3000));
    for (int j = 0; j < 4; ++j)
      EXPECT_LT((at.world_force(j) - Planar::Point(kIdeal[j][0], kIdeal[j][1])).norm(), 2e7 / k + 1e-5) << k << " " << at.system().joints[j].name;
  }
}

// M a = Q + G' f with the state's own values, and gap'' = G a + the convective term.
TEST(StartForces, StateIsBalanced) {
  for (const Start start : {Start::kAssembled, Start::kUnloaded, Start::kRaw}) {
    Model model = sample::four_bar(1e8, 3000);
    model.gravity = {0, -9.81};
    model.simulate.start = start;
    const Assembled at(model);
    const State& s = at.state();
    const DenseEquations e(at.system(), 0, s.q, s.v);
    Eigen::VectorXd f(e.G.rows()), a(9), accel(e.G.rows());
    for (int r = 0; r < f.size(); ++r) {
      f[r] = s.force[e.rows[r].first][e.rows[r].second];
      accel[r] = s.gap_accel[e.rows[r].first][e.rows[r].second];
    }
    for (int b = 0; b < 3; ++b) a.segment<3>(3 * b) = s.a[b];
    EXPECT_LT((e.mass.cwiseProduct(a) - e.Q - e.G.transpose() * f).norm(), 1e-9);
    EXPECT_LT((e.G * a + e.bias - accel).norm(), 1e-9);
  }
}

// Started on the joints' slow motion and with every vibration resolved, the forces (of 600 N) stay within 0.05 N of
// those of ideal joints: nothing rings.
TEST(SlowManifold, AStartOnItDoesNotRing) {
  const Model model = sample::four_bar(1e8, 3000);
  Assembled at(model);
  State start = at.state();
  move_onto_slow_manifold(at.system(), all_fast(at.system()), 2e-3, start);
  Dopri5 stepper(at.system(), 1e-8);
  stepper.start(start, 1e-6);
  double largest = 0;
  while (stepper.state().t < 5e-3) {
    ASSERT_TRUE(stepper.step(5e-3));
    const State& s = stepper.state();
    const DenseEquations e(at.system(), s.t, s.q, s.v);
    const Eigen::VectorXd ideal = e.reactions();
    for (int r = 0; r < ideal.size(); ++r) largest = std::max(largest, std::abs(s.force[e.rows[r].first][e.rows[r].second] - ideal[r]));
  }
  EXPECT_LT(largest, 0.05);
}

}  // namespace
}  // namespace pintle
