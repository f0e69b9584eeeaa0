// The common battery over the alternatives of JointDisplacement (a new one must be given a sample here to compile), then an example
// of each that can be followed by hand.
#include "joints/joint_displacement.h"

#include <gtest/gtest.h>

#include <type_traits>

#include "base/constants.h"
#include "base/expression/expression_parser.h"
#include "base/units.h"
#include "joints/cam_profile.h"
#include "joints/catalog.h"
#include "joints/edge_profile.h"
#include "joints/joint_checks_for_tests.h"

namespace pintle {
namespace {

using S = Planar;
using Vec = Planar::Vec;
using sample::Couple;
using sample::Random;

Selection sample_of(std::type_identity<Selection>, Random& random) { return {{0, 0, 2 * kPi * random.below(3)}}; }
Distance sample_of(std::type_identity<Distance>, Random& random) { return {random.uniform(0.1, 3)}; }
Mesh sample_of(std::type_identity<Mesh>, Random& random) {
  return {random.uniform(0.5, 1), random.uniform(1.2, 2), random.coin() ? 1.0 : -1.0, random.uniform(-0.1, 0.1), random.coin(), random.coin()};
}
RackMesh sample_of(std::type_identity<RackMesh>, Random& random) {
  return {random.uniform(0.1, 1), random.coin() ? 1.0 : -1.0, random.uniform(-0.1, 0.1), random.coin(), random.coin()};
}

GapFunction sum_of_squares(const Planar::Vec& z, const double* p) {
  GapFunction g;
  g.gap = p[0] * z[0] * z[0] + p[1] * z[1] * z[1] + p[2] * z[2] - p[3];
  g.gradient << 2 * p[0] * z[0], 2 * p[1] * z[1], p[2];
  g.hessian(0, 0) = 2 * p[0];
  g.hessian(1, 1) = 2 * p[1];
  return g;
}
FunctionGap sample_of(std::type_identity<FunctionGap>, Random& random) {
  return {sum_of_squares, {random.uniform(0.5, 1), random.uniform(0.5, 1), random.uniform(-0.5, 0.5), random.uniform(0.1, 1)}};
}

// The lift of a cam in the tests.
Expression wavy_lift() {
  ParseScope scope;
  scope.variables = {{"angle", kAngle}};
  return std::get<ParsedExpression>(parse_expression("0.02 m*cos(angle) + 0.01 m*sin(2*angle)", scope)).expression;
}
CamGap sample_of(std::type_identity<CamGap>, Random& random) {
  static const CamProfile roller(Cam{wavy_lift(), 0.3, 0.1, false}), flat(Cam{wavy_lift(), 0.3, 0, true});
  return {random.coin() ? &roller : &flat};
}

EdgeGap sample_of(std::type_identity<EdgeGap>, Random& random) {
  ParseScope scope;
  scope.variables = {{"x", kLength}};
  static const Expression hills = std::get<ParsedExpression>(parse_expression("0.02 m*sin(x/1 m) - 0.01 m*cos(2*x/1 m)", scope)).expression;
  static const EdgeProfile wheel(Edge{hills, 0.3, -5, 5}), point(Edge{hills, 0, -5, 5});
  return {random.coin() ? &wheel : &point};
}

template <class V>
struct TypesOf;
template <class... P>
struct TypesOf<std::variant<P...>> {
  using type = testing::Types<P...>;
};

template <class P>
class AnyJointDisplacement : public testing::Test {};
TYPED_TEST_SUITE(AnyJointDisplacement, TypesOf<JointDisplacement>::type);

TYPED_TEST(AnyJointDisplacement, PassesTheBattery) {
  Random random(7);
  for (int i = 0; i < 200; ++i) {
    const JointDisplacement displacement = sample_of(std::type_identity<TypeParam>{}, random);
    sample::expect_all(displacement, sample::random_couple(random), random);
    if (testing::Test::HasFailure()) return;
  }
}

TYPED_TEST(AnyJointDisplacement, IsFiniteFarOut) {
  Random random(8);
  for (const double far : {1e3, 1e6}) {
    const JointDisplacement displacement = sample_of(std::type_identity<TypeParam>{}, random);
    Couple c = sample::random_couple(random);
    c.qB.head<2>() *= far;
    c.vB *= far;
    const JointKinematics r = sample::kinematics(displacement, c);
    EXPECT_TRUE(r.gap.allFinite() && r.rate.allFinite() && r.bias.allFinite() && r.GA().allFinite() && r.GB().allFinite());
  }
}

// Eq. (2.1): the position of M in the axes of F.
TEST(RelativePose, ByHand) {
  Couple c;
  c.F = S::Frame::at({1, 0}, 0);
  c.M = S::Frame::at({0, 2}, kPi / 2);
  c.qA = {1, 1, kPi / 2};  // F at (1, 2), its x axis along world y
  c.qB = {4, 1, 0};        // M at (4, 3)
  c.vA = {0, 0, 2};        // turns about (1, 1): F moves with (-2, 0)
  c.vB = {1, 0, 3};        // M moves with (1, 0) + 3 (-2, 0)
  const RelativePose p = c.pose();
  EXPECT_NEAR((p.z - Vec(1, -3, 0)).norm(), 0, 1e-15);  // d = (3, 1) in axes x = (0, 1), y = (-1, 0)
  // d' = (-5, 0) - (-2, 0) = (-3, 0); minus w x d = 2 (-1, 3): (-1, -6) in F's axes is (-6, 1)
  EXPECT_NEAR((p.rate - Vec(-6, 1, 1)).norm(), 0, 1e-14);
  EXPECT_NEAR((p.world_force({5, 0, 0}) - S::Point(0, 5)).norm(), 0, 1e-15);
}

TEST(Selection, TakesOffItsOffset) {
  Couple c;
  c.qA = c.vA = c.vB = Vec::Zero();
  c.qB = {0.1, 0.2, 2 * kPi + 0.3};
  const JointKinematics r = sample::kinematics(Selection{{0, 0, 2 * kPi}}, c);
  EXPECT_NEAR((r.gap - Vec(0.1, 0.2, 0.3)).norm(), 0, 1e-15);
}

TEST(Distance, ByHand) {
  Couple c;
  c.qA = Vec::Zero();
  c.vA = Vec::Zero();
  c.qB = {3, 4, 1};
  c.vB = {4, -3, 7};  // across the line, speed 5: centripetal 25 / 5
  const JointKinematics r = sample::kinematics(Distance{4.5}, c);
  EXPECT_NEAR(r.gap[0], 0.5, 1e-15);
  EXPECT_NEAR(r.rate[0], 0, 1e-14);
  EXPECT_NEAR(r.bias[0], 5, 1e-14);
  EXPECT_NEAR((r.GB().row(0).transpose() - Vec(0.6, 0.8, 0)).norm(), 0, 1e-15);
  EXPECT_EQ(r.gap[1], 0);
  EXPECT_EQ(r.GB().bottomRows<2>().norm(), 0);
}

TEST(Distance, HasADirectionEvenAtZero) {
  const GapFunction g = Distance{2}(Vec::Zero());
  EXPECT_EQ(g.gap, -2);
  EXPECT_EQ(g.gradient, Vec(1, 0, 0));
  EXPECT_TRUE(g.hessian.allFinite());
}

// Centres 0.1 m farther apart open an external mesh, and close an internal one; a pinion 0.1 m farther from its rack opens it on either side.
TEST(Mesh, OpensAsItsCentresSeparate) {
  EXPECT_NEAR((Mesh{1, 2, 1, 0, true}).opening({0, 3.1, 0.4}).gap, 0.1, 1e-15);
  EXPECT_NEAR((Mesh{2, 1, -1, 0, true}).opening({0, 1.1, 0.4}).gap, -0.1, 1e-15);
  for (const double side : {1.0, -1.0}) EXPECT_NEAR((RackMesh{0.5, side, 0, true}).opening({0.7, -0.6 * side, 0}).gap, 0.1, 1e-15);
  EXPECT_EQ(count_functions(JointDisplacement(Mesh{1, 2, 1, 0, true})), 2);
  EXPECT_EQ(count_functions(JointDisplacement(Mesh{1, 2, 1, 0})), 1);
  EXPECT_EQ(count_functions(JointDisplacement(Mesh{1, 2, 1, 0, false, true})), 3);
  EXPECT_EQ(count_functions(JointDisplacement(Selection{})), 0);
}

// Wheels of 1 m and 2 m on a fixed frame: the second turns back by half the angle of the first.
TEST(Mesh, ExternalWheelsTurnAgainstEachOther) {
  const Mesh mesh{1, 2, 1, 0};
  Couple c;
  c.vA = c.vB = Vec::Zero();
  for (const double turn : {0.0, 0.1, 1.0, -2.5}) {
    c.qA = {0, 0, turn};
    c.qB = {3, 0, -turn / 2};
    EXPECT_NEAR(sample::kinematics(mesh, c).gap[0], 0, 1e-14) << turn;
  }
  c.vA[2] = 4;
  c.vB[2] = -2;
  EXPECT_NEAR(sample::kinematics(mesh, c).rate[0], 0, 1e-14);
  c.vB[2] = 0;
  EXPECT_NEAR(std::abs(sample::kinematics(mesh, c).rate[0]), 4, 1e-14);  // the first wheel's rim slips at 4 m/s
}

TEST(Mesh, InternalWheelsTurnTogether) {
  const Mesh mesh{1, 3, -1, 0};
  Couple c;
  c.vA = c.vB = Vec::Zero();
  for (const double turn : {0.0, 0.3, -2.0}) {
    c.qA = {0, 0, turn};
    c.qB = {2, 0, turn / 3};
    EXPECT_NEAR(sample::kinematics(mesh, c).gap[0], 0, 1e-14) << turn;
  }
}

// A planet of 1 m on a fixed sun of 2 m: one turn of the carrier turns the planet three times.
TEST(Mesh, PlanetRollsAroundItsSun) {
  const Mesh mesh{2, 1, 1, 0};
  Couple c;
  c.qA = c.vA = c.vB = Vec::Zero();
  for (const double carrier : {0.0, 1.0, 2.0, 3.0, 7.0, 40.0}) {
    c.qB = {3 * std::cos(carrier), 3 * std::sin(carrier), 3 * carrier};
    EXPECT_NEAR(sample::kinematics(mesh, c).gap[0], 0, 1e-12) << carrier;
  }
}

// A pinion of 0.5 m rolls on the rack: 1 m to the right is 2 rad clockwise when the rack is below it.
TEST(RackMesh, PinionRollsOnBothSides) {
  for (const double side : {1.0, -1.0}) {
    const RackMesh mesh{0.5, side, 0};
    Couple c;  // pinion first, rack second and fixed
    c.vA = c.vB = c.qB = Vec::Zero();
    for (const double x : {0.0, 0.25, 1.0, -3.0}) {
      c.qA = {x, side * 0.5, -side * x / 0.5};
      EXPECT_NEAR(sample::kinematics(mesh, c).gap[0], 0, 1e-14) << x;
    }
  }
}

TEST(JointTypeCatalog, GapAndFreeCoordinatesMakeUpThePlane) {
  for (const JointTypeInfo& type : joint_type_catalog()) {
    EXPECT_EQ(find_joint_type(type.word), &type);
    EXPECT_FALSE(type.gap.empty() && type.free.empty());
    EXPECT_LE(type.gap.size() + type.free.size(), 3u);
    EXPECT_FALSE(type.meaning.empty());
  }
  EXPECT_EQ(find_joint_type("revolut"), nullptr);
}

}  // namespace
}  // namespace pintle
