// All methods by their names: they agree on the joint forces of a stiff pendulum, keep the energy account, and are refused
// where they are not available.
#include "integrators/methods.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "integrators/general/sundials_stepper.h"
#include "integrators/start_states_for_tests.h"

namespace pintle {
namespace {

MethodChoice newtonian(const std::string& method) { return {Equations::kNewtonian, method, 3}; }

std::vector<std::string> methods() {
  std::vector<std::string> list{"radau", "dopri5", "ode23t", "hht", "generalised_alpha"};
  if (has_sundials()) list.insert(list.end(), {"ode45", "ode15s", "ode113"});
  return list;
}

std::unique_ptr<Stepper> run_method(const System& system, const State& from, const std::string& method, double tolerance, double duration) {
  std::unique_ptr<Stepper> stepper = make_stepper(system, newtonian(method), tolerance);
  stepper->start(from, 1e-4 * duration);
  while (stepper->state().t < duration)
    if (!stepper->step(duration)) {
      ADD_FAILURE() << method << ": " << stepper->failure();
      break;
    }
  return stepper;
}

double energy(const System& system, const State& s) {
  std::vector<Planar::Motion> m;
  system.motions(s.q, s.v, m);
  double total = system.kinetic(s.v) + system.external_work(s.t, s.q, m).potential + s.dissipated - s.supplied;
  for (int j = 0; j < system.n_joints(); ++j) total += respond(system.joints[j].law, s.gap[j], s.gap_rate[j]).energy;
  return total;
}

// Pendulum of the paper's section 7, k = 1e6 N/m.
TEST(Methods, AgreeOnTheForcesOfAStiffPendulum) {
  const Model model = sample::pendulum(1e6, 500);
  const System system = build_system(model);
  const State from = sample::loaded_start(model, system);
  const double duration = 0.25;
  MethodChoice tight = newtonian("radau");
  tight.stages = 5;
  const auto truth = make_stepper(system, tight, 1e-10);
  truth->start(from, 1e-5);
  while (truth->state().t < duration) ASSERT_TRUE(truth->step(duration));
  for (const std::string& method : methods()) {
    const auto stepper = run_method(system, from, method, 1e-9, duration);
    EXPECT_EQ(stepper->state().t, duration);
    // Order 2 leaves an error of about 1e-6 of the state at this tolerance, the others less.
    EXPECT_LT(sample::largest_difference(stepper->state().force, truth->state().force), 1e-4) << method;
    EXPECT_LT(sample::largest_difference(stepper->state().q, truth->state().q), 2e-6) << method;
    EXPECT_NEAR(energy(system, stepper->state()), energy(system, from), 2e-5) << method;
    EXPECT_GT(stepper->counters().steps, 0U);
    EXPECT_GT(stepper->counters().evaluations, 0U);
  }
}

// With a damper and a driving force: energy supplied and dissipated is accounted for as well.
TEST(Methods, KeepTheEnergyAccountOfADrivenOscillator) {
  Model model = sample::oscillator();
  model.springs[0].damping = 1.5;
  const System system = build_system(model);
  const State from = sample::plain_start(model, system);
  for (const std::string& method : methods()) {
    if (method == "dopri5") continue;  // its account uses the trapezoidal rule over long steps
    const auto loose = run_method(system, from, method, 1e-4, 2), tight = run_method(system, from, method, 1e-8, 2);
    const double before = energy(system, from);
    EXPECT_NEAR(energy(system, tight->state()), before, 1e-4) << method;
    EXPECT_GT(std::abs(tight->state().dissipated), 1) << method;
    EXPECT_LE(std::abs(energy(system, tight->state()) - before), std::abs(energy(system, loose->state()) - before) + 1e-7) << method;
  }
}

// Smaller tolerances give smaller errors, against the closed form of the driven oscillator.
TEST(Methods, ErrorsFollowTheTolerance) {
  const Model model = sample::oscillator();
  const System system = build_system(model);
  for (const std::string& method : methods()) {
    double last = 1e9;
    for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
      const auto stepper = run_method(system, sample::plain_start(model, system), method, tolerance, 2);
      const double error = std::abs(stepper->state().q[0][0] - sample::oscillator_at(2)[0]);
      EXPECT_LT(error, last) << method << " at " << tolerance;
      EXPECT_LT(error, 2000 * tolerance) << method;
      last = error;
    }
  }
}

// The states inside a step belong to the same motion as those at its ends.
TEST(Methods, InsideAStepTheMotionIsTheSame) {
  const Model model = sample::oscillator();
  const System system = build_system(model);
  for (const std::string& method : methods()) {
    const auto stepper = make_stepper(system, newtonian(method), 1e-9);
    stepper->start(sample::plain_start(model, system), 1e-4);
    double worst = 0;
    while (stepper->state().t < 1) {
      ASSERT_TRUE(stepper->step(1)) << method;
      const double t = 0.3 * stepper->previous().t + 0.7 * stepper->state().t;
      const State& s = stepper->interpolate(t);
      EXPECT_EQ(s.t, t);
      worst = std::max({worst, std::abs(s.q[0][0] - sample::oscillator_at(t)[0]), std::abs(s.v[0][0] - sample::oscillator_at(t)[1]) / 5});
    }
    EXPECT_LT(worst, 5e-6) << method;
  }
}

// More bodies than the dense solver takes: the sparse one gives the same result.
TEST(Methods, ManyBodiesAreNoDifferentMatter) {
  if (!has_sundials()) GTEST_SKIP() << "a build without SUNDIALS";
  Model model;
  model.ground = {{"O", {0, 0}, 0}};
  for (int i = 0; i < 12; ++i) {
    model.bodies.push_back(sample::body("link" + std::to_string(i), 1, 1.0 / 12, {{"P", {-0.5, 0}, 0}, {"Q", {0.5, 0}, 0}}));
    sample::put_at(model.bodies.back(), 0.5 + i, 0, 0);
    const std::string before = i == 0 ? "ground" : "link" + std::to_string(i - 1);
    model.joints.push_back(sample::joint("J" + std::to_string(i), "revolute", {before, i == 0 ? "O" : "Q"}, {model.bodies.back().name, "P"}, 1e4, 100));
  }
  const System system = build_system(model);
  const State from = sample::plain_start(model, system);
  const auto bdf = run_method(system, from, "ode15s", 1e-8, 0.2), erk = run_method(system, from, "ode45", 1e-9, 0.2), trapezoidal = run_method(system, from, "ode23t", 1e-9, 0.2);
  EXPECT_LT(sample::largest_difference(bdf->state().q, erk->state().q), 1e-5);
  EXPECT_LT(sample::largest_difference(trapezoidal->state().q, erk->state().q), 1e-5);
}

TEST(Methods, SayWhyTheyAreNotToBeHad) {
  const Model model = sample::pendulum(1e6, 500);
  const System system = build_system(model);
  for (const char* method : {"ode45", "ode23t", "ode15s", "ode113", "hht", "generalised_alpha"})
    for (const Equations equations : {Equations::kIdeal, Equations::kRelative}) {
      const std::string reason = why_not({equations, method, 3});
      EXPECT_NE(reason.find(method), std::string::npos);
      EXPECT_NE(reason.find("force laws"), std::string::npos);
      EXPECT_THROW(make_stepper(system, {equations, method, 3}, 1e-5), std::invalid_argument);
    }
  for (const char* method : {"ode23t", "hht", "generalised_alpha"}) EXPECT_EQ(why_not({Equations::kAugmentedLagrangian, method}), "");
  for (const char* method : {"dopri5", "ode23t", "hht", "generalised_alpha"}) EXPECT_EQ(why_not({Equations::kPenalty, method}), "");
  EXPECT_FALSE(why_not({Equations::kPenalty, "radau"}).empty());
  EXPECT_FALSE(why_not({Equations::kAugmentedLagrangian, "dopri5"}).empty());
  EXPECT_FALSE(why_not({Equations::kRelativeAugmented, "generalised_alpha"}).empty());
  EXPECT_FALSE(why_not(newtonian("euler")).empty());
  EXPECT_EQ(why_not(newtonian("hht")), "");
  EXPECT_EQ(why_not(newtonian("ode45")).find("libsundials-dev") == std::string::npos, has_sundials());
}

TEST(Methods, InSpaceThereIsRadauAlone) {
  BasicSystem<Spatial> system;
  system.finish();
  const auto refusal = [&system](const MethodChoice& choice) -> std::string {
    try {
      make_stepper(system, choice, 1e-5);
      return "";
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
  };
  EXPECT_EQ(refusal(newtonian("radau")), "");
  for (const char* method : {"dopri5", "ode45", "ode23t", "hht", "euler"}) EXPECT_EQ(refusal(newtonian(method)).find("method " + std::string(method) + " is for mechanisms of the plane"), 0u);
  for (const Equations equations : {Equations::kIdeal, Equations::kRelative}) EXPECT_NE(refusal({equations, "radau", 3}).find("set equations = \"newtonian\""), std::string::npos);
}

}  // namespace
}  // namespace pintle
