// A compressor on soft joints: at the top its gas force is larger on the way up than on the way down, since the soft joints have kept the piston from coming
// all the way, and so the piston is held there for a while. Compared with the explicit method, which is given a ramp in the model itself.
#include <gtest/gtest.h>

#include "system/sample_systems_for_tests.h"
#include "tests/reference_tables.h"

namespace pintle {
namespace {

constexpr double kRampWidth = 1e-3;  // [m/s]: a part in 2000 of the piston's speed

Model soft_compressor() {
  Model model = reference::mechanism("slider_crank", {"body.crank.spin=60 rad/s"});
  reference::set_joints(model, 1e6, 500);
  model.simulate.duration = 0.05;
  model.simulate.output_step = 5e-4;
  return model;
}

Motor& gas_of(Model& model) {
  return *std::find_if(model.motors.begin(), model.motors.end(), [](const Motor& motor) { return motor.name == "gas"; });
}

// The model's own numbers, with a ramp from the force of the way down to that of the way up in place of the jump at rate 0.
Expression gas_with_ramp() {
  const std::string area = "0.0028274333882308137", ceiling = "0.133", in = "1e5", out = "7e5";
  const std::string up = "min(" + out + ", " + in + "*(0.065/(" + ceiling + " - slide))^1.3)";
  const std::string down = "max(" + in + ", " + out + "*(0.005/(" + ceiling + " - slide))^1.3)";
  const std::string share = "min(1, max(0, 0.5 + rate/" + std::to_string(kRampWidth) + "))";
  return sample::expression("-" + area + "*(" + down + " + " + share + "*(" + up + " - " + down + ") - " + in + ")", {"slide", "rate"});
}

// At every row, to a fraction `share` of the largest peak.
void expect_same_forces(const Trajectory& run, const Trajectory& other, double share) {
  ASSERT_EQ(run.n_rows(), other.n_rows());
  double peak = 0;
  for (const LoadSummary& joint : run.joints) peak = std::max(peak, joint.peak);
  for (std::size_t c = 0; c < run.columns.size(); ++c) {
    const std::string& name = run.columns[c].name;
    if (!name.starts_with("joint.") || !name.ends_with("[world]")) continue;
    double difference = 0;
    for (std::size_t i = 0; i < run.n_rows(); ++i) difference = std::max(difference, std::abs(run.at(i, c) - other.at(i, c)));
    EXPECT_LT(difference, share * peak) << name << ", share " << share;
  }
}

TEST(HeldGasForce, ASoftCompressorRunsThroughItsDeadCentre) {
  Model model = soft_compressor();
  const Trajectory held = simulate(model);
  ASSERT_EQ(held.outcome, Outcome::kCompleted) << held.message;
  gas_of(model).law = gas_with_ramp();
  model.simulate.method = "dopri5";
  const Trajectory ramp = simulate(model);
  ASSERT_EQ(ramp.outcome, Outcome::kCompleted) << ramp.message;
  expect_same_forces(held, ramp, kRampWidth);
}

// While the piston is held, forces keep the tolerance, also at the ends of steps of any length.
TEST(HeldGasForce, EveryToleranceIsMetInAFewPasses) {
  Model model = soft_compressor();
  model.simulate.tolerance = 1e-6;
  const Trajectory fine = simulate(model);
  ASSERT_EQ(fine.outcome, Outcome::kCompleted) << fine.message;
  for (const double tolerance : {1e-3, 3e-4, 1e-4, 3e-5, 1e-5}) {
    model.simulate.tolerance = tolerance;
    const Trajectory run = simulate(model);
    EXPECT_EQ(run.outcome, Outcome::kCompleted) << tolerance << ": " << run.message;
    EXPECT_LE(run.counters.passes, 6) << tolerance;  // the lag of the ramp counts in full
    for (std::size_t j = 0; j < run.joints.size(); ++j) EXPECT_NEAR(run.joints[j].peak, fine.joints[j].peak, tolerance * fine.joints[j].peak) << tolerance;
    expect_same_forces(fine, run, tolerance);
  }
}

// The energy account includes the effort of a motor that is held.
TEST(HeldGasForce, TheAccountCloses) {
  const Trajectory run = simulate(soft_compressor());
  ASSERT_EQ(run.outcome, Outcome::kCompleted) << run.message;
  EXPECT_LT(std::abs(run.energy.drift), 1e-5 * run.energy.kinetic_peak);
}

// A ramp that widened with 1/tolerance for the roundoff of velocities would let a shaper's ram creep where it is held: the smaller the tolerance, the further.
// The lag of the ramp is stated, and where finer passes do not make it small enough the run says so.
TEST(HeldGasForce, AHeldRamStaysWhereItIsAtATightTolerance) {
  const auto run = [](double tolerance) {
    Model model = reference::test_model("shaper_on_stiff_joints");
    model.simulate.tolerance = tolerance;
    return simulate(model);
  };
  const Trajectory loose = run(1e-4), tight = run(1e-6);
  EXPECT_EQ(loose.outcome, Outcome::kCompleted) << loose.message;
  EXPECT_EQ(tight.outcome, Outcome::kToleranceNotMet);
  EXPECT_NE(tight.message.find("motor cut keeps switching"), std::string::npos) << tight.message;
  EXPECT_LT(tight.counters.steps, 20000u);
  for (std::size_t j = 0; j < loose.joints.size(); ++j) EXPECT_NEAR(tight.joints[j].peak, loose.joints[j].peak, 1e-4 * loose.joints[j].peak) << loose.joints[j].name;
  const std::string column = "joint.O4.on_arm.fx[world]";
  const auto c = static_cast<std::size_t>(loose.column(column));
  double apart = 0;
  for (std::size_t row = 0; row < loose.n_rows(); ++row) apart = std::max(apart, std::abs(loose.at(row, c) - tight.at(row, c)));
  const auto stated = [](const Trajectory& of) {
    return std::find_if(of.joints.begin(), of.joints.end(), [](const LoadSummary& joint) { return joint.name == "O4"; })->error_estimate;
  };
  EXPECT_GT(apart, 0);
  EXPECT_LT(apart, stated(loose) + stated(tight));
}

// A bang-bang controller whose pin rings while it slides. The force at 0.2832 s, 21.928 N, is that of two integrations of the same pin written for this test. One solves for the
// torque that keeps the switching function at zero, by A. F. Filippov's definition, with steps of 0.4 and 0.2 us; the other switches at every step.
TEST(HeldGasForce, WhatARelayLagsBehindIsStated) {
  for (const double tolerance : {1e-2, 1e-3, 1e-5}) {
    Model model = reference::test_model("relay_on_a_ringing_pin");
    model.simulate.tolerance = tolerance;
    const Trajectory run = simulate(model);
    const LoadSummary& pin = run.joints.at(0);
    const double force = run.at(run.n_rows() - 29, static_cast<std::size_t>(run.column("joint.J.on_arm.fx[world]"))), error = std::abs(force - 21.928);
    ASSERT_NEAR(run.at(run.n_rows() - 29, 0), 0.2832, 1e-9);
    EXPECT_EQ(run.outcome, error < tolerance * pin.peak && tolerance > 1e-4 ? Outcome::kCompleted : Outcome::kToleranceNotMet) << tolerance << ": " << run.message;
    EXPECT_LT(error, 2 * pin.error_estimate) << tolerance;
  }
}

// A bang-bang governor reaches its speed and holds it: where the crank turns at exactly the speed of the comparison, `rate < 25 rad/s` is false. Once that point counted as
// neither side, and the torque switched on and off in the last bits.
TEST(HeldGasForce, AGovernorHoldsItsSpeed) {
  std::vector<double> peaks;
  for (const double tolerance : {1e-3, 1e-4, 1e-5}) {
    Model model = reference::test_model("governed_pump");
    model.simulate.tolerance = tolerance;
    const Trajectory run = simulate(model);
    EXPECT_EQ(run.outcome, Outcome::kCompleted) << tolerance << ": " << run.message;
    EXPECT_LT(run.counters.steps, 8000u) << tolerance;
    EXPECT_NEAR(reference::at_end(run, "body.crank.spin"), 25, 0.02) << tolerance;
    peaks.push_back(run.joints.at(0).peak);
  }
  EXPECT_NEAR(peaks[0], peaks[2], 1e-3 * peaks[2]);
  EXPECT_NEAR(peaks[1], peaks[2], 1e-4 * peaks[2]);
}

// The curves of steps across the reversal lead to it too early, always by the same part of the step: attempts that start from the usual step never arrive.
TEST(HeldGasForce, AirMotorReverses) {
  Model model = reference::test_model("air_motor");
  for (const double tolerance : {1e-3, 1e-4}) {
    model.simulate.tolerance = tolerance;
    const Trajectory run = reference::completed(model);
    EXPECT_LT(run.counters.steps, 80000u) << tolerance;
    const LoadSummary& pin = run.joints.at(1);
    EXPECT_NEAR(pin.peak, 19204.5783, pin.error_estimate) << tolerance;  // at a tolerance of 1e-7, which states an error of 5e-5 N
  }
}

}  // namespace
}  // namespace pintle
