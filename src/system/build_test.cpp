// From model to system: every joint type of the catalog, names, lengths, drives.
#include "system/build.h"

#include <gtest/gtest.h>

#include "joints/catalog.h"
#include "joints/joint_checks_for_tests.h"
#include "system/sample_systems_for_tests.h"

namespace pintle {
namespace {

using S = Planar;
using sample::Random;

// Two bodies with a joint of this type between them.
Model model_of(const std::string& type) {
  Model model;
  model.ground = {{"O", {0, 0}, 0}};
  model.bodies = {sample::body("a", 1, 0.1, {{"P", {0.3, -0.4}, 0.5}}), sample::body("b", 2, 0.2, {{"P", {-0.6, 0.2}, -0.8}})};
  model.joints = {sample::joint("j", type, {"a", "P"}, {"b", "P"}, 1e3, 10)};
  if (type == "gear") model.joints[0].geometry = {{"radius_first", 0.3}, {"radius_second", 0.5}};
  if (type == "cam") model.joints[0].cam = Cam{sample::expression("0.02*cos(angle) + 0.01*sin(2*angle)", {"angle"}), 0.3, 0.05, false};
  if (type == "edge") model.joints[0].edge = Edge{sample::expression("0.02*sin(x) - 0.01*cos(2*x)", {"x"}), 0.05, -5, 5};
  if (type == "cylinder") {
    model.joints[0].geometry = {{"bore", 0.1}, {"rod_diameter", 0.06}, {"closed_length", 0.5}, {"stroke", 0.4}};
    model.joints[0].stops = {"hard", {{"stop_stiffness", {1e6}}}};
  }
  if (type == "rack") model.joints[0].geometry = {{"radius", 0.3}};
  if (type == "belt") model.joints[0].geometry = {{"first_radius", 0.1}, {"second_radius", 0.3}, {"second_side", 1}};
  return model;
}

class JointType : public testing::TestWithParam<std::string> {};

TEST_P(JointType, PassesTheCommonBattery) {
  Random random(21);
  const Model model = model_of(GetParam());
  for (int i = 0; i < 50; ++i) {
    const System open = build_system(model);
    sample::Couple c;
    c.F = open.joints[0].at.F;
    c.M = open.joints[0].at.M;
    sample::place_at_random(random, 0.4, c);
    std::vector<std::string> notes;
    const System system = fix_assembled_values(model, open, {c.qA, c.qB}, notes);
    sample::place_at_random(random, 0.4, c);
    sample::expect_all(system.joints[0].displacement, c, random);
    if (HasFailure()) return;
  }
}

// The law resists exactly the components that the catalog names; the catalog's free components are free in the system.
TEST_P(JointType, ResistsWhatTheCatalogSays) {
  const System system = build_system(model_of(GetParam()));
  const JointTypeInfo& info = *find_joint_type(GetParam());
  const JointData& joint = system.joints[0];
  const S::Mat K = respond(joint.law, S::Vec(1e-3, 0, 0), S::Vec::Zero()).stiffness;
  int linear = 0, angular = 0;
  for (const ComponentInfo& component : info.gap) ++(component.angular ? angular : linear);
  EXPECT_EQ((K(0, 0) > 0) + (K(1, 1) > 0), linear);
  EXPECT_EQ(K(2, 2) > 0, angular > 0);
  for (const ComponentInfo& component : info.free) {
    const int k = component.angular ? 2 : 0;
    EXPECT_EQ(joint.free_mask[k], 1);
    EXPECT_EQ(K(k, k), 0) << component.name;
  }
  EXPECT_EQ(joint.free_mask.sum(), static_cast<double>(info.free.size() + (has_slip(joint.displacement) ? 1 : 0)));
}

TEST_P(JointType, GapIsZeroWhereItIsSettledOpen) {
  Random random(22);
  const Model model = model_of(GetParam());
  const System open = build_system(model);
  if (!is_open(model, open, 0)) return;  // its gap is known before assembly
  Vecs q, v;
  sample::random_state(random, 2, q, v);
  std::vector<std::string> notes;
  const System system = fix_assembled_values(model, open, q, notes);
  std::vector<S::Motion> m;
  system.motions(q, v, m);
  EXPECT_NEAR(system.kinematics(0, 0, m).gap[0], 0, 1e-14);
}

std::vector<std::string> catalog_words() {
  std::vector<std::string> all;
  for (const JointTypeInfo& info : joint_type_catalog()) all.emplace_back(info.word);
  return all;
}
INSTANTIATE_TEST_SUITE_P(Catalog, JointType, testing::ValuesIn(catalog_words()), [](const auto& type) { return type.param; });

TEST(BuildSystem, KeepsNamesAndOrder) {
  const System system = build_system(sample::four_bar(1e8, 3000));
  ASSERT_EQ(system.n_bodies(), 3);
  ASSERT_EQ(system.n_joints(), 4);
  EXPECT_EQ(system.bodies[1].name, "coupler");
  EXPECT_EQ(system.bodies[1].mass, S::Vec(4, 4, 5.333));
  EXPECT_EQ(system.joints[2].name, "B");
  EXPECT_EQ(system.joints[2].at.a, 1);
  EXPECT_EQ(system.joints[2].at.b, 2);
  EXPECT_EQ(system.joints[0].at.a, kGround);
  EXPECT_EQ(system.joints[3].at.F.p, S::Point(6, 0));
}

TEST(BuildSystem, ServosStandAfterTheJointsInTheMotorsOrder) {
  const System system = build_system(sample::everything());
  const int n = system.n_joints();
  ASSERT_GE(n, 2);
  EXPECT_EQ(system.joints[n - 2].name, "V");
  EXPECT_EQ(system.joints[n - 2].servo, 2);
  EXPECT_EQ(system.joints[n - 2].speed, 1.7);
  EXPECT_EQ(system.joints[n - 1].name, "W");
  EXPECT_EQ(system.joints[n - 1].servo, 0);  // a slot's free coordinate: the slide
  for (int j = 0; j < n - 2; ++j) EXPECT_EQ(system.joints[j].servo, -1);
}

TEST(BuildSystem, DampingAndStiffnessPerComponent) {
  Model model = model_of("prismatic");
  model.joints[0].law.values = {{"stiffness", {7e5}}, {"damping", {11}}, {"angular_stiffness", {3e4}}, {"angular_damping", {5}}};
  const LinearLaw prismatic = *build_system(model).joints[0].law.as_linear();
  EXPECT_EQ(prismatic.k, S::Vec(0, 7e5, 3e4));
  EXPECT_EQ(prismatic.c, S::Vec(0, 11, 5));
  model = model_of("revolute");
  model.joints[0].law.values = {{"stiffness", {1e6, 2e6}}};
  const LinearLaw revolute = *build_system(model).joints[0].law.as_linear();
  EXPECT_EQ(revolute.k, S::Vec(1e6, 2e6, 0));
  EXPECT_EQ(revolute.c, S::Vec(3e3, 3e3, 0));  // the catalog's fallback
}

void expect_refused(const Model& model, const std::string& word) {
  try {
    static_cast<void>(build_system(model));
    ADD_FAILURE() << "not refused: " << word;
  } catch (const std::invalid_argument& refusal) {
    EXPECT_NE(std::string(refusal.what()).find(word), std::string::npos) << refusal.what();
  }
}

TEST(BuildSystem, RefusesNamesThatDoNotExist) {
  Model model = sample::four_bar(1e8, 3000);
  model.joints[1].second.body = "copler";
  expect_refused(model, "copler");
  model = sample::four_bar(1e8, 3000);
  model.joints[1].second.marker = "Z";
  expect_refused(model, "'Z'");
  model = sample::four_bar(1e8, 3000);
  model.joints[1].type = "hinge";
  expect_refused(model, "hinge");
  model = sample::four_bar(1e8, 3000);
  model.joints[1].law.word = "rubber";
  expect_refused(model, "rubber");
  model = sample::four_bar(1e8, 3000);
  model.motors = {sample::motor("M", "O3", MotorKind::kSpeed, Expression::constant(1))};
  expect_refused(model, "O3");
  model = sample::four_bar(1e8, 3000);
  model.motors = {sample::motor("M", "O2", MotorKind::kEffort, sample::expression("bogus", {"bogus"}))};
  expect_refused(model, "bogus");
}

TEST(BuildSystem, RefusesValuesThatALawDoesNotTake) {
  const auto with = [](const char* law, std::map<std::string, std::vector<double>> values) {
    Model model = sample::four_bar(1e8, 3000);
    model.joints[1].law = {law, std::move(values)};
    return model;
  };
  expect_refused(with("linear", {{"stifness", {1e4}}}), "did you mean 'stiffness'?");
  expect_refused(with("linear", {{"stiffness", {-1e8}}}), "stiffness = -1e+08");
  expect_refused(with("linear", {{"stiffness", {}}}), "stiffness is one number");
  expect_refused(with("linear", {{"damping", {std::nan("")}}}), "damping is not a number");
  expect_refused(with("clearance", {}), "needs the key 'clearance'");
  Model model = sample::four_bar(1e8, 3000);
  model.joints[1].friction = {"coulomb", {{"coefficient", {0.9}}, {"pin_radius", {0.05}}}};
  expect_refused(model, "friction_coefficient");
}

TEST(BuildSystem, RefusesTwoOfOneName) {
  Model model = sample::four_bar(1e8, 3000);
  model.bodies[1].name = model.bodies[0].name;
  expect_refused(model, "two bodies");
  model = sample::four_bar(1e8, 3000);
  model.joints[1].name = model.joints[0].name;
  expect_refused(model, "two joints");
}

TEST(BuildSystem, RefusesMassesThatAreNotPositive) {
  for (const double bad : {0.0, -1.0, std::nan("")}) {
    Model model = sample::pendulum(1e6, 0);
    model.bodies[0].mass = bad;
    expect_refused(model, "rod");
    model = sample::pendulum(1e6, 0);
    model.bodies[0].inertia = bad;
    expect_refused(model, "rod");
  }
}

TEST(BuildSystem, RefusesAJointOfABodyWithItself) {
  Model model = sample::four_bar(1e8, 3000);
  model.joints[1].second = {"crank", "O2"};
  expect_refused(model, "same body");
}

// A body that hangs on a spring with the assembled length 2 m.
Model hanging() {
  Model model = sample::pendulum(1e6, 0);
  model.ground.push_back({"H", {0.0, 2}, 0});
  model.springs = {sample::spring("S", false, {"ground", "H"}, {"rod", "O"}, 100, 1)};
  return model;
}

System settled_system(const Model& model, std::vector<std::string>& notes) {
  return fix_assembled_values(model, build_system(model), {{0.5, 0, 0}}, notes);
}

TEST(Settle, FreeLengthIsTheAssembledOneLessThePreload) {
  std::vector<std::string> notes;
  Model model = hanging();
  EXPECT_NEAR(settled_system(model, notes).loads[0].free, 2, 1e-15);
  EXPECT_EQ(notes.size(), 1u);
  model.springs[0].preload = 30;
  const System tense = settled_system(model, notes);
  EXPECT_NEAR(tense.loads[0].free, 1.7, 1e-15);
  std::vector<S::Motion> m;
  tense.motions({{0.5, 0, 0}}, {{0, 0, 0}}, m);
  EXPECT_NEAR(tense.load_effort(tense.loads[0], 0, m), -30, 1e-12);
  model.springs[0].preload.reset();
  model.springs[0].free_length = 0.9;
  EXPECT_EQ(settled_system(model, notes).loads[0].free, 0.9);
}

// Forces that read coordinates are loads too; they come after the springs.
TEST(Settle, FreeLengthIsTheSpringsOwnBesideAForceThatReads) {
  std::vector<std::string> notes;
  Model model = hanging();
  AppliedForce force;
  force.name = "push";
  force.on = model.springs[0].second;
  force.force[0] = sample::expression("rod.x", {"rod.x"});
  model.forces.push_back(std::move(force));
  ASSERT_EQ(build_system(model).loads.size(), 2u);
  EXPECT_NEAR(settled_system(model, notes).loads[0].free, 2, 1e-15);
}

TEST(Settle, ADamperWithoutStiffnessHasNoForceAtRest) {
  std::vector<std::string> notes;
  Model model = hanging();
  model.springs[0].stiffness = 0;
  const System system = settled_system(model, notes);
  std::vector<S::Motion> m;
  system.motions({{0.5, 0, 0}}, {{0, 3, 0}}, m);
  EXPECT_NEAR(system.load_effort(system.loads[0], 0, m), 3, 1e-12);  // it shortens at 3 m/s, so it pushes
  EXPECT_EQ(system.external_work(0, {{0.5, 0, 0}}, m).potential, 0);
}

TEST(Settle, APreloadWithoutStiffnessPullsAtAnyLength) {
  std::vector<std::string> notes;
  Model model = hanging();
  model.springs[0].stiffness = model.springs[0].damping = 0;
  model.springs[0].preload = 30;
  const System system = settled_system(model, notes);
  std::vector<S::Motion> m;
  for (const double lift : {0.0, 0.5, -1.0}) {
    system.motions({{0.5, lift, 0}}, {{0, 3, 0}}, m);
    EXPECT_EQ(system.load_effort(system.loads[0], 0, m), -30);
    // With the body's own weight: lifting along the spring's pull stores less energy in the spring.
    EXPECT_NEAR(system.external_work(0, {{0.5, lift, 0}}, m).potential, (9.81 - 30) * lift, 1e-12);
  }
}

TEST(Settle, TorsionPreloadTurnsTowardsSmallerAngles) {
  std::vector<std::string> notes;
  Model model = hanging();
  model.springs = {sample::spring("T", true, {"ground", "O"}, {"rod", "O"}, 4, 0)};
  model.springs[0].preload = 2;
  const System system = settled_system(model, notes);
  Vecs Q;
  std::vector<S::Motion> m;
  system.motions({{0.5, 0, 0}}, {{0, 0, 0}}, m);
  system.external(0, m, Q);
  EXPECT_NEAR(Q[0][2], -2, 1e-13);
}

TEST(Settle, ConstantSpeedDriveStartsWhereItIs) {
  Model model = sample::four_bar(1e8, 3000);
  model.motors = {sample::motor("M", "O2", MotorKind::kSpeed, Expression::constant(10))};
  const System open = build_system(model);
  EXPECT_TRUE(is_open(model, open, 4));
  EXPECT_FALSE(is_open(model, open, 0));
  Vecs q, v;
  for (const Body& body : model.bodies) {
    q.emplace_back((*body.position)[0], (*body.position)[1], *body.angle);
    v.emplace_back((*body.velocity)[0], (*body.velocity)[1], *body.spin);
  }
  std::vector<std::string> notes;
  const System system = fix_assembled_values(model, open, q, notes);
  EXPECT_DOUBLE_EQ(system.joints[4].start, std::numbers::pi / 3);
  std::vector<S::Motion> m;
  system.motions(q, v, m);
  const JointKinematics r = system.kinematics(4, 0, m);
  EXPECT_NEAR(r.gap[2], 0, 1e-15);
  EXPECT_NEAR(r.rate[2], 0, 1e-14);
}

TEST(Settle, RodWithoutLengthKeepsItsDistance) {
  Model model = model_of("rod");
  EXPECT_TRUE(is_open(model, build_system(model), 0));
  model.joints[0].geometry = {{"length", 2}};
  EXPECT_FALSE(is_open(model, build_system(model), 0));
}

TEST(Unwind, WholeTurnsOfSlidersAndWeldsAreTakenOff) {
  for (const char* type : {"prismatic", "fixed"}) {
    const double turn = 2 * std::numbers::pi;
    const Vecs q{{0, 0, 0.1}, {1, 0, 0.5 + 0.8 + 3 * turn}};
    const System system = unwind(build_system(model_of(type)), q);
    std::vector<S::Motion> m;
    system.motions(q, {{0, 0, 0}, {0, 0, 0}}, m);
    EXPECT_NEAR(system.kinematics(0, 0, m).gap[2], -0.1, 1e-13) << type;
  }
}

}  // namespace
}  // namespace pintle
