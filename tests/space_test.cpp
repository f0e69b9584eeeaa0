// Mechanisms in space against published and computed values: a free body (closed form), a heavy top on a spherical joint, Bricard's six hinges.
// Figures from the benchmark collections named beside them. theory/space.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "integrators/absolute/radau_stepper.h"
#include "integrators/dense/dense_output.h"
#include "start/preload.h"
#include "start/settle_joints.h"
#include "start/start.h"
#include "system/build.h"
#include "system/sample_systems_for_tests.h"

namespace pintle {
namespace {

using S = Spatial;
using SpatialSystem = BasicSystem<S>;
using SpatialState = BasicState<S>;
using Point = S::Point;

BasicBodyData<S> body(const std::string& name, double mass, const Point& inertia, const Point& gravity) {
  BasicBodyData<S> b;
  b.name = name;
  b.mass << mass, mass, mass, inertia;
  b.gravity << mass * gravity, 0, 0, 0;
  return b;
}

BasicJointData<S> joint(const std::string& name, const std::string& type, int a, const S::Frame& F, int b, const S::Frame& M, double k, double c, double k_turn, double c_turn) {
  BasicJointData<S> j;
  j.name = name;
  j.type = type;
  j.at = {a, b, F, M};
  BasicLinearLaw<S> law;
  const bool hinge = type == "revolute";
  for (int i = 0; i < S::kDof; ++i) {
    const bool held = i < S::kDim || (hinge && i != S::kTurn);
    j.held[i] = held;
    j.free_mask[i] = held ? 0 : 1;
    if (!held) continue;
    law.k[i] = i < S::kDim ? k : k_turn;
    law.c[i] = i < S::kDim ? c : c_turn;
  }
  j.law = law;
  return j;
}

SpatialState at(const SpatialSystem& system, const PositionsOf<S>& q, const VecsOf<S>& v) {
  SpatialState state;
  state.q = q;
  state.v = v;
  start_forces(system, true, state);
  return state;
}

// The state at each of the times, and the number of steps.
struct SpatialRun {
  std::vector<SpatialState> states;
  Counters counters;
};
SpatialRun run(const SpatialSystem& system, const SpatialState& start, const std::vector<double>& times, double tolerance, int stages) {
  BasicRadauStepper<S> stepper(system, tolerance, stages);
  BasicDenseOutput<S> dense(system);
  stepper.start(start, 1e-4 * times.back());
  SpatialRun out;
  for (std::size_t next = 0; next < times.size();) {
    if (!stepper.step(times.back())) {
      ADD_FAILURE() << stepper.failure();
      break;
    }
    for (; next < times.size() && times[next] <= stepper.state().t; ++next)
      out.states.push_back(dense.at(times[next], stepper.previous(), stepper.state(), stepper.nodes()));
  }
  out.counters = stepper.counters();
  return out;
}

// L. D. Landau, E. M. Lifshitz, Mechanics, section 37: inertias 1, 2, 3 and almost a turn about the second axis. Omega at 5 and 10 s, and when the body has turned
// over: half a period.
TEST(Space, AFreeBodyTurnsOverWhenJacobisFunctionsSay) {
  SpatialSystem system;
  system.bodies.push_back(body("body", 1, {1, 2, 3}, Point::Zero()));
  system.finish();
  S::Vec v;
  v << 0, 0, 0, 0.01, 5, 0.01;
  const SpatialState start = at(system, {S::Coordinates{}}, {v});
  constexpr double kFlip = 5.02592913815747;
  for (const int stages : {3, 5}) {
    const SpatialRun done = run(system, start, {2.5, 5, kFlip}, stages == 3 ? 1e-9 : 1e-11, stages);
    EXPECT_LT(done.counters.steps, stages == 3 ? 500u : 170u);
    const auto &at_5 = done.states[1], &flipped = done.states[2];
    EXPECT_NEAR(at_5.v[0][3], -0.011325693900949457, 1e-6);
    EXPECT_NEAR(at_5.v[0][4], -4.999997172864967, 1e-6);
    EXPECT_NEAR(at_5.v[0][5], 0.01046058223902162, 1e-6);
    // Half a period turns all but the third component: the crossing is known as well as that one's rate allows.
    EXPECT_NEAR(flipped.v[0][3], -0.01, 1e-6);
    EXPECT_NEAR(flipped.v[0][4], -5, 1e-6);
    EXPECT_NEAR(flipped.v[0][5], 0.01, 1e-6);
    const Eigen::Quaterniond wanted(0.002587229517335836, -0.8309815842769167, 0.0008476303653822472, -0.5562932629097853);
    EXPECT_LT(wanted.angularDistance(at_5.q[0].r), 2e-6);
    const Point momentum = at_5.q[0].r * Point(at_5.v[0][3], 2 * at_5.v[0][4], 3 * at_5.v[0][5]);
    EXPECT_LT((momentum - Point(0.01, 10, 0.03)).norm(), 1e-6);
  }
}

// Z. Terze, A. Mueller, D. Zlatar, Multibody System Dynamics 38 (2016) 201-225, with a spherical joint: 15 kg, 150 rad/s. Forces of ideal joints, as computed with
// multipliers to 1e-13.
TEST(Space, AHeavyTopCarriesTheKnownForces) {
  SpatialSystem system;
  system.bodies.push_back(body("top", 15, {0.234375, 0.46875, 0.234375}, {0, 0, -9.81}));
  system.joints.push_back(joint("ball", "spherical", kGround, S::Frame{}, 0, S::Frame::at({0, -1, 0}, Eigen::Matrix3d::Identity()), 1e9, 1e4, 0, 0));
  system.finish();
  S::Vec v;
  v << 4.61538, 0, 0, 0, 150, -4.61538;
  const SpatialState start = at(system, {S::Coordinates{{0, 1, 0}, Eigen::Quaterniond::Identity()}}, {v});
  const Point expected[] = {{-640.2364079922062, -148.62771134696467, 136.9293130385287}, {-517.6007394773699, -396.8431014892873, 404.5749251636106}};
  const Eigen::Quaterniond wanted(-0.7082791529743135, 0.4387810881265964, 0.5457283961454085, 0.08939975282398263);
  const SpatialRun close = run(system, start, {0.2, 1.0}, 1e-9, 5);
  for (const double tolerance : {1e-4, 1e-6}) {
    const SpatialRun done = run(system, start, {0.2, 1.0}, tolerance, 5);
    EXPECT_LT(done.counters.steps, 400u);
    EXPECT_LT(wanted.angularDistance(done.states[0].q[0].r), 1e-6);
    for (int i = 0; i < 2; ++i) {
      const Point f = done.states[i].force[0].head<3>();
      EXPECT_LT((f - expected[i]).norm(), 1e-5 * expected[i].norm());                                    // the ball gives way by F / k
      EXPECT_LT((f - close.states[i].force[0].head<3>()).norm(), tolerance * expected[i].norm());
    }
  }
}

// IFToMM library of benchmark problems, A04: Bricard's mechanism, six hinges in a ring of five rods, one of whose conditions is redundant. P3, the joint of the third
// and fourth rod, as computed with ideal joints to 1e-12.
SpatialSystem bricard(double k) {
  SpatialSystem system;
  const std::vector<Point> P{{0, 0, 0}, {1, 0, 0}, {1, -1, 0}, {1, -1, 1}, {0, -1, 1}, {0, 0, 1}};
  const std::vector<Point> axis{Point::UnitY(), Point::UnitZ(), Point::UnitX(), Point::UnitY(), Point::UnitZ(), Point::UnitX()};
  std::vector<Point> centre;
  for (int i = 0; i < 5; ++i) {
    const Point along = P[i + 1] - P[i];
    Point inertia = Point::Constant(0.08416666666666667);
    inertia += (0.0016666666666666668 - inertia[0]) * along.cwiseAbs();
    system.bodies.push_back(body("rod" + std::to_string(i + 1), 1, inertia, {0, -9.81, 0}));
    centre.push_back(0.5 * (P[i] + P[i + 1]));
  }
  for (int j = 0; j < 6; ++j) {
    const int a = j == 0 ? kGround : j - 1, b = j == 5 ? kGround : j;
    const auto frame = [&](int on) { return S::Frame::along(on == kGround ? P[j] : Point(P[j] - centre[on]), axis[j]); };
    system.joints.push_back(joint("P" + std::to_string(j), "revolute", a, frame(a), b, frame(b), k, 1e-4 * k, 0.1 * k, 1e-5 * k));
  }
  system.finish();
  return system;
}
SpatialState bricard_start(const SpatialSystem& system) {
  PositionsOf<S> q;
  for (const Point& p : {Point(0.5, 0, 0), Point(1, -0.5, 0), Point(1, -1, 0.5), Point(0.5, -1, 1), Point(0, -0.5, 1)}) q.push_back({p, Eigen::Quaterniond::Identity()});
  BasicSettledStart<S> start;
  start.state = at(system, q, VecsOf<S>(5, S::Vec::Zero()));
  settle_joints(system, 10, 0, start);
  EXPECT_TRUE(start.notes.empty());
  return start.state;
}

TEST(Space, BricardsHingesMoveAsComputed) {
  const SpatialSystem system = bricard(1e9);
  const SpatialState start = bricard_start(system);
  const SpatialRun done = run(system, start, {1, 2, 4, 7, 9, 10}, 1e-5, 5);
  EXPECT_LT(done.counters.steps, 250u);
  const Point expected[] = {{0.5105014611872182, -1.6491675993948074, 0.14012311455318463}, {-0.9693403447776451, -1.2212468949563386, 0.7542780107797513},
                            {0.5248995933913272, -1.6438760013360654, 0.14883584611567457}, {-0.9713738492431965, -1.2145418748558687, 0.7624440171107958},
                            {0.5390642884947408, -1.6384532083403974, 0.1577353783580486},  {0.9999999638063497, -1.0002690126961664, 0.9997309511199182}};
  for (std::size_t i = 0; i < done.states.size(); ++i) {
    const auto& q = done.states[i].q[2];
    const Point P3 = q.p + q.r * Point(0, 0, 0.5);
    EXPECT_LT((P3 - expected[i]).norm(), 2e-6) << i;
  }
}

// Forces of all hinges keep the tolerance against a run that is a thousand times as tight, and converge as the stiffness grows: the ring's redundant condition
// shares its load by the hinges' compliances.
TEST(Space, BricardsReactionsAreRightAndConvergeWithTheStiffness) {
  const std::vector<double> times{1, 2, 4, 7};
  const auto forces = [&times](double k, double tolerance) {
    const SpatialSystem system = bricard(k);
    std::vector<S::Vec> all;
    for (const SpatialState& state : run(system, bricard_start(system), times, tolerance, 5).states)
      for (const S::Vec& f : state.force) all.push_back(f);
    return all;
  };
  const auto difference = [](const std::vector<S::Vec>& a, const std::vector<S::Vec>& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, (a[i] - b[i]).head<3>().norm());
    return largest;
  };
  double peak = 0;
  const std::vector<S::Vec> exact = forces(1e9, 1e-8);
  for (const S::Vec& f : exact) peak = std::max(peak, f.head<3>().norm());
  EXPECT_LT(difference(forces(1e9, 1e-5), exact), 1e-5 * peak);
  const double first = difference(forces(1e7, 1e-8), forces(1e8, 1e-8)), second = difference(forces(1e8, 1e-8), exact);
  EXPECT_NEAR(first / second, 10, 1);
}

// A wheel on a hinge: its free turn counts on past half a turn, inside steps too.
TEST(Space, AHingeCountsTurns) {
  SpatialSystem system;
  system.bodies.push_back(body("wheel", 2, {0.1, 0.1, 0.2}, Point::Zero()));
  system.joints.push_back(joint("axle", "revolute", kGround, S::Frame{}, 0, S::Frame{}, 1e8, 1e4, 1e6, 1e2));
  system.finish();
  S::Vec v;
  v << 0, 0, 0, 0, 0, 10;
  const SpatialState start = at(system, {S::Coordinates{}}, {v});
  const std::vector<double> times{0.1, 0.3, 0.35, 0.9, 2};
  const SpatialRun done = run(system, start, times, 1e-8, 5);
  ASSERT_EQ(done.states.size(), times.size());
  for (std::size_t i = 0; i < times.size(); ++i) EXPECT_NEAR(done.states[i].gap[0][S::kTurn], 10 * times[i], 1e-9);
}

// A component of the plane in space: x, y and the turn about z.
constexpr std::array<int, Planar::kDof> kInSpace{0, 1, S::kTurn};
S::Vec in_space(const Planar::Vec& x) {
  S::Vec y = S::Vec::Zero();
  for (int k = 0; k < Planar::kDof; ++k) y[kInSpace[k]] = x[k];
  return y;
}
S::Frame in_space(const Planar::Frame& F) { return S::Frame::at({F.p.x(), F.p.y(), 0}, Eigen::AngleAxisd(F.angle, Point::UnitZ()).toRotationMatrix()); }

// A planar system of hinges as one in space, with z axes out of the plane and hinges that hold their tilts.
SpatialSystem in_space(const System& planar) {
  SpatialSystem system;
  for (const BodyData& b : planar.bodies) system.bodies.push_back(body(b.name, b.mass[0], Point(0.4, 0.7, 1) * b.mass[2], {b.gravity[0] / b.mass[0], b.gravity[1] / b.mass[0], 0}));
  for (const JointData& j : planar.joints) {
    const LinearLaw& law = *j.law.constant_diagonal();
    system.joints.push_back(joint(j.name, "revolute", j.at.a, in_space(j.at.F), j.at.b, in_space(j.at.M), law.k[0], law.c[0], law.k[0], law.c[0]));
  }
  system.finish();
  return system;
}
SpatialState in_space(const SpatialSystem& system, const State& planar) {
  SpatialState state;
  for (const Planar::Vec& q : planar.q) state.q.push_back({{q[0], q[1], 0}, Eigen::Quaterniond(Eigen::AngleAxisd(q[2], Point::UnitZ()))});
  for (const Planar::Vec& v : planar.v) state.v.push_back(in_space(v));
  start_forces(system, false, state);
  const auto put = [](const Vecs& from, VecsOf<S>& to) {
    for (std::size_t i = 0; i < from.size(); ++i) to[i] = in_space(from[i]);
  };
  put(planar.gap, state.gap);
  put(planar.gap_rate, state.gap_rate);
  put(planar.gap_accel, state.gap_accel);
  put(planar.force, state.force);
  put(planar.a, state.a);
  return state;
}

// The paper's four-bar, section 8, in the plane and in space.
TEST(Space, APlanarFourBarGivesThePlanarForces) {
  const Model model = sample::four_bar(1e8, 3000);
  System planar = build_system(model);
  const State start = start_of_run(model, planar).state;
  const SpatialSystem system = in_space(planar);
  RadauStepper flat(planar, 1e-9, 5);
  BasicRadauStepper<S> deep(system, 1e-9, 5);
  flat.start(start, 1e-3);
  deep.start(in_space(system, start), 1e-3);
  const double end = 0.5;
  while (flat.state().t < end) ASSERT_TRUE(flat.step(end)) << flat.failure();
  while (deep.state().t < end) ASSERT_TRUE(deep.step(end)) << deep.failure();
  EXPECT_LT(deep.counters().steps, 1.1 * static_cast<double>(flat.counters().steps));
  double peak = 0;
  for (const Planar::Vec& f : flat.state().force) peak = std::max(peak, f.head<2>().norm());
  for (std::size_t j = 0; j < planar.joints.size(); ++j) {
    EXPECT_LT((deep.state().force[j] - in_space(flat.state().force[j])).norm(), 1e-9 * peak) << planar.joints[j].name;
    EXPECT_LT(std::abs(deep.state().force[j][2]) + std::abs(deep.state().force[j][3]) + std::abs(deep.state().force[j][4]), 1e-9 * peak);
  }
  for (std::size_t b = 0; b < planar.bodies.size(); ++b) EXPECT_LT((deep.state().q[b].p.head<2>() - flat.state().q[b].head<2>()).norm(), 1e-9);
}

}  // namespace
}  // namespace pintle
