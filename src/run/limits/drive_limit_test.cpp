// Limits of drives against the geometry of their mechanisms.
#include "run/limits/drive_limit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/constants.h"
#include "system/build.h"
#include "system/sample_systems_for_tests.h"

namespace pintle {
namespace {

struct Bar {
  const char* name;
  const char* from;
  const char* to;
  Planar::Point a, b;
};

// Bars between pins. Markers with the same name share a pin; `ground` lists the markers of the ground.
class Linkage {
 public:
  Linkage(const std::vector<std::pair<const char*, Planar::Point>>& ground, const std::vector<Bar>& bars) {
    for (const auto& [name, p] : ground) model.ground.push_back({name, {p.x(), p.y()}, 0});
    for (const Bar& bar : bars) {
      const Planar::Point d = bar.b - bar.a, middle = 0.5 * (bar.a + bar.b);
      const double half = 0.5 * d.norm(), angle = std::atan2(d.y(), d.x());
      model.bodies.push_back(sample::body(bar.name, 0.3, 1e-3, {{bar.from, {-half, 0}, 0}, {bar.to, {half, 0}, 0}}));
      sample::put_at(model.bodies.back(), middle.x(), middle.y(), angle);
      q.emplace_back(middle.x(), middle.y(), angle);
    }
  }
  void pin(const char* name, const char* first, const char* second) { model.joints.push_back(sample::joint(name, "revolute", {first, name}, {second, name}, 1e8, 3000)); }
  void drive(const char* joint, const std::string& position) {
    model.motors.push_back(sample::motor(std::string("at ") + joint, joint, MotorKind::kPosition, sample::expression(position)));
    model.motors.back().stiffness = 1e4;
  }
  std::optional<DriveLimit> limit(double t = 0, int drive = 0) const {
    const System system = build_system(model);
    return find_drive_limit(system, q, t, static_cast<int>(model.joints.size()) + drive);
  }

  Model model;
  Vecs q;
};

// Intersection of two circles, to the left of the line from p to r.
Planar::Point meeting(const Planar::Point& p, double a, const Planar::Point& r, double b) {
  const Planar::Point d = r - p;
  const double along = (d.squaredNorm() + a * a - b * b) / (2 * d.norm()), across = std::sqrt(a * a - along * along);
  return p + along / d.norm() * d + across / d.norm() * Planar::perp(d);
}

Linkage driven_four_bar(double ground, double crank, double coupler, double rocker, double angle, const std::string& position) {
  const Planar::Point O(0, 0), A(crank * std::cos(angle), crank * std::sin(angle)), C(ground, 0), B = meeting(A, coupler, C, rocker);
  Linkage four({{"O", O}, {"C", C}}, {{"crank", "O", "A", O, A}, {"coupler", "A", "B", A, B}, {"rocker", "C", "B", C, B}});
  four.pin("O", "ground", "crank");
  four.pin("A", "crank", "coupler");
  four.pin("B", "coupler", "rocker");
  four.pin("C", "ground", "rocker");
  four.drive("O", position);
  return four;
}

TEST(DriveLimit, IsWhereCouplerAndRockerAreInLine) {
  const double limit = std::acos((0.09 + 0.04 - 0.44 * 0.44) / 0.12);
  for (const double sign : {1.0, -1.0}) {
    const auto found = driven_four_bar(0.3, 0.2, 0.22, 0.22, 90 * kDegree, sign > 0 ? "3" : "-3").limit();
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->value, sign * limit, 1e-9);
    EXPECT_EQ(found->ahead, sign > 0 ? 1 : -1);
    EXPECT_EQ(found->in_line, (std::vector<int>{1, 2, 3}));
    EXPECT_NEAR(std::abs(std::sin(found->q[1][2] - found->q[2][2])), 0, 1e-6);
  }
  // Folded: coupler and rocker on top of each other.
  const auto folded = driven_four_bar(0.3, 0.25, 0.3, 0.1, 60 * kDegree, "0").limit();
  ASSERT_TRUE(folded);
  EXPECT_NEAR(folded->value, std::acos((0.09 + 0.0625 - 0.04) / 0.15), 1e-9);
  EXPECT_EQ(folded->ahead, -1);
}

TEST(DriveLimit, NothingWhereTheDriveCanBeWhereItShould) {
  EXPECT_FALSE(driven_four_bar(0.3, 0.2, 0.22, 0.22, 90 * kDegree, "121.9*pi/180").limit());
  EXPECT_TRUE(driven_four_bar(0.3, 0.2, 0.22, 0.22, 90 * kDegree, "122.1*pi/180").limit());
  EXPECT_FALSE(driven_four_bar(0.3, 0.1, 0.25, 0.25, 90 * kDegree, "300*pi/180").limit());  // a crank: it only lags
  EXPECT_FALSE(driven_four_bar(0.3, 0.1, 0.3, 0.1, 60 * kDegree, "200*pi/180").limit());    // a parallelogram, through its flat position
}

TEST(DriveLimit, JointsThatGiveWayAreClosedFirst) {
  Linkage four = driven_four_bar(0.3, 0.2, 0.22, 0.22, 121 * kDegree, "3");
  four.q[0] += Planar::Vec(-0.002, 0.001, 0.02);
  four.q[1] += Planar::Vec(0.003, 0.002, -0.01);
  const auto found = four.limit();
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->value, std::acos((0.09 + 0.04 - 0.44 * 0.44) / 0.12), 1e-9);
}

// The limit is that of the loop, regardless of bodies that hang on it or duplicate its bars, even if these do not fit exactly.
TEST(DriveLimit, FreeAndRedundantBodiesDoNotMatter) {
  Linkage four = driven_four_bar(0.3, 0.2, 0.22, 0.22, 90 * kDegree, "3");
  const double limit = four.limit()->value;
  Linkage hanging = four;
  hanging.model.bodies.push_back(sample::body("weight", 0.2, 1e-3, {{"B", {-0.1, 0}, 0}}));
  hanging.q.emplace_back(hanging.q[2][0] + 0.11 * std::cos(hanging.q[2][2]), hanging.q[2][1] + 0.11 * std::sin(hanging.q[2][2]) - 0.1, -90 * kDegree);
  hanging.model.joints.push_back(sample::joint("W", "revolute", {"rocker", "B"}, {"weight", "B"}, 1e8, 3000));
  const auto with_weight = hanging.limit();
  ASSERT_TRUE(with_weight);
  EXPECT_NEAR(with_weight->value, limit, 1e-6);
  for (const double longer : {0.0, 2e-5}) {
    Linkage doubled = four;
    doubled.model.bodies.push_back(sample::body("second", 0.3, 1e-3, {{"A", {-0.11, 0}, 0}, {"B", {0.11 + longer, 0}, 0}}));
    doubled.q.push_back(doubled.q[1]);
    doubled.model.joints.push_back(sample::joint("A2", "revolute", {"crank", "A"}, {"second", "A"}, 1e8, 3000));
    doubled.model.joints.push_back(sample::joint("B2", "revolute", {"second", "B"}, {"rocker", "B"}, 1e8, 3000));
    const auto found = doubled.limit();
    ASSERT_TRUE(found) << longer;
    EXPECT_NEAR(found->value, limit, 10 * longer + 1e-6) << longer;
    EXPECT_EQ(found->in_line.size(), 3u);
  }
}

// Two cranks that pull a chain of two bars straight: each has a limit while the other stays.
TEST(DriveLimit, OtherDrivesStayWhereTheyAre) {
  const Planar::Point O(0, 0), C(0.3, 0), P(0.2 * std::cos(110 * kDegree), 0.2 * std::sin(110 * kDegree)), Q(0.3 + 0.2 * std::cos(80 * kDegree), 0.2 * std::sin(80 * kDegree)),
      R = meeting(P, 0.25, Q, 0.25);
  Linkage five({{"O", O}, {"C", C}}, {{"one", "O", "P", O, P}, {"two", "C", "Q", C, Q}, {"left", "P", "R", P, R}, {"right", "Q", "R", Q, R}});
  five.pin("O", "ground", "one");
  five.pin("C", "ground", "two");
  five.pin("P", "one", "left");
  five.pin("Q", "two", "right");
  five.pin("R", "left", "right");
  five.drive("O", "110*pi/180 + t");
  five.drive("C", "80*pi/180 - t");
  EXPECT_FALSE(five.limit(0.1, 0));
  const auto found = five.limit(1.5, 0);
  ASSERT_TRUE(found);
  const Planar::Point to(0.2 * std::cos(found->value), 0.2 * std::sin(found->value));
  EXPECT_NEAR((to - Q).norm(), 0.5, 1e-8);
}

// A crank of 30 mm on a rod of 20 mm: it turns as far as the rod can follow, perpendicular to the guide. The guide holds the slider's angle with a
// hundredth of a hundredth of its stiffness in units of length.
TEST(DriveLimit, AGuideHoldsItsSlider) {
  const double angle = 20 * kDegree, crank = 0.03, rod = 0.02;
  const Planar::Point O(0, 0), A(crank * std::cos(angle), crank * std::sin(angle)), B(A.x() + std::sqrt(rod * rod - A.y() * A.y()), 0);
  Linkage slider({{"O", O}, {"guide", O}}, {{"crank", "O", "A", O, A}, {"rod", "A", "B", A, B}});
  slider.model.bodies.push_back(sample::body("slider", 0.3, 1e-5, {{"B", {0, 0}, 0}, {"S", {5e-3, 0}, 0}}));
  sample::put_at(slider.model.bodies.back(), B.x(), 0, 0);
  slider.q.emplace_back(B.x(), 0, 0);
  slider.pin("O", "ground", "crank");
  slider.pin("A", "crank", "rod");
  slider.pin("B", "rod", "slider");
  slider.model.joints.push_back(sample::joint("guide", "prismatic", {"ground", "guide"}, {"slider", "S"}, 1e8, 3000));
  slider.model.joints.back().law.values["angular_stiffness"] = {3e3};
  slider.drive("O", "60*pi/180");
  const auto found = slider.limit();
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->value, std::asin(rod / crank), 1e-6);
}

// A triangle of bars cannot move: that is not a limit of its motor.
TEST(DriveLimit, AStructureHasNone) {
  const Planar::Point O(0, 0), C(0.3, 0), B = meeting(O, 0.25, C, 0.25);
  Linkage triangle({{"O", O}, {"C", C}}, {{"left", "O", "B", O, B}, {"right", "C", "B", C, B}});
  triangle.pin("O", "ground", "left");
  triangle.pin("C", "ground", "right");
  triangle.pin("B", "left", "right");
  triangle.drive("O", "2");
  EXPECT_FALSE(triangle.limit());
}

}  // namespace
}  // namespace pintle
