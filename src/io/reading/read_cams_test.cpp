// Cams and curved edges in model files: their profiles, from expressions or tables, and every mistake.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "pintle/read_model.h"

namespace pintle {
namespace {

std::string cam_model(const std::string& joint, const std::string& tables = "") {
  return "format = 1\n" + tables + R"(
[body.cam]
mass = 1
inertia = 1
markers.O = [0, 0]
[body.follower]
mass = 1
inertia = 1
markers.foot = [0, 0]
[joint.J]
type = "cam"
between = ["cam.O", "follower.foot"]
)" + joint;
}

std::vector<Complaint> complaints_about_cam(const std::string& text) {
  try {
    parse_model(text, "m.toml");
  } catch (const InputError& error) {
    return error.complaints();
  }
  return {};
}

TEST(ReadCams, AnExpressionOrATableIsTheLift) {
  const Model a = parse_model(cam_model("base_radius = \"40 mm\"\nlift = \"5 mm*(1 - cos(angle))\"\nroller_radius = \"1 cm\"\n"), "m.toml");
  ASSERT_TRUE(a.joints[0].cam);
  EXPECT_DOUBLE_EQ(a.joints[0].cam->base_radius, 0.04);
  EXPECT_DOUBLE_EQ(a.joints[0].cam->roller_radius, 0.01);
  EXPECT_FALSE(a.joints[0].cam->flat);
  EXPECT_DOUBLE_EQ(a.joints[0].cam->lift.value(std::vector{0.0}), 0);
  const Model b = parse_model(cam_model("base_radius = 0.05\nlift = \"rise(angle)\"\nfollower = \"flat\"\nlaw = \"contact\"\n",
                                        "[table.rise]\nx = [0, 90, 180, 270]\nx_unit = \"deg\"\ny = [0, 2, 5, 2]\ny_unit = \"mm\"\nperiod = 360\ninterpolation = \"spline\"\n"),
                              "m.toml");
  ASSERT_TRUE(b.joints[0].cam);
  EXPECT_TRUE(b.joints[0].cam->flat);
  EXPECT_NEAR(b.joints[0].cam->lift.value(std::vector{3.14159265358979}), 5e-3, 1e-12);
  EXPECT_TRUE(a.joints[0] == a.joints[0]);
  EXPECT_FALSE(a.joints[0].cam == b.joints[0].cam);
}

// Linear interpolation has corners.
TEST(ReadCams, ATableNeedsASmoothInterpolation) {
  const auto complaints = complaints_about_cam(cam_model("base_radius = 0.05\nlift = \"rise(angle)\"\n", "[table.rise]\nx = [0, 90, 180, 270]\nx_unit = \"deg\"\ny = [0, 2, 5, 2]\ny_unit = \"mm\"\nperiod = 360\n"));
  ASSERT_EQ(complaints.size(), 1U);
  EXPECT_NE(complaints[0].because.find("a corner at 90 deg"), std::string::npos) << complaints[0].because;
  EXPECT_NE(complaints[0].suggestion.find("spline"), std::string::npos);
}

// @ precedes the character that the complaint should point at.
struct CamMistake {
  const char* joint;
  const char* path;
  const char* because;
};

void expect_complaint(std::string text, const CamMistake& mistake) {
  const std::size_t mark = text.find('@');
  ASSERT_NE(mark, std::string::npos);
  text.erase(mark, 1);
  const int line = 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(mark), '\n'));
  const int column = static_cast<int>(mark - text.rfind('\n', mark - 1));
  const auto complaints = complaints_about_cam(text);
  std::string all;
  for (const Complaint& complaint : complaints) all += to_text(complaint) + "\n";
  EXPECT_TRUE(std::any_of(complaints.begin(), complaints.end(),
                          [&](const Complaint& c) { return c.place.line == line && c.place.column == column && c.path == mistake.path && c.because.find(mistake.because) != std::string::npos; }))
      << "wanted " << line << ":" << column << " " << mistake.path << ": " << mistake.because << "\ngot\n" << all;
  EXPECT_LE(complaints.size(), 2U) << all;
}

TEST(ReadCams, MistakesAreLocatedAndExplained) {
  const std::vector<CamMistake> mistakes{
      {"base_radius = 0.04\nlift = \"@5 mm*angle\"\n", "joint.J.lift", "does not close"},
      {"base_radius = 0.04\nlift = \"@5 s\"\n", "joint.J.lift", "a length [m] is expected"},
      {"base_radius = 0.04\nlift = \"@t\"\n", "joint.J.lift", ""},
      {"base_radius = @0\nlift = \"5 mm\"\n", "joint.J.base_radius", "greater than 0"},
      {"base_radius = 0.01\nlift = \"@20 mm*cos(angle)\"\n", "joint.J.lift", "the radius at"},
      {"base_radius = 0.03\nroller_radius = 0.02\nlift = \"@3 mm*cos(6*angle)\"\n", "joint.J.lift", "undercut"},
      {"base_radius = 0.04\nfollower = \"flat\"\nlift = \"@1 cm*cos(3*angle)\"\n", "joint.J.lift", "hollow"},
      {"base_radius = 0.04\nfollower = \"@knife\"\nlift = 0\n", "joint.J.follower", "none of roller, flat"},
      {"base_radius = 0.04\nfollower = \"flat\"\nroller_radius = @0.01\nlift = 0\n", "joint.J.roller_radius", "has no roller"},
      {"base_radius = 0.04\nlift = 0\nlaw = \"@clearance\"\nclearance = 1e-3\n", "joint.J.law", "a cam joint cannot have it"},
      {"base_radius = 0.04\nlift = 0\nlaw = \"contact\"\nfriction_coefficient = 0.1\nstatic_friction = @0.05\n", "joint.J.static_friction", "below friction_coefficient"},
      {"base_radius = 0.04\nlift = 0\nfriction = \"coulomb\"\nguide_length = @0.1\n", "joint.J.guide_length", "have no guide"},
      {"base_radius = 0.04\nlift = 0\n@radius = 1\n", "joint.J.radius", "rack joints only"},
  };
  for (const CamMistake& mistake : mistakes) expect_complaint(cam_model(mistake.joint), mistake);
}

// Mistakes of a curved edge whose table is complete except for what each case tries.
TEST(ReadEdges, MistakesAreLocatedAndExplained) {
  const std::string complete = "from = \"-1 m\"\nto = \"1 m\"\n";
  const std::vector<CamMistake> mistakes{
      {"height = \"@0.1 m*abs(x/(1 m))\"\nfrom = \"-1 m\"\nto = \"1 m\"\n", "joint.J.height", "a corner at"},
      {"height = \"@x^2/(0.2 m)\"\nroller_radius = 0.2\nfrom = \"-1 m\"\nto = \"1 m\"\n", "joint.J.height", "touch in two places"},
      {"height = \"@1 m^2/x\"\nfrom = \"-1 m\"\nto = \"1 m\"\n", "joint.J.height", "not finite"},
      {"height = \"@angle\"\nfrom = \"-1 m\"\nto = \"1 m\"\n", "joint.J.height", ""},
      {"height = 0\nfrom = 1\nto = @1\n", "joint.J.to", "not above from"},
      {"height = 0\nfrom = 0\nto = 1\n@base_radius = 1\n", "joint.J.base_radius", "cam joints only"},
  };
  for (const CamMistake& mistake : mistakes) {
    std::string text = cam_model(mistake.joint);
    text.replace(text.find("\"cam\""), 5, "\"edge\"");
    expect_complaint(text, mistake);
  }
  for (const auto& [outside, fits] : {std::pair{"extend", true}, {"hold", false}}) {  // a table that is held beyond its end has a corner there
    std::string road = cam_model("height = \"road(x)\"\n" + complete, std::string("[table.road]\nx = [-1, 0, 1]\ny = [0, 0.1, 0.3]\nx_unit = \"m\"\ny_unit = \"m\"\ninterpolation = \"spline\"\noutside = \"") + outside + "\"\n");
    road.replace(road.find("\"cam\""), 5, "\"edge\"");
    EXPECT_EQ(complaints_about_cam(road).empty(), fits) << outside;
  }
  std::string text = cam_model("height = \"0.1 m*sin(x/(1 m))\"\nroller_radius = \"5 cm\"\n" + complete);
  text.replace(text.find("\"cam\""), 5, "\"edge\"");
  const Model model = parse_model(text, "m.toml");
  ASSERT_TRUE(model.joints[0].edge);
  EXPECT_DOUBLE_EQ(model.joints[0].edge->roller_radius, 0.05);
  EXPECT_DOUBLE_EQ(model.joints[0].edge->height.value(std::vector{0.5}), 0.1 * std::sin(0.5));
  EXPECT_EQ(model.joints[0].edge->from, -1);
}

}  // namespace
}  // namespace pintle
