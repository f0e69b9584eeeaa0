// Penalties and the augmented Lagrangian on whole mechanisms: published motions, a closed form, redundancy.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "pintle/compare.h"
#include "tests/reference_tables.h"

namespace pintle {
namespace {

using reference::value;

nlohmann::json published(const std::string& name) {
  std::ifstream file(std::string(PINTLE_SOURCE_DIR) + "/bench/published/" + name + ".json");
  return nlohmann::json::parse(file);
}

struct Way {
  const char* equations;
  const char* method;
};
constexpr Way kWays[] = {{"penalty", "dopri5"}, {"penalty", "trapezoidal"}, {"augmented_lagrangian", "trapezoidal"}, {"augmented_lagrangian", "hht"}, {"relative_augmented_lagrangian", "trapezoidal"}, {"relative_augmented_lagrangian", "hht"}};

std::vector<std::string> by(const Way& way, std::vector<std::string> more) {
  more.push_back(std::string("simulate.equations=") + way.equations);
  more.push_back(std::string("simulate.method=") + way.method);
  return more;
}

// A01, half of its 10 s: motion, energy (the library's is zero), and the rod's tension m (v^2 - g y)/L.
TEST(SlowPublishedPenalty, PendulumIsThatOfTheLibrary) {
  const nlohmann::json known = published("iftomm_a01");
  for (const Way& way : kWays) {
    std::vector<std::string> settings{"simulate.tolerance=1e-2", "simulate.max_step=0.5e-3", "simulate.duration=5"};
    if (way.equations == std::string("penalty")) settings.push_back("simulate.penalty_frequency=100");
    const Model model = read_model(std::string(PINTLE_SOURCE_DIR) + "/bench/published/simple_pendulum.toml", by(way, settings));
    const Trajectory run = simulate(model);
    ASSERT_EQ(run.outcome, Outcome::kCompleted) << way.method << run.message;
    for (const auto& at : known["published"]["rows"]) {
      if (at[0].get<double>() > 5) continue;
      const std::size_t row = reference::row_at(run, at[0]);
      EXPECT_NEAR(value(run, row, "body.mass.x"), at[1].get<double>(), 5e-5) << way.method;
      EXPECT_NEAR(value(run, row, "body.mass.y"), at[2].get<double>(), 5e-5) << way.method;
    }
    for (std::size_t row = 0; row < run.n_rows(); ++row) {
      const double x = value(run, row, "body.mass.x"), y = value(run, row, "body.mass.y"), vx = value(run, row, "body.mass.vx"), vy = value(run, row, "body.mass.vy");
      const double tension = vx * vx + vy * vy - 9.81 * y;
      EXPECT_LT(std::abs(value(run, row, "energy.kinetic") + value(run, row, "energy.potential")), 5e-5) << way.method;
      EXPECT_LT(reference::force_error(run, row, "rod.on_mass", -tension * x, -tension * y), 5e-5) << way.method << run.at(row, 0);
    }
  }
}

// A02 with N = 2 through six of its singular positions, to the library's class of high precision.
TEST(SlowPublishedPenalty, NFourBarKeepsItsBranch) {
  const nlohmann::json known = published("iftomm_a02");
  for (const Way& way : kWays) {
    std::vector<std::string> settings{"simulate.tolerance=1e-2", "simulate.max_step=1e-3", "simulate.duration=3"};
    if (way.equations == std::string("penalty") && way.method == std::string("trapezoidal")) continue;  // in ALONE
    if (way.equations == std::string("penalty")) settings.push_back("simulate.penalty_frequency=300");
    const Trajectory run = simulate(reference::mechanism("n_four_bar_2", by(way, settings)));
    ASSERT_NE(run.outcome, Outcome::kFailed) << way.method << run.message;
    for (const auto& at : known["exact_2"]["rows"]) {
      if (at[0].get<double>() > 3) continue;
      const std::size_t row = reference::row_at(run, std::round(20 * at[0].get<double>()) / 20);
      EXPECT_NEAR(2 * value(run, row, "body.crank0.x"), at[1].get<double>(), 1e-3) << way.method;
      EXPECT_NEAR(2 * value(run, row, "body.crank0.y"), at[2].get<double>(), 1e-3) << way.method;
    }
    for (std::size_t row = 0; row < run.n_rows(); ++row)
      EXPECT_NEAR(value(run, row, "energy.kinetic") + value(run, row, "energy.potential"), value(run, 0, "energy.kinetic") + value(run, 0, "energy.potential"), 0.05) << way.method;
  }
}

// The methods end a step at the jump, at 0.4003 s, which lies beside the grid of what they look at beforehand. All passes made the same error there.
TEST(PenaltyRuns, JumpsOfLoadsAreNotSteppedOver) {
  const Trajectory ideal = simulate(reference::test_model("torque_that_jumps", {"simulate.equations=\"ideal\""}));
  ASSERT_EQ(ideal.outcome, Outcome::kCompleted) << ideal.message;
  for (const Way& way : kWays) {
    const Trajectory run = simulate(reference::test_model("torque_that_jumps", by(way, {"simulate.tolerance=1e-4"})));
    ASSERT_EQ(run.outcome, Outcome::kCompleted) << way.method << run.message;
    EXPECT_NEAR(run.joints[0].peak, ideal.joints[0].peak, 1e-4 * ideal.joints[0].peak) << way.equations << way.method;
  }
}

// A uniform rod along u that has fallen from the horizontal carries 5/2 of the part of its weight along u, and 1/4 of the part across.
TEST(PenaltyRuns, PendulumHasTheReactionsOfTheClosedForm) {
  for (const Way& way : kWays) {
    const Model model = reference::mechanism("pendulum", by(way, {"simulate.duration=2", "simulate.tolerance=1e-4"}));
    const double wx = model.bodies[0].mass * model.gravity[0], wy = model.bodies[0].mass * model.gravity[1];
    const Trajectory run = simulate(model);
    ASSERT_EQ(run.outcome, Outcome::kCompleted) << way.method << run.message;
    double worst = 0;
    for (std::size_t row = 0; row < run.n_rows(); ++row) {
      const double angle = value(run, row, "body.rod.angle"), ux = std::cos(angle), uy = std::sin(angle), along = wx * ux + wy * uy;
      worst = std::max(worst, reference::force_error(run, row, "pin.on_rod", -0.25 * wx - 2.25 * along * ux, -0.25 * wy - 2.25 * along * uy));
    }
    EXPECT_LT(worst, 1e-4 * run.joints[0].peak) << way.equations << " " << way.method;
  }
}

// The violation of constraints is reported for penalties, which alone violate them.
TEST(PenaltyRuns, TellHowFarConstraintsAreViolated) {
  const auto notes = [](const char* equations, const char* method) {
    std::string all;
    for (const std::string& note : simulate(reference::mechanism("four_bar", by({equations, method}, {"simulate.duration=0.05", "simulate.tolerance=1e-2"}))).notes) all += note + '\n';
    return all;
  };
  EXPECT_NE(notes("penalty", "dopri5").find("penalties: the constraints of ideal joints are violated by at most"), std::string::npos) << notes("penalty", "dopri5");
  EXPECT_EQ(notes("ideal", "dopri5").find("violated"), std::string::npos);
}

// The parallelogram's bars carry their coupler together; the constraints do not determine how they share it.
TEST(PenaltyRuns, RedundantJointsHaveFiniteForces) {
  const auto run_of = [](std::vector<std::string> settings) {
    settings.insert(settings.end(), {"simulate.duration=0.1", "parameters.error=0"});
    Model model = reference::mechanism("five_bar_parallelogram", settings);
    model.motors.clear();
    return simulate(model);
  };
  const Trajectory ideal = run_of({"simulate.equations=ideal"});
  for (const Way& way : kWays) {
    const Trajectory run = run_of(by(way, {"simulate.tolerance=1e-4"}));
    ASSERT_EQ(run.outcome, Outcome::kCompleted) << way.method << run.message;
    for (const LoadSummary& joint : run.joints) EXPECT_FALSE(joint.unique) << joint.name;
    ASSERT_EQ(run.n_rows(), ideal.n_rows());
    for (std::size_t row = 0; row < run.n_rows(); ++row)
      for (const char* axis : {"fx[world]", "fy[world]"}) {
        double sum = 0, expected = 0;
        for (const char* joint : {"A1", "A2", "A3"})
          for (const LoadSummary& load : run.joints)
            if (load.name == joint) {
              const std::string column = std::string("joint.") + joint + ".on_" + load.second_body + "." + axis;
              sum += value(run, row, column);
              expected += value(ideal, row, column);
            }
        EXPECT_NEAR(sum, expected, 1e-4 * run.joints[1].peak) << way.method << axis;
      }
  }
}

TEST(PenaltyRuns, AreComparedWithCompliantJoints) {
  const Model model = reference::mechanism("four_bar", {"simulate.tolerance=1e-4"});
  for (const Equations against : {Equations::kPenalty, Equations::kAugmentedLagrangian, Equations::kRelativeAugmented}) {
    const Comparison c = compare(model, against);
    ASSERT_EQ(c.second.outcome, Outcome::kCompleted) << c.second.message;
    ASSERT_FALSE(c.forces.empty());
    for (const Difference& force : c.forces) EXPECT_LT(force.relative, 1e-3) << force.name;
  }
}

// A rigid mechanism cannot follow a jump, with whatever equations it is kept closed.
TEST(PenaltyRuns, TargetsThatJumpAreRefused) {
  for (const Equations equations : {Equations::kIdeal, Equations::kPenalty, Equations::kAugmentedLagrangian, Equations::kRelativeAugmented})
    for (const char* motor : {"motor.m.position=\"0.5*t + 0.3*step(t-0.6)\"", "motor.m.position=\"0.5*t + 0.3*max(t-0.6, 0)\""}) {
      Model model = reference::test_model("crank_rocker_jump", {motor});
      model.simulate.equations = equations;
      const Trajectory run = simulate(model);
      EXPECT_EQ(run.outcome, Outcome::kFailed) << to_word(equations) << run.message;
      EXPECT_NE(run.message.find("motor m is to"), std::string::npos) << to_word(equations) << run.message;
      EXPECT_NEAR(run.t_end, 0.6, 0.01) << to_word(equations);
    }
}

// At a change point a penalty may leave the branch, and the augmented Lagrangian's reactions have peaks that no tolerance finds: neither is "completed". Ideal joints
// go on along the smooth branch, where the crank keeps its speed: 1 kg at 0.15 m and 2 kg at 0.3 m of each crank's end shared by both.
TEST(PenaltyRuns, WrongForcesAtChangePointsAreNotCompleted) {
  const auto run_as = [](Equations equations) {
    Model model = reference::test_model("parallelogram_ideal");
    model.simulate.equations = equations;
    return simulate(model);
  };
  const Trajectory ideal = run_as(Equations::kIdeal);
  ASSERT_EQ(ideal.outcome, Outcome::kCompleted) << ideal.message;
  EXPECT_NEAR(ideal.joints[0].peak, 36 * (0.15 + 0.3), 1e-3);
  EXPECT_EQ(run_as(Equations::kPenalty).outcome, Outcome::kEnergyOpen);
  EXPECT_EQ(run_as(Equations::kAugmentedLagrangian).outcome, Outcome::kToleranceNotMet);
}

}  // namespace
}  // namespace pintle
