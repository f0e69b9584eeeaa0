// Pins with clearance and contact with an edge, in whole runs: closed forms of impacts, balances, every method.
#include <gtest/gtest.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "laws/contact/contact.h"
#include "pintle/check.h"
#include "system/build.h"
#include "tests/contact_runs.h"
#include "tests/reference_tables.h"

namespace pintle {
namespace {

using contacts::follow;
using contacts::Followed;

Model thrown(const std::string& law, const std::string& duration = "0.1 s") {
  return parse_model(fmt::format(R"toml(
format = 1
gravity = [0, 0]
[simulate]
duration = "{}"
start = "raw"
[ground.markers]
o = {{ x = 0, y = 0 }}
[body.block]
mass = 2
inertia = 0.01
position = [0, 0.01]
velocity = [0, -0.5]
angle = 0
spin = 0
markers.c = {{ x = 0, y = 0 }}
[joint.edge]
type = "slot"
between = ["ground.o", "block.c"]
law = "contact"
pin_radius = 0
{}
)toml",
                                 duration, law),
                     "thrown.toml");
}

// --- A free impact ---

TEST(Contact, AFreeImpactReturnsWhatItsHysteresisSays) {
  const std::array<std::pair<const char*, ContactModel>, 5> models{{{"exact", ContactModel::kExact},
                                                                    {"lankarani-nikravesh", ContactModel::kLankaraniNikravesh},
                                                                    {"hunt-crossley", ContactModel::kHuntCrossley},
                                                                    {"flores", ContactModel::kFlores},
                                                                    {"gonthier", ContactModel::kGonthier}}};
  for (const auto& [word, model] : models)
    for (const double asked : {0.5, 0.9})
      for (const double exponent : {1.5, 2.0}) {
        const Followed run = follow(thrown(fmt::format("contact_model = \"{}\"\nrestitution = {}\ncontact_stiffness = 1e7\ncontact_exponent = {}\nleast_approach_speed = 1e-6", word, asked, exponent)), 1e-11, 0.1, {});
        const double h = hysteresis_of(model, asked), e = restitution_of(h);
        EXPECT_NEAR(h * (1 + e), std::log((1 + h) / (1 - h * e)), 1e-12);
        if (model == ContactModel::kExact) { EXPECT_NEAR(e, asked, 1e-12); }
        ASSERT_EQ(run.contacts.size(), 2u) << word;
        EXPECT_NEAR(run.contacts[0].t, 0.02, 1e-10) << word;
        EXPECT_NEAR(run.end.v[0][1] / 0.5, e, 1e-9) << word << ' ' << asked << ' ' << exponent;
        EXPECT_NEAR(run.end.dissipated, 0.5 * 2 * 0.25 * (1 - e * e), 1e-9) << word;
      }
}

// METHOD: with 0.5 asked for, the published laws return other restitutions.
TEST(Contact, ThePublishedLawsDoNotReturnTheRestitutionAskedFor) {
  EXPECT_NEAR(restitution_of(hysteresis_of(ContactModel::kHuntCrossley, 0.5)), 0.663, 5e-4);
  EXPECT_NEAR(restitution_of(hysteresis_of(ContactModel::kLankaraniNikravesh, 0.5)), 0.725, 5e-4);
  EXPECT_NEAR(restitution_of(hysteresis_of(ContactModel::kFlores, 0.5)), 0.470, 5e-4);
  EXPECT_NEAR(restitution_of(hysteresis_of(ContactModel::kGonthier, 0.5)), 0.488, 5e-4);
  for (double e = 0.02; e <= 1; e += 0.02) EXPECT_NEAR(restitution_of(hysteresis_of(ContactModel::kExact, e)), e, 1e-12);
}

// Spring and damper: until the force vanishes, x = v/w_d exp(-z w t) sin(w_d t) ends at tan(w_d t) = -.. in closed form; with attraction kept it ends at half a
// period. The force jumps at the touch, which is crossed by 1e-9 of a step.
TEST(Contact, ALinearContactEndsWhereItsForceVanishesOrWhereTheBodiesPart) {
  const double m = 2, k = 1e7, v = 0.5;
  for (const double ratio : {0.09, 0.88}) {
    const double w = std::sqrt(k / m), c = 2 * ratio * m * w, wd = w * std::sqrt(1 - ratio * ratio), angle = std::acos(ratio);
    const auto speed = [&](double t) { return v * std::exp(-ratio * w * t) * (std::cos(wd * t) - ratio * w / wd * std::sin(wd * t)); };
    const double part = std::numbers::pi / wd, vanish = 2 * angle / wd;  // k x + c x' = 0 at phase 2 acos(ratio)
    for (const bool kept : {false, true}) {
      const double lasts = kept ? part : vanish;
      const Followed run = follow(thrown(fmt::format("contact_model = \"linear\"\ncontact_stiffness = {}\ncontact_damping = {}\nattraction = \"{}\"", k, c, kept ? "kept" : "cut-off")), 1e-11, 0.1, {});
      EXPECT_NEAR(run.end.v[0][1], -speed(lasts), 1e-8) << ratio << ' ' << kept;
      EXPECT_NEAR(run.end.dissipated, 0.5 * m * (v * v - speed(lasts) * speed(lasts)), 1e-8) << ratio << ' ' << kept;
      ASSERT_EQ(run.contacts.size(), 2u);
      if (kept) { EXPECT_NEAR(run.contacts[1].t - run.contacts[0].t, part, 1e-9) << ratio; }
    }
  }
}

// --- Balances ---

// Two free bodies, a bush and a pin that flies about in it and rubs: no external force acts, so that both momenta are constant.
TEST(Contact, NoMomentumIsLostWherePinAndBushRub) {
  const Model model = parse_model(R"toml(
format = 1
gravity = [0, 0]
[simulate]
duration = "0.1 s"
start = "raw"
[ground.markers]
o = { x = 0, y = 0 }
[body.bush]
mass = 2
inertia = 0.02
position = [0, 0]
velocity = [0.1, 0]
angle = 0.3
spin = 5
markers.c = { x = 0.1, y = 0.02 }
[body.pin]
mass = 1
inertia = 0.003
position = [0.2, 0.1]
velocity = [-0.3, 0.2]
angle = 0
spin = -20
markers.c = { x = -0.11037, y = -0.05134 }
[joint.b]
type = "revolute"
between = ["bush.c", "pin.c"]
law = "clearance"
clearance = 0.001
pin_radius = 0.01
contact_stiffness = 1e9
restitution = 0.7
friction_coefficient = 0.3
)toml",
                                  "free.toml");
  const System system = build_system(model);
  const auto momenta = [&system](const State& s) {
    Planar::Vec sum = Planar::Vec::Zero();
    for (int i = 0; i < 2; ++i) {
      const Planar::Vec p = system.bodies[i].mass.cwiseProduct(s.v[i]);
      sum += Planar::Vec(p[0], p[1], p[2] + s.q[i][0] * p[1] - s.q[i][1] * p[0]);
    }
    return sum;
  };
  const State start = start_of_run(model).state;
  const Followed run = follow(model, 1e-8, 0.1, {});
  EXPECT_GT(run.contacts.size(), 4u);
  EXPECT_LE((momenta(run.end) - momenta(start)).cwiseAbs().maxCoeff(), 1e-13);  // measured: 4e-15. The steps' error of the angular momentum is 1e-11 at a tolerance of 1e-6
  EXPECT_GT(run.end.dissipated, 0.01);
}

// A block thrown along an edge onto which it is pressed: friction takes mu times the impulse of the normal force, however that varies.
TEST(Contact, FrictionTakesItsShareOfTheNormalImpulse) {
  const double mu = 0.25, v0 = 2, g = 9.81;
  const Model model = parse_model(fmt::format(R"toml(
format = 1
gravity = [0, {}]
[simulate]
duration = "0.5 s"
start = "raw"
[ground.markers]
o = {{ x = 0, y = 0 }}
[body.block]
mass = 2
inertia = 1e6
position = [0, 0.001]
velocity = [{}, 0]
angle = 0
spin = 0
markers.c = {{ x = 0, y = 0 }}
[joint.edge]
type = "slot"
between = ["ground.o", "block.c"]
law = "contact"
pin_radius = 0
contact_stiffness = 1e9
restitution = 0.5
friction_coefficient = {}
)toml",
                                          -g, v0, mu),
                              "thrown.toml");
  const Followed run = follow(model, 1e-7, 0.5, {});
  EXPECT_GE(run.contacts.size(), 3u);  // it bounces before it slides
  EXPECT_NEAR(run.end.v[0][0], v0 - mu * (g * 0.5 + run.end.v[0][1]), 1e-8);
}

// A slider loaded off its middle lies on one wall, and its ends share the load by the lever; with the load beyond an end it tilts between both walls.
TEST(Contact, TheEndsOfALooseSliderShareItsLoadByTheLever) {
  const double load = 100, length = 0.1;
  for (const double arm : {0.02, 0.08}) {
    const Trajectory run = simulate(parse_model(fmt::format(R"toml(
format = 1
gravity = [0, 0]
[simulate]
duration = "0.5 s"
tolerance = 1e-5
[ground.markers]
o = {{ x = 0, y = 0 }}
[body.block]
mass = 2
inertia = 0.005
position = [0, 0]
velocity = [0, 0]
angle = 0
spin = 0
markers.c = {{ x = 0, y = 0 }}
markers.f = {{ x = {}, y = 0 }}
[joint.guide]
type = "prismatic"
between = ["ground.o", "block.c"]
law = "clearance"
clearance = 0.0001
guide_length = {}
contact_stiffness = 1e9
restitution = 0.2
[force.f]
on = "block.f"
force = [0, {}]
)toml",
                                                            arm, length, -load),
                                                "slider.toml"));
    ASSERT_EQ(run.outcome, Outcome::kCompleted) << run.message;
    const auto last = [&run](const char* column) { return run.at(run.n_rows() - 1, static_cast<std::size_t>(run.column(column))); };
    EXPECT_NEAR(last("joint.guide.contact_force_front"), load * (0.5 + arm / length), 1e-2 * load);
    EXPECT_NEAR(last("joint.guide.contact_force_rear"), std::abs(load * (0.5 - arm / length)), 1e-2 * load);
    ASSERT_EQ(run.events.size(), 1u);
    EXPECT_EQ(run.events[0].joint, "guide");
    ASSERT_EQ(run.events[0].columns.size(), 8u);  // those of the law and the heat
    EXPECT_EQ(run.events[0].columns.back().name, "heat");
    EXPECT_EQ(run.events[0].events.front().values.size(), 8u);
  }
}

TEST(Contact, ARunListsItsTouches) {
  const Trajectory run = simulate(thrown("contact_stiffness = 1e7\nrestitution = 0.5"));
  ASSERT_EQ(run.events.size(), 1u);
  ASSERT_EQ(run.events[0].events.size(), 2u);
  EXPECT_EQ(run.events[0].events[0].what, "touch");
  EXPECT_NEAR(run.events[0].events[0].t, 0.02, 1e-8);
  EXPECT_EQ(run.events[0].columns[3].name, "approach_speed");
  EXPECT_NEAR(run.events[0].events[0].values[3], 0.5, 1e-8);
  EXPECT_EQ(run.events[0].events[1].what, "let-go");
}

TEST(Contact, BodiesThatStartInsideEachOtherAreRefused) {
  Model model = thrown("contact_stiffness = 1e7");
  model.ground[0].position = {0, 0.5};
  try {
    simulate(model);
    ADD_FAILURE() << "it ran";
  } catch (const AssemblyError& error) {
    EXPECT_NE(std::string(error.what()).find("joint edge: its bodies start 0.49 m inside each other"), std::string::npos) << error.what();
    EXPECT_EQ(std::string(error.what()).find("assembly"), std::string::npos) << error.what();
  }
}

// Where assembly has moved them there, the message says so.
TEST(Contact, BodiesThatAssemblyPutsInsideEachOtherAreRefusedWithWhatItDid) {
  try {
    simulate(reference::test_model("walker_in_the_floor"));
    ADD_FAILURE() << "it ran";
  } catch (const AssemblyError& error) {
    EXPECT_NE(std::string(error.what()).find("inside each other"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("body trunk: assembly turned it by"), std::string::npos) << error.what();
  }
}

// A pendulum that falls onto a floor starts as one without a floor, whatever the duration: a floor that it does not touch does not hold it.
TEST(Contact, AFloorBelowDoesNotMatterAtTheStart) {
  const auto pendulum = [](double duration, const std::string& floor) {
    return parse_model(fmt::format(R"toml(
format = 1
name = "Pendulum over a floor"
[simulate]
duration = {}
[ground.markers]
pin = [0, 0]
floor = [0, -0.25]
[body.rod]
mass = 0.16
inertia = 1.9e-3
position = [0.14, 0.065]
angle = 0.44
spin = -2.5
hold = ["angle"]
markers.pin = [-0.15, 0]
markers.tip = [0.15, 0]
[joint.pin]
type = "revolute"
between = ["ground.pin", "rod.pin"]
stiffness = 1e8
damping = 1e3
{})toml", duration, floor), "floor.toml");
  };
  const std::string floor = R"toml([joint.floor]
type = "slot"
between = ["ground.floor", "rod.tip"]
law = "contact"
contact_exponent = 1
contact_stiffness = 1e9
pin_radius = 4e-3
restitution = 0.4
)toml";
  for (const double duration : {1e-5, 0.02}) {
    const Trajectory with = simulate(pendulum(duration, floor)), without = simulate(pendulum(duration, ""));
    EXPECT_TRUE(with.notes.empty()) << with.notes.front();
    for (const char* column : {"joint.pin.on_rod.fx[world]", "joint.pin.on_rod.fy[world]"})
      for (const std::size_t row : {std::size_t{0}, with.n_rows() - 1}) EXPECT_NEAR(with.at(row, with.column(column)), without.at(row, without.column(column)), 1e-5) << column << ' ' << duration;
  }
}

// --- Every method ---

TEST(Contact, EveryMethodTouchesAndLetsGo) {
  for (const std::string method : {"radau", "dopri5", "ode45", "ode15s", "ode113", "ode23t", "hht", "generalised_alpha"}) {
    MethodChoice choice{.method = method};
    if (!why_not(choice).empty()) continue;
    const double tolerance = method == "radau" || method == "dopri5" ? 1e-7 : method.starts_with("ode") ? 1e-9 : 1e-8;
    const Followed run = follow(thrown("contact_stiffness = 1e7\nrestitution = 0.5"), tolerance, 0.1, choice);
    ASSERT_EQ(run.contacts.size(), 2u) << method;
    EXPECT_NEAR(run.contacts[0].t, 0.02, 1e-5) << method;
    EXPECT_NEAR(run.end.v[0][1], 0.25, 1e-3) << method;
  }
}

// A block that falls 10 mm on an edge of 1e8 N/m and 1e4 N s/m. The contact's steps are a ten-thousandth of the flight's; those that lead up to a release begin
// at their own length, not at that of the flight. m d'' = m g - k d - c d' while k d + c d' > 0, then flight.
TEST(LinearContact, BouncesAsInClosedFormAndComesToRest) {
  constexpr double kG = 9.80665, kMass = 2, kStiff = 1e8, kDamp = 1e4, kHeight = 0.01;
  const double decay = kDamp / (2 * kMass), w = std::sqrt(kStiff / kMass - decay * decay), rest = kMass * kG / kStiff;
  struct FreeFlight {
    double begin, speed;  // upwards
  };
  std::vector<FreeFlight> flights;
  double touch = std::sqrt(2 * kHeight / kG), speed = kG * touch;
  for (int bounce = 0; bounce < 3; ++bounce) {
    const auto motion = [&](double s) {
      const double A = -rest, B = (speed + decay * A) / w, e = std::exp(-decay * s), c = std::cos(w * s), n = std::sin(w * s);
      return std::array{rest + e * (A * c + B * n), e * ((w * B - decay * A) * c - (w * A + decay * B) * n)};
    };
    double low = 1e-5, high = 6e-4;  // the force is zero between
    for (int k = 0; k < 60; ++k) {
      const double s = 0.5 * (low + high);
      const auto [depth, rate] = motion(s);
      (kStiff * depth + kDamp * rate > 0 ? low : high) = s;
    }
    const auto [depth, rate] = motion(low);
    const double apart = (-rate - std::sqrt(rate * rate - 2 * kG * depth)) / kG;
    flights.push_back({touch + low + apart, -(rate + kG * apart)});
    touch = flights.back().begin + 2 * flights.back().speed / kG;
    speed = flights.back().speed;
  }
  for (const double tolerance : {1e-4, 1e-5}) {
    Model model = parse_model(R"toml(
format = 1
[simulate]
duration = "0.4 s"
output_step = "1 ms"
[ground.markers]
O = [0, 0]
[body.block]
mass = 2
inertia = 0.0025
position = [0, "10 mm"]
angle = 0
velocity = [0, 0]
spin = 0
markers.c = [0, 0]
[joint.edge]
type = "slot"
between = ["ground.O", "block.c"]
law = "contact"
pin_radius = 0
contact_model = "linear"
contact_stiffness = 1e8
contact_damping = 1e4
contact_exponent = 1
)toml",
                              "falls.toml");
    model.simulate.tolerance = tolerance;
    const Trajectory run = reference::completed(model);
    int compared = 0;
    for (std::size_t i = 0; i < run.n_rows(); ++i)
      for (const FreeFlight& flight : flights) {
        const double s = run.at(i, 0) - flight.begin;
        if (s < 0 || s > 2 * flight.speed / kG) continue;
        EXPECT_NEAR(reference::value(run, i, "body.block.y"), flight.speed * s - 0.5 * kG * s * s, 1e-7) << run.at(i, 0);
        ++compared;
      }
    EXPECT_GT(compared, 50);
    EXPECT_NEAR(reference::at_end(run, "joint.edge.contact_force"), kMass * kG, 1e-4);
    EXPECT_LT(run.counters.steps, 10000) << tolerance;
  }
}

std::string foot(const std::string& name) {
  return fmt::format("[joint.{0}]\ntype = \"slot\"\nbetween = [\"ground.t\", \"part.{0}\"]\nlaw = \"contact\"\npin_radius = 0\ncontact_stiffness = 1e6\ncontact_exponent = 1\nfriction_coefficient = 0.2\n", name);
}

// A block on two feet; its height decides how deep it presses them into a table, and its start whether it rests on it yet.
Model block_on_table(const std::string& height, const std::string& start) {
  return parse_model(fmt::format(R"toml(
format = 1
[simulate]
duration = "0.2 s"
start = "{}"
[ground.markers]
t = [0, 0]
[body.part]
mass = "0.2 kg"
inertia = "1e-4 kg*m^2"
position = [0, "{}"]
angle = 0
markers.f1 = ["-10 mm", "-20 mm"]
markers.f2 = ["10 mm", "-20 mm"]
{}{})toml", start, height, foot("f1"), foot("f2")), "block.toml");
}

// Friction with a ramp is linear where it begins at rest.
TEST(Contact, TheSlopeOfFrictionAtRestIsThatOfItsRamp) { EXPECT_TRUE(check_model(block_on_table("19.999 mm", "assembled")).jacobians.passed()); }

// Bodies that are to settle first may be stated inside each other: they are checked at rest.
TEST(Contact, IsCheckedWhereBodiesSettle) { EXPECT_TRUE(check_model(block_on_table("10 mm", "settled")).jacobians.passed()); }

// A touch of 0.1 ms after a flight of half a second: its end lies within a distance that is too small a part of the flight to take steps through.
TEST(LinearContact, TouchesMuchShorterThanTheFlightKeepTheirEnergy) {
  for (const double stiffness : {1e7, 1e8, 1e9, 1e10})
    for (const double tolerance : {1e-3, 1e-5}) {
      Model model = reference::test_model("ball_on_stiff_linear_contact");
      model.simulate.tolerance = tolerance;
      auto& law = model.joints[0].law.values;
      law["contact_stiffness"] = {stiffness};
      law["contact_damping"] = {0.0};
      const Trajectory run = reference::completed(model);
      const double energy = run.energy.kinetic_end + run.energy.potential_end, before = run.energy.kinetic_start + run.energy.potential_start;
      EXPECT_NEAR(energy, before, 1e-4 * before) << stiffness << " " << tolerance;
      EXPECT_LT(std::abs(run.energy.dissipated), 1e-4 * before) << stiffness << " " << tolerance;
    }
}

// Roundoff puts surfaces that touch as assembled just apart or just into each other; they count either way.
TEST(Contact, SurfacesThatTouchHoldWhateverTheRoundoff) {
  for (const char* slope : {"30 deg", "45 deg", "50 deg", "60 deg", "70 deg"}) {
    const CheckReport report = check_model(reference::test_model("ladder_on_a_wall", {"parameters.slope=\"" + std::string(slope) + "\""}));
    EXPECT_EQ(report.mobility.mobility, 1) << slope;
    EXPECT_EQ(report.mobility.constraints, 2) << slope;
  }
}

}  // namespace
}  // namespace pintle
