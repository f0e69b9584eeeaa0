// Published and computed mechanisms with clearance and contact: when the bodies touch, let go, and where they are.
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

// Source: the published problem of P. Flores and others, computed with an event-driven program of 8 to 9 digits: times of touch and let-go,
// then the slider's place and speed.
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

// P. E. Nikravesh, Planar Multibody Dynamics, 2nd ed., CRC Press 2018, model Rod; computed with an event-driven program to 8 digits.
TEST(Contact, AFallingRodRattlesBetweenItsEnds) {
  constexpr double kTouches[] = {0.04700898820430489, 0.10935032212720068, 0.12597334980893377, 0.13432838087504526, 0.1396862682526294,  0.1436713356095538,  0.14697385238236665, 0.14996495184321443,
                                 0.15289992930636037, 0.15601489000790122, 0.15960793822564898, 0.16417106018975822, 0.17072334862613933, 0.18197188533309142, 0.2085576314089762};
  constexpr double kLetGoes[] = {0.04702738027060336, 0.10936154350042714, 0.12598342460425316, 0.13433789864449974};
  const Followed run = follow(rod(), 1e-10, 1, {.stages = 5});
  ASSERT_EQ(run.contacts.size(), 30u);
  for (int i = 0; i < 15; ++i) {
    EXPECT_NEAR(run.contacts[2 * i].t, kTouches[i], 1e-7) << i;
    EXPECT_EQ(run.contacts[2 * i].joint, i % 2) << i;
  }
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(run.contacts[2 * i + 1].t, kLetGoes[i], 1e-7) << i;
  EXPECT_NEAR(run.end.q[0][1], 0.7976752390296686, 1e-6);
  EXPECT_NEAR(run.end.q[0][2], 7.77522062845828, 1e-5);
}

}  // namespace
}  // namespace pintle
