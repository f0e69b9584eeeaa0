// Equations over a tree of ideal joints, compared with those of free bodies with a stiff law in every joint, and with exact solutions.
#include <gtest/gtest.h>

#include <algorithm>
#include <complex>

#include "system/sample_systems_for_tests.h"
#include "tests/reference_tables.h"

namespace pintle {
namespace {

using reference::completed;
using reference::mechanism;
using reference::value;

Model over_tree(Model model, const std::vector<std::string>& ideal) {
  model.simulate.equations = Equations::kRelative;
  for (Joint& joint : model.joints)
    for (const std::string& name : ideal) joint.ideal = joint.ideal || joint.name == name;
  return model;
}

std::vector<std::string> all_but(const Model& model, const std::string& opened) {
  std::vector<std::string> names;
  for (const Joint& joint : model.joints)
    if (joint.name != opened) names.push_back(joint.name);
  return names;
}

/// Largest differences of two runs with the same rows: of the bodies' columns, and of each joint's force and moment relative to its peak (at least a thousandth
/// of the largest joint's).
struct LargestDifferences {
  double bodies = 0, forces = 0;
};
LargestDifferences compare_runs(const Trajectory& a, const Trajectory& b) {
  LargestDifferences out;
  EXPECT_EQ(a.n_rows(), b.n_rows());
  double largest = 0;
  for (const LoadSummary& joint : a.joints) largest = std::max(largest, joint.peak);
  for (std::size_t c = 0; c < a.columns.size(); ++c) {
    const std::string& name = a.columns[c].name;
    double difference = 0, peak = 0;
    for (std::size_t i = 0; i < std::min(a.n_rows(), b.n_rows()); ++i) {
      difference = std::max(difference, std::abs(a.at(i, c) - b.at(i, c)));
      peak = std::max(peak, std::abs(a.at(i, c)));
    }
    if (name.starts_with("body.")) out.bodies = std::max(out.bodies, difference / std::max(1.0, peak));
    if (!name.starts_with("joint.") || !name.ends_with("[world]")) continue;
    for (const LoadSummary& joint : a.joints) {
      if (!name.starts_with("joint." + joint.name + ".")) continue;
      const double size = name.ends_with(".m[world]") ? peak : joint.peak;
      out.forces = std::max(out.forces, difference / std::max(size, 1e-3 * largest));
    }
  }
  return out;
}

Model stiff(const std::string& name, double k, double c, double angular_k = 0, double angular_c = 0) {
  Model model = mechanism(name);
  reference::set_joints(model, k, c);
  for (Joint& joint : model.joints) {
    if (joint.law.values.contains("angular_stiffness") && angular_k > 0) {
      joint.law.values["angular_stiffness"] = {angular_k};
      joint.law.values["angular_damping"] = {angular_c};
    }
  }
  return model;
}

// Free bodies deflect by f/k at each of their joints, 1e-8 m at 1e11 N/m: the two cannot agree more closely than that.
TEST(RelativeFourBar, WhicheverJointIsOpenedMotionAndForcesAreThoseOfFreeBodies) {
  Model model = stiff("four_bar", 1e11, 3000 * std::sqrt(1e3));
  model.simulate.tolerance = 1e-8;
  const Trajectory free = completed(model);
  for (const Joint& opened : model.joints) {
    const Trajectory run = completed(over_tree(model, all_but(model, opened.name)));
    const LargestDifferences d = compare_runs(free, run);
    EXPECT_LT(d.bodies, 3e-8) << opened.name;
    EXPECT_LT(d.forces, 1e-7) << opened.name;
    EXPECT_LT(run.energy.drift, 1e-12 * run.energy.kinetic_peak) << opened.name;
  }
}

// The remaining difference is the other joints' compliance: it is proportional to 1/k.
TEST(RelativeFourBar, TheDifferenceFromFreeBodiesGoesWithTheirCompliance) {
  std::vector<LargestDifferences> differences;
  for (const double k : {1e9, 1e10}) {
    Model model = stiff("four_bar", k, 3000 * std::sqrt(k / 1e8));
    model.simulate.tolerance = 1e-8;
    differences.push_back(compare_runs(completed(model), completed(over_tree(model, all_but(model, "B")))));
  }
  EXPECT_NEAR(differences[0].bodies / differences[1].bodies, 10, 1);
  EXPECT_NEAR(differences[0].forces / differences[1].forces, 10, 1);
}

TEST(RelativeFourBar, ForcesAreThoseOfIdealJoints) {
  Model model = over_tree(stiff("four_bar", 1e12, 1e5), {"O2", "A", "O4"});
  model.simulate.tolerance = 1e-8;
  const Trajectory run = completed(model);
  const reference::Table ideal = reference::read_table("four_bar");
  for (const auto& [column, x, y] : {std::array{"O2.on_crank", "F12x", "F12y"}, std::array{"A.on_coupler", "F23x", "F23y"},
                                     std::array{"B.on_follower", "F34x", "F34y"}, std::array{"O4.on_follower", "F14x", "F14y"}})
    for (std::size_t i = 0; i < ideal.rows.size(); ++i) {
      const std::size_t row = reference::row_at(run, ideal.at(i, "t"));
      EXPECT_LT(reference::force_error(run, row, column, ideal.at(i, x), ideal.at(i, y)), 1e-7 * ideal.peak(x, y)) << column << " " << i;
    }
}

TEST(RelativeFourBar, WithoutIdealJointsTheEquationsAreThoseOfFreeBodies) {
  Model model = mechanism("four_bar");
  model.simulate.tolerance = 1e-8;
  const LargestDifferences d = compare_runs(completed(model), completed(over_tree(model, {})));
  EXPECT_LT(d.bodies, 1e-9);
  EXPECT_LT(d.forces, 1e-8);
}

TEST(RelativeFourBar, ALoopOfIdealJointsIsOpenedAndTheNotesSayWhere) {
  const Model model = mechanism("four_bar");
  const Trajectory one = completed(over_tree(model, {"O2", "A", "O4"})), all = completed(over_tree(model, all_but(model, "")));
  const LargestDifferences d = compare_runs(one, all);
  EXPECT_EQ(d.bodies, 0);
  EXPECT_EQ(d.forces, 0);
  const auto noted = [&all](const std::string& line) { return std::find(all.notes.begin(), all.notes.end(), line) != all.notes.end(); };
  EXPECT_TRUE(noted("joint B is opened: it closes a loop with the ideal joints A, O2, O4; its force law acts"));
  EXPECT_TRUE(noted("joints eliminated by relative coordinates: O2, O4, A; 3 coordinates"));
}

// Its force law acts, so that what its spring stores belongs to the energy account, and the run does not depend on whether the model calls it ideal.
TEST(RelativeFourBar, AnOpenedJointKeepsTheEnergyOfItsLaw) {
  const Model model = stiff("four_bar", 2e5, 100);
  const Trajectory one = completed(over_tree(model, {"O2", "A", "O4"})), all = completed(over_tree(model, all_but(model, "")));
  EXPECT_EQ(compare_runs(one, all).forces, 0);
  EXPECT_EQ(all.energy.drift, one.energy.drift);
  EXPECT_LT(reference::drift(all), 1e-6);
}

// Pins whose misfit hardly any motion of the tree changes: their load is the misfit times the stiffness of the one that is not ideal, and the arm stays where it is.
TEST(RelativeArm, RedundantPinsStartWithTheLoadOfTheirMisfit) {
  for (const double misfit : {0.0, 1e-5, 3e-5, 1e-4}) {
    Model model = reference::test_model("arm_of_pinned_plates");
    Marker& hole = model.bodies[1].markers[1];
    ASSERT_EQ(hole.name, "Q");
    hole.position[0] = -0.3 + misfit;
    const Trajectory run = completed(model);
    EXPECT_NEAR(value(run, 0, "body.a.angle"), 0, 1e-5) << misfit;
    EXPECT_NEAR(value(run, 0, "body.b.angle"), 0, 1e-5) << misfit;
    EXPECT_NEAR(std::abs(value(run, 0, "joint.Q.on_b.fx[world]")), 5e7 * misfit, 0.05) << misfit;
    EXPECT_LT(reference::drift(run), 1e-6) << misfit;
  }
}

// Coupler and follower at rest while the crank turns: ideal joints share out the momentum at once, the opened one keeps its law. Its damping dissipates what
// the free bodies' joints do, and both settle on the same motion.
TEST(RelativeFourBar, AnInconsistentStartSettlesOnTheMotionOfFreeBodies) {
  Model model = sample::four_bar(1e10, 3e4);
  for (const int i : {1, 2}) {
    model.bodies[i].velocity = Vec2{0, 0};
    model.bodies[i].spin = 0;
  }
  model.simulate.start = Start::kRaw;
  model.simulate.duration = 0.5;
  model.simulate.tolerance = 1e-6;
  const Trajectory free = completed(model), run = completed(over_tree(model, {"O2", "A", "O4"}));
  const std::size_t last = free.n_rows() - 1;
  EXPECT_NEAR(value(run, last, "body.crank.spin"), value(free, last, "body.crank.spin"), 1e-7);
  EXPECT_NEAR(value(run, last, "body.follower.spin"), value(free, last, "body.follower.spin"), 1e-6);
  EXPECT_LT(run.energy.drift, 1e-6 * run.energy.kinetic_peak);
}

std::uint64_t steps(const Model& model) { return reference::reported_pass(model).steps; }

TEST(RelativeFourBar, StepsAreAboutThoseOfFreeBodies) {
  for (const double k : {1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12}) {
    const Model model = stiff("four_bar", k, 3000 * std::sqrt(k / 1e8));
    const double free = static_cast<double>(steps(model));
    for (const char* opened : {"O2", "A", "B", "O4"}) {
      const double now = static_cast<double>(steps(over_tree(model, all_but(model, opened))));
      EXPECT_LE(now, 2 * free) << opened << " " << k;
      RecordProperty(std::string(opened) + " of " + std::to_string(static_cast<int>(free)), static_cast<int>(now));
    }
  }
}

// Softer joints, so that the explicit method does not need too many steps.
TEST(RelativeFourBar, ImplicitAndExplicitMethodAgree) {
  Model model = over_tree(stiff("four_bar", 1e6, 300), {"O2", "A", "O4"});
  model.simulate.tolerance = 1e-7;
  const Trajectory implicit = completed(model);
  model.simulate.method = "dopri5";
  const LargestDifferences d = compare_runs(implicit, completed(model));
  EXPECT_LT(d.bodies, 1e-7);
  EXPECT_LT(d.forces, 1e-6);
}

class RelativePendulum : public ::testing::TestWithParam<const char*> {};

TEST_P(RelativePendulum, AngleAndForceAreExactWithAnIdealPin) {
  Model model = over_tree(mechanism("pendulum"), {"pin"});
  model.simulate.tolerance = 1e-9;
  model.simulate.method = GetParam();
  const Trajectory run = completed(model);
  const reference::Table exact = reference::read_table("pendulum");
  for (std::size_t i = 0; i < exact.rows.size(); ++i) {
    const std::size_t row = reference::row_at(run, exact.at(i, "t"));
    EXPECT_NEAR(value(run, row, "body.rod.angle"), exact.at(i, "theta"), 1e-8);
    EXPECT_NEAR(value(run, row, "body.rod.spin"), exact.at(i, "omega"), 1e-8 * exact.peak("omega"));
    EXPECT_LT(reference::force_error(run, row, "pin.on_rod", exact.at(i, "Fx"), exact.at(i, "Fy")), 1e-8 * exact.peak("Fx", "Fy"));
  }
  EXPECT_LT(run.energy.drift, 1e-8 * run.energy.kinetic_peak);
}

INSTANTIATE_TEST_SUITE_P(BothMethods, RelativePendulum, ::testing::Values("radau", "dopri5"));

// Its servos are soft, and a start on their slow motion is known to fewer digits than the run keeps: both start from one state.
TEST(RelativeRobotArm, AnOpenChainMovesAndLoadsAsFreeBodies) {
  Model model = stiff("robot_arm", 1e11, 1e5, 1e9, 1e4);
  const State start = start_of_run(model).state;
  const auto run = [&](const Model& of) {
    std::vector<std::string> notes;
    const System on = fix_assembled_values(of, build_system(of), start.q, notes);
    IntegrationPlan plan;
    plan.duration = 1.8;
    plan.output_step = 0.01;
    plan.tolerance = 1e-8;
    plan.first_step = 1e-4;
    plan.choice = {of.simulate.equations, "radau", 5};
    Recorder recorder(of, on);
    EXPECT_EQ(integrate(on, start, plan, recorder).ended, Ended::kAtEnd);
    Trajectory out;
    recorder.fill(out);
    out.values.erase(out.values.begin(), out.values.begin() + static_cast<long>(out.columns.size()));  // the start itself
    return out;
  };
  const Model tree = over_tree(model, {"shoulder", "elbow", "wrist", "grip"});
  const LargestDifferences d = compare_runs(run(model), run(tree));
  EXPECT_LT(d.bodies, 1e-6);
  EXPECT_LT(d.forces, 1e-6);
}

TEST(RelativeSliderCrank, WhicheverJointIsOpenedMotionAndForcesAreThoseOfFreeBodies) {
  Model model = stiff("slider_crank", 1e11, 1e6, 1e9, 1e3);
  model.simulate.duration = 0.03;
  model.simulate.tolerance = 1e-7;
  const Trajectory free = completed(model);
  for (const Joint& opened : model.joints) {
    const Trajectory run = completed(over_tree(model, all_but(model, opened.name)));
    const LargestDifferences d = compare_runs(free, run);
    EXPECT_LT(d.bodies, 1e-6) << opened.name;
    EXPECT_LT(d.forces, 1e-6) << opened.name;
    EXPECT_LT(run.energy.drift, 1e-6 * run.energy.kinetic_peak) << opened.name;
  }
}

TEST(RelativeInvertedSliderCrank, WhicheverJointIsOpenedMotionAndForcesAreThoseOfFreeBodies) {
  Model model = stiff("inverted_slider_crank", 1e11, 1e5, 1e9, 1e3);
  model.simulate.tolerance = 1e-7;
  const Trajectory free = completed(model);
  for (const Joint& opened : model.joints) {
    const Trajectory run = completed(over_tree(model, all_but(model, opened.name)));
    const LargestDifferences d = compare_runs(free, run);
    EXPECT_LT(d.bodies, 1e-6) << opened.name;
    EXPECT_LT(d.forces, 1e-6) << opened.name;
    EXPECT_LT(run.energy.drift, 1e-9 * run.energy.kinetic_peak) << opened.name;
  }
}

// Two bars swing into a rope, from which they bounce several times.
TEST(RelativeRope, AnOpenedRopePullsAndHangsLooseAsBetweenFreeBodies) {
  Model model = sample::pendulum(1e11, 1e6);
  model.bodies[0].markers.push_back({"A", {0.5, 0}, 0});
  model.bodies.push_back(sample::body("second", 1, 0.1, {{"A", {-0.4, 0}, 0}, {"T", {0.4, 0}, 0}}));
  sample::put_at(model.bodies[1], 1.4, 0, 0);
  for (Body& body : model.bodies) {
    body.velocity = Vec2{0, 0};
    body.spin = 0;
  }
  model.ground.push_back({"H", {0.6, 1}, 0});
  model.joints.push_back(sample::joint("A", "revolute", {"rod", "A"}, {"second", "A"}, 1e11, 1e6));
  model.joints.push_back(sample::joint("rope", "rope", {"ground", "H"}, {"second", "T"}, 1e6, 500));
  model.joints.back().geometry = {{"length", 1.6}};
  model.simulate.duration = 0.3;
  model.simulate.start = Start::kRaw;
  model.simulate.tolerance = 1e-6;
  const Trajectory free = completed(model), run = completed(over_tree(model, {"pin", "A"}));
  bool taut = false, loose = false;
  for (std::size_t i = 0; i < run.n_rows(); ++i) (value(run, i, "joint.rope.on_second.f1[joint]") != 0 ? taut : loose) = true;
  EXPECT_TRUE(taut && loose);
  const LargestDifferences d = compare_runs(free, run);
  EXPECT_LT(d.bodies, 1e-5);
}

// The wheels are to turn to and fro, and the belt's spans to carry what that needs from the first instant on: 8.0403 N*m at the motor, where 8 would do for rigid spans. Without them
// the motor was off by 0.5 % of its peak, and the belt rang.
TEST(RelativeBelt, StartsOnTheSlowMotionOfItsSpans) {
  const Model model = reference::test_model("wheels_turned_to_and_fro");
  Model stiff = model;
  stiff.simulate.equations = Equations::kNewtonian;
  const Trajectory run = completed(model), free = completed(stiff);
  const std::complex<double> s(0, 20), span = 2.0 * (2e4 + 40.0 * s), second = 0.1 * 0.2 * span / (0.04 * s * s + 0.2 * 0.2 * span);  // of the angle of the first wheel, -cos(20 t)
  EXPECT_NEAR(value(run, 0, "motor.m.effort"), -(0.01 * s * s + 0.1 * span * (0.1 - 0.2 * second)).real(), 2e-4);
  EXPECT_NEAR(value(run, 0, "body.b.spin"), -(s * second).real(), 2e-6);
  for (const double t : {0.0, 0.001, 0.01, 0.1}) {
    const std::size_t row = reference::row_at(run, t);
    EXPECT_NEAR(value(run, row, "motor.m.effort"), value(free, row, "motor.m.effort"), 1e-3) << t;
  }
}

TEST(RelativeRope, ARopeMarkedIdealIsOpenedAndRuns) {
  Model model = over_tree(mechanism("rope_pendulum"), {"rope", "rod"});
  model.simulate.duration = 0.5;
  const Trajectory run = completed(model);
  EXPECT_EQ(std::count_if(run.notes.begin(), run.notes.end(), [](const std::string& line) { return line.find("is opened: a r") != std::string::npos; }), 2);
}

// The closed joints have no compliance: how they share the load with those that are opened depends on the order in which the model names them.
TEST(RelativeRedundancy, ReactionsOfRedundantJointsAreNotUnique) {
  Model model = reference::test_model("three_ideal_cranks");
  const auto undetermined = [](const Trajectory& run) { return std::count_if(run.joints.begin(), run.joints.end(), [](const LoadSummary& joint) { return !joint.unique; }); };
  EXPECT_EQ(undetermined(completed(model)), 0);  // compliant: shared by stiffness
  model.simulate.equations = Equations::kRelative;
  const Trajectory run = completed(model);
  EXPECT_GT(undetermined(run), 3);
  EXPECT_TRUE(std::any_of(run.notes.begin(), run.notes.end(), [](const std::string& note) { return note.find("these reactions are not") != std::string::npos; }));
}

TEST(RelativeCoordinates, StopsOfAnIdealPinAreLeftOutOfTheStartToo) {
  const Trajectory run = reference::completed(reference::test_model("ideal_pin_with_stops"));
  EXPECT_GT(run.counters.events, 0U);  // the slide reaches its stop
  EXPECT_TRUE(std::any_of(run.notes.begin(), run.notes.end(), [](const std::string& note) { return note.find("joint A is ideal: its stops are not in these equations") != std::string::npos; }));
}

// No coordinate could follow the length, and no step would see that it changes.
TEST(RelativeCoordinates, ADrivenLengthNeedsACoordinate) {
  Model model = reference::test_model("welded_plate_with_a_driven_rod");
  const Trajectory run = reference::completed(model);
  EXPECT_NEAR(run.joints.at(1).peak, 98, 0.5);  // 1e6 N/m of 0.1 mm, and a weld that yields
  model.simulate.equations = Equations::kRelative;
  EXPECT_THROW(simulate(model), AssemblyError);
}

}  // namespace
}  // namespace pintle
