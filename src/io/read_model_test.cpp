#include "pintle/read_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <numbers>

#include "base/constants.h"
#include "io/test_models.h"
#include "io/writers.h"
#include "pintle/results.h"

namespace pintle {
namespace {

Model full() {
  return parse_model(kFullModel, "full.toml");
}

TEST(ReadModel, HeadAndSettings) {
  const Model model = full();
  EXPECT_EQ(model.name, "Four-bar");
  EXPECT_EQ(model.description, "Two\nlines");
  EXPECT_EQ(model.space, "planar");
  EXPECT_EQ(model.gravity, (Vec2{0, -1.5}));
  EXPECT_EQ(model.simulate.duration, 0.5);
  EXPECT_DOUBLE_EQ(model.simulate.output_step, 2e-3);
  EXPECT_EQ(model.simulate.tolerance, 1e-6);
  EXPECT_EQ(model.simulate.method, "radau");
  EXPECT_EQ(model.simulate.start, Start::kUnloaded);
  EXPECT_EQ(model.simulate.max_step, 1);
}

TEST(ReadModel, Defaults) {
  const Model model = parse_model("format = 1\nbody.a = { mass = 1, inertia = 1 }", "x.toml");
  EXPECT_EQ(model.gravity, (Vec2{0, -9.80665}));
  EXPECT_EQ(model.simulate.duration, 0);
  EXPECT_EQ(model.simulate.tolerance, 1e-5);
  EXPECT_EQ(model.simulate.method, "auto");
  EXPECT_EQ(model.simulate.start, Start::kAssembled);
  EXPECT_FALSE(model.bodies[0].position || model.bodies[0].angle || model.bodies[0].velocity || model.bodies[0].spin);
}

TEST(ReadModel, BodiesAndMarkers) {
  const Model model = full();
  ASSERT_EQ(model.bodies.size(), 3U);
  const Body& crank = model.bodies[0];
  EXPECT_EQ(crank.name, "crank");
  EXPECT_EQ(crank.mass, 1);
  EXPECT_EQ(crank.inertia, 1e5);
  EXPECT_DOUBLE_EQ((*crank.position)[1], std::sqrt(3.0) / 4);
  EXPECT_DOUBLE_EQ(*crank.angle, kPi / 3);
  EXPECT_EQ((*crank.velocity)[1], 2);
  EXPECT_EQ(*crank.spin, 10);
  EXPECT_EQ(crank.hold, (std::array<bool, 3>{false, true, true}));
  ASSERT_EQ(crank.markers.size(), 2U);
  EXPECT_EQ(crank.markers[0].position, (Vec2{-0.5, 0}));
  EXPECT_DOUBLE_EQ(crank.markers[1].axis, kPi / 4);
}

TEST(ReadModel, PolarAndCartesianMarkersOfTheGround) {
  const Model model = full();
  ASSERT_EQ(model.ground.size(), 3U);
  EXPECT_EQ(model.ground[1].position, (Vec2{6, 0}));
  EXPECT_DOUBLE_EQ(model.ground[1].axis, kPi / 2);
  EXPECT_EQ(model.ground[2].position, (Vec2{1, 3}));
}

TEST(ReadModel, JointsTakeTheirOwnValuesThenDefaultsThenTheCatalogs) {
  const Model model = full();
  ASSERT_EQ(model.joints.size(), 6U);
  const auto& values = [&](std::size_t i, const char* key) { return model.joints[i].law.values.at(key); };
  EXPECT_EQ(model.joints[0].first, (MarkerRef{"ground", "O2"}));
  EXPECT_EQ(model.joints[0].second, (MarkerRef{"crank", "O2"}));
  EXPECT_EQ(values(0, "stiffness"), std::vector<double>{2e8});
  EXPECT_EQ(values(0, "damping"), std::vector<double>{3e3});
  EXPECT_EQ(values(1, "stiffness"), (std::vector<double>{1e6, 2e6}));
  EXPECT_EQ(values(1, "damping"), std::vector<double>{3500});
  EXPECT_EQ(values(2, "angular_stiffness"), std::vector<double>{5e5});
  EXPECT_EQ(values(2, "angular_damping"), std::vector<double>{7});
}

// One key gives friction to all joints that can have it: not rods, nor joints whose law already has friction, nor those that say otherwise.
TEST(ReadModel, FrictionOfTheDefaultsIsThatOfAllJointsThatCanHaveIt) {
  const std::string text = R"toml(
format = 1
[simulate]
duration = 1
[defaults.joint]
friction = "coulomb"
pin_radius = "10 mm"
friction_coefficient = 0.12
[ground.markers]
o = [0, 0]
p = [1, 0]
[body.a]
mass = 1
inertia = 1
markers.o = [0, 0]
markers.p = [1, 0]
[joint.pin]
type = "revolute"
between = ["ground.o", "a.o"]
[joint.lugre]
type = "revolute"
between = ["ground.o", "a.o"]
friction = "lugre"
friction_coefficient = 0.05
[joint.smooth]
type = "revolute"
between = ["ground.o", "a.o"]
friction = "none"
[joint.rod]
type = "rod"
between = ["ground.p", "a.p"]
length = 1
[joint.worn]
type = "revolute"
between = ["ground.o", "a.o"]
law = "clearance"
clearance = "0.1 mm"
[joint.rigid]
type = "revolute"
between = ["ground.o", "a.o"]
ideal = true
)toml";
  const Model model = parse_model(text, "x.toml");
  const auto friction = [&](std::size_t i) { return model.joints[i].friction.word; };
  ASSERT_EQ(model.joints.size(), 6U);
  EXPECT_EQ(friction(0), "coulomb");
  EXPECT_EQ(model.joints[0].friction.values.at("friction_coefficient"), std::vector<double>{0.12});
  EXPECT_EQ(friction(1), "lugre");
  EXPECT_EQ(model.joints[1].friction.values.at("friction_coefficient"), std::vector<double>{0.05});
  EXPECT_EQ(model.joints[1].friction.values.at("pin_radius"), std::vector<double>{0.01});
  for (std::size_t i = 2; i < 6; ++i) EXPECT_EQ(friction(i), "") << model.joints[i].name;
  EXPECT_EQ(parse_model(text, "x.toml", std::vector<std::string>{"defaults.joint.friction=none"}).joints[0].friction.word, "");
}

// A spring with an invalid value is not also reported as having none.
TEST(ReadModel, ASpringWithAWrongStiffnessIsComplainedAboutOnce) {
  try {
    parse_model("format = 1\n[simulate]\nduration = 1\n[ground.markers]\no = [0, 0]\n[body.a]\nmass = 1\ninertia = 1\nmarkers.c = [0, 0]\n"
                "[spring.s]\nbetween = [\"ground.o\", \"a.c\"]\nstiffness = \"40 N*m/rad\"\n", "x.toml");
    FAIL();
  } catch (const InputError& error) {
    ASSERT_EQ(error.complaints().size(), 1u);
    EXPECT_EQ(error.complaints()[0].path, "spring.s.stiffness");
  }
}

TEST(ReadModel, GeometryOfJoints) {
  const Model model = full();
  EXPECT_EQ(model.joints[3].geometry.at("radius_first"), 0.02);
  EXPECT_EQ(model.joints[3].geometry.at("radius_second"), 0.04);
  EXPECT_EQ(model.joints[3].geometry.at("internal"), 1);
  EXPECT_EQ(model.joints[4].geometry.at("length"), 1);
  EXPECT_EQ(model.joints[5].geometry.at("radius"), 0.03);
  const std::vector<std::string> external{"joint.O4.mesh=external"};
  EXPECT_EQ(parse_model(kFullModel, "x.toml", external).joints[3].geometry.at("internal"), 0);
}

TEST(ReadModel, SpringsAndForces) {
  const Model model = full();
  ASSERT_EQ(model.springs.size(), 2U);
  EXPECT_EQ(model.springs[0].stiffness, 10);
  EXPECT_EQ(model.springs[0].damping, 1);
  EXPECT_EQ(model.springs[0].free_length, 0.5);
  EXPECT_FALSE(model.springs[0].torsion || model.springs[0].preload);
  EXPECT_TRUE(model.springs[1].torsion);
  EXPECT_EQ(model.springs[1].preload, 2);
  ASSERT_EQ(model.forces.size(), 1U);
  EXPECT_TRUE(model.forces[0].body_axes);
  const double t = 0.25;
  EXPECT_DOUBLE_EQ(model.forces[0].force[0].value(std::span(&t, 1)), 10 * std::sin(0.5));
  EXPECT_EQ(model.forces[0].torque.value({}), 3);
}

TEST(ReadModel, Motors) {
  const Model model = full();
  ASSERT_EQ(model.motors.size(), 3U);
  EXPECT_EQ(model.motors[0].kind, MotorKind::kEffort);
  EXPECT_EQ(model.motors[0].law.variables(), (std::vector<std::string>{"rate", "B.slide"}));
  EXPECT_EQ(model.motors[1].kind, MotorKind::kSpeed);
  EXPECT_EQ(model.motors[1].law.value({}), 0.1);
  EXPECT_EQ(model.motors[1].stiffness, 1e5);
  EXPECT_EQ(model.motors[1].damping, 100);
  EXPECT_EQ(model.motors[2].kind, MotorKind::kPosition);
  EXPECT_EQ(model.motors[2].stiffness, 1e6);
}

// "lagrangian" is a synonym of "relative".
TEST(ReadModel, SynonymsStandForTheirWords) {
  for (const char* word : {"simulate.equations=relative", "simulate.equations=lagrangian"})
    EXPECT_EQ(parse_model(kFullModel, "x.toml", std::vector<std::string>{word}).simulate.equations, Equations::kRelative) << word;
}

TEST(ReadModel, PenaltiesAndAugmentedLagrangian) {
  const auto read = [](std::vector<std::string> overrides) {
    overrides.push_back("simulate.method=auto");
    return parse_model(kFullModel, "x.toml", overrides).simulate;
  };
  for (const Equations e : {Equations::kNewtonian, Equations::kRelative, Equations::kIdeal, Equations::kPenalty, Equations::kAugmentedLagrangian, Equations::kRelativeAugmented})
    EXPECT_EQ(read({std::string("simulate.equations=") + to_word(e)}).equations, e);
  EXPECT_EQ(read({"simulate.equations=penalty"}).penalty.factor, 1e7);
  const SimulateSettings chosen = read({"simulate.equations=penalty", "simulate.penalty=1e5", "simulate.penalty_frequency=300 rpm", "simulate.penalty_damping=0.7"});
  EXPECT_EQ(chosen.penalty.factor, 1e5);
  EXPECT_NEAR(chosen.penalty.frequency, 10 * std::numbers::pi, 1e-12);
  EXPECT_EQ(chosen.penalty.damping, 0.7);
  EXPECT_EQ(parse_model(kFullModel, "x.toml", {"simulate.equations=augmented_lagrangian", "simulate.method=trapezoidal"}).simulate.method, "ode23t");
}

// The rate of a free coordinate is named after the coordinate; `rate` alone is the slide's, if there is one.
TEST(ReadModel, RatesOfFreeCoordinates) {
  for (const char* law : {"motor.M.torque=5 N*m - 0.1*angle_rate", "motor.M.torque=5 N*m - 0.1*rate", "motor.M.torque=5 N*m - 0.2*B.slide_rate"})
    EXPECT_EQ(parse_model(kFullModel, "x.toml", std::vector<std::string>{law}).motors[0].law.variables().size(), 1U) << law;
}

TEST(ReadModel, OverridesAreReadAsTomlOrAsStrings) {
  const Model model = parse_model(kFullModel, "x.toml",
                                  {"joint.A.stiffness=2e8", "simulate.duration=0.7 s", "gravity=[0, \"-1 m/s^2\"]",
                                   "parameters.crank=2*count", "simulate.start=\"raw\"", "body.crank.mass=3"});
  EXPECT_EQ(model.joints[1].law.values.at("stiffness"), std::vector<double>{2e8});
  EXPECT_EQ(model.simulate.duration, 0.7);
  EXPECT_EQ(model.gravity[1], -1);
  EXPECT_EQ(model.bodies[0].markers[1].position[0], 3);
  EXPECT_EQ(model.simulate.start, Start::kRaw);
  EXPECT_EQ(model.bodies[0].mass, 3);
}

TEST(ReadModel, OverridesMayAddSections) {
  const Model model = parse_model("format = 1\nbody.a = { mass = 1, inertia = 1 }", "x.toml", {"simulate.duration=2"});
  EXPECT_EQ(model.simulate.duration, 2);
}

TEST(ReadModel, TheJsonTwinGivesTheSameModel) {
  const std::string json = to_json(parse_document(kFullModel, "full.toml"));
  const Model a = full();
  const Model b = parse_model(json, "full.json");
  EXPECT_EQ(a.bodies, b.bodies);
  EXPECT_EQ(a.joints, b.joints);
  EXPECT_EQ(a.springs, b.springs);
  EXPECT_EQ(a.ground, b.ground);
  EXPECT_EQ(a.motors.size(), b.motors.size());
}

TEST(ReadModel, AFileThatIsNotThere) {
  EXPECT_THROW(read_model("/nowhere/model.toml"), FileError);
}

TEST(ReadModel, LongChainsOfParametersNeedNoDeepStack) {
  std::string text = "format = 1\nbody.a = { mass = \"p20000\", inertia = 1 }\n[parameters]\np0 = 1\n";
  for (int i = 20000; i > 0; --i) text += "p" + std::to_string(i) + " = \"p" + std::to_string(i - 1) + "\"\n";
  EXPECT_EQ(parse_model(text, "x.toml").bodies[0].mass, 1);
}

// A chain of bodies, as a file.
std::string chain(int bodies) {
  std::string text = "format = 1\n[ground.markers]\nO = [0, 0]\n";
  for (int i = 0; i < bodies; ++i) {
    const std::string name = "b" + std::to_string(i);
    text += "[body." + name + "]\nmass = \"2 kg\"\ninertia = 1\nmarkers.a = [\"-1/2\", 0]\nmarkers.b = { r = 1 }\n";
    text += "[joint." + name + "]\ntype = \"revolute\"\nbetween = [\"" +
            (i == 0 ? std::string("ground.O") : "b" + std::to_string(i - 1) + ".b") + "\", \"" + name + ".a\"]\n";
  }
  return text;
}

// Processor time to read it [s].
double reading_time(int bodies) {
  const std::string text = chain(bodies);
  const std::clock_t start = std::clock();
  EXPECT_EQ(parse_model(text, "x.toml").joints.size(), static_cast<std::size_t>(bodies));
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

TEST(ReadModel, TimeIsLinearInTheNumberOfBodies) {
  reading_time(500);  // the first call is slower
  EXPECT_LT(reading_time(8000), 5 * 8 * reading_time(1000)) << "64 times if it were quadratic";
}

TEST(ReadModel, Bearings) {
  const Model model = parse_model(kFullModel, "full.toml",
                                  {"joint.O2.bearing.type=ball", "joint.O2.bearing.dynamic_load_rating=9.56 kN", "joint.A.bearing={ pin_diameter = \"20 mm\", pin_length = 0.025 }"});
  ASSERT_TRUE(model.joints[0].bearing && model.joints[1].bearing);
  EXPECT_EQ(*model.joints[0].bearing, (Bearing{.type = "ball", .dynamic_load_rating = 9560}));
  EXPECT_EQ(*model.joints[1].bearing, (Bearing{.type = "", .pin_diameter = 0.020, .pin_length = 0.025}));
  EXPECT_FALSE(model.joints[2].bearing);
}

TEST(ReadModel, ABearingHasThePinThatRubs) {
  const auto with_radius = [](const std::string& radius) {
    return parse_model(kFullModel, "full.toml", {"joint.A.friction=coulomb", "joint.A.friction_coefficient=0.1", "joint.A.pin_radius=" + radius, "joint.A.bearing={ pin_diameter = \"20 mm\", pin_length = 0.025 }"});
  };
  EXPECT_EQ(with_radius("10 mm").joints[1].bearing->pin_diameter, 0.020);
  try {
    with_radius("20 mm");
    FAIL();
  } catch (const InputError& error) {
    ASSERT_EQ(error.complaints().size(), 1u);
    EXPECT_EQ(error.complaints()[0].path, "joint.A.bearing.pin_diameter");
    EXPECT_EQ(error.complaints()[0].because, "the joint's own pin_radius is 0.02 m, which is another pin");
  }
}

// Keys that both laws have are kept, those of the former law alone are dropped, and a note says so.
TEST(ReadModel, ALawIsChosenWithItsKeys) {
  const Model model = parse_model(kFullModel, "full.toml", {"--law joint.A=maxwell,branch_ratio=[1, 2],branch_time=[\"10 ms\", 0.1],damping='7 N*s/m'"});
  const LawChoice& law = model.joints[1].law;
  EXPECT_EQ(law.word, "maxwell");
  EXPECT_EQ(law.values.at("branch_ratio"), (std::vector<double>{1, 2}));
  EXPECT_EQ(law.values.at("branch_time"), (std::vector<double>{0.01, 0.1}));
  EXPECT_EQ(law.values.at("damping"), (std::vector<double>{7}));
  EXPECT_EQ(law.values.at("stiffness"), (std::vector<double>{1e6, 2e6}));
  ASSERT_EQ(model.notes.size(), 1U);
  EXPECT_EQ(model.notes[0], "joint A: law maxwell instead of linear; with the joint's own stiffness");
  const Model back = parse_model(kFullModel, "full.toml", {"--law joint.A=maxwell,branch_ratio=[1],branch_time=[1]", "--law joint.A=linear", "joint.A.damping=9"});
  EXPECT_EQ(back.joints[1].law.word, "linear");
  EXPECT_EQ(back.joints[1].law.values.at("damping"), (std::vector<double>{9}));
  EXPECT_EQ(back.notes.back(), "joint A: law linear instead of maxwell; with the joint's own stiffness, damping; without branch_ratio, branch_time, which it does not have");
}

// One key makes a worn pin ideal and worn again: the keys of the law that is not stated are kept in waiting.
TEST(ReadModel, KeysOfAnotherLawWaitWhereALawIsStated) {
  const Model model = parse_model(kFullModel, "full.toml", {"joint.A.law=\"linear\"", "joint.A.clearance=\"0.1 mm\"", "joint.A.restitution=0.9"});
  EXPECT_EQ(model.joints[1].law.values.count("clearance"), 0U);
  EXPECT_EQ(model.notes.at(0), "joint A: clearance, restitution are keys of other laws than the stated one, without effect");
  EXPECT_EQ(parse_model(kFullModel, "full.toml", {"joint.A.law=\"linear\"", "joint.A.clearance=\"0.1 mm\""}).notes.at(0), "joint A: clearance is a key of other laws than the stated one, without effect");
  EXPECT_THROW(parse_model(kFullModel, "full.toml", {"joint.O2.clearance=\"0.1 mm\""}), InputError);
  EXPECT_THROW(parse_model(kFullModel, "full.toml", {"joint.A.law=\"linear\"", "joint.A.notch_width=0.01"}), InputError);
}

// The name of a friction law chooses the friction; the law that holds the joint keeps its keys.
TEST(ReadModel, FrictionIsChosenLikeALaw) {
  const Model model = parse_model(kFullModel, "full.toml", {"--law joint.A=lugre,pin_radius=12 mm"});
  EXPECT_EQ(model.joints[1].law, parse_model(kFullModel, "full.toml").joints[1].law);
  EXPECT_EQ(parse_model(kFullModel, "full.toml", {"--law joint.O2=bushing"}).notes.at(0), "joint O2: law bushing instead of linear; with stiffness of defaults.joint");
  EXPECT_EQ(model.joints[1].friction.word, "lugre");
  EXPECT_EQ(model.joints[1].friction.values.at("pin_radius"), (std::vector<double>{0.012}));
  EXPECT_EQ(model.notes.at(0), "joint A: friction lugre");
}

TEST(ReadModel, DefaultsGiveWhatALawRequires) {
  const auto model = [](const std::string& defaults, const std::string& law) {
    return parse_model("format = 1\n[defaults.joint]\n" + defaults + R"toml(
[table.measured]
x = [0, 1e-4, 1e-3]
y = [0, 10, 200]
[ground.markers]
o = [0, 0]
[body.bob]
mass = 1
inertia = 1
position = [0, 0]
angle = 0
markers.o = [0, 0]
[joint.pin]
type = "revolute"
between = ["ground.o", "bob.o"]
)toml" + law,
                       "defaults.toml");
  };
  EXPECT_EQ(model("clearance = 2e-4", "law = \"clearance\"").joints.at(0).law.values.at("clearance"), (std::vector<double>{2e-4}));
  EXPECT_EQ(model("curve = \"measured\"", "law = \"table\"").joints.at(0).law.values.at("force"), (std::vector<double>{0, 10, 200}));
  EXPECT_THROW(model("stiffness = 1e8", "law = \"clearance\""), InputError);
}

TEST(ReadModel, AChosenLawKeepsWhatFrictionNeeds) {
  const Model model = parse_model(kFullModel, "full.toml", {"--law joint.A=lugre,pin_radius=12 mm", "--law joint.A=linear,stiffness=1e7"});
  EXPECT_EQ(model.joints[1].friction.values.at("pin_radius"), (std::vector<double>{0.012}));
  EXPECT_EQ(model.joints[1].law.values.at("stiffness"), (std::vector<double>{1e7}));
}

}  // namespace
}  // namespace pintle
