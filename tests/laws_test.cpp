// Joint laws in whole mechanisms: published and closed-form solutions, and, in every method, laws and joint types that the program does not know.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <string>
#include <vector>

#include "batch/envelope.h"
#include "integrators/general/sundials_stepper.h"
#include "joints/catalog.h"
#include "laws/catalog.h"
#include "laws/law_math.h"
#include "pintle/live.h"
#include "tests/reference_tables.h"

namespace pintle {
namespace {

using reference::at_end;
using reference::completed;
using reference::drift;

// A clutch that slips: two states, a border, full unsymmetric matrices.
struct SlippingClutch {
  static constexpr std::string_view kWord = "clutch";
  double k = 0, c = 0, grip = 0, rate = 0;

  int n_states() const { return 2; }
  template <class T>
  void evaluate(const LawInput<T>& in, LawOutput<T>& out) const {
    const T x = in.gap[0] - in.state[0], y = in.gap[1] - in.state[1];
    out.force[0] = -(k * in.gap[0] + c * in.rate[0] + 0.3 * k * in.gap[1]) - grip * law_math::where_positive(in.gap[0], x, 0.8 * x);
    out.force[1] = -(k * in.gap[1] + c * in.rate[1] + 0.2 * k * in.gap[0]) - grip * y;
    out.state_rate[0] = rate * x + 0.3 * rate * y;
    out.state_rate[1] = rate * y;
    out.loss = T(0.0) - out.force[0] * in.rate[0] - out.force[1] * in.rate[1];  // all that goes in counts as lost
  }
  void rest(const LawInput<double>& in, double* state) const {
    state[0] = in.gap[0];
    state[1] = in.gap[1];
  }
  int n_borders() const { return 1; }
  void borders(const LawInput<double>& in, double* value) const { value[0] = in.gap[0]; }
  Planar::Vec engaged_stiffness() const { return {k, k, 0}; }
};

constexpr std::array<KeyInfo, 2> kClutchKeys{{{.key = "clutch_stiffness", .unit = "N/m", .fallback = 4e5, .minimum_exclusive = true, .meaning = "of a test"},
                                              {.key = "clutch_rate", .unit = "s^-1", .fallback = 30, .minimum_exclusive = true, .meaning = "of a test"}}};
void make_clutch(const LawSetting& at, Law& law) {
  const double k = at.number("clutch_stiffness");
  law.add(std::make_unique<LawPartOf<SlippingClutch>>(SlippingClutch{k, 2e-3 * k, 0.5 * k, at.number("clutch_rate")}));
}

// A gap function that is not in the catalog: two points stay on a hyperbola x y = product.
GapFunction hyperbola(const Planar::Vec& z, const double* p) {
  GapFunction g;
  g.gap = (z[0] * z[1] - p[0]) / p[1];
  g.gradient << z[1] / p[1], z[0] / p[1], 0;
  g.hessian(0, 1) = g.hessian(1, 0) = 1 / p[1];
  return g;
}
JointDisplacement make_hyperbola(const Geometry& g) { return FunctionGap{hyperbola, {g.at("product"), 1.0}}; }
constexpr std::array<ComponentInfo, 1> kProduct{{{.name = "product"}}};
constexpr std::array<KeyInfo, 1> kHyperbolaKeys{{{.key = "product", .unit = "m", .required = true, .meaning = "of a test"}}};

// To be called before the first model is read.
void register_laws() {
  static const bool done = [] {
    register_law({.word = "clutch", .meaning = "of a test", .keys = kClutchKeys, .make = make_clutch});
    register_joint_type({.word = "hyperbola", .meaning = "of a test", .gap = kProduct, .free = {}, .keys = kHyperbolaKeys, .make = make_hyperbola});
    return true;
  }();
  static_cast<void>(done);
}

// The parameters of the paper, for a load of 1 N.
constexpr const char* kBristles = R"toml(friction = "lugre"
friction_coefficient = 1
static_friction = 1.5
stribeck_speed = "0.001 m/s"
bristle_stiffness = 1e5
bristle_damping = "sqrt(1e5) * 1 s/m"
viscous_friction = "0.4 s/m"
)toml";

// Canudas de Wit, Olsson, Astrom, Lischinsky 1995; the table comes from a Radau code at 1e-11.
TEST(LuGre, PulledMassSticksAndSlipsAsPublished) {
  const auto table = reference::read_table("lugre_stick_slip");
  for (const double tolerance : {1e-5, 1e-7}) {
    Model model = parse_model(reference::pulled_mass(1, kBristles), "pulled.toml");
    model.simulate.tolerance = tolerance;
    const Trajectory run = completed(model);
    ASSERT_EQ(run.n_rows(), table.rows.size());
    for (std::size_t i = 0; i < run.n_rows(); ++i) {
      EXPECT_NEAR(run.at(i, run.column("joint.slide.slide")), table.at(i, "x"), 1e-6) << table.at(i, "t");
      EXPECT_NEAR(run.at(i, run.column("body.mass.vx")), table.at(i, "v"), 1e-5) << table.at(i, "t");
    }
    EXPECT_LT(drift(run), 1e-6);
  }
}

// A block of 2 kg, released on an incline of `angle` degrees, mu_s = 0.15.
Trajectory block_on_incline(const std::string& angle, const std::string& settings) {
  return completed(parse_model(R"toml(
format = 1
name = "Block on an incline"
[simulate]
)toml" + settings + R"toml(
[ground.markers]
o = { x = 0, y = 0, axis = "-)toml" + angle + R"toml( deg" }
[body.block]
mass = 2
inertia = 0.01
markers.c = { x = 0, y = 0, axis = "-)toml" + angle + R"toml( deg" }
[joint.slide]
type = "prismatic"
between = ["ground.o", "block.c"]
friction = "lugre"
)toml", "incline.toml"));
}

// It holds for 1000 s, with bristles that bend no farther than mu_s / s_0.
TEST(LuGre, HoldsALoadOnAnIncline) {
  const Trajectory run = block_on_incline("3", "duration = 1000\noutput_step = 10\nmax_step = 2\n");
  const int slide = run.column("joint.slide.slide");
  for (std::size_t i = 1; i < run.n_rows(); ++i) EXPECT_LT(std::abs(run.at(i, slide) - run.at(1, slide)), 0.15 / 1e5) << i;
  EXPECT_NEAR(at_end(run, "joint.slide.friction"), -2 * 9.80665 * std::sin(3 * M_PI / 180), 1e-4);
}

// Bristles start bent under the load that they hold, and do not ring.
TEST(LuGre, BristlesStartBentUnderTheirLoad) {
  const Trajectory held = block_on_incline("3", "duration = 20\n");
  const double weight = 2 * 9.80665, load = weight * std::sin(3 * M_PI / 180);
  for (std::size_t i = 0; i < held.n_rows(); ++i) EXPECT_NEAR(held.at(i, held.column("joint.slide.friction")), -load, 1e-5 * weight) << i;
  EXPECT_LT(held.counters.steps, 1500u);
}

// One turn; the joint forces in every method that integrates laws with states.
TEST(LuGreSlow, FourBarIsTheSameInEveryMethod) {
  Model model = reference::rubbing_four_bar();
  model.simulate.duration = 0.3;
  model.simulate.tolerance = 1e-6;
  const Trajectory truth = completed(model);
  EXPECT_LT(truth.energy.drift, 1e-6);
  std::vector<std::string> methods{"dopri5", "ode23t", "hht", "generalised_alpha"};
  if (has_sundials()) methods.insert(methods.end(), {"ode15s", "ode45"});
  model.simulate.tolerance = 1e-4;
  for (const std::string& method : methods) {
    model.simulate.method = method;
    const Trajectory run = completed(model);
    for (std::size_t j = 0; j < truth.joints.size(); ++j) EXPECT_NEAR(run.joints[j].peak, truth.joints[j].peak, 1e-4 * truth.joints[j].peak) << method;
    for (const char* column : {"joint.B.friction", "joint.O4.friction"}) EXPECT_NEAR(at_end(run, column), at_end(truth, column), 1e-4 * 1.8) << method;
  }
}

// A pin turned at constant speed under a constant load: the couple is N mu(v) r from the start on.
TEST(LuGre, SteadySlipCarriesItsCoefficient) {
  Model model = reference::rubbing_four_bar();
  const Trajectory run = completed(model);
  const int force_x = run.column("joint.O2.on_crank.fx[world]"), force_y = run.column("joint.O2.on_crank.fy[world]"), friction = run.column("joint.O2.friction");
  for (std::size_t i = 0; i < run.n_rows(); ++i)
    EXPECT_NEAR(run.at(i, friction), -0.1 * 0.01 * std::hypot(run.at(i, force_x), run.at(i, force_y)), 3e-4 * 0.67) << i;
}

// Compared with the same turn of the same four-bar without friction.
TEST(LuGre, FrictionInAllPinsOfAFourBarCostsLessThanTwiceTheIterations) {
  const Model rubbing = reference::rubbing_four_bar();
  const Trajectory with = completed(rubbing), without = completed(reference::mechanism("four_bar"));
  EXPECT_LT(static_cast<double>(with.counters.steps), 2.75 * static_cast<double>(without.counters.steps));
  EXPECT_LT(static_cast<double>(with.counters.newton_iterations), 1.9 * static_cast<double>(without.counters.newton_iterations));
  EXPECT_EQ(with.counters.newton_failures, 0);
}

// The bristles of four pins reverse within a few thousandths of a second, and leave a vibration near the tolerance that all passes damp: for crank angles that
// differ by a hundredth of a degree, errors are 0.3 to 5 times those stated. The tolerance is kept.
TEST(LuGre, FourBarKeepsItsTolerance) {
  Model model = reference::rubbing_four_bar();
  model.simulate.tolerance = 1e-8;
  const Trajectory truth = completed(model);
  for (const double tolerance : {1e-4, 1e-5}) {
    model.simulate.tolerance = tolerance;
    const Trajectory run = completed(model);
    for (std::size_t j = 0; j < run.joints.size(); ++j) {
      EXPECT_LT(run.joints[j].relative_error_estimate, tolerance);
      for (std::size_t c = 1; c < run.columns.size(); ++c) {
        const std::string& name = run.columns[c].name;
        if (name.rfind("joint." + run.joints[j].name + ".on_", 0) != 0 || name.find(".f") == std::string::npos || name.find("[world]") == std::string::npos) continue;
        for (std::size_t i = 0; i < run.n_rows(); ++i)
          EXPECT_NEAR(run.at(i, c), truth.at(i, c), tolerance * truth.joints[j].peak) << name << ' ' << i << ' ' << tolerance;
      }
    }
  }
}

constexpr const char* kRubber = R"toml(
format = 1
name = "Mass on rubber"
gravity = [0, 0]
[simulate]
duration = "0.5 s"
output_step = "10 ms"
tolerance = 1e-9
start = "raw"
[ground.markers]
o = [0, 0]
[body.b]
mass = 0.5
inertia = 0.01
position = ["1 mm", 0]
velocity = [0, 0]
angle = 0
spin = 0
markers.c = [0, 0]
[joint.mount]
type = "fixed"
between = ["ground.o", "b.c"]
law = "maxwell"
stiffness = 2e4
damping = "20 N*s/m"
angular_stiffness = 100
branch_ratio = [2, 0.5]
branch_time = ["5 ms", "0.1 s"]
[force.push]
on = "b.c"
force = [50, 0]
)toml";

// The equations in x, x', z_1, z_2 are linear: solved by eigenvalues. The motion starts relaxed at 1 mm, under 50 N from then on.
TEST(Maxwell, CreepsAndRelaxesAsTheClosedFormSays) {
  const Trajectory run = completed(parse_model(kRubber, "rubber.toml"));
  const double m = 0.5, k = 2e4, c = 20, F = 50, tau[2] = {5e-3, 0.1}, branch[2] = {2 * k, 0.5 * k};
  Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
  A(0, 1) = 1;
  A.row(1) << -(k + branch[0] + branch[1]) / m, -c / m, branch[0] / m, branch[1] / m;
  for (int i = 0; i < 2; ++i) {
    A(2 + i, 0) = 1 / tau[i];
    A(2 + i, 2 + i) = -1 / tau[i];
  }
  const Eigen::Vector4d rest = Eigen::Vector4d(1, 0, 1, 1) * (F / k), start(1e-3, 0, 1e-3, 1e-3);
  const Eigen::EigenSolver<Eigen::Matrix4d> modes(A);
  const Eigen::Vector4cd share = modes.eigenvectors().partialPivLu().solve((start - rest).cast<std::complex<double>>());
  const int x = run.column("body.b.x"), t = run.column("t"), fx = run.column("joint.mount.on_b.fx[world]");
  for (std::size_t i = 0; i < run.n_rows(); ++i) {
    const Eigen::Vector4cd now = (modes.eigenvalues() * run.at(i, t)).array().exp() * share.array();
    const Eigen::Vector4d y = rest + (modes.eigenvectors() * now).real();
    EXPECT_NEAR(run.at(i, x), y[0], 1e-9 * F / k);
    const double force = -k * y[0] - c * y[1] - branch[0] * (y[0] - y[2]) - branch[1] * (y[0] - y[3]);
    EXPECT_NEAR(run.at(i, fx), force, 1e-8 * F);
  }
  EXPECT_LT(drift(run), 1e-8);
}

// A skew matrix under gravity and an eccentric mass, solved by hand: K e = f.
TEST(Bushing, RestsWhereItsMatrixSays) {
  const Model model = parse_model(R"toml(
format = 1
name = "Bushing"
[simulate]
duration = "1 s"
[ground.markers]
o = [0, 0]
[body.b]
mass = 2
inertia = 0.01
markers.c = [0, 0]
[joint.mount]
type = "fixed"
between = ["ground.o", "b.c"]
law = "bushing"
stiffness = ["1e6 N/m", "2e6 N/m"]
damping = "500 N*s/m"
angular_stiffness = 1000
angular_damping = 1
stiffness_xy = "3e5 N/m"
stiffness_xa = "-2e3 N/rad"
stiffness_ya = "5e3 N/rad"
preload_x = "5 N"
offset_y = "0.1 mm"
)toml", "bushing.toml");
  const Trajectory run = completed(model);
  Eigen::Matrix3d K;
  K << 1e6, 3e5, -2e3, 3e5, 2e6, 5e3, -2e3, 5e3, 1000;
  const Eigen::Vector3d place = Eigen::Vector3d(0, 1e-4, 0) + K.lu().solve(Eigen::Vector3d(5, -2 * 9.80665, 0));
  EXPECT_NEAR(at_end(run, "body.b.x"), place[0], 1e-9 * 1e-4);
  EXPECT_NEAR(at_end(run, "body.b.y"), place[1], 1e-9 * 1e-4);
  EXPECT_NEAR(at_end(run, "body.b.angle"), place[2], 1e-9 * 1e-2);
}

// The same mechanism turned and moved has the same forces in the bushing's axes.
TEST(Bushing, DoesNotCareWhereTheMechanismStands) {
  const auto swinging = [](double turn) {
    Model model = parse_model(R"toml(
format = 1
name = "Arm in a bushing"
gravity = [0, 0]
[parameters]
turn = "0 deg"
[simulate]
duration = "0.2 s"
start = "raw"
[ground.markers]
o = { x = "3*sin(turn)", y = 1, axis = "turn" }
[body.arm]
mass = 2
inertia = 0.05
position = ["3*sin(turn) + 0.3*cos(turn)", "1 + 0.3*sin(turn)"]
velocity = ["0.2*cos(turn) - 0.5*sin(turn)", "0.2*sin(turn) + 0.5*cos(turn)"]
spin = 1
angle = "turn"
markers.c = [-0.3, 0]
[joint.mount]
type = "fixed"
between = ["ground.o", "arm.c"]
law = "bushing"
stiffness = ["1e6 N/m", "2e6 N/m"]
angular_stiffness = 1000
angular_damping = 1
stiffness_xy = "3e5 N/m"
stiffness_ya = "5e3 N/rad"
preload_y = "20 N"
)toml", "arm.toml", {"parameters.turn=" + std::to_string(turn)});
    return completed(model);
  };
  const Trajectory level = swinging(0), turned = swinging(2.1);
  for (const char* column : {"joint.mount.on_arm.f1[joint]", "joint.mount.on_arm.f2[joint]", "joint.mount.on_arm.m[world]"})
    for (std::size_t i = 0; i < level.n_rows(); ++i)
      EXPECT_NEAR(turned.at(i, turned.column(column)), level.at(i, level.column(column)), 3e-5 * level.joints[0].peak) << column << ' ' << i;
}

constexpr const char* kClutched = R"toml(
format = 1
name = "Two arms on clutches"
[simulate]
duration = "0.4 s"
output_step = "20 ms"
[ground.markers]
o = [0, 0]
[body.upper]
mass = 1
inertia = 0.02
position = [0.2, 0]
angle = 0
markers.a = [-0.2, 0]
markers.b = [0.2, 0]
[body.lower]
mass = 1
inertia = 0.02
position = [0.6, 0]
angle = 0
markers.b = [-0.2, 0]
[joint.A]
type = "revolute"
between = ["ground.o", "upper.a"]
stiffness = 1e7
[joint.B]
type = "revolute"
between = ["upper.b", "lower.b"]
law = "clutch"
)toml";

TEST(AnyLawSlow, OfATestRunsInEveryMethod) {
  register_laws();
  Model model = parse_model(kClutched, "clutched.toml");
  model.simulate.tolerance = 1e-7;
  const Trajectory truth = completed(model);
  EXPECT_LT(drift(truth), 1e-7);
  model.simulate.tolerance = 1e-5;
  std::vector<std::string> methods{"radau", "dopri5", "ode23t", "hht", "generalised_alpha"};
  if (has_sundials()) methods.insert(methods.end(), {"ode15s", "ode45", "ode113"});
  for (const std::string& method : methods) {
    model.simulate.method = method;
    const Trajectory run = completed(model);
    for (const char* column : {"joint.B.on_lower.fx[world]", "joint.B.on_lower.fy[world]"})
      for (std::size_t i = 0; i < run.n_rows(); ++i) EXPECT_NEAR(run.at(i, run.column(column)), truth.at(i, truth.column(column)), 1.5e-5 * truth.joints[1].peak) << method << i;
  }
}

TEST(AnyLaw, OfATestRunsInRelativeCoordinates) {
  register_laws();
  Model model = parse_model(kClutched, "clutched.toml", {"joint.A.ideal=true", "simulate.equations=\"relative\"", "joint.A.stiffness=1e12"});
  const Trajectory tree = completed(model);
  model.simulate.method = "dopri5";
  const Trajectory explicit_tree = completed(model);
  model.simulate.method = "auto";
  model.simulate.equations = Equations::kNewtonian;
  const Trajectory bodies = completed(model);
  for (const Trajectory* run : {&tree, &explicit_tree})
    for (std::size_t i = 0; i < tree.n_rows(); ++i)
      EXPECT_NEAR(run->at(i, run->column("joint.B.on_lower.fx[world]")), bodies.at(i, bodies.column("joint.B.on_lower.fx[world]")), 3e-5 * bodies.joints[1].peak) << i;
}

TEST(AnyLaw, OfATestRunsInSweeps) {
  register_laws();
  const Model base = parse_model(kClutched, "clutched.toml");
  std::vector<Variant> variants;
  for (const double factor : {0.9, 1.1}) {
    Model model = base;
    for (Body& body : model.bodies) body.mass *= factor;
    variants.push_back({model, false});
  }
  const auto results = EnvelopeEngine(base, {{}, true}).run(variants, [] { return true; });
  for (std::size_t i = 0; i < variants.size(); ++i) {
    const Trajectory truth = completed(variants[i].model);
    for (std::size_t j = 0; j < truth.joints.size(); ++j) EXPECT_NEAR(results[i].joints[j].force, truth.joints[j].peak, 2e-5 * truth.joints[j].peak);
  }
}

TEST(AnyLaw, OfATestRunsLive) {
  register_laws();
  const Model model = parse_model(kClutched, "clutched.toml");
  const Trajectory truth = completed(model);
  LiveMotion live(model);
  for (std::size_t i = 1; i < truth.n_rows(); ++i) ASSERT_TRUE(live.advance(truth.at(i, 0) - live.time())) << live.failure();
  EXPECT_NEAR(live.joint_forces()[1][0], at_end(truth, "joint.B.on_lower.fx[world]"), 2e-3 * truth.joints[1].peak);
}

// A bead on a hyperbola: energy is conserved, and the force law of this gap keeps the promised error.
TEST(AnyJointType, OfATestRuns) {
  register_laws();
  Model model = parse_model(R"toml(
format = 1
name = "Bead on a hyperbola"
[simulate]
duration = "0.5 s"
tolerance = 1e-6
[ground.markers]
o = [0, 0]
[body.bead]
mass = 1
inertia = 0.01
position = [0.5, 2]
hold = ["x"]
markers.c = [0, 0]
[joint.wire]
type = "hyperbola"
between = ["ground.o", "bead.c"]
product = 1
)toml", "bead.toml");
  const Trajectory run = completed(model);
  EXPECT_LT(drift(run), 1e-6);
  const double x = at_end(run, "body.bead.x"), y = at_end(run, "body.bead.y");
  EXPECT_NEAR(x * y, 1, 1e-5);
  EXPECT_LT(y, 1.9);
  model.simulate.method = "dopri5";
  const Trajectory other = completed(model);
  EXPECT_NEAR(other.joints[0].peak, run.joints[0].peak, 1e-5 * run.joints[0].peak);
}

}  // namespace
}  // namespace pintle
