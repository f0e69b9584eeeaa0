// Mechanisms in space against published and computed values: a free body (closed form), a heavy top on a spherical joint, Bricard's six hinges. The figures
// come from the benchmark collections named with them. theory/space.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "integrators/absolute/radau_stepper.h"
#include "integrators/dense/dense_output.h"
#include "run/errors/stated_error.h"
#include "run/run_system.h"
#include "start/start.h"
#include "system/sample_systems_for_tests.h"
#include "tests/spatial_models.h"

namespace pintle {
namespace {

using S = Spatial;
using Point = S::Point;
using sample::SpatialSample;
using sample::SpatialState;
using sample::SpatialSystem;

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

// L. D. Landau, E. M. Lifshitz, Mechanics, section 37: inertias 1, 2, 3 and almost a pure rotation about the second axis. Omega at 5 and 10 s, and when the body
// has turned over: half a period.
TEST(Space, AFreeBodyTurnsOverWhenJacobisFunctionsSay) {
  SpatialSample free;
  free.system.bodies.push_back(sample::spatial_body("body", 1, {1, 2, 3}, Point::Zero()));
  free.system.finish();
  S::Vec v;
  v << 0, 0, 0, 0.01, 5, 0.01;
  free.start_at({S::Coordinates{}}, {v});
  constexpr double kFlip = 5.02592913815747;
  for (const int stages : {3, 5}) {
    const SpatialRun done = run(free.system, free.start, {2.5, 5, kFlip}, stages == 3 ? 1e-9 : 1e-11, stages);
    EXPECT_LT(done.counters.steps, stages == 3 ? 500u : 170u);
    const auto &at_5 = done.states[1], &flipped = done.states[2];
    EXPECT_NEAR(at_5.v[0][3], -0.011325693900949457, 1e-6);
    EXPECT_NEAR(at_5.v[0][4], -4.999997172864967, 1e-6);
    EXPECT_NEAR(at_5.v[0][5], 0.01046058223902162, 1e-6);
    // Half a period reverses all but the third component: the crossing is known as accurately as the rate of that component allows.
    EXPECT_NEAR(flipped.v[0][3], -0.01, 1e-6);
    EXPECT_NEAR(flipped.v[0][4], -5, 1e-6);
    EXPECT_NEAR(flipped.v[0][5], 0.01, 1e-6);
    const Eigen::Quaterniond wanted(0.002587229517335836, -0.8309815842769167, 0.0008476303653822472, -0.5562932629097853);
    EXPECT_LT(wanted.angularDistance(at_5.q[0].r), 2e-6);
    const Point momentum = at_5.q[0].r * Point(at_5.v[0][3], 2 * at_5.v[0][4], 3 * at_5.v[0][5]);
    EXPECT_LT((momentum - Point(0.01, 10, 0.03)).norm(), 1e-6);
  }
}

// Forces of ideal joints, as computed with multipliers to 1e-13.
TEST(Space, AHeavyTopCarriesTheKnownForces) {
  const auto [system, start, notes] = sample::heavy_top();
  const Point expected[] = {{-640.2364079922062, -148.62771134696467, 136.9293130385287}, {-517.6007394773699, -396.8431014892873, 404.5749251636106}};
  const Eigen::Quaterniond wanted(-0.7082791529743135, 0.4387810881265964, 0.5457283961454085, 0.08939975282398263);
  const SpatialRun close = run(system, start, {0.2, 1.0}, 1e-9, 5);
  for (const double tolerance : {1e-4, 1e-6}) {
    const SpatialRun done = run(system, start, {0.2, 1.0}, tolerance, 5);
    EXPECT_LT(done.counters.steps, 400u);
    EXPECT_LT(wanted.angularDistance(done.states[0].q[0].r), 1e-6);
    for (int i = 0; i < 2; ++i) {
      const Point f = done.states[i].force[0].head<3>();
      EXPECT_LT((f - expected[i]).norm(), 1e-5 * expected[i].norm());                                    // the ball joint deflects by F / k
      EXPECT_LT((f - close.states[i].force[0].head<3>()).norm(), tolerance * expected[i].norm());
    }
  }
}

// P3 as computed with ideal joints to 1e-12.
TEST(Space, BricardsHingesMoveAsComputed) {
  const auto [system, start, notes] = sample::bricard(1e9);
  EXPECT_TRUE(notes.empty());
  const SpatialRun done = run(system, start, {1, 2, 4, 7, 9, 10}, 1e-5, 5);
  EXPECT_LT(done.counters.steps, 250u);
  const Point expected[] = {{0.5105014611872182, -1.6491675993948074, 0.14012311455318463}, {-0.9693403447776451, -1.2212468949563386, 0.7542780107797513},
                            {0.5248995933913272, -1.6438760013360654, 0.14883584611567457}, {-0.9713738492431965, -1.2145418748558687, 0.7624440171107958},
                            {0.5390642884947408, -1.6384532083403974, 0.1577353783580486},  {0.9999999638063497, -1.0002690126961664, 0.9997309511199182}};
  for (std::size_t i = 0; i < done.states.size(); ++i) {
    EXPECT_LT((sample::bricard_p3(done.states[i].q[2]) - expected[i]).norm(), 2e-6) << i;
  }
}

// Forces of all hinges keep the tolerance against a run with a tolerance a thousand times tighter, and converge as the stiffness grows: the hinges share the
// load of the ring's redundant constraint by their compliances.
TEST(Space, BricardsReactionsAreRightAndConvergeWithTheStiffness) {
  const std::vector<double> times{1, 2, 4, 7};
  const auto forces = [&times](double k, double tolerance) {
    const SpatialSample ring = sample::bricard(k);
    std::vector<S::Vec> all;
    for (const SpatialState& state : run(ring.system, ring.start, times, tolerance, 5).states)
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

// Between the ends of long steps, where the stages' positions do not fit the redundant constraint, the hinges share its load as they do at the ends.
TEST(Space, BricardsReactionsAreRightWithinSteps) {
  const SpatialSample ring = sample::bricard(1e9);
  std::vector<double> times;
  for (int i = 1; i <= 40; ++i) times.push_back(0.025 * i);
  const SpatialRun coarse = run(ring.system, ring.start, times, 1e-5, 3), fine = run(ring.system, ring.start, times, 1e-9, 5);
  EXPECT_LT(coarse.counters.steps, 40u);
  double peak = 0, worst = 0;
  for (std::size_t i = 0; i < times.size(); ++i)
    for (std::size_t j = 0; j < ring.system.joints.size(); ++j) {
      const S::Vec& exact = fine.states[i].force[j];
      peak = std::max(peak, exact.head<3>().norm());
      worst = std::max(worst, (coarse.states[i].force[j] - exact).norm());
    }
  EXPECT_LT(worst, 1e-6 * peak);
}

// A wheel on a hinge: its free angle keeps counting beyond half a turn, within steps too.
TEST(Space, AHingeCountsTurns) {
  SpatialSample spinning;
  spinning.system.bodies.push_back(sample::spatial_body("wheel", 2, {0.1, 0.1, 0.2}, Point::Zero()));
  spinning.system.joints.push_back(sample::spatial_joint("axle", "revolute", kGround, S::Frame{}, 0, S::Frame{}, {1e8, 1e4, 1e6, 1e2}));
  spinning.system.finish();
  S::Vec v;
  v << 0, 0, 0, 0, 0, 10;
  spinning.start_at({S::Coordinates{}}, {v});
  const std::vector<double> times{0.1, 0.3, 0.35, 0.9, 2};
  const SpatialRun done = run(spinning.system, spinning.start, times, 1e-8, 5);
  ASSERT_EQ(done.states.size(), times.size());
  for (std::size_t i = 0; i < times.size(); ++i) EXPECT_NEAR(done.states[i].gap[0][S::kTurn], 10 * times[i], 1e-9);
}

// The paper's four-bar, section 8, in the plane and in space.
TEST(Space, APlanarFourBarGivesThePlanarForces) {
  const Model model = sample::four_bar(1e8, 3000);
  const Assembly assembly = start_of_run(model);
  const System& planar = assembly.system;
  const State& start = assembly.state;
  const SpatialSystem system = sample::in_space(planar);
  RadauStepper flat(planar, 1e-9, 5);
  BasicRadauStepper<S> deep(system, 1e-9, 5);
  flat.start(start, 1e-3);
  deep.start(sample::in_space(system, start), 1e-3);
  const double end = 0.5;
  while (flat.state().t < end) ASSERT_TRUE(flat.step(end)) << flat.failure();
  while (deep.state().t < end) ASSERT_TRUE(deep.step(end)) << deep.failure();
  EXPECT_LT(deep.counters().steps, 1.1 * static_cast<double>(flat.counters().steps));
  double peak = 0;
  for (const Planar::Vec& f : flat.state().force) peak = std::max(peak, f.head<2>().norm());
  for (std::size_t j = 0; j < planar.joints.size(); ++j) {
    EXPECT_LT((deep.state().force[j] - sample::in_space(flat.state().force[j])).norm(), 1e-9 * peak) << planar.joints[j].name;
    EXPECT_LT(std::abs(deep.state().force[j][2]) + std::abs(deep.state().force[j][3]) + std::abs(deep.state().force[j][4]), 1e-9 * peak);
  }
  for (std::size_t b = 0; b < planar.bodies.size(); ++b) EXPECT_LT((deep.state().q[b].p.head<2>() - flat.state().q[b].head<2>()).norm(), 1e-9);
}

// Runs at three tolerances, each with a stated error, against one at 1e-9: each joint force is right within the tolerance, and the stated error is between a third of the true one and thirty times it, apart from
// the error stated by the run at 1e-9 itself. Hinges of 1e9 N/m that share a redundant constraint cannot have forces to 1e-9, which is less than the roundoff of positions in metres causes; that run has to be ten
// times better than the best.
// `overstated`: a tolerance at which a factor of a thousand is allowed.
void expect_promise(const SpatialSample& of, double duration, const std::string& what, double overstated = 0) {
  SimulateSettings settings;
  settings.duration = duration;
  settings.tolerance = 1e-9;
  const BasicSystemRun<S> truth = run_system(of.system, of.start, settings);
  ASSERT_EQ(truth.rows.t.back(), duration) << what << ": " << truth.result.message;
  for (const LoadSummary& joint : truth.result.joints) ASSERT_LT(joint.relative_error_estimate, 1e-8) << what << ": " << truth.result.message;
  for (const double tolerance : {1e-3, 1e-5, 1e-7}) {
    settings.tolerance = tolerance;
    const double most = tolerance == overstated ? 1000 : 30;
    const BasicSystemRun<S> done = run_system(of.system, of.start, settings);
    ASSERT_EQ(done.result.outcome, Outcome::kCompleted) << what << ": " << done.result.message;
    ASSERT_EQ(done.rows.t, truth.rows.t);
    EXPECT_TRUE(done.result.notes.empty()) << done.result.notes[0];
    EXPECT_LT(done.result.energy.drift, tolerance * (done.result.energy.kinetic_peak + std::abs(done.result.energy.potential_start))) << what;
    const PassDifference apart = difference_of_passes(of.system, done.rows, truth.rows, duration, 1.0);
    const std::vector<double> relative = relative_differences(of.system, apart);
    for (std::size_t j = 0; j < of.system.joints.size(); ++j) {
      const LoadSummary& joint = done.result.joints[j];
      SCOPED_TRACE(what + ", " + joint.name + ", " + std::to_string(std::log10(tolerance)));
      EXPECT_LT(relative[j], tolerance);
      const LoadSummary& exact = truth.result.joints[j];
      EXPECT_LT(relative[j], 3 * joint.relative_error_estimate + exact.relative_error_estimate);
      EXPECT_LT(joint.relative_error_estimate, most * (relative[j] + exact.relative_error_estimate));
      EXPECT_LT(apart.force[j], 3 * joint.error_estimate + exact.error_estimate);
      EXPECT_LT(joint.error_estimate, most * (apart.force[j] + exact.error_estimate));
      if (!joint.has_moment) continue;
      EXPECT_LT(apart.couple[j], 3 * joint.moment_error_estimate + exact.moment_error_estimate);
      EXPECT_LT(joint.moment_error_estimate, most * (apart.couple[j] + exact.moment_error_estimate));
    }
  }
}

TEST(SpaceRuns, AHeavyTopKeepsWhatItStates) { expect_promise(sample::heavy_top(1), 1, "top"); }
// The hinges' compliances determine the force of the redundant constraint: at 1e-3 Newton's iteration, not the tolerance, limits the steps. The error of the last
// pass, whose steps are half as long, is 2e-7 of the peak; its difference from the previous one, seven hundred times that, is what can be stated.
TEST(SpaceRunsSlow, BricardsHingesKeepWhatTheyState) { expect_promise(sample::bricard(1e9), 10, "Bricard", 1e-3); }
TEST(SpaceRuns, AFreeChainKeepsWhatItStates) { expect_promise(sample::free_chain(4, 1e8), 2, "chain"); }

// No force acts on the chain: its momentum is constant, and its centre moves in a straight line.
TEST(SpaceRuns, AFreeChainKeepsItsMomentum) {
  const SpatialSample chain = sample::free_chain(4, 1e8);
  SimulateSettings settings;
  settings.duration = 2;
  const BasicSystemRun<S> done = run_system(chain.system, chain.start, settings);
  const std::size_t bodies = chain.system.bodies.size();
  struct Momenta {
    Point linear = Point::Zero(), angular = Point::Zero();
  };
  const auto momenta = [&](std::size_t row) {
    Momenta sum;
    for (std::size_t i = 0; i < bodies; ++i) {
      const auto& q = done.rows.place[row * bodies + i];
      const S::Vec p = chain.system.bodies[i].mass.cwiseProduct(done.rows.velocity[row * bodies + i]);
      sum.linear += p.head<3>();
      sum.angular += q.p.cross(Point(p.head<3>())) + q.r * Point(p.tail<3>());
    }
    return sum;
  };
  const Momenta first = momenta(0);
  for (std::size_t row = 1; row < done.rows.t.size(); ++row) {
    EXPECT_LT((momenta(row).linear - first.linear).norm(), 1e-9 * first.linear.norm());
    EXPECT_LT((momenta(row).angular - first.angular).norm(), 1e-6 * first.angular.norm());
  }
}

// The recorder reports what the laws do: a rod falls from the horizontal about its hinge, and the energies are known.
TEST(SpaceRuns, APendulumsAccountAndPeakAreKnown) {
  SpatialSample rod;
  rod.system.bodies.push_back(sample::spatial_body("rod", 2, {1e-3, 0.04, 0.04}, {0, 0, -10}));
  rod.system.joints.push_back(sample::spatial_joint("hinge", "revolute", kGround, S::Frame::along(Point::Zero(), Point::UnitY()), 0, S::Frame::along({-0.5, 0, 0}, Point::UnitY()), {1e9, 1e5, 1e8, 1e4}));
  rod.system.finish();
  rod.start_at({S::Coordinates{{0.5, 0, 0}, Eigen::Quaterniond::Identity()}}, {S::Vec::Zero()}, 1);
  SimulateSettings settings;
  settings.duration = 1;
  settings.output_step = 1e-3;
  const BasicSystemRun<S> done = run_system(rod.system, rod.start, settings);
  ASSERT_EQ(done.result.outcome, Outcome::kCompleted) << done.result.message;
  EXPECT_EQ(done.rows.t.size(), 1001u);
  EXPECT_GE(done.result.counters.passes, 2u);
  ASSERT_EQ(done.result.joints.size(), 1u);
  const LoadSummary& hinge = done.result.joints[0];
  EXPECT_TRUE(hinge.has_moment);
  EXPECT_EQ(hinge.first_body, "ground");
  EXPECT_EQ(hinge.second_body, "rod");
  // Straight down it has fallen 0.5 m: m g + m r w^2 with J w^2 / 2 = m g r about the hinge.
  const double inertia = 0.04 + 2 * 0.25;
  EXPECT_NEAR(hinge.peak, 20 + 2 * 0.5 * (2 * 20 * 0.5 / inertia), 1e-3);
  EXPECT_NEAR(done.result.energy.kinetic_peak, 10, 1e-4);
  EXPECT_LT(done.result.energy.drift, settings.tolerance * done.result.energy.kinetic_peak);
}

// The tolerance applies to positions: checked against a run at 1e-9.
TEST(SpaceRuns, ARunOfTheMotionKeepsItsTolerance) {
  const SpatialSample top = sample::heavy_top(1);
  SimulateSettings settings;
  settings.duration = 1;
  settings.tolerance = 1e-9;
  const BasicSystemRun<S> truth = run_system(top.system, top.start, settings);
  settings.tolerance_of = ToleranceOf::kMotion;
  for (const double tolerance : {1e-3, 1e-5}) {
    settings.tolerance = tolerance;
    const BasicSystemRun<S> done = run_system(top.system, top.start, settings);
    ASSERT_EQ(done.result.outcome, Outcome::kCompleted) << done.result.message;
    const double error = motion_difference(top.system, done.rows, truth.rows);
    EXPECT_LT(error, tolerance);
    EXPECT_LT(error, 3 * done.result.motion_error);
  }
}

// A force that grows e-fold every fifth of a second feeds energy to a body without end, and is named.
TEST(SpaceRuns, AForceThatFeedsWithoutEndIsNamed) {
  SpatialSample fed;
  fed.system.bodies.push_back(sample::spatial_body("body", 1, {1, 2, 3}, Point::Zero()));
  BasicAppliedData<S> force;
  force.name = "gale";
  for (Expression* e : {&force.force[1], &force.force[2], &force.torque[0], &force.torque[1], &force.torque[2]}) *e = sample::expression("0");
  force.force[0] = sample::expression("exp(5*t)");
  fed.system.applied.push_back(force);
  fed.system.finish();
  fed.start_at({S::Coordinates{}}, {S::Vec::Zero()});
  SimulateSettings settings;
  settings.duration = 20;
  const BasicSystemRun<S> done = run_system(fed.system, fed.start, settings);
  EXPECT_EQ(done.result.outcome, Outcome::kRunaway);
  EXPECT_NE(done.result.message.find("force gale feeds it"), std::string::npos) << done.result.message;
}

TEST(SpaceRuns, SayWhatTheyCannotDo) {
  SpatialSample top = sample::heavy_top();
  const auto refusal = [&top](const SpatialState& start, const SimulateSettings& settings) -> std::string {
    try {
      run_system(top.system, start, settings);
      return "";
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
  };
  SimulateSettings good;
  good.duration = 0.01;
  EXPECT_EQ(refusal(top.start, good), "");
  SimulateSettings settings = good;
  settings.method = "dopri5";
  EXPECT_NE(refusal(top.start, settings).find("in space set method"), std::string::npos);
  settings = good;
  settings.equations = Equations::kIdeal;
  EXPECT_NE(refusal(top.start, settings).find("newtonian"), std::string::npos);
  settings = good;
  settings.duration = 0;
  EXPECT_NE(refusal(top.start, settings).find("duration is 0 s"), std::string::npos);
  settings = good;
  settings.tolerance = -1;
  EXPECT_NE(refusal(top.start, settings).find("tolerance is -1"), std::string::npos);
  SpatialState start = top.start;
  start.q.clear();
  EXPECT_NE(refusal(start, good).find("places of 0"), std::string::npos);
  start = top.start;
  start.force.clear();
  EXPECT_NE(refusal(start, good).find("start_forces"), std::string::npos);
  start = top.start;
  start.v[0][4] = std::nan("");
  EXPECT_NE(refusal(start, good).find("not numbers"), std::string::npos);
}

}  // namespace
}  // namespace pintle
