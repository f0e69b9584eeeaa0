// The estimated loss of a joint's free vibration agrees with the true one, from steps that resolve the vibration to steps that do not.
#include "run/errors/ringing_loss.h"

#include <gtest/gtest.h>

#include <cmath>

#include "integrators/absolute/radau_stepper.h"
#include "integrators/start_states_for_tests.h"

namespace pintle {
namespace {

constexpr double kStiffness = 1e6, kFrequency = 1000;  // of a rod of 1 kg along its axis [N/m], [1/s]
constexpr double kAmplitude = 1;                       // [N]

struct Loss {
  double true_one, said;  // [N]
};

// The rod starts with its pin stretched; `n` steps are taken.
Loss loss_of_ringing(int stages, double angle_per_step, double damping, int n) {
  Model model = sample::pendulum(kStiffness, damping, 0);
  sample::put_at(model.bodies[0], 0.5 + kAmplitude / kStiffness, 0, 0);
  const System system = build_system(model);
  const State start = sample::plain_start(model, system);
  BasicRingingLoss<Planar> ringing(system, start);
  RadauStepper stepper(system, 1e-4, stages);
  const double h = angle_per_step / kFrequency;
  stepper.start(start, h);
  for (int i = 0; i < n; ++i) {
    EXPECT_TRUE(stepper.trial(h));
    ringing.see_step(stepper.nodes(), h);
  }
  const State& end = stepper.state();
  const double left = kStiffness * std::hypot(end.gap[0][0], end.gap_rate[0][0] / kFrequency);
  const double exact = kAmplitude * std::exp(-0.5 * damping * n * h);
  return {exact - left, ringing.force(0)};
}

TEST(RingingLoss, IsWhatStepsTakeOffAVibration) {
  for (const int stages : {3, 5})
    for (const double angle : {1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 20.0}) {
      const Loss loss = loss_of_ringing(stages, angle, 0, 40);
      if (loss.true_one < 1e-9) continue;  // rounding
      const double least = angle > 6 ? 0.2 : 0.33;  // if unresolved, it depends on the phase at which the step begins
      EXPECT_GT(loss.said, least * loss.true_one) << stages << " stages, " << angle;
      EXPECT_LT(loss.said, 2 * loss.true_one) << stages << " stages, " << angle;
    }
}

// A step that spans many periods loses all of it; the estimate does not rise further however many steps follow.
TEST(RingingLoss, IsNeverMoreThanThereWas) {
  for (const int stages : {3, 5}) {
    const Loss loss = loss_of_ringing(stages, 1000, 0, 30);
    EXPECT_NEAR(loss.true_one, kAmplitude, 1e-3);
    EXPECT_NEAR(loss.said, kAmplitude, 0.1 * kAmplitude);
  }
}

// What the joint itself has damped by the end of the step does not count as lost.
TEST(RingingLoss, LeavesOutWhatTheJointDamps) {
  const Loss loss = loss_of_ringing(5, 20, 1000, 1);  // exp(-10)
  EXPECT_LT(loss.said, 1e-4 * kAmplitude);
}

}  // namespace
}  // namespace pintle
