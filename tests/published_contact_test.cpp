// Published and computed mechanisms with clearance and contact: when the bodies touch and separate, and where they are.
#include <gtest/gtest.h>

#include "laws/contact/contact.h"
#include "tests/contact_runs.h"

namespace pintle {
namespace {

using contacts::follow;
using contacts::Followed;

// --- Slider-crank with a dry clearance joint ---

Model slider_crank() {
  return parse_model(R"toml(
format = 1
gravity = [0, -9.81]
name = "Slider-crank with clearance between rod and slider"
[simulate]
duration = "12 ms"
equations = "relative"
start = "raw"
[ground.markers]
o = { x = 0, y = 0 }
guide = { x = 0, y = 0 }
[body.crank]
mass = 0.3
inertia = 1e7
position = [0, 0]
angle = 0
spin = 523.5987755982989
velocity = [0, 0]
markers.o = { x = 0, y = 0 }
markers.a = { x = 0.05, y = 0 }
[body.rod]
mass = 0.21
inertia = 0.00025
position = [0.11, 0]
angle = 0
velocity = [0, 13.089969389957473]
spin = -218.16615649929122
markers.a = { x = -0.06, y = 0 }
markers.b = { x = 0.06, y = 0 }
[body.slider]
mass = 0.14
inertia = 1e-4
position = [0.17, 0]
angle = 0
velocity = [0, 0]
spin = 0
markers.b = { x = 0, y = 0 }
[joint.crank]
ideal = true
type = "revolute"
between = ["ground.o", "crank.o"]
[joint.a]
ideal = true
type = "revolute"
between = ["crank.a", "rod.a"]
[joint.b]
type = "revolute"
between = ["slider.b", "rod.b"]
law = "clearance"
clearance = 0.0005
pin_radius = 0.0095
contact_model = "lankarani-nikravesh"
restitution = 0.9
attraction = "kept"
[joint.guide]
ideal = true
type = "prismatic"
between = ["ground.guide", "slider.b"]
)toml",
                     "slider_crank.toml");
}

// Source: the published problem of P. Flores and others, computed with an event-driven program of 8 to 9 digits: times of touch and release, then the slider's
// position and speed.
TEST(Contact, SliderCrankWithAClearanceJointTouchesWhenItShould) {
  constexpr double kTimes[][2] = {{0.00022728488012118236, 0.0002807207844316768}, {0.0006364282783851722, 0.0006902209705600365}, {0.0007491400437525636, 0.0008147093951919064},
                                  {0.0010795439932897116, 0.0011396965983561608}, {0.0012034282009330778, 0.0014862242870707781}};
  EXPECT_NEAR(hertz_stiffness(207e9, 0.3, 0.0095, 0.01), 66101983978.96843, 1);
  for (const int stages : {3, 5}) {
    const Followed run = follow(slider_crank(), stages == 3 ? 1e-8 : 1e-10, 0.008, {.stages = stages});
    ASSERT_GE(run.contacts.size(), 10u);
    for (int i = 0; i < 5; ++i) {
      EXPECT_NEAR(run.contacts[2 * i].t, kTimes[i][0], 1e-7) << i;
      EXPECT_NEAR(run.contacts[2 * i + 1].t, kTimes[i][1], 1e-7) << i;
    }
    EXPECT_NEAR(run.end.q[2][0], 0.08663045087524897, 2e-7);
    EXPECT_NEAR(run.end.v[2][0], 17.517049072379418, 1e-3);
  }
}

// --- A rod that strikes the ground with both ends ---

Model rod() {
  return parse_model(R"toml(
format = 1
gravity = [0, -9.81]
name = "Falling rod"
[simulate]
duration = "1 s"
start = "raw"
[ground.markers]
o = { x = 0, y = 0 }
[body.rod]
mass = 1
inertia = 0.01
position = [0, 1]
angle = 0.7853981633974483
velocity = [0, -6]
spin = 0
markers.a = { x = 0, y = -1 }
markers.b = { x = 0, y = 1 }
[joint.a]
type = "slot"
between = ["ground.o", "rod.a"]
law = "contact"
pin_radius = 0
contact_stiffness = 1e11
contact_model = "lankarani-nikravesh"
restitution = 0.95
attraction = "kept"
[joint.b]
type = "slot"
between = ["ground.o", "rod.b"]
law = "contact"
pin_radius = 0
contact_stiffness = 1e11
contact_model = "lankarani-nikravesh"
restitution = 0.95
attraction = "kept"
)toml",
                     "rod.toml");
}

// P. E. Nikravesh, Planar Multibody Dynamics, 2nd ed., CRC Press 2018, model Rod; computed with an event-driven program to 8 digits, tests/reference/falling_rod*.csv.
TEST(Contact, AFallingRodRattlesBetweenItsEnds) {
  const reference::Table impacts = reference::read_table("falling_rod_contacts");
  const Followed run = follow(rod(), 1e-10, 1, {.stages = 5});
  ASSERT_EQ(impacts.rows.size(), 15u);
  ASSERT_EQ(run.contacts.size(), 30u);
  for (std::size_t i = 0; i < 30; ++i) {
    const bool out = i % 2 == 1;
    const double end = impacts.at(i / 2, "end");
    const State& state = run.touched[i];
    const double arm = (end == 1 ? 1 : -1) * std::sin(state.q[0][2]);  // from the middle to this end, along x
    EXPECT_EQ(run.contacts[i].border, out ? contacts::kLetGo : contacts::kTouch) << i;
    EXPECT_EQ(run.contacts[i].joint, end - 1) << i;
    EXPECT_NEAR(run.contacts[i].t, impacts.at(i / 2, out ? "t_out" : "t_in"), 1e-9) << i;                                // measured: 8e-11
    EXPECT_NEAR(state.v[0][1] + arm * state.v[0][2], impacts.at(i / 2, out ? "vy_out" : "vy_in"), 1e-7) << i;  // measured: 7e-9
  }
}

// The two computations of the table agree to 4e-10 m, 9e-10 rad, 5e-10 m/s and 2e-9 rad/s.
TEST(Contact, AFallingRodMovesAsTheTableSays) {
  Model model = rod();
  model.simulate.output_step = 0.02;
  Trajectory run;
  reference::integrate_once(model, 1e-10, 5, nullptr, &run);
  const reference::Table table = reference::read_table("falling_rod");
  ASSERT_EQ(run.n_rows(), table.rows.size());
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const auto error = [&](const std::string& column) { return std::abs(reference::value(run, i, "body.rod." + column) - table.at(i, column)); };
    EXPECT_LT(error("y"), 2e-9) << i;
    EXPECT_LT(error("angle"), 3e-9) << i;
    EXPECT_LT(error("vy"), 2e-9) << i;
    EXPECT_LT(error("spin"), 1e-8) << i;
  }
  // The published run, MATLAB ode45 at 1e-6: known to be 8.4e-3 m/s and 3.1e-2 rad/s off after the last impact, and close before the second.
  const reference::Table published = reference::read_table("falling_rod_published");
  for (std::size_t i = 0; i < published.rows.size(); ++i) {
    const std::size_t row = reference::row_at(run, published.at(i, "t"));
    const auto error = [&](const std::string& column) { return std::abs(reference::value(run, row, "body.rod." + column) - published.at(i, column)); };
    if (i < 2) {
      EXPECT_LT(error("y"), 1e-6);
      EXPECT_LT(error("angle"), 5e-5);
    } else if (i > 2) {
      EXPECT_NEAR(error("vy"), 8.4e-3, 5e-5) << i;
      EXPECT_NEAR(error("spin"), 3.1e-2, 5e-4) << i;
    }
  }
}

}  // namespace
}  // namespace pintle
