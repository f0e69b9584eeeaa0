// Belts and ropes on drums in whole runs, against closed forms.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/constants.h"
#include "pintle/check.h"
#include "tests/reference_tables.h"

namespace pintle {
namespace {

using reference::at_end;
using reference::completed;
using reference::mechanism;
using reference::value;

TEST(Belts, AtwoodsMachineFallsAsItsInertiaSays) {
  const Trajectory run = completed(mechanism("atwood"));
  const double m1 = 8, m2 = 13, r = 0.1, a = (m2 - m1) * kStandardGravity / (m1 + m2 + 0.115 / (r * r));
  for (std::size_t i = 0; i < run.n_rows(); ++i) {
    const double t = run.at(i, 0);
    EXPECT_NEAR(value(run, i, "joint.left.tension"), m1 * (kStandardGravity + a), 1e-8) << t;
    EXPECT_NEAR(value(run, i, "joint.right.tension"), m2 * (kStandardGravity - a), 1e-8) << t;
    const auto since = [&run, i](const char* column) { return value(run, i, column) - value(run, 0, column); };  // the start stretches axle and rope
    EXPECT_NEAR(since("body.heavy.y"), -0.5 * a * t * t, 1e-9) << t;
    EXPECT_NEAR(since("body.pulley.angle"), -0.5 * a * t * t / r, 1e-8) << t;
    EXPECT_NEAR(since("joint.left.run"), -0.5 * a * t * t, 1e-9) << t;
  }
}

// A motor that follows a speed over time: by theory/joints (4.7) the car rises by the integral of the speed; while the speed is constant the ropes carry the
// weights.
TEST(Belts, ALiftRisesAsFarAsItsSpeedGoes) {
  const Trajectory run = completed(mechanism("goods_lift"));
  const auto risen = [&run](double t) { return value(run, reference::row_at(run, t), "body.car.y") - value(run, 0, "body.car.y"); };
  EXPECT_NEAR(risen(1), 1.25 * 2 * (0.125 - 0.03125), 2e-3);  // of a ramp of 2 s: 2 (x^3 - x^4/2) at x = 1/2; the ropes stretch by m a/k
  EXPECT_NEAR(risen(11), 10, 1e-4);
  const std::size_t begin = reference::row_at(run, 3), end = reference::row_at(run, 8), even = reference::row_at(run, 5);
  const auto since_start = [&run, even](const char* column) { return value(run, even, column) - value(run, 0, column); };
  const auto damped = [&](std::size_t row) { return 2e3 * -(value(run, row, "body.car.vy") + 0.5 * value(run, row, "body.sheave.spin")); };
  const double pull = since_start("joint.car_rope.tension") - (damped(even) - damped(0));
  EXPECT_NEAR(risen(5), 5 - pull / 1.2e6 + 0.5 * since_start("motor.drive.effort") / 1e6, 1e-6);  // less the deflections of rope and servo
  EXPECT_NEAR(value(run, even, "body.sheave.spin"), -2.5, 1e-3);
  const auto mean = [&](const char* column) {
    double sum = 0;
    for (std::size_t row = begin; row < end; ++row) sum += value(run, row, column);
    return sum / static_cast<double>(end - begin);
  };
  EXPECT_NEAR(mean("joint.car_rope.tension"), 800 * kStandardGravity, 1);  // the ropes ring about their loads
  EXPECT_NEAR(mean("joint.weight_rope.tension"), 1000 * kStandardGravity, 1);
  EXPECT_NEAR(mean("motor.drive.effort"), 0.5 * 200 * kStandardGravity, 1);
}

// The couple of both runs on a pulley is its radius times the difference of their tensions; angles follow from the radii.
TEST(Belts, ADriveCarriesItsMomentByTheDifferenceOfItsRuns) {
  const Trajectory run = completed(mechanism("belt_drive"));
  const std::size_t last = run.n_rows() - 1;
  const double difference = at_end(run, "joint.upper.tension") - at_end(run, "joint.lower.tension"), sum = at_end(run, "joint.upper.tension") + at_end(run, "joint.lower.tension");
  EXPECT_NEAR(at_end(run, "body.shaft.spin"), 100, 0.01);  // where the characteristics of motor and fan meet; at its end the run is 2e-4 short of it
  EXPECT_NEAR(at_end(run, "body.fan.spin") / at_end(run, "body.shaft.spin"), 1.0 / 3, 1e-6);
  EXPECT_NEAR(0.15 * difference, -at_end(run, "motor.air.effort"), 1e-2);
  EXPECT_NEAR(0.05 * difference, at_end(run, "motor.drive.effort"), 1e-2);
  // 400 N each, less the deflection of the bearings: each run of the belt is shorter by as much as its ends are nearer.
  const double nearer = 2 * (sum * std::cos(std::asin(0.2))) / 1e8, stiffness = 6e4 / std::sqrt(0.24);
  EXPECT_NEAR(sum, 800 - 2 * stiffness * nearer * std::cos(std::asin(0.2)), 1e-3 * 800);
  for (const char* joint : {"upper", "lower"}) {
    const std::string p = fmt::format("joint.{}.", joint);
    const double side = std::string(joint) == "upper" ? 1 : -1;
    EXPECT_NEAR(value(run, last, p + "on_fan.m[world]"), side * 0.15 * at_end(run, p + "tension"), 1e-9);
    EXPECT_NEAR(value(run, last, p + "on_shaft.m[world]"), -side * 0.05 * at_end(run, p + "tension"), 1e-9);
  }
}

// Euler and Eytelwein: exp(mu wrap) between the runs on both sides of a post, theory/joints Eqs. (2.17), (2.18).
TEST(Belts, ARopeSlipsRoundAPostAsEulerSays) {
  const Trajectory run = completed(mechanism("bollard"));
  const double ratio = std::exp(0.2 * 3 * kPi), a = kStandardGravity * (100 - 10 * ratio) / (100 + 10 * ratio);
  for (const double t : {0.1, 0.3, 0.6}) {
    const std::size_t row = reference::row_at(run, t);
    EXPECT_NEAR(value(run, row, "joint.down.tension"), 100 * (kStandardGravity - a), 5e-5 * 780);  // the rope on the post weighs a gram
    EXPECT_NEAR(value(run, row, "joint.up.tension"), 10 * (kStandardGravity + a), 5e-5 * 780);
    EXPECT_NEAR(value(run, row, "body.load.vy"), -0.5 - a * t, 2e-4);
  }
}

TEST(Belts, CheckStatesTheirRatio) {
  const CheckReport report = check_model(mechanism("belt_drive"));
  ASSERT_EQ(report.gears.size(), 2u);
  EXPECT_NEAR(report.gears[0].ratio, 1.0 / 3, 1e-15);
  EXPECT_TRUE(report.passed());
}

std::string hoist(const std::string& keys) {
  return fmt::format(R"toml(
format = 1
[simulate]
duration = "2 s"
output_step = "0.01 s"
[ground.markers]
axle = [0, 0]
[body.drum]
mass = 20
inertia = 0.4
position = [0, 0]
angle = 0
spin = 0
hold = ["angle"]
markers.axle = [0, 0]
[body.load]
mass = 50
inertia = 2
position = ["0.2 m", "-8 m"]
velocity = [0, 0]
angle = 0
spin = 0
markers.eye = [0, 0]
[joint.axle]
type = "revolute"
between = ["ground.axle", "drum.axle"]
ideal = true
[motor.drive]
joint = "axle"
position = "1.5*pi*(t/1 s - sin(pi*t/1 s)/pi)"
[joint.rope]
type = "belt"
between = ["drum.axle", "load.eye"]
{}
)toml",
                     keys);
}
constexpr const char* kRope = "first_radius = 0.2\nstretch = \"50 kg*9.80665 m/s^2/(2e6 N/m)\"\nstiffness = 2e6\ndamping = 2e3\n";

// A drum that turns by one and a half turns lifts its load by that times its circumference. The rope carries m (g + r alpha), the motor r times that and the
// drum's inertia.
TEST(Belts, ADrumHoistsItsLoad) {
  Model model = parse_model(hoist(kRope), "hoist.toml");
  model.simulate.tolerance = 1e-6;  // 1e-5 takes thirty steps, and an energy account that drifts by 2e-5 of what is supplied
  const Trajectory run = completed(model);
  const double r = 0.2, m = 50, inertia = 0.4;
  EXPECT_NEAR(at_end(run, "joint.axle.angle"), 3 * kPi, 1e-3);
  EXPECT_NEAR(at_end(run, "body.load.y"), -8 + r * 3 * kPi, 1e-3);
  EXPECT_NEAR(at_end(run, "joint.rope.run"), 8 - r * 3 * kPi, 1e-3);
  for (const double t : {0.7, 1.0, 1.6}) {  // the rope's ringing at 200 rad/s has died away
    const std::size_t row = reference::row_at(run, t);
    const double alpha = 1.5 * kPi * kPi * std::sin(kPi * t), tension = m * (kStandardGravity + r * alpha);
    EXPECT_NEAR(value(run, row, "joint.rope.tension"), tension, 5e-4 * tension) << t;
    EXPECT_NEAR(value(run, row, "motor.drive.effort"), r * tension + inertia * alpha, 1e-3 * r * tension) << t;
  }
  EXPECT_LT(run.energy.drift, 1e-5 * run.energy.supplied);
}

TEST(Belts, SayWhatIsWrong) {
  const auto complaint = [](const std::string& keys) -> std::string {
    try {
      simulate(parse_model(hoist(keys), "hoist.toml"));
    } catch (const InputError& error) {
      return error.what();
    } catch (const AssemblyError& error) {
      return error.what();
    }
    return "";
  };
  const auto says = [&complaint](const std::string& keys, const std::string& words) { EXPECT_NE(complaint(keys).find(words), std::string::npos) << keys << '\n' << complaint(keys); };
  says("", "a belt winds onto one disc at least");
  says("first_radius = -0.2", "this must be at least 0 m");
  says("first_radius = 0.2\nfirst_side = \"top\"", "it is none of left, right");
  says("first_radius = 0.2\nsecond_side = \"left\"", "the belt ends in the second marker");
  says("second_radius = 0.2\nfirst_side = \"left\"", "the belt ends in the first marker");
  says("first_radius = 9", "its discs are 8.002 m apart, and the belt cannot run between them: that takes more than 9 m");
}

// A weight on a rope that is exactly as long as its path is at rest under its load; on a longer rope it falls.
TEST(Ropes, ATautOneCarriesFromTheStart) {
  const auto hung = [](const std::string& length) {
    return simulate(parse_model(R"toml(format = 1
[simulate]
duration = 1
[ground.markers]
o = [0, 0]
[body.load]
mass = 50
inertia = 1
position = [0, -1]
markers.hook = [0, 0]
[joint.rope]
type = "rope"
between = ["ground.o", "load.hook"]
stiffness = 2e6
damping = 500
)toml" + length, "hung.toml"));
  };
  const double weight = 50 * 9.80665;
  const Trajectory taut = hung(""), slack = hung("length = 1.001\n");
  EXPECT_NEAR(taut.joints[0].peak, weight, 1e-9 * weight);
  EXPECT_NEAR(taut.joints[0].rms, weight, 1e-9 * weight);
  EXPECT_GT(slack.joints[0].peak, 2 * weight);
}

// At rest, with everything in one line: each force is the weight's component along it, and none rings. A millisecond of swinging curves them by 2.5 mN.
TEST(Ropes, ATautOneSwingsFromTheStartWithoutRinging) {
  const Trajectory run = completed(mechanism("rope_pendulum"));
  EXPECT_TRUE(run.notes.empty()) << run.notes.front();
  const double along = kStandardGravity * std::cos(kPi * 25 / 180);
  const auto force = [&run](std::size_t row, const std::string& end) { return std::hypot(value(run, row, end + ".fx[world]"), value(run, row, end + ".fy[world]")); };
  for (const auto& [end, mass] : {std::pair<std::string, double>{"joint.rod.on_load", 50}, {"joint.rope.on_hook", 70}}) {
    EXPECT_NEAR(force(0, end), mass * along, 0.2) << end;  // less what accelerates the stretch: m T''/k, 0.07 N
    for (std::size_t row = 1; row < 50; ++row) EXPECT_LT(std::abs(force(row - 1, end) - 2 * force(row, end) + force(row + 1, end)), 5e-3) << end << " " << row;
  }
}

// A turn winds 19 mm less onto one disc than off the other: 2.2 mm of stretch is pretension, and not 17 mm of slack.
Model alike_discs(double stretch) {
  return parse_model(fmt::format(R"toml(
format = 1
gravity = [0, 0]
[simulate]
duration = "50 ms"
[ground.markers]
a = [0, 0]
b = [0.38, 0]
[defaults.joint]
stiffness = 1e8
damping = 1e3
[body.crank]
mass = 4
inertia = 8e-3
position = [0, 0]
angle = 0
spin = 0
hold = ["angle"]
markers.o = [0, 0]
[body.fan]
mass = 4
inertia = 6e-3
position = [0.38, 0]
angle = 0
spin = 0
hold = ["angle"]
markers.o = [0, 0]
[joint.A]
type = "revolute"
between = ["ground.a", "crank.o"]
[joint.B]
type = "revolute"
between = ["ground.b", "fan.o"]
[joint.left]
type = "belt"
between = ["crank.o", "fan.o"]
first_radius = 0.037
second_radius = 0.034
first_side = "left"
stretch = {0}
stiffness = 1e5
damping = 100
[joint.right]
type = "belt"
between = ["crank.o", "fan.o"]
first_radius = 0.037
second_radius = 0.034
first_side = "right"
stretch = {0}
stiffness = 1e5
damping = 100
)toml",
                                 stretch),
                     "alike.toml");
}

TEST(Belts, BetweenDiscsOfNearlyEqualRadiiCarryTheirPretension) {
  for (const double stretch : {2.2e-3, 9e-3, 25e-3}) {
    const Trajectory run = completed(alike_discs(stretch));
    for (const char* tension : {"joint.left.tension", "joint.right.tension"}) EXPECT_NEAR(at_end(run, tension), 1e5 * stretch, 1e3 * stretch) << tension;  // the bearings deflect by a hundredth of a millimetre
  }
}

// A reel of nearly the radius of its post, whose cord stretches by a third of what a turn winds: it used to start slack, and snatched.
TEST(Belts, StartStretchedByWhatTheyCarry) {
  const Trajectory run = completed(reference::test_model("reel_beside_a_post"));
  EXPECT_NEAR(run.joints.at(1).peak, 2 / 49.9e-3, 0.05) << run.joints.at(1).name;
}

// A bobbin held by 1 N*m/rad, and a yarn of 100 N/m that is pulled by 60 mm, nearly half of its circumference.
TEST(Belts, AreStretchedByAnyPartOfATurn) {
  for (const char* method : {"radau", "dopri5"}) {
    const Trajectory run = completed(reference::test_model("yarn_on_a_sprung_bobbin", {std::string("simulate.method=") + method}));
    EXPECT_NEAR(at_end(run, "joint.yarn.tension"), 100 * 0.06 / (1 + 100 * 0.02 * 0.02), 2e-3) << method;
  }
}

// The difference between what a turn winds off one disc and onto the other is no limit on how far a belt may be stretched or slack.
TEST(Belts, OverDiscsOfNearlyEqualRadiiTransmitTorques) {
  const Trajectory run = completed(reference::test_model("timing_belt_of_20_and_19_teeth", {"simulate.duration=1"}));
  constexpr double kTorque = 1.6, kFirst = 15.92e-3, kSecond = 15.12e-3;
  const double one = at_end(run, "joint.up.tension"), other = at_end(run, "joint.low.tension");
  EXPECT_NEAR(std::abs(one - other), kTorque / kFirst, 0.02);
  EXPECT_EQ(std::min(one, other), 0);  // pretension of 15 N a run
  EXPECT_NEAR(std::abs(at_end(run, "body.load.spin")), kTorque * kSecond / kFirst / 0.02, 0.02);  // against 0.02 N*m*s/rad
}

// Discs of equal radii wind nothing: their belt may be stretched or slack by any amount.
TEST(Belts, RunOverEqualDiscs) {
  const Trajectory run = completed(reference::test_model("belt_over_equal_discs"));
  EXPECT_NEAR(run.joints.at(2).peak, 75.13, 0.1) << run.joints.at(2).name;
}

}  // namespace
}  // namespace pintle
