// Forces that read where bodies are and how they move: against springs that do the same, and a published strut on its tyre.
#include <gtest/gtest.h>
#include <fmt/format.h>

#include <cmath>
#include <string>

#include "tests/reference_tables.h"

namespace pintle {
namespace {

// A block on a prismatic guide, held by a spring and a damper, or by a force that reads its place and speed.
std::string held_by(const char* what, const char* equations = "newtonian") {
  return fmt::format(R"toml(
format = 1
gravity = [0, 0]
[simulate]
duration = "1 s"
tolerance = 1e-7
equations = "{}"
[ground.markers]
o = {{ x = 0, y = 0 }}
[body.block]
mass = 2
inertia = 0.01
position = [1.3, 0]
velocity = [0.2, 0]
angle = 0
markers.c = {{ x = 0, y = 0 }}
[joint.guide]
type = "prismatic"
between = ["ground.o", "block.c"]
{}
)toml",
                     equations, what);
}

TEST(StateForces, ASpringWrittenAsAForceIsThatSpring) {
  const std::string spring = "[spring.s]\nbetween = [\"ground.o\", \"block.c\"]\nstiffness = 50\ndamping = 0.7\nfree_length = 1";
  for (const char* force : {"[force.f]\non = \"block.c\"\nforce = [\"-50 N/m*(block.x - 1 m) - 0.7 N*s/m*block.vx\", 0]",
                            "[force.f]\non = \"block.c\"\nforce = [\"-50 N/m*(block.c.x - 1 m) - 0.7 N*s/m*block.c.vx\", 0]",
                            "[force.f]\non = \"block.c\"\nforce = [\"-50 N/m*(guide.slide - 1 m) - 0.7 N*s/m*guide.rate\", 0]"})
    for (const char* equations : {"newtonian", "relative", "ideal"}) {
      const Trajectory a = simulate(parse_model(held_by(spring.c_str(), equations), "spring.toml")), b = simulate(parse_model(held_by(force, equations), "force.toml"));
      ASSERT_EQ(b.outcome, Outcome::kCompleted) << force << b.message;
      const auto x = static_cast<std::size_t>(a.column("body.block.x")), y = static_cast<std::size_t>(b.column("body.block.x"));
      for (std::size_t i = 0; i < a.n_rows(); i += 25) EXPECT_NEAR(b.at(i, y), a.at(i, x), 1e-9) << force << ' ' << equations;
    }
}

// A torque that reads the angle of a body, from a marker turned against it.
TEST(StateForces, ATorqueReadsTheAngleOfItsMarker) {
  const Trajectory run = simulate(parse_model(R"toml(
format = 1
gravity = [0, 0]
[simulate]
duration = "1 s"
tolerance = 1e-8
[ground.markers]
o = { x = 0, y = 0 }
[body.wheel]
mass = 2
inertia = 0.5
position = [0, 0]
angle = "0.1 rad"
spin = 0
markers.o = { x = 0, y = 0 }
markers.m = { x = 0.1, y = 0, axis = "0.2 rad" }
[joint.pin]
type = "revolute"
between = ["ground.o", "wheel.o"]
[force.f]
on = "wheel.o"
torque = "-8 N*m/rad*(wheel.m.angle - 0.2 rad)"
)toml",
                                              "torque.toml"));
  ASSERT_EQ(run.outcome, Outcome::kCompleted) << run.message;
  const auto angle = static_cast<std::size_t>(run.column("body.wheel.angle"));
  EXPECT_NEAR(run.at(run.n_rows() - 1, angle), 0.1 * std::cos(4.0), 1e-7);  // sqrt(8 / 0.5) = 4 rad/s
}

TEST(StateForces, InTheAxesOfTheBodyTheyReadTimeOnly) {
  const std::string force = "[force.f]\non = \"block.c\"\naxes = \"body\"\nforce = [\"-50 N/m*block.x\", 0]";
  try {
    parse_model(held_by(force.c_str()), "force.toml");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("block.x acts in the world's axes"), std::string::npos) << error.what();
  }
}

// P. E. Nikravesh, Planar Multibody Dynamics, 2nd ed., CRC Press 2018, model MP_A: a wheel and strut dropped on its tyre, whose force begins where
// the centre is below 0.3 m and reads height and speed. Computed by maximal coordinates with multipliers to 10 digits.
TEST(StateForces, MacPhersonStrutDropsOnItsTyre) {
  Model model = parse_model(R"toml(
format = 1
gravity = [0, -9.81]
[simulate]
duration = "0.6 s"
output_step = "20 ms"
tolerance = 1e-7
start = "unloaded"
[defaults.joint]
stiffness = 1e10
angular_stiffness = 1e8
[ground.markers]
Q = [0.12, 0.29]
O = [0.41, 0.83]
[body.wheel]
mass = 20
inertia = 2.5
position = [0.583980543671757, 0.35857677251067166]
angle = "6.082111054507328 rad"
velocity = [0, 0]
spin = 0
markers.A = [0, -0.07]
markers.B = [-0.17, 0.25]
markers.C = [0.11, -0.02]
markers.strut = { x = -0.17, y = 0.25, axis = "-1.0802493779679874 rad" }
[body.arm]
mass = 2
inertia = 0.5
position = [0.3449999999074227, 0.2899935455593034]
angle = "-2.8686403099837492e-05 rad"
velocity = [0, 0]
spin = 0
markers.A = [0.225, 0]
markers.Q = [-0.225, 0]
[body.upper]
mass = 0.5
inertia = 0.2
position = [0.4528170349540246, 0.6862408211008916]
angle = "5.00186167653934 rad"
velocity = [0, 0]
spin = 0
markers.O = [-0.15, 0]
markers.axis = { x = 0, y = 0, axis = 0 }
[joint.A]
type = "revolute"
between = ["arm.A", "wheel.A"]
[joint.Q]
type = "revolute"
between = ["ground.Q", "arm.Q"]
[joint.O]
type = "revolute"
between = ["ground.O", "upper.O"]
[joint.strut]
type = "prismatic"
between = ["upper.axis", "wheel.strut"]
[spring.s]
between = ["ground.O", "wheel.B"]
stiffness = 20000
damping = 1100
free_length = 0.34
[force.tyre]
on = "wheel.C"
force = [0, "if(wheel.y < 0.3 m, -1e5 N/m*(wheel.y - 0.3 m) - 1e3 N*s/m*wheel.vy, 0)"]
)toml",
                                  "strut.toml");
  constexpr double kRows[][4] = {{0.02, 0.5842673306223523, 0.3404489524017038, 6.072666636983105}, {0.04, 0.5828147684412524, 0.30444023725144753, 6.0521306126311165}, {0.06, 0.580261677481829, 0.2799297008991481, 6.036905184434261},
                                 {0.1, 0.5808901248243659, 0.2849557331027089, 6.040106100327226},  {0.2, 0.5809842944200269, 0.2857486466594766, 6.040607406183016},    {0.6, 0.5809877172739558, 0.2857776835217704, 6.040625745169296}};
  for (const Equations equations : {Equations::kNewtonian, Equations::kIdeal}) {
    model.simulate.equations = equations;
    const Trajectory run = simulate(model);
    ASSERT_EQ(run.outcome, Outcome::kCompleted) << run.message;
    const auto at = [&run](std::size_t row, const char* column) { return run.at(row, static_cast<std::size_t>(run.column(column))); };
    for (const auto& row : kRows) {
      const auto i = static_cast<std::size_t>(std::lround(row[0] / 0.02));
      EXPECT_NEAR(at(i, "body.wheel.x"), row[1], 1e-5) << row[0];
      EXPECT_NEAR(at(i, "body.wheel.y"), row[2], 1e-5) << row[0];
      EXPECT_NEAR(at(i, "body.wheel.angle"), row[3], 1e-5) << row[0];
    }
    if (equations == Equations::kNewtonian) continue;  // its joints ring after the tyre has struck
    EXPECT_NEAR(at(1, "joint.A.on_wheel.fx[world]"), -454.41591004216673, 1e-4);
    EXPECT_NEAR(at(1, "joint.A.on_wheel.fy[world]"), 131.12333615488978, 1e-4);
  }
}

}  // namespace
}  // namespace pintle
