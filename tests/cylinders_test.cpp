// Cylinders in whole runs: closed forms of pushing, holding and throwing, balances, complaints.
#include <gtest/gtest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "base/constants.h"
#include "pintle/complaint.h"
#include "pintle/simulate.h"
#include "tests/reference_tables.h"

namespace pintle {
namespace {

using reference::at_end;
using reference::completed;
using reference::drift;
using reference::value;

constexpr double kPistonMass = 40;
constexpr double kCap = 25e-4 * kPi, kRod = 16e-4 * kPi;  // of 100/60 mm [m^2]

const std::string kHard = "stops = \"hard\"\nstop_stiffness = \"1e7 N/m\"\n";

// A mass on a slide, pushed by a cylinder of 100/60 mm that is extended by 100 mm.
std::string pushed_piston(const std::string& more, const std::string& duration = "0.2 s") {
  return fmt::format(R"toml(
format = 1
gravity = [0, 0]
[simulate]
duration = "{}"
tolerance = 1e-6
[ground.markers]
rail = [0, 0]
foot = ["-0.6 m", 0]
[body.block]
mass = {}
inertia = 0.1
position = [0, 0]
velocity = [0, 0]
angle = 0
hold = ["x"]
markers.c = [0, 0]
[joint.slide]
type = "prismatic"
between = ["ground.rail", "block.c"]
[joint.ram]
type = "cylinder"
between = ["ground.foot", "block.c"]
bore = "100 mm"
rod_diameter = "60 mm"
closed_length = "500 mm"
{}
)toml",
                     duration, kPistonMass, more);
}
Model ram(const std::string& more, const std::string& duration = "0.2 s") { return parse_model(pushed_piston(more, duration), "ram.toml"); }

// F = p_c A_c - p_r A_r, x = F t^2/2m, flows A v, power F v.
TEST(Cylinders, ConstantPressureAcceleratesEvenly) {
  const double force = 1e5 * kCap - 0.6e5 * kRod;
  for (const Equations equations : {Equations::kNewtonian, Equations::kRelative, Equations::kIdeal}) {
    Model model = ram(kHard + "stroke = \"2 m\"\ncap_pressure = \"1 bar\"\nrod_pressure = \"0.6 bar\"");
    model.simulate.equations = equations;
    model.joints[0].ideal = equations == Equations::kRelative;
    const Trajectory run = completed(model);
    for (std::size_t i = 0; i < run.n_rows(); i += 50) {
      const double v = force / kPistonMass * value(run, i, "t");
      EXPECT_NEAR(value(run, i, "joint.ram.force"), force, 1e-6 * force);
      EXPECT_NEAR(value(run, i, "joint.ram.on_block.fx[world]"), force, 1e-6 * force);
      EXPECT_NEAR(value(run, i, "joint.ram.stroke_rate"), v, 1e-6);
      EXPECT_NEAR(value(run, i, "joint.ram.cap_flow"), kCap * v, 1e-8);
      EXPECT_NEAR(value(run, i, "joint.ram.rod_flow"), -kRod * v, 1e-8);
      EXPECT_NEAR(value(run, i, "joint.ram.hydraulic_power"), force * v, 1e-3);
    }
    const double way = 0.5 * force / kPistonMass * 0.04;
    EXPECT_NEAR(at_end(run, "joint.ram.stroke"), 0.1 + way, 1e-7);
    EXPECT_NEAR(run.energy.supplied, force * way, 1e-6 * force * way);
    EXPECT_LT(drift(run), 1e-6 * force * way);
  }
}

// A boom released with the spin w under the pressure that virtual work requires (theory/cylinders Eq. (5.2)) keeps turning at w.
TEST(Cylinders, ABoomUnderThePressureOfVirtualWorkIsInBalanceEverywhere) {
  const Model model = parse_model(R"toml(
format = 1
[parameters]
foot_x = "0.5 m"
foot_y = "-0.6 m"
eye = "1.6 m"
low = "-10 deg"
weight = "900 kg*9.80665 m/s^2"
closed = "1 m"
# The angle at the pin between foot and eye, by the law of cosines from the length, and the boom's from it.
foot = "sqrt(foot_x^2 + foot_y^2)"
foot_angle = "atan2(foot_y, foot_x)"
[simulate]
duration = "2 s"
tolerance = 1e-7
[ground.markers]
pin = [0, 0]
foot = ["foot_x", "foot_y"]
[body.boom]
mass = "900 kg"
inertia = 1200
position = ["2 m*cos(low)", "2 m*sin(low)"]
angle = "low"
spin = 0.5
hold = ["angle"]
markers.pin = ["-2 m", 0]
markers.eye = ["eye - 2 m", 0]
[joint.pin]
type = "revolute"
between = ["ground.pin", "boom.pin"]
stiffness = 1e10
damping = 1e6
[joint.lift]
type = "cylinder"
between = ["ground.foot", "boom.eye"]
bore = "120 mm"
rod_diameter = "70 mm"
closed_length = "closed"
stroke = "1 m"
stops = "hard"
stop_stiffness = "1e8 N/m"
cap_pressure = "weight*2 m*cos(foot_angle + acos((foot^2 + eye^2 - (closed + stroke)^2)/(2*foot*eye)))*(closed + stroke)/(foot*eye*sin(acos((foot^2 + eye^2 - (closed + stroke)^2)/(2*foot*eye))))/(pi/4*(120 mm)^2)"
)toml",
                                  "boom.toml");
  const Trajectory run = completed(model);
  EXPECT_GT(at_end(run, "joint.lift.stroke") - value(run, 0, "joint.lift.stroke"), 0.6);
  for (std::size_t i = 0; i < run.n_rows(); ++i) {
    EXPECT_NEAR(value(run, i, "body.boom.spin"), 0.5, 2e-5);
    const double angle = value(run, i, "body.boom.angle"), ex = 1.6 * std::cos(angle), ey = 1.6 * std::sin(angle);
    const double arm = (0.5 * ey + 0.6 * ex) / std::hypot(ex - 0.5, ey + 0.6), moment = 900 * 9.80665 * 2 * std::cos(angle);
    EXPECT_NEAR(value(run, i, "joint.lift.cap_pressure"), moment / arm / (36e-4 * kPi), 1e-4 * moment / arm / (36e-4 * kPi));
  }
  EXPECT_LT(drift(run), 1);
}

// The work of enclosed air is p1 V1/(n - 1) (1 - (V1/V)^(n - 1)) less p0 A x; the cushion takes it, and the account closes over the impact.
TEST(Cylinders, ExpandingAirThrowsAMassIntoTheCushion) {
  const std::string air = R"(stroke = "400 mm"
cap_pressure = "7 bar*(150 mm/(50 mm + stroke))^1.4"
rod_pressure = "1.01325 bar"
ambient_pressure = "1.01325 bar"
stops = "cushioned"
upper_stop = "350 mm"
stop_stiffness = "4e4 N/m"
stop_damping = "5e4 N*s/m"
stop_cushion = "30 mm")";
  const std::string text = pushed_piston(air, "0.5 s");
  const auto given = [](double stroke) { return 7e5 * kCap * 0.15 / 0.4 * (1 - std::pow(0.15 / (stroke + 0.05), 0.4)) - 101325 * kCap * (stroke - 0.1); };
  const double work = given(0.35);
  for (const char* method : {"radau", "dopri5"}) {
    Model model = parse_model(text, "air.toml");
    model.simulate.method = method;
    const Trajectory run = completed(model);
    for (std::size_t i = 0; i < run.n_rows() && value(run, i, "joint.ram.stroke") <= 0.35; ++i)
      EXPECT_NEAR(value(run, i, "joint.ram.stroke_rate"), std::sqrt(2 * given(value(run, i, "joint.ram.stroke")) / kPistonMass), 2e-5);
    EXPECT_GT(run.energy.dissipated, 0.9 * work);
    EXPECT_LT(drift(run), 1e-5 * work);
    EXPECT_LT(at_end(run, "joint.ram.stroke"), 0.4);
    // At rest against the cushion: the force with which the air still pushes.
    EXPECT_NEAR(at_end(run, "joint.ram.stop_force"), -(at_end(run, "joint.ram.cap_force") - at_end(run, "joint.ram.rod_force")), 30);
  }
}

// Friction of fast slip: mu (N_0 + A_s (p_c + p_r)). A ram that its seals can hold does not move, another one does.
TEST(Cylinders, SealsRubMoreUnderPressure) {
  const std::string seals = kHard + "rod_pressure = \"5 bar\"\nstroke = \"2 m\"\nfriction_coefficient = 0.1\nstatic_friction = 0.15\nfriction_preload = \"2 kN\"\nseal_area = \"15 cm^2\"\n";
  const Trajectory run = completed(ram(seals + "cap_pressure = \"20 bar\"\nfriction = \"stribeck\"", "0.05 s"));
  const double load = 2000 + 15e-4 * 25e5, force = 20e5 * kCap - 5e5 * kRod;
  EXPECT_NEAR(at_end(run, "joint.ram.friction"), -0.1 * load, 1e-6 * load);
  EXPECT_NEAR(at_end(run, "joint.ram.force"), force - 0.1 * load, 1e-6 * force);
  EXPECT_LT(drift(run), 1e-5 * run.energy.supplied);
  // Beyond the balance of both sides it breaks away at 0.15 times the normal force.
  const double balance = 5e5 * kRod / kCap, breakaway = 0.15 * (2000 + 15e-4 * (5e5 + balance)) / (kCap - 0.15 * 15e-4);
  for (const double share : {0.99, 1.01}) {
    const Trajectory held = completed(ram(seals + fmt::format("cap_pressure = \"{:.3f} Pa + {:.3f} Pa*smoothstep(0 s, 0.1 s, t)\"\nfriction = \"coulomb\"", balance, share * breakaway)));
    EXPECT_EQ(at_end(held, "joint.ram.stuck"), share < 1 ? 1 : 0) << share;
  }
  // Pressed from the start, it holds or slips from the start; seals rub against what would move it, not against what the pressures push.
  for (const double cap : {2e5, 3.3e5, 20e5}) {
    const Trajectory pressed = completed(ram(seals + fmt::format("cap_pressure = \"{} Pa\"\nfriction = \"coulomb\"", cap), "0.05 s"));
    const double push = cap * kCap - 5e5 * kRod, most = 0.15 * (2000 + 15e-4 * (5e5 + cap)), friction = std::abs(push) < most ? push : std::copysign(0.1 / 0.15 * most, push);
    for (std::size_t i = 0; i < pressed.n_rows(); ++i) {
      EXPECT_EQ(value(pressed, i, "joint.ram.stuck"), std::abs(push) < most ? 1 : 0) << cap << " " << i;
      EXPECT_NEAR(value(pressed, i, "joint.ram.friction"), -friction, 1e-5 * std::abs(push)) << cap << " " << i;
    }
  }
}

// A valve that opens at once is a jump, on which a step ends.
TEST(Cylinders, AValveThatOpensIsAnEvent) {
  const Trajectory run = completed(ram(kHard + "stroke = \"2 m\"\ncap_pressure = \"if(t < 0.05 s, 0 bar, 1 bar)\""));
  EXPECT_NEAR(at_end(run, "joint.ram.stroke_rate"), 1e5 * kCap / kPistonMass * 0.15, 1e-6);
  EXPECT_EQ(value(run, 0, "joint.ram.force"), 0);
}

std::string complaint(const std::string& text) {
  try {
    parse_model(text, "ram.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(Cylinders, BadInputIsLocated) {
  const std::string good = kHard + "stroke = \"1 m\"\n";
  EXPECT_EQ(complaint(pushed_piston(good)), "");
  std::string thick = pushed_piston(good);
  thick.replace(thick.find("60 mm"), 5, "101 mm");
  EXPECT_NE(complaint(thick).find("rod_diameter"), std::string::npos);
  EXPECT_NE(complaint(thick).find("ram.toml:25"), std::string::npos) << complaint(thick);
  EXPECT_NE(complaint(pushed_piston(good + "rod_pressure = \"-2 bar\"")).find("below vacuum"), std::string::npos);
  EXPECT_EQ(complaint(pushed_piston(good + "rod_pressure = \"-0.9 bar\"")), "");
  EXPECT_NE(complaint(pushed_piston(good + "rod_pressure = \"-0.9 bar\"\nambient_pressure = \"1 bar\"")).find("below vacuum"), std::string::npos);
  EXPECT_NE(complaint(pushed_piston(kHard + "stroke = 0")).find("joint.ram.stroke"), std::string::npos);
  EXPECT_NE(complaint(pushed_piston("stroke = \"1 m\"")).find("stops"), std::string::npos);
  EXPECT_NE(complaint(pushed_piston(good + "upper_stop = \"1.2 m\"")).find("upper_stop"), std::string::npos);
  EXPECT_NE(complaint(pushed_piston(good + "cap_pressure = \"1 bar*slide\"")).find("cap_pressure"), std::string::npos);
  EXPECT_NE(complaint(pushed_piston(good + "cap_pressure = \"1 N\"")).find("cap_pressure"), std::string::npos);
  EXPECT_NE(complaint(pushed_piston(good + "friction = \"stribeck\"\nguide_length = 0.1")).find("guide_length"), std::string::npos);
  EXPECT_NE(complaint(pushed_piston(good + "[motor.m]\njoint = \"ram\"\nforce = \"1 N\"")).find("driven by its pressures"), std::string::npos);
  EXPECT_THROW(completed(ram(kHard + "stroke = \"50 mm\"")), AssemblyError);
}

// A flow law does not know that oil cavitates: a note says so, with the lowest pressure. Constant pressures are refused when the model is read.
TEST(Cylinders, PressuresBelowVacuumAreNoted) {
  const auto notes = [](const std::string& pressures) {
    std::string all;
    for (const std::string& note : completed(ram(kHard + "stroke = \"2 m\"\n" + pressures)).notes) all += note + "\n";
    return all;
  };
  EXPECT_NE(notes("cap_pressure = \"1 bar - 30 bar/s*t\"").find("on the cap side of cylinder ram falls to -5 bar at t = 0.2 s, below vacuum (-1.013 bar)"), std::string::npos) << notes("cap_pressure = \"1 bar - 30 bar/s*t\"");
  EXPECT_NE(notes("ambient_pressure = \"1 bar\"\ncap_pressure = \"1 bar\"\nrod_pressure = \"1 bar - 7 bar/s*t\"").find("on the rod side of cylinder ram falls to -0.4 bar at t = 0.2 s, below vacuum (0 bar)"), std::string::npos);
  EXPECT_EQ(notes("cap_pressure = \"1 bar - 9 bar/s*t\"").find("vacuum"), std::string::npos);
}

}  // namespace
}  // namespace pintle
