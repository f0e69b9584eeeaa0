// Jumps that drive the motion back from both sides: dry friction at rest, against closed forms, on free bodies and trees.
#include "integrators/radau/sliding_mode.h"

#include <gtest/gtest.h>

#include <cmath>

#include "integrators/methods.h"
#include "integrators/start_states_for_tests.h"

namespace pintle {
namespace {

using sample::expression;

constexpr double kBlockTolerance = 1e-6, kBlockMass = 2, kFriction = 3;

// A block in a guide with dry friction; `drive` is a further push, an expression of t and slide.
Model sticking_block(const std::string& drive) {
  Model model;
  model.ground = {{"O", {0, 0}, 0}};
  model.bodies = {sample::body("block", kBlockMass, 0.1, {{"C", {0, 0}, 0}})};
  sample::put_at(model.bodies[0], 1.5, 0, 0);
  model.joints = {sample::joint("guide", "prismatic", {"ground", "O"}, {"block", "C"}, 1e8, 3000)};
  model.motors = {sample::motor("friction", "guide", MotorKind::kEffort, expression("if(rate > 0, -3, 3)", {"rate"})),
                  sample::motor("drive", "guide", MotorKind::kEffort, expression(drive, {"t", "slide"}))};
  return model;
}

double friction_of(const System& system, const State& state) {
  std::vector<Planar::Motion> m;
  system.motions(state.q, state.v, m);
  for (const LoadData& load : system.loads)
    if (load.name == "friction") return system.load_effort(load, state.t, m, state.sliding);
  return std::nan("");
}

// Every method that steps to kinks, from the model's state to `end`; calls `look` at each step.
template <class Look>
void follow_all(Model model, double end, std::uint64_t most_steps, const Look& look) {
  for (const bool tree : {false, true})
    for (const int stages : {3, 5}) {
      model.joints[0].ideal = tree;
      model.simulate.equations = tree ? Equations::kRelative : Equations::kNewtonian;
      const System system = build_system(model);
      MethodChoice choice;
      choice.equations = model.simulate.equations;
      choice.method = "radau";
      choice.stages = stages;
      const auto stepper = make_stepper(system, choice, kBlockTolerance);
      stepper->start(tree ? sample::plain_start(model, system) : sample::loaded_start(model, system), 1e-4);
      while (stepper->state().t < end) {
        ASSERT_TRUE(stepper->step(end)) << stepper->failure();
        look(system, stepper->state());
      }
      EXPECT_LE(stepper->counters().steps, most_steps) << tree << " " << stages;
    }
}

// On a spring of 50 N/m the turning points move inwards by 0.12 m each half period, until friction holds the spring: at 0.02 m.
TEST(SlidingModes, ABlockComesToRestOffItsSpringsLength) {
  const double rest = 4 * std::numbers::pi / 5;
  follow_all(sticking_block("50*(1 - slide)"), 6, 250, [&](const System& system, const State& s) {
    if (s.t < rest + 1e-3) return;
    EXPECT_NEAR(s.q[0][0], 1.02, 5 * kBlockTolerance) << s.t;
    EXPECT_NEAR(s.v[0][0], 0, 5 * kBlockTolerance) << s.t;
    EXPECT_NEAR(friction_of(system, s), 1, 300 * kBlockTolerance) << s.t;
  });
}

// At rest until a growing push is stronger than the friction, at 0.3 s; then m x'' = 10 t - 3.
TEST(SlidingModes, ABlockSticksUntilItIsPushedHardEnough) {
  const double loose = kFriction / 10;
  follow_all(sticking_block("10*t + 0*slide"), 1, 150, [&](const System& system, const State& s) {
    const double x = s.t < loose ? 0 : 10 / (6 * kBlockMass) * std::pow(s.t - loose, 3);
    EXPECT_NEAR(s.q[0][0], 1.5 + x, 10 * kBlockTolerance) << s.t;
    const bool near_a_change = s.t < 1e-3 || std::abs(s.t - loose) < 1e-3;
    const double friction = s.t < loose ? -10 * s.t : -kFriction;
    if (!near_a_change) {
      EXPECT_NEAR(friction_of(system, s), friction, 20 * kBlockTolerance) << s.t;
    }
  });
}

// A jump that only reverses the force is crossed, not held.
TEST(SlidingModes, AJumpThatLetsThroughIsNotSlidOn) {
  Model model = sticking_block("20 + 0*t*slide");
  follow_all(model, 0.5, 100, [&](const System&, const State& s) {
    EXPECT_TRUE(s.sliding.empty());
    EXPECT_NEAR(s.q[0][0], 1.5 + 0.5 * 17 / kBlockMass * s.t * s.t, 10 * kBlockTolerance);
  });
}

}  // namespace
}  // namespace pintle
