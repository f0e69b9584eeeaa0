// Every kind of mistake in a model file is found, at its line and column, with its path and a reason.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "io/test_models.h"
#include "pintle/read_model.h"

namespace pintle {
namespace {

// One piece of the full model is replaced; in the replacement, @ precedes the character that the complaint should point at.
struct Mistake {
  const char* piece;
  const char* replacement;
  const char* path;
  const char* because;          // part of the reason
  const char* suggestion = "";  // part of it
};

std::vector<Complaint> complaints_about(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    parse_model(text, "m.toml", overrides);
  } catch (const InputError& error) {
    return error.complaints();
  }
  return {};
}

const std::vector<Mistake> kMistakes{
    {"type = \"revolute\"\nbetween", "type = \"revolute\"\nstops = \"@soft\"\nbetween", "joint.O2.stops", "none of hard, cushioned, none"},
    {"type = \"revolute\"\nbetween", "type = \"revolute\"\nstops = \"@hunt-crossley\"\nbetween", "joint.O2.stops", "none of hard, cushioned", "stop_model = \"hunt-crossley\""},
    {"type = \"revolute\"\nbetween", "type = \"@hinge\"\nbetween", "joint.O2.type", "it is none of revolute", "revolute"},
    {"type = \"revolute\"\nbetween", "type = \"revolute\"\nstops = \"hard\"\nstop_stiffness = 1\nupper_stop = 2\nstop_restitution = @0\nbetween", "joint.O2.stop_restitution", "greater than 0", "0.01"},
    {"type = \"revolute\"\nbetween", "type = \"revolute\"\nlaw = \"@coulomb\"\nbetween", "joint.O2.law", "none of", "friction = \"coulomb\""},
    {"type = \"revolute\"\nbetween", "type = \"revolute\"\n@preload = 5\nbetween", "joint.O2.preload", "belongs to law", "or friction_preload if friction is meant"},
    {"type = \"revolute\"\nbetween", "type = \"revolute\"\n@restitution = 0.5\nbetween", "joint.O2.restitution", "belongs to law", "or stop_restitution if the stops are meant"},
    {"type = \"revolute\"\nbetween", "type = \"revolute\"\n@upper_stop = 1\nbetween", "joint.O2.upper_stop", "belongs to stops = \"hard\" or stops = \"cushioned\""},
    {"type = \"revolute\"\nbetween", "type = \"revolute\"\nstops = \"@hard\"\nstop_stiffness = 1\nbetween", "joint.O2.stops", "neither lower_stop nor upper_stop"},
    {"type = \"revolute\"\nbetween", "type = \"revolute\"\nstops = \"hard\"\nstop_stiffness = 1\nlower_stop = \"@90 deg\"\nupper_stop = 1\nbetween", "joint.O2.lower_stop", "is not below upper_stop"},
    {"type = \"revolute\"\nbetween", "type = \"revolute\"\nstops = \"hard\"\nstop_stiffness = 1\nupper_stop = \"@5 mm\"\nbetween", "joint.O2.upper_stop", "an angle [rad] is expected"},
    {"type = \"revolute\"\nbetween", "type = \"revolute\"\nstops = \"hard\"\nstop_stiffness = \"@1 N/m\"\nupper_stop = 2\nbetween", "joint.O2.stop_stiffness", "is expected"},
    {"type = \"revolute\"\nbetween", "type = \"revolute\"\nstops = \"hard\"\nstop_stiffness = 1\nupper_stop = 2\nstop_restitution = @1.5\nbetween", "joint.O2.stop_restitution", "would gain energy"},
    {"type = \"revolute\"\nbetween", "type = \"revolute\"\nstops = \"hard\"\nstop_stiffness = 1\nupper_stop = 2\nstop_model = \"linear\"\nstop_restitution = @0.5\nbetween", "joint.O2.stop_restitution", "damped by stop_damping alone", "stop_model = \"exact\""},
    {"type = \"revolute\"\nbetween", "type = \"revolute\"\nstops = \"hard\"\nstop_stiffness = 1\nupper_stop = 2\nstop_model = \"linear\"\nstop_exponent = @1.5\nbetween", "joint.O2.stop_exponent", "as the depth itself", "stop_model = \"exact\""},
    {"type = \"revolute\"\nbetween", "type = \"revolute\"\nstops = \"hard\"\nstop_stiffness = 1\nupper_stop = 2\nstop_damping_factor = 0.1\nstop_restitution = @0.5\nbetween", "joint.O2.stop_restitution", "that of stop_damping_factor", "one of the two"},
    {"type = \"revolute\"\nbetween", "type = \"revolute\"\nstops = \"hard\"\nstop_stiffness = 1\nupper_stop = 2\nstop_damping = @5\nbetween", "joint.O2.stop_damping", "of the linear model only", "stop_model = \"linear\""},
    {"angular_stiffness = \"5e5 N*m/rad\"", "stops = \"cushioned\"\nstop_stiffness = 1\nstop_damping = 1\nstop_cushion = \"@3 deg\"\nupper_stop = 2", "joint.B.stop_cushion", "a length [m] is expected"},
    {"radius = \"30 mm\"", "radius = \"30 mm\"\nstops = \"@hard\"\nstop_stiffness = 1\nupper_stop = 2", "joint.K.stops", "a rack joint cannot have it"},
    {"length = \"1 m\"", "length = \"@2 m/s*t\"", "joint.R.length", "greater than 0"},
    {"length = \"1 m\"", "length = \"@1 s + t\"", "joint.R.length", "a length [m] is expected"},
    {"[joint.B]", "[joint.O2.bearing]\ntype = \"@needle\"\n\n[joint.B]", "joint.O2.bearing.type", "none of ball, roller"},
    {"[joint.B]", "[joint.O2.bearing]\ndynamic_load_rating = @0\n\n[joint.B]", "joint.O2.bearing.dynamic_load_rating", "greater than 0"},
    {"[joint.B]", "[joint.O2.bearing]\ndynamic_load_rating = \"@-5 kN\"\n\n[joint.B]", "joint.O2.bearing.dynamic_load_rating", "greater than 0"},
    {"[joint.B]", "[joint.O2.bearing]\npin_diameter = \"@20 N\"\n\n[joint.B]", "joint.O2.bearing.pin_diameter", "a length [m] is expected"},
    {"[joint.B]", "[joint.O2.bearing]\n@pin_diametre = 1\n\n[joint.B]", "joint.O2.bearing.pin_diametre", "no such key", "pin_diameter"},
    {"angular_stiffness = \"5e5 N*m/rad\"", "@bearing = { type = \"ball\" }", "joint.B.bearing", "a prismatic joint has no pin", "revolute"},
    {"stiffness = [\"1e6 N/m\", \"2e6 N/m\"]", "bearing = @3", "joint.A.bearing", "a table is expected"},
    {"method = \"radau\"\nstart = \"unloaded\"", "start = \"@settled\"\nequations = \"ideal\"", "simulate.start", "these equations cannot bring a mechanism"},
    {"format = 1\n", "@name2 = 1\nformat = 1\n", "name2", "no such key", "did you mean \"name\"?"},
    {"format = 1\n", "format = @2\n", "format", "newer than the program"},
    {"format = 1\n", "format = @0\n", "format", "at least 1"},
    {"format = 1\n", "format = \"@1\"\n", "format", "whole number"},
    {"format = 1\nname", "@name", "format", "required"},
    {"name = \"Four-bar\"", "name = @3", "name", "a string is expected"},
    {"space = \"planar\"", "space = \"@spatial\"", "space", "not available yet"},
    {"space = \"planar\"", "space = \"@plana\"", "space", "none of planar, spatial", "did you mean \"planar\"?"},
    {"gravity = [0, \"-1.5 m/s^2\"]", "gravity = @9.81", "gravity", "a list of 2 numbers"},
    {"gravity = [0, \"-1.5 m/s^2\"]", "gravity = [0, \"@-1.5 m/s\"]", "gravity", "an acceleration [m/s^2] is expected"},
    {"[parameters]\n", "[parameters]\nh = 3\nv = \"2 mm/@h\"\n", "parameters.v", "could be the unit h as well"},
    {"[parameters]\n", "[parameters]\n@t = 3\n", "parameters.t", "time"},
    {"[parameters]\n", "[parameters]\n@sin = 3\n", "parameters.sin", "name of a function"},
    {"[parameters]\n", "[parameters]\n@pi = 3\n", "parameters.pi", "constant"},
    {"[parameters]\n", "[parameters]\n@a-b = 3\n", "parameters.a-b", "a letter, then letters, digits"},
    {"half = \"crank/2\"\ncrank = \"1 m\"", "half = \"@crank/2\"\ncrank = \"2*half\"", "parameters.half",
     "half -> crank -> half"},
    {"crank = \"1 m\"", "crank = \"@crank\"", "parameters.crank", "crank -> crank"},
    {"crank = \"1 m\"", "crank = \"1 m @+ 2 s\"", "parameters.crank", ""},
    {"crank = \"1 m\"", "crank = \"1 m@/0\"", "parameters.crank", "finite"},
    {"crank = \"1 m\"", "crank = \"1 @mn\"", "parameters.crank", "unit"},
    {"crank = \"1 m\"", "crank = \"1 m*(@\"", "parameters.crank", ""},
    {"crank = \"1 m\"", "crank = @true", "parameters.crank", "a number is expected"},
    {"count = 3", "count = @inf", "parameters.count", "finite"},
    {"duration = \"0.5 s\"", "duration = @0", "simulate.duration", "greater than 0"},
    {"duration = \"0.5 s\"", "duration = \"@1 kg\"", "simulate.duration", "a time [s] is expected"},
    {"duration = \"0.5 s\"", "@duratoin = 1", "simulate.duratoin", "no such key", "duration"},
    {"output_step = \"2 ms\"", "output_step = \"@2 s\"", "simulate.output_step", "exceeds the duration"},
    {"output_step = \"2 ms\"", "record = [\"joint.*\", \"@joint.O22\"]", "simulate.record", "no body or joint", "joint.O2"},
    {"output_step = \"2 ms\"", "record = [\"@crank.*\"]", "simulate.record", "joint.NAME is expected", "joint.*"},
    {"output_step = \"2 ms\"", "output_step = @1e-9", "simulate.output_step", "10 million rows"},
    {"tolerance = 1e-6", "tolerance = @1", "simulate.tolerance", "at most 0.1"},
    {"tolerance = 1e-6", "tolerance = @1e-12", "simulate.tolerance", "at least"},
    {"method = \"radau\"", "method = \"@rk4\"", "simulate.method", "none of auto, radau, dopri5, ode45"},
    {"method = \"radau\"", "method = \"@radau\"\nequations = \"penalty\"", "simulate.method", "does not solve the penalty equations", "dopri5"},
    {"method = \"radau\"", "method = \"@dopri5\"\nequations = \"augmented_lagrangian\"", "simulate.method", "does not solve the augmented_lagrangian", "trapezoidal"},
    {"method = \"radau\"", "method = \"@generalised_alpha\"\nequations = \"relative_augmented_lagrangian\"", "simulate.method", "does not solve", "hht"},
    {"method = \"radau\"", "penalty = @1e6", "simulate.penalty", "no penalty to choose", "equations = \"penalty\""},
    {"method = \"radau\"", "equations = \"penalty\"\npenalty = @1", "simulate.penalty", "at least 100"},
    {"method = \"radau\"", "equations = \"penalty\"\npenalty_frequency = \"@10 kg\"", "simulate.penalty_frequency", "is expected"},
    {"stiffness = \"2e8 N/m\"", "@radii = 3", "defaults.joint.radii", "no such key"},
    {"stiffness = \"2e8 N/m\"", "stiffness = @[1, 2]", "defaults.joint.stiffness", "a number is expected"},
    {"[defaults.joint]\n", "[defaults]\n@spring = 1\n[defaults.joint]\n", "defaults.spring", "no such key"},
    {"O2 = [0, 0]", "O2 = @[0, 0, 0, 0]", "ground.markers.O2", "two or three numbers"},
    {"O2 = [0, 0]", "O2 = @3", "ground.markers.O2", "not a marker"},
    {"O2 = [0, 0]", "@O2 = { x = 1 }", "ground.markers.O2", "x and y, or r and xi"},
    {"O2 = [0, 0]", "@O2 = { x = 1, y = 2, r = 3 }", "ground.markers.O2", "x and y, or r and xi"},
    {"O2 = [0, 0]", "O2 = { x = 1, y = 2, @z = 3 }", "ground.markers.O2.z", "no such key"},
    {"O2 = [0, 0]", "O2 = [0, \"@3 deg\"]", "ground.markers.O2", "a length [m] is expected"},
    {"mass = \"1 kg\"", "mass = \"@-1 kg\"", "body.crank.mass", "greater than 0"},
    {"mass = \"1 kg\"", "mass = \"1 @kgg\"", "body.crank.mass", "unit"},
    {"[body.crank]\nmass = \"1 kg\"\n", "[body.@crank]\n", "body.crank.mass", "required"},
    {"inertia = \"1e5 kg*m^2\"", "inertia = @0", "body.crank.inertia", "greater than 0"},
    {"angle = \"60 deg\"", "angle = \"@60 mm\"", "body.crank.angle", "an angle [rad] is expected"},
    {"angle = \"60 deg\"\n", "", "body.crank.hold", "must be stated"},
    {"hold = [\"y\", \"angle\"]", "hold = [\"@z\"]", "body.crank.hold", "none of x, y, angle"},
    {"markers.A = [\"half\"", "markers.A = [\"@haf\"", "body.crank.markers.A", "", "half"},
    {"[body.crank]", "[body.@\"a b\"]\nmass = 1\ninertia = 1\n[body.crank]", "body.a b", "letters, digits, _ and -"},
    {"[body.crank]", "[body.@ground]\nmass = 1\ninertia = 1\n[body.crank]", "body.ground", "reserved for the world"},
    {"[body.crank]\n", "[body]\nextra = @3\n[body.crank]\n", "body.extra", "a table is expected"},
    {"[joint.O2]\ntype = \"revolute\"", "[joint.O2]\ntype = \"@revolut\"", "joint.O2.type", "none of", "revolute"},
    {"[joint.O2]\ntype = \"revolute\"", "[joint.@O2]", "joint.O2.type", "required"},
    {"law = \"linear\"", "law = \"@linaer\"", "joint.A.law", "none of", "linear"},
    {"[\"crank.A\", \"coupler.A\"]\nst", "[\"crank.A\", \"@copler.A\"]\nst", "joint.A.between", "no body \"copler\"",
     "coupler.A"},
    {"[\"crank.A\", \"coupler.A\"]\nst", "[\"crank.@O\", \"coupler.A\"]\nst", "joint.A.between", "no marker \"O\""},
    {"[\"crank.A\", \"coupler.A\"]\nst", "[\"@crank\", \"coupler.A\"]\nst", "joint.A.between", "body.marker"},
    {"[\"crank.A\", \"coupler.A\"]\nst", "@[\"crank.A\", \"crank.O2\"]\nst", "joint.A.between", "and itself"},
    {"[\"crank.A\", \"coupler.A\"]\nst", "@[\"ground.O2\", \"ground.P\"]\nst", "joint.A.between",
     "both ends are on the ground"},
    {"[\"crank.A\", \"coupler.A\"]\nst", "@[\"crank.A\"]\nst", "joint.A.between", "a list of 2"},
    {"[\"1e6 N/m\", \"2e6 N/m\"]", "@[1e6, 1e6, 1e6]", "joint.A.stiffness", "a list of 2 numbers"},
    {"[\"1e6 N/m\", \"2e6 N/m\"]", "[1e6, @-5]", "joint.A.stiffness", "feeds energy"},
    {"damping = \"3500 N*s/m\"", "damping = \"@3500 N/m\"", "joint.A.damping", "is expected"},
    {"damping = \"3500 N*s/m\"", "@length = 1", "joint.A.length", "rod joints, rope joints only"},
    {"damping = \"3500 N*s/m\"", "angular_stiffness = @1", "joint.A.angular_stiffness", "forbids no angle"},
    {"radii = [\"20 mm\", \"40 mm\"]\n", "radii = @[\"20 mm\"]\n", "joint.O4.radii", "a list of 2 numbers"},
    {"radii = [\"20 mm\", \"40 mm\"]\n", "radii = @[2, 2]\n", "joint.O4.radii", "inside one of its own size"},
    {"length = \"1 m\"", "length = @0", "joint.R.length", "greater than 0"},
    {"radius = \"30 mm\"\n", "", "joint.K.radius", "required"},
    {"free_length = \"0.5 m\"", "free_length = 1\npreload = @2", "spring.S.preload", "determines the other"},
    {"[torsion_spring.T]", "[torsion_spring.@S]", "torsion_spring.S", "results would collide"},
    {"[spring.S]", "[spring.@Z]\nbetween = [\"ground.P\", \"crank.A\"]\n[spring.S]", "spring.Z", "does nothing"},
    {"on = \"crank.A\"", "on = \"@ground.P\"", "force.F.on", "moves nothing"},
    {"[\"10 N*sin(2*t)\", 0]", "[\"10 N*sin(2*@u)\", 0]", "force.F.force", ""},
    {"[\"10 N*sin(2*t)\", 0]", "[\"@1/t\", 0]", "force.F.force", "not a finite number at t = 0"},
    {"[\"10 N*sin(2*t)\", 0]", "\"@10 N\"", "force.F.force", "a list of 2"},
    {"axes = \"body\"", "axes = \"@boddy\"", "force.F.axes", "none of", "body"},
    {"joint = \"O2\"", "joint = \"@O3\"", "motor.M.joint", "no such joint", "O2"},
    {"joint = \"O2\"", "joint = \"@R\"", "motor.M.joint", "no coordinate free"},
    {"torque = \"5 N*m - 0.1*rate + B.slide*2 N\"\n", "", "motor.M", "needs one of them"},
    {"torque = \"5 N*m - 0.1*rate + B.slide*2 N\"", "torque = 1\n@speed = 2", "motor.M.speed", "exactly one"},
    {"torque = \"5 N*m - 0.1*rate + B.slide*2 N\"", "torque = 1\n@damping = 2", "motor.M.damping", "only servos"},
    {"torque = \"5 N*m - 0.1*rate + B.slide*2 N\"", "@force = 1", "motor.M.force", "sliding joints only"},
    {"torque = \"5 N*m - 0.1*rate + B.slide*2 N\"", "torque = \"@B.slyde*2 N\"", "motor.M.torque", "", "B.slide"},
    {"speed = \"0.1 m/s\"", "speed = \"@10 rpm\"", "motor.V.speed", "is expected"},
    {"speed = \"0.1 m/s\"", "speed = \"0.1 m/s*sin(@x)\"", "motor.V.speed", "not defined", "one of t"},
    {"joint = \"A\"\n", "joint = \"@B\"\n", "motor.W.joint", "is already a servo"},
};

class MistakeTest : public testing::TestWithParam<Mistake> {};

TEST_P(MistakeTest, IsLocatedAndExplained) {
  const Mistake& mistake = GetParam();
  std::string text = kFullModel;
  const std::size_t start = text.find(mistake.piece);
  ASSERT_NE(start, std::string::npos);
  text.replace(start, std::string(mistake.piece).size(), mistake.replacement);
  const std::size_t mark = text.find('@');
  int line = 0;
  int column = 0;
  if (mark != std::string::npos) {
    text.erase(mark, 1);
    line = 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(mark), '\n'));
    column = static_cast<int>(mark - (text.rfind('\n', mark == 0 ? 0 : mark - 1) + 1)) + 1;
    if (text.find('\n') > mark) column = static_cast<int>(mark) + 1;
  }
  const std::vector<Complaint> complaints = complaints_about(text);
  std::string all;
  for (const Complaint& complaint : complaints) all += to_text(complaint) + "\n";
  const auto matches = [&](const Complaint& complaint) {
    const bool here = line == 0 || (complaint.place.line == line && complaint.place.column == column);
    return here && complaint.place.file == "m.toml" && complaint.path.starts_with(mistake.path) &&
           complaint.because.find(mistake.because) != std::string::npos &&
           complaint.suggestion.find(mistake.suggestion) != std::string::npos && !complaint.because.empty();
  };
  EXPECT_TRUE(std::any_of(complaints.begin(), complaints.end(), matches))
      << "wanted " << line << ":" << column << " " << mistake.path << ": " << mistake.because << "\ngot\n"
      << all;
  EXPECT_LE(complaints.size(), 3U) << all;
}

INSTANTIATE_TEST_SUITE_P(All, MistakeTest, testing::ValuesIn(kMistakes));

TEST(Mistakes, TheFullModelHasNone) {
  EXPECT_TRUE(complaints_about(kFullModel).empty());
}

TEST(Mistakes, AllAreCollectedInTheOrderOfTheFile) {
  const auto complaints =
      complaints_about("format = 1\n[body.a]\nmass = -1\ninertia = 0\n[joint.j]\ntyp = 1\n[parameters]\npi = 1\n");
  ASSERT_EQ(complaints.size(), 5U);
  for (std::size_t i = 1; i < complaints.size(); ++i) EXPECT_LE(complaints[i - 1].place.line, complaints[i].place.line);
}

TEST(Mistakes, AModelNeedsABody) {
  EXPECT_EQ(complaints_about("format = 1\n").at(0).path, "body");
}

TEST(Mistakes, AMisspeltKeyIsNotMissingToo) {
  const std::vector<Complaint> found = complaints_about("format = 1\n[body.rod]\nmas = \"2 kg\"\ninertia = 0.1\n");
  ASSERT_EQ(found.size(), 1);
  EXPECT_EQ(found[0].path, "body.rod.mas");
}

TEST(Mistakes, AParameterBehindANumberIsReadAsAUnit) {
  const auto complaints = complaints_about("format = 1\n[parameters]\nW = \"10 m\"\n[body.gate]\nmass = \"60 t\"\ninertia = \"60 t*W^2/12\"\n");
  ASSERT_EQ(complaints.size(), 1u);
  EXPECT_NE(complaints[0].because.find("behind a number, W is a unit and not the parameter W: parentheses keep them apart, as in (2 kg)*W"), std::string::npos) << complaints[0].because;
}

TEST(Mistakes, ASettledStartIsAtRest) {
  const std::vector<Complaint> found = complaints_about("format = 1\n[simulate]\nduration = 1\nstart = \"settled\"\n[body.a]\nmass = 1\ninertia = 1\nspin = 2\n[body.b]\nmass = 1\ninertia = 1\nspin = 0\nvelocity = [0, 1]\n");
  ASSERT_EQ(found.size(), 2);
  EXPECT_EQ(found[0].path, "body.a.spin");
  EXPECT_EQ(found[1].path, "body.b.velocity");
}

TEST(Mistakes, AFaultyParameterIsBlamedOnce) {
  const auto complaints =
      complaints_about("format = 1\n[parameters]\na = \"1/0\"\nb = \"2*a\"\n[body.c]\nmass = \"b\"\ninertia = 1\n");
  ASSERT_EQ(complaints.size(), 1U);
  EXPECT_EQ(complaints[0].path, "parameters.a");
}

TEST(Mistakes, AFaultyMarkerIsBlamedOnce) {
  const auto complaints = complaints_about(R"(format = 1
[simulate]
duration = 1
[body.arm]
mass = 1
inertia = 1
markers.tip = ["1 kg", 0]
[force.wind]
on = "arm.tip"
force = ["-8 N*s/m*arm.tip.vx", 0]
)");
  ASSERT_EQ(complaints.size(), 1u);
  EXPECT_EQ(complaints[0].path, "body.arm.markers.tip");
}

TEST(Mistakes, AParameterIsSetByItsPath) {
  const auto found = complaints_about("format = 1\n[parameters]\nreach = 1\n[body.c]\nmass = 1\ninertia = 1\n", {"reach=2"});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].suggestion, "parameters.reach");
}

TEST(Mistakes, OverridesHaveTheirOwnPlaces) {
  const auto at = [](const std::string& override) {
    const auto complaints = complaints_about(kFullModel, {"simulate.duration=1", override});
    if (complaints.empty()) return std::string("none");
    const Complaint& first = complaints.front();
    EXPECT_EQ(first.source_line, override);
    return first.place.file + ":" + std::to_string(first.place.column) + " " + first.path;
  };
  EXPECT_EQ(at("joint.A.stifness=2"), "--set:9 joint.A.stifness");
  EXPECT_EQ(at("joint.Z.stiffness=2"), "--set:7 joint.Z");
  EXPECT_EQ(at("parameters.crnk=2"), "--set:12 parameters.crnk");
  EXPECT_EQ(at("joint.Z=2"), "--set:7 joint.Z");
  EXPECT_EQ(at("body.crank.mass=-2"), "--set:17 body.crank.mass");
  EXPECT_EQ(at("body.crank.mass=2 + 1/0"), "--set:22 body.crank.mass");
  EXPECT_EQ(at("body.crank.mass.x=2"), "--set:12 mass");
  EXPECT_EQ(at("body.crank.mass"), "--set:1 ");
  EXPECT_EQ(at("body..mass=1"), "--set:1 ");
  EXPECT_EQ(at("simulat.duration=1"), "--set:1 simulat");
  EXPECT_EQ(at("body.crank.mass="), "--set:17 body.crank.mass");
}

TEST(Mistakes, ChosenLawsHaveTheirOwnPlaces) {
  const auto at = [](const std::string& law) {
    const auto complaints = complaints_about(kFullModel, {"simulate.duration=1", "--law " + law});
    if (complaints.empty()) return std::string("none");
    const Complaint& first = complaints.front();
    EXPECT_EQ(first.source_line, law);
    return first.place.file + ":" + std::to_string(first.place.column) + " " + first.path + ": " + first.because;
  };
  const auto begins = [&](const std::string& law, const std::string& with) {
    const std::string found = at(law);
    EXPECT_EQ(found.substr(0, with.size()), with) << found;
  };
  EXPECT_EQ(at("joint.A=linear,stiffness=1e7"), "none");
  begins("joint.A=maxwel", "--law:9 joint.A.law: ");
  begins("joint.Z=linear", "--law:7 joint.Z: the model has no such joint");
  begins("joint.O4=maxwell,branch_ratio=[1],branch_time=[1],stifness=2", "--law:51 joint.O4.stifness: the law maxwell has no such key");
  begins("joint.A=linear,stiffness=-2", "--law:26 joint.A.stiffness: ");
  begins("joint.O4=bushing", "--law:10 joint.O4.law: a gear joint cannot have it");
  begins("joint.R=lugre", "--law:9 joint.R.friction: a rod joint cannot have it");
  begins("joint.A=linear,type=fixed", "--law:16 joint.A.type: the law linear has no such key");
  begins("joint.A=linear,stiffness", "--law:16 joint.A: a key of a law has a value");
  begins("A=linear", "--law:1 : a law is chosen as joint.NAME=law");
  begins("joint.A", "--law:1 : a law is chosen as joint.NAME=law");
  begins("joint.A.law=linear", "--law:1 : a law is chosen as joint.NAME=law");
  begins("", "--law:1 : a law is chosen as joint.NAME=law");
  begins("joint.A=3", "--law:9 joint.A.law: ");
  const auto required = complaints_about(kFullModel, {"--law joint.A=maxwell"});
  ASSERT_EQ(required.size(), 2U);
  EXPECT_EQ(required[0].path, "joint.A.branch_ratio");
}

TEST(Mistakes, JsonIsLocatedToo) {
  try {
    parse_model("{\"format\": 1,\n \"body\": {\"a\": {\"mass\": \"2 kgs\",\n  \"inertia\": 1}}}", "m.json");
    FAIL();
  } catch (const InputError& error) {
    ASSERT_EQ(error.complaints().size(), 1U);
    EXPECT_EQ(error.complaints()[0].place.line, 2);
    EXPECT_EQ(error.complaints()[0].place.column, 28);
  }
}

// A value that does not fit a joint may be that of [defaults.joint].
TEST(Mistakes, ADefaultThatDoesNotFitIsNamed) {
  const std::vector<Complaint> complaints =
      complaints_about(kFullModel, {"defaults.joint.static_friction=0.05", "joint.O2.friction=coulomb", "joint.O2.pin_radius=10 mm", "joint.O2.friction_coefficient=0.4"});
  ASSERT_EQ(complaints.size(), 1U);
  EXPECT_EQ(complaints[0].path, "joint.O2.static_friction");
  EXPECT_EQ(complaints[0].found, "0.05 of [defaults.joint]");
}

// Hertz are no turns per second, by whatever way they come to a rotational speed.
TEST(Mistakes, AFrequencyBehindAParameterIsNoSpeed) {
  const auto complaint = [](const std::string& parameters, const std::string& speed) -> std::string {
    try {
      parse_model("format = 1\n[parameters]\n" + parameters + "\n[body.a]\nmass = 1\ninertia = 1\nspin = \"" + speed + "\"\n", "m.toml");
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  for (const char* speed : {"f", "2*f", "5 Hz", "f/2"}) EXPECT_NE(complaint("f = \"5 Hz\"", speed).find("would count radians, not turns"), std::string::npos) << speed;
  EXPECT_NE(complaint("f = \"5 Hz\"\ng = \"2*f\"", "g").find("would count radians, not turns"), std::string::npos);
  for (const char* speed : {"2*pi*f", "f*1 rev", "300 rpm"}) EXPECT_EQ(complaint("f = \"5 Hz\"", speed), "") << speed;
  for (const char* speed : {"n", "n/2", "300 min^-1", "300*1/(1 min)"}) EXPECT_NE(complaint("n = \"300 min^-1\"", speed).find("would count radians, not turns"), std::string::npos) << speed;
  for (const char* speed : {"n*2*pi", "n*1 rev", "min(w, 3 rad/s)", "w*(1 min)/(2 min)", "min(w, w)"}) EXPECT_EQ(complaint("n = \"300 min^-1\"\nw = \"2 rad/s\"", speed), "") << speed;
  EXPECT_EQ(complaint("T = \"1/(5 Hz)\"", "1 rev/T"), "");
}

}  // namespace
}  // namespace pintle
