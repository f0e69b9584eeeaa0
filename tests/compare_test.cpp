// Compliant joints compared with ideal ones, and how stiff they have to be.
#include "pintle/compare.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "pintle/simulate.h"
#include "pintle/stiffen.h"
#include "results/studies/compare_report.h"
#include "tests/reference_tables.h"

namespace pintle {
namespace {

TEST(Compare, DigitsAreSignificantFigures) {
  EXPECT_EQ(agreeing_digits(0.5), 0);
  EXPECT_EQ(agreeing_digits(5e-5), 4);
  EXPECT_EQ(agreeing_digits(5.1e-5), 3);
  EXPECT_EQ(agreeing_digits(0), 15);
  EXPECT_EQ(agreeing_digits(std::nan("")), 0);
}

TEST(Compare, DifferenceOfStiffJointsIsPhysicalAndGoesAsTheCompliance) {
  const Comparison one = compare(reference::mechanism("four_bar", {"simulate.tolerance=1e-7"}), Equations::kIdeal);
  Model stiffer = reference::mechanism("four_bar", {"simulate.tolerance=1e-7"});
  reference::set_joints(stiffer, 1e9, 1e4);
  const Comparison ten = compare(stiffer, Equations::kIdeal);
  ASSERT_EQ(one.forces.size(), 4u);
  EXPECT_NE(compare_text(one, "").find("it comes from joint compliance and goes as 1 / stiffness"), std::string::npos);
  for (std::size_t j = 0; j < 4; ++j) {
    EXPECT_EQ(one.forces[j].cause, Cause::kPhysical) << one.forces[j].name;
    EXPECT_NEAR(one.forces[j].largest / ten.forces[j].largest, 10, 0.5) << one.forces[j].name;
    EXPECT_GE(one.forces[j].rms, 0);
    EXPECT_LE(one.forces[j].rms, one.forces[j].largest);
  }
}

TEST(Compare, DifferenceWithinTheErrorsIsNumerical) {
  Model model = reference::mechanism("four_bar", {"simulate.tolerance=1e-4"});
  reference::set_joints(model, 1e12, 3e5);
  const Comparison c = compare(model, Equations::kIdeal);
  for (const Difference& force : c.forces) EXPECT_EQ(force.cause, Cause::kNumerical) << force.name;
  const std::string text = compare_text(c, "");
  EXPECT_NE(text.find("numerical: within the error estimates"), std::string::npos);
  EXPECT_EQ(text.find("it comes from joint compliance"), std::string::npos);
}

// Couples have errors of their own [N*m]; a body that stands still is measured by those that move.
TEST(Compare, CouplesAreJudgedByTheirOwnErrors) {
  const Model model = reference::mechanism("slider_crank", {"simulate.tolerance=1e-6", "simulate.duration=0.1"});
  const Comparison c = compare(model, Equations::kIdeal);
  ASSERT_FALSE(c.couples.empty());
  for (const Difference& couple : c.couples) {
    double stated = 0;
    for (const Trajectory* run : {&c.first, &c.second})
      for (const LoadSummary& joint : run->joints)
        if (joint.name == couple.name) stated += joint.moment_error_estimate;
    EXPECT_EQ(couple.error_estimate, stated) << couple.name;
  }
  for (const Difference& coordinate : c.coordinates) EXPECT_GE(coordinate.digits, 2) << coordinate.name;
}

// Rows that only one of the runs has are left out, whichever run it is.
TEST(Compare, RunsAreComparedWhereBothHaveRows) {
  const auto run = [](const char* step) { return simulate(reference::mechanism("four_bar", {"simulate.duration=0.12 s", std::string("simulate.output_step=") + step})); };
  const Model model = reference::mechanism("four_bar");
  for (const auto& [first, second] : {std::pair{"20 ms", "30 ms"}, {"30 ms", "20 ms"}, {"20 ms", "20 ms"}})
    for (const Difference& force : compare(model, run(first), run(second), Equations::kNewtonian).forces) {
      EXPECT_LT(force.largest, 1e-3 * force.peak) << first << " " << second;
      EXPECT_GT(force.peak, 0);
    }
}

TEST(Compare, NamesTheSoftJoint) {
  const Comparison c = compare(reference::mechanism("four_bar", {"joint.B.stiffness=1e6"}), Equations::kIdeal);
  EXPECT_EQ(c.softness.front().joint, "B");
  EXPECT_GT(c.softness.front().share, 0.5);
}

TEST(Compare, RedundantReactionsAreNotUnique) {
  const Comparison c = compare(reference::mechanism("five_bar_parallelogram", {"simulate.duration=0.2"}), Equations::kIdeal);
  for (const Difference& force : c.forces) EXPECT_EQ(force.cause, Cause::kNotUnique) << force.name;
}

// By hand: the middle crank, too long by e, and the two outer ones act as springs (two pins of stiffness k in series each) on a stiff coupler: the middle one
// is compressed with k e / 3, the outer ones pulled with half of that.
TEST(Compare, CompliantJointsShareTheLoadOfAMisfit) {
  Model model = reference::mechanism("five_bar_parallelogram");
  reference::set_joints(model, 1e9, 3e4);
  const Trajectory run = simulate(model);
  const double squeeze = 1e9 * 10e-6 / 3;
  // Along the middle crank; the coupler's inertia, shared equally, is 15.8 N.
  const double c = std::cos(reference::value(run, 0, "body.crank2.angle")), s = std::sin(reference::value(run, 0, "body.crank2.angle"));
  const auto along = [&](const std::string& joint) {
    return c * reference::value(run, 0, "joint." + joint + ".on_coupler.fx[world]") + s * reference::value(run, 0, "joint." + joint + ".on_coupler.fy[world]");
  };
  const double inertia = -6 * 0.2 * std::pow(2 * std::numbers::pi, 2) / 3;
  EXPECT_NEAR(along("A2"), squeeze + inertia, 1e-3 * squeeze);
  EXPECT_NEAR(along("A1"), -squeeze / 2 + inertia, 1e-3 * squeeze);
  EXPECT_NEAR(along("A3"), -squeeze / 2 + inertia, 1e-3 * squeeze);
}

double peak_of(const Trajectory& run, const std::string& joint) {
  for (const LoadSummary& load : run.joints)
    if (load.name == joint) return load.peak;
  throw std::logic_error("no joint " + joint);
}

TEST(Stiffen, FindsTheFourBarsStiffnessAndItsLimit) {
  const Model model = reference::mechanism("four_bar");
  const Stiffening s = stiffen(model, {});
  ASSERT_TRUE(s.found) << s.reason;
  Model ideal = model;
  ideal.simulate.equations = Equations::kIdeal;
  ideal.simulate.tolerance = 1e-8;
  const Trajectory exact = simulate(ideal);
  for (const StiffenLimit& limit : s.limits) {
    const double peak = peak_of(exact, limit.name), of_run = std::abs(limit.peak - peak);
    EXPECT_LT(of_run, 0.5e-4 * peak) << limit.name;
    EXPECT_LE(std::abs(limit.limit - peak), limit.error) << limit.name;
    EXPECT_LT(limit.error, 1e-6 * peak) << limit.name;
    EXPECT_GE(limit.error, s.steps.back().error_estimate * limit.peak) << limit.name;
  }
  // With the stiffness recommended for each joint the digits agree with ideal joints.
  const Comparison c = compare(stiffened(model, s.joints), Equations::kIdeal);
  for (const Difference& force : c.forces) EXPECT_GE(force.digits, 4) << force.name;
}

// Where friction holds, the position of rest is one of many, and each stiffness leads to another.
TEST(Stiffen, NamesJointsThatFrictionHolds) {
  StiffenRequest request;
  request.digits = 3;
  const Stiffening s = stiffen(reference::test_model("scissor_table_that_sticks"), request);
  EXPECT_FALSE(s.found);
  EXPECT_NE(s.reason.find("friction holds M, bl, cyl at the end"), std::string::npos) << s.reason;
}

// The limit is two decades below the stiffest run's own difference, where the runs' errors are smaller still.
TEST(Stiffen, TheLimitIsTwoDigitsBetterThanTheStiffestRun) {
  StiffenRequest request;
  request.digits = 8;
  request.last = 1e9;
  request.damping_ratio = 0.3;
  const Model model = reference::mechanism("four_bar", {"simulate.tolerance=1e-9"});
  const Stiffening s = stiffen(model, request);
  EXPECT_FALSE(s.found);
  EXPECT_FALSE(s.reason.empty());
  Model ideal = model;
  ideal.simulate.equations = Equations::kIdeal;
  const Trajectory exact = simulate(ideal);
  for (const StiffenLimit& limit : s.limits) {
    const double peak = peak_of(exact, limit.name);
    EXPECT_LT(std::abs(limit.limit - peak), 1e-2 * std::abs(limit.peak - peak)) << limit.name;
  }
}

TEST(Stiffen, ASoftJointDecidesForItself) {
  const Stiffening s = stiffen(reference::mechanism("four_bar", {"joint.B.stiffness=2e5"}), {});
  EXPECT_NE(s.reason.find("B: its own flexibility matters"), std::string::npos) << s.reason;
  EXPECT_TRUE(s.joints[2].kept);
  EXPECT_GT(s.kept_influence, 1e-3);
}

TEST(Stiffen, AMisfitHasNoLimit) {
  const Stiffening s = stiffen(reference::mechanism("five_bar_parallelogram", {"simulate.duration=0.1"}), {});
  EXPECT_FALSE(s.found);
  EXPECT_NE(s.reason.find("misfit"), std::string::npos) << s.reason;
  ASSERT_FALSE(s.notes.empty());
  EXPECT_NE(s.notes.front().find("redundant"), std::string::npos);
}

TEST(Stiffen, AnUnknownJointIsRefused) {
  StiffenRequest request;
  request.joints = {"O5"};
  EXPECT_THROW(stiffen(reference::mechanism("four_bar"), request), InputError);
}

// Beyond the horizon two runs of a chaotic motion have no peaks in common, and nothing physical follows from that.
TEST(Compare, ChaoticMotionsAreComparedUpToTheirHorizon) {
  const auto pendulum = [](double tolerance) {
    Model model = reference::mechanism("double_pendulum", {"simulate.record=[\"all\"]"});
    model.simulate.tolerance = tolerance;
    return model;
  };
  const Trajectory first = simulate(pendulum(1e-5)), second = simulate(pendulum(2e-5));
  ASSERT_EQ(first.outcome, Outcome::kHorizon);
  const Comparison c = compare(pendulum(1e-5), first, second, Equations::kNewtonian);
  EXPECT_EQ(c.until, std::min(first.growth.horizon, second.growth.horizon));
  for (const Difference& force : c.forces) {
    EXPECT_LE(force.largest_time, c.until);
    EXPECT_EQ(force.cause, Cause::kNumerical) << force.name << " by " << force.largest << " N, stated " << force.error_estimate;
  }
  const Variants side_by_side = compare({{"one", first}, {"other", second}});
  for (const VariantJoint& joint : side_by_side.joints) EXPECT_EQ(joint.loads[1].cause, Cause::kChaotic) << joint.joint;
}

// A motor of the wrong sign feeds every run of the sequence in the same way: their digits agree.
TEST(Stiffen, RunawaysAndChaosHaveNoLimit) {
  const Stiffening runaway = stiffen(parse_model(R"toml(
format = 1
[simulate]
duration = "5 s"
[ground.markers]
o = [0, 0]
[body.rod]
mass = 2
inertia = 0.2
angle = 0
spin = 1
markers.o = [0, 0]
[joint.o]
type = "revolute"
between = ["ground.o", "rod.o"]
[motor.m]
joint = "o"
torque = "50 N*m*s/rad*rate"
)toml",
                                                 "runaway.toml"),
                                     {});
  EXPECT_FALSE(runaway.found) << runaway.reason;
}

}  // namespace
}  // namespace pintle
