// Tables in whole mechanisms: work of a gas over a cycle, run-up along a motor's curve, a lift that a servo follows, a stop.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "base/constants.h"
#include "base/tables/table_function.h"
#include "io/reading/file_columns.h"
#include "results/disk.h"
#include "tests/reference_tables.h"

namespace pintle {
namespace {

const MotorSummary& motor_of(const Trajectory& run, const std::string& name) {
  return *std::find_if(run.motors.begin(), run.motors.end(), [&](const MotorSummary& motor) { return motor.name == name; });
}

// The engine of the collection, turned at constant speed.
Model motored_engine(Equations equations, const std::string& interpolation) {
  Model model = reference::mechanism("engine", {"table.pressure.interpolation=" + interpolation, "simulate.duration=40 ms"});
  for (Motor& motor : model.motors)
    if (motor.name == "brake") motor = {"brake", "O", MotorKind::kSpeed, Expression::constant(3000 * kTurn / 60)};
  model.simulate.equations = equations;
  model.simulate.tolerance = 1e-6;
  return model;
}

// The integral of p dV over one cycle of two turns, from the file itself: Simpson's rule on straight pieces of the pressure.
double indicated_work() {
  const std::string file = "gas_pressure.csv";
  const FileColumns found = read_file_columns(file, read_file(std::string(PINTLE_SOURCE_DIR) + "/mechanisms/" + file), {ColumnChoice{"", 1}, ColumnChoice{"", 2}});
  const std::vector<double>&angle = found.columns[0].numbers, &pressure = found.columns[1].numbers;
  const double crank = 0.043, rod = 0.145, area = std::numbers::pi * 0.086 * 0.086 / 4;
  const auto volume_rate = [&](double degrees) {
    const double at = degrees * kTurn / 360, s = crank * std::sin(at), c = crank * std::cos(at);
    return area * (s + s * c / std::sqrt(rod * rod - s * s)) * kTurn / 360;
  };
  double work = 0;
  for (std::size_t i = 1; i < angle.size(); ++i) {
    const double width = angle[i] - angle[i - 1], middle = angle[i - 1] + width / 2;
    work += width / 6 * 1e5 * (pressure[i - 1] * volume_rate(angle[i - 1]) + 2 * (pressure[i - 1] + pressure[i]) * volume_rate(middle) + pressure[i] * volume_rate(angle[i]));
  }
  return work;
}

TEST(Tables, TheGasOfAnEngineDoesItsIndicatedWorkInACycle) {
  const double work = indicated_work();
  EXPECT_NEAR(work, 387.4, 0.1);
  const Trajectory ideal = simulate(motored_engine(Equations::kIdeal, "linear"));
  ASSERT_EQ(ideal.outcome, Outcome::kCompleted) << ideal.message;
  EXPECT_NEAR(motor_of(ideal, "gas").work, work, 1e-5 * work);
  Model model = motored_engine(Equations::kNewtonian, "linear");
  reference::set_joints(model, 2e10, 3e4);
  const Trajectory stiff = simulate(model);
  ASSERT_EQ(stiff.outcome, Outcome::kCompleted) << stiff.message;
  EXPECT_NEAR(motor_of(stiff, "gas").work, work, 1e-4 * work);  // joints deflect by a micrometre
  EXPECT_GT(stiff.counters.events, 200U);                       // one at each point at which the slope changes, in each pass
  EXPECT_LT(std::abs(stiff.energy.drift), 1e-5 * stiff.energy.kinetic_peak);
  const Trajectory smooth = simulate(motored_engine(Equations::kIdeal, "spline"));
  ASSERT_EQ(smooth.outcome, Outcome::kCompleted) << smooth.message;
  EXPECT_NEAR(motor_of(smooth, "gas").work, work, 1e-3 * work);
  EXPECT_EQ(smooth.counters.events, 0U);
}

// A disc on a pin, a motor whose torque is a table of the speed, and a load that grows with the speed.
Model run_up(Equations equations, const std::string& method) {
  Model model = parse_model(R"toml(
format = 1
name = "Run-up"
gravity = [0, 0]
[table.curve]
x = [0, 100, 150]
x_unit = "rad/s"
y = [10, 8, 0]
y_unit = "N*m"
[simulate]
duration = "4 s"
output_step = "10 ms"
tolerance = 1e-7
[ground.markers]
O = [0, 0]
[body.disc]
mass = "1 kg"
inertia = "0.05 kg*m^2"
position = [0, 0]
angle = 0
spin = 0
markers.O = [0, 0]
[joint.O]
type = "revolute"
between = ["ground.O", "disc.O"]
ideal = true
[motor.M]
joint = "O"
torque = "curve(rate) - 0.05 N*m*s/rad*rate"
)toml",
                            "run_up.toml");
  model.simulate.equations = equations;
  model.simulate.method = method;
  if (equations == Equations::kNewtonian) model.joints[0].ideal = false;
  return model;
}

// J w' = 10 - 0.02 w - 0.05 w below 100 rad/s, 24 - 0.16 w - 0.05 w above; it tends to 24/0.21.
double speed_at(double t) {
  const double J = 0.05, low = 10 / 0.07, high = 24 / 0.21, change = -J / 0.07 * std::log(1 - 100 / low);
  return t < change ? low * (1 - std::exp(-0.07 * t / J)) : high + (100 - high) * std::exp(-0.21 * (t - change) / J);
}

// The curvature of a monotone table jumps at its points: steps end at points that are few and far apart, and pass over points that are many and close together.
TEST(Tables, StepsEndWhereTheCurvatureJumpsByMuch) {
  for (const double tolerance : {1e-4, 1e-5, 1e-6}) {
    Model model = reference::test_model("force_by_four_points");
    model.simulate.tolerance = tolerance;
    const Trajectory run = simulate(model);
    EXPECT_EQ(run.outcome, Outcome::kCompleted) << tolerance << ": " << run.message;
    EXPECT_LT(run.counters.steps, 350u) << tolerance;  // two thirds of them follow the vibrations that kinks leave in the pin: 4e-4 N of 15 N
    for (std::size_t i = 0; i < run.n_rows(); ++i) {
      const double t = run.at(i, 0) - 1, s = t - 1;
      if (t < 1 || t > 2) continue;  // not between the turning points
      EXPECT_NEAR(reference::value(run, i, "joint.pin.on_block.fx[world]"), -(10 + 3 - 2 * s * s * (3 - 2 * s)), 15 * tolerance) << t;
    }
  }
  std::vector<double> x, y;
  for (int i = 0; i <= 400; ++i) {
    x.push_back(i / 40.0);
    y.push_back(std::sin(3 * x.back()));
  }
  EXPECT_FALSE(TableFunction(x, y, TableInterpolation::kMonotone, TableOutside::kExtend).has_kinks());
}

TEST(Tables, AMotorRunsUpAlongItsCurve) {
  struct Case {
    Equations equations;
    const char* method;
    double tolerance;  // relative, of the speed; the pin carries no force, so that only steps that end at the knee are accurate to the last bits
  };
  for (const Case& c : {Case{Equations::kNewtonian, "auto", 1e-7}, {Equations::kRelative, "auto", 1e-7}, {Equations::kRelative, "dopri5", 1e-4}, {Equations::kIdeal, "auto", 1e-6}, {Equations::kNewtonian, "ode15s", 1e-4}}) {
    const Trajectory run = simulate(run_up(c.equations, c.method));
    ASSERT_EQ(run.outcome, Outcome::kCompleted) << run.message;
    const auto spin = static_cast<std::size_t>(run.column("body.disc.spin"));
    for (std::size_t i = 0; i < run.n_rows(); ++i) EXPECT_NEAR(run.at(i, spin), speed_at(run.at(i, 0)), c.tolerance * 114) << c.method << " t = " << run.at(i, 0);
    EXPECT_NEAR(run.at(run.n_rows() - 1, spin), 24 / 0.21, 0.01);
  }
}

// A servo without compliance carries a mass along a lift: its effort is mass times the second derivative of the spline.
TEST(Tables, AServoFollowsASplineWithItsAcceleration) {
  const std::vector<double> angle{0, 60, 120, 180, 240, 300}, lift{0, 0, 8, 12, 8, 0};
  Model model = parse_model(R"toml(
format = 1
name = "Lift"
gravity = [0, 0]
[table.lift]
x = [0, 60, 120, 180, 240, 300]
x_unit = "deg"
y = [0, 0, 8, 12, 8, 0]
y_unit = "mm"
period = 360
interpolation = "spline"
[simulate]
duration = "0.3 s"
output_step = "1 ms"
tolerance = 1e-7
equations = "ideal"
[ground.markers]
O = [0, 0]
[body.valve]
mass = "0.2 kg"
inertia = "1e-4 kg*m^2"
position = [0, 0]
angle = 0
markers.O = [0, 0]
[joint.guide]
type = "prismatic"
between = ["ground.O", "valve.O"]
[motor.cam]
joint = "guide"
position = "lift(40 rad/s*t)"
)toml",
                            "lift.toml");
  const Trajectory run = simulate(model);
  ASSERT_EQ(run.outcome, Outcome::kCompleted) << run.message;
  std::vector<double> x, y;
  for (std::size_t i = 0; i < angle.size(); ++i) {
    x.push_back(angle[i] * kTurn / 360);
    y.push_back(1e-3 * lift[i]);
  }
  const TableFunction exact(x, y, TableInterpolation::kSpline, TableOutside::kHold, kTurn);
  const auto effort = static_cast<std::size_t>(run.column("motor.cam.effort")), slide = static_cast<std::size_t>(run.column("joint.guide.slide"));
  for (std::size_t i = 0; i < run.n_rows(); ++i) {
    const double t = run.at(i, 0);
    EXPECT_NEAR(run.at(i, slide), exact.value(40 * t), 1e-9) << t;
    EXPECT_NEAR(run.at(i, effort), 0.2 * 1600 * exact.at(40 * t).second, 1e-3) << t;
  }
}

// A mass between two springs given by a table: its motion is known on the soft part and on the hard part.
TEST(Tables, AMassSwingsOnASpringWithAKnee) {
  const Model model = parse_model(R"toml(
format = 1
name = "Knee"
gravity = [0, 0]
[table.spring]
x = [-2, -1, 1, 2]
y = [-5, -1, 1, 5]
y_unit = "N"
x_unit = "m"
outside = "extend"
[simulate]
duration = "12 s"
output_step = "10 ms"
tolerance = 1e-6
[ground.markers]
O = [0, 0]
[body.mass]
mass = "1 kg"
inertia = "1 kg*m^2"
position = [0, 0]
angle = 0
velocity = ["2 m/s", 0]
markers.O = [0, 0]
[joint.guide]
type = "prismatic"
between = ["ground.O", "mass.O"]
[motor.spring]
joint = "guide"
force = "-spring(slide)"
)toml",
                                  "knee.toml");
  const Trajectory run = simulate(model);
  ASSERT_EQ(run.outcome, Outcome::kCompleted) << run.message;
  // To the knee: x = 2 sin t. Beyond it, x = 3/4 + 1/4 cos(2 s) + sqrt(3)/2 sin(2 s), from slope 4: the speed at the knee is sqrt(3).
  const double knee = std::asin(0.5), half = std::atan2(std::sqrt(3.0) / 2, 0.25), period = 4 * knee + 2 * half;
  const auto exact = [&](double t) {
    t = std::fmod(t, period);
    const double sign = t > period / 2 ? -1 : 1;
    if (t > period / 2) t -= period / 2;
    if (t > period / 4) t = period / 2 - t;
    return sign * (t < knee ? 2 * std::sin(t) : 0.75 + 0.25 * std::cos(2 * (t - knee)) + std::sqrt(3.0) / 2 * std::sin(2 * (t - knee)));
  };
  const auto x = static_cast<std::size_t>(run.column("body.mass.x"));
  for (std::size_t i = 0; i < run.n_rows(); ++i) EXPECT_NEAR(run.at(i, x), exact(run.at(i, 0)), 2e-5) << run.at(i, 0);
  EXPECT_GE(run.counters.events, 4U);
}

}  // namespace
}  // namespace pintle
