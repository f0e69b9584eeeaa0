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
    printf("free stages %d steps %d\n", stages, (int)done.counters.steps);
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
  for (const double tolerance : {1e-4, 1e-6}) {
    const SpatialRun done = run(system, start, {0.2, 1.0}, tolerance, 5);
    printf("top tol %g steps %d newton %d\n", tolerance, (int)done.counters.steps, (int)done.counters.newton_iterations);
    for (int i = 0; i < 2; ++i) {
      const Point f = done.states[i].force[0].head<3>();
      printf("  %d force error %.3g of %g\n", i, (f - expected[i]).norm(), expected[i].norm());
    }
    const Eigen::Quaterniond wanted(-0.7082791529743135, 0.4387810881265964, 0.5457283961454085, 0.08939975282398263);
    printf("  angle error %.3g\n", wanted.angularDistance(done.states[0].q[0].r));
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
  for (const auto& note : start.notes) printf("note %s\n", note.c_str());
  return start.state;
}

TEST(Space, BricardsHingesMoveAsComputed) {
  const SpatialSystem system = bricard(1e9);
  const SpatialState start = bricard_start(system);
  const SpatialRun done = run(system, start, {1, 2, 4, 7, 9, 10}, 1e-5, 5);
  printf("bricard steps %d rejected %d newton %d\n", (int)done.counters.steps, (int)done.counters.rejected, (int)done.counters.newton_iterations);
  const Point expected[] = {{0.5105014611872182, -1.6491675993948074, 0.14012311455318463}, {-0.9693403447776451, -1.2212468949563386, 0.7542780107797513},
                            {0.5248995933913272, -1.6438760013360654, 0.14883584611567457}, {-0.9713738492431965, -1.2145418748558687, 0.7624440171107958},
                            {0.5390642884947408, -1.6384532083403974, 0.1577353783580486},  {0.9999999638063497, -1.0002690126961664, 0.9997309511199182}};
  for (std::size_t i = 0; i < done.states.size(); ++i) {
    const auto& q = done.states[i].q[2];
    const Point P3 = q.p + q.r * Point(0, 0, 0.5);
    printf("  %zu error %.3g\n", i, (P3 - expected[i]).norm());
  }
}

}  // namespace
}  // namespace pintle
