// Friction in the joints of whole mechanisms: published motions that stick and slip, closed forms of what locks, friction circles.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/reference_tables.h"

namespace pintle {
namespace {

Trajectory completed(const Model& model) {
  Trajectory run = simulate(model);
  EXPECT_EQ(run.outcome, Outcome::kCompleted) << run.message;
  return run;
}

double at_end(const Trajectory& run, const std::string& column) { return reference::value(run, run.n_rows() - 1, column); }

double drift(const Trajectory& run) { return run.energy.drift / (run.energy.kinetic_peak + run.energy.dissipated + std::abs(run.energy.supplied)); }

constexpr const char* kPulledMass = R"toml(
format = 1
name = "Pulled mass"
gravity = [0, -9.81]
[simulate]
duration = "25 s"
output_step = "0.5 s"
[ground.markers]
o = [0, 0]
[body.mass]
mass = 1
inertia = 0.01
markers.c = [0, 0]
[joint.slide]
type = "prismatic"
between = ["ground.o", "mass.c"]
friction = "brown-mcphee"
friction_coefficient = 0.1
static_friction = 0.15
transition_speed = "0.001 m/s"
[motor.pull]
joint = "slide"
force = "2 N/m*(0.1 m/s*t - slide)"
)toml";

TEST(BrownMcPhee, PulledMassSticksAndSlipsAsComputedElsewhere) {
  const auto table = reference::read_table("brown_mcphee_stick_slip");
  for (const double tolerance : {1e-5, 1e-7}) {
    Model model = parse_model(kPulledMass, "pulled.toml");
    model.simulate.tolerance = tolerance;
    const Trajectory run = completed(model);
    ASSERT_EQ(run.n_rows(), table.rows.size());
    double x = 0, v = 0;
    for (std::size_t i = 0; i < run.n_rows(); ++i) {
      x = std::max(x, std::abs(reference::value(run, i, "joint.slide.slide") - table.at(i, "x")));
      v = std::max(v, std::abs(reference::value(run, i, "body.mass.vx") - table.at(i, "v")));
    }
    printf("bm tol %g  x %g v %g drift %g steps %ld newton %ld fail %ld\n", tolerance, x, v, drift(run), (long)run.counters.steps, (long)run.counters.newton_iterations, (long)run.counters.newton_failures);
    EXPECT_LT(drift(run), 1e-6);
  }
}

constexpr const char* kConveyor = R"toml(
format = 1
name = "Block on a conveyor belt"
gravity = [0, -9.81]
[simulate]
duration = "10 s"
output_step = "0.1 s"
[ground.markers]
o = [0, 0]
[body.belt]
mass = 1000
inertia = 1000
position = [0, 0]
angle = 0
velocity = [0.1, 0]
markers.c = [0, 0]
[body.block]
mass = 1
inertia = 0.01
position = [1, 0]
velocity = [0, 0]
angle = 0
hold = ["x"]
markers.c = [0, 0]
[joint.rollers]
type = "prismatic"
between = ["ground.o", "belt.c"]
[joint.contact]
type = "prismatic"
between = ["belt.c", "block.c"]
friction = "stribeck"
friction_coefficient = 0.15
static_friction = 0.2
stribeck_speed = "0.001 m/s"
transition_speed = "1e-4 m/s"
[spring.s]
between = ["ground.o", "block.c"]
stiffness = "10 N/m"
free_length = "0.8 m"
[motor.drive]
joint = "rollers"
speed = 0.1
stiffness = 1e9
damping = 1e6
)toml";

TEST(Stribeck, BlockOnAConveyorBeltMovesAsPublished) {
  const auto table = reference::read_table("conveyor_belt");
  for (const double tolerance : {1e-5, 1e-7}) {
    Model model = parse_model(kConveyor, "conveyor.toml");
    model.simulate.tolerance = tolerance;
    const Trajectory run = completed(model);
    ASSERT_EQ(run.n_rows(), table.rows.size());
    double x = 0, v = 0;
    for (std::size_t i = 0; i < run.n_rows(); ++i) {
      x = std::max(x, std::abs(reference::value(run, i, "body.block.x") - table.at(i, "x")));
      v = std::max(v, std::abs(reference::value(run, i, "body.block.vx") - table.at(i, "vx")));
    }
    printf("cb tol %g  x %g v %g drift %g steps %ld newton %ld fail %ld\n", tolerance, x, v, drift(run), (long)run.counters.steps, (long)run.counters.newton_iterations, (long)run.counters.newton_failures);
    EXPECT_LT(drift(run), 1e-6);
  }
}

}  // namespace
}  // namespace pintle
