// The stage equations of an implicit step: the conditions of a solution, evaluated in plain numbers by the system; how the
// iteration ends and how many iterations it takes.
#include "integrators/absolute/stage_solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "integrators/absolute/radau_stepper.h"
#include "integrators/general/dopri5.h"
#include "integrators/start_states_for_tests.h"

namespace pintle {
namespace {

using sample::Random;
using Vec = Planar::Vec;

// A model at an instant, ready for a step.
struct Start {
  Model model;
  const System system;
  State begin;
  LoadScale scale;

  explicit Start(Model m, double t = 0) : model(std::move(m)), system(build_system(model)) { start_from(sample::plain_start(model, system), t); }
  Start(Model m, State (*state)(const Model&, const System&)) : model(std::move(m)), system(build_system(model)) {
    start_from(state(model, system), 0);
  }

 private:
  void start_from(State state, double t) {
    begin = std::move(state);
    begin.t = t;
    Dopri5(system, 1).complete(begin);
    RadauStepper stepper(system, 1e-6);
    stepper.start(begin, 1);
    scale = stepper.load_scale();
  }
};

std::vector<Stage> room_for(const System& system, int stages) {
  const Vecs bodies(system.bodies.size(), Vec::Zero()), joints(system.joints.size(), Vec::Zero());
  return std::vector<Stage>(stages, Stage{bodies, bodies, bodies, bodies, joints, joints, joints, joints, {}, {}, std::vector<Planar::Motion>(bodies.size())});
}

double largest_entry(const Vec& x) { return x.cwiseAbs().maxCoeff(); }

// Eq. (3.5): the residuals of x, x' and x'' at stage i in the collocation, relative to their size.
double collocation_misfit(const RadauTable& table, int i, double h, const Vec& x0, const Vec& v0, const Vec& x, const Vec& v,
                          const std::vector<Vec>& a) {
  Vec v_expected = v0, x_expected = x0 + table.c[i] * h * v0;
  for (int k = 0; k < table.n; ++k) {
    v_expected += h * table.A(i, k) * a[k];
    x_expected += h * h * table.A2(i, k) * a[k];
  }
  double size = 0;
  for (const Vec& ak : a) size = std::max(size, largest_entry(ak));
  return std::max(largest_entry(v - v_expected) / (largest_entry(v0) + std::abs(h) * size + 1e-300),
                  largest_entry(x - x_expected) / (largest_entry(x0) + std::abs(h) * largest_entry(v0) + h * h * size + 1e-300));
}

// Relative to sizes; what remains is due to the iteration or, in the first one, to rounding.
struct Misfits {
  double collocation = 0, pose = 0, force = 0, motion = 0, gap = 0, loss = 0;
};

// The residuals of Eqs. (3.5) and (3.6) at the stages, evaluated one by one in plain numbers.
Misfits misfits(const Start& at, const RadauTable& table, double h, const std::vector<Stage>& stages) {
  const System& system = at.system;
  Misfits worst;
  const auto note = [](double& of, double x) { of = std::isnan(x) ? std::numeric_limits<double>::infinity() : std::max(of, x); };
  const auto over_stages = [&](Vecs Stage::*what, std::size_t index) {
    std::vector<Vec> all;
    for (const Stage& s : stages) all.push_back((s.*what)[index]);
    return all;
  };
  for (int i = 0; i < table.n; ++i) {
    const Stage& s = stages[i];
    const double t = at.begin.t + table.c[i] * h;
    std::vector<Planar::Motion> m;
    std::vector<JointKinematics> r;
    Vecs Q;
    system.motions(s.q, s.v, m);
    system.joint_kinematics(t, m, r);
    system.external(t, m, Q);
    Vecs left(system.bodies.size());
    for (std::size_t b = 0; b < left.size(); ++b) {
      note(worst.collocation, collocation_misfit(table, i, h, at.begin.q[b], at.begin.v[b], s.q[b], s.v[b], over_stages(&Stage::a, b)));
      note(worst.pose, std::max({(s.m[b].p - m[b].p).norm(), (s.m[b].v - m[b].v).norm(), std::abs(s.m[b].angle - m[b].angle),
                                 std::abs(s.m[b].w - m[b].w), std::abs(s.m[b].c - m[b].c), std::abs(s.m[b].s - m[b].s)}));
      note(worst.motion, largest_entry((s.Q[b] - Q[b]).cwiseQuotient(at.scale.body[b])));
      left[b] = system.bodies[b].mass.cwiseProduct(s.a[b]) - Q[b];
    }
    double loss = 0;
    for (int j = 0; j < system.n_joints(); ++j)
      if (system.joints[j].servo < 0 && system.joints[j].law.as_linear()) loss += system.joints[j].law.loss({0, s.gap[j], s.gap_rate[j]});
    note(worst.loss, std::abs(s.loss - loss) / (1 + loss));
    for (int j = 0; j < system.n_joints(); ++j) {
      const Placement& on = system.joints[j].at;
      note(worst.collocation,
           collocation_misfit(table, i, h, at.begin.gap[j], at.begin.gap_rate[j], s.gap[j], s.gap_rate[j], over_stages(&Stage::gap_accel, j)));
      const Vec f = system.joints[j].law.force({0, s.gap[j], s.gap_rate[j]});
      note(worst.force, largest_entry(s.force[j] - f) / (1 + largest_entry(f)));
      Vec accel = r[j].bias;
      double size = 1 + largest_entry(r[j].bias);
      for (const auto& [body, G] : {std::pair{on.a, r[j].GA()}, std::pair{on.b, r[j].GB()}}) {
        if (body == kGround) continue;
        left[body] -= G.transpose() * f;
        accel += G * s.a[body];
        size = std::max(size, largest_entry(G * s.a[body]));
      }
      note(worst.gap, largest_entry(s.gap_accel[j] - accel) / size);
    }
    for (std::size_t b = 0; b < left.size(); ++b) note(worst.motion, largest_entry(left[b].cwiseQuotient(at.scale.body[b])));
  }
  return worst;
}

// Solves a step, without a prediction unless one is given, and checks the solution.
std::vector<Stage> solve_and_check(const Start& at, int stages, double h, const std::string& name, const StepNodes* before = nullptr,
                                   double last_h = 0) {
  const RadauTable& table = RadauTable::of(stages);
  const auto solver = make_stage_solver(at.system, table, 1e-12);
  auto found = room_for(at.system, stages);
  Counters counters;
  const std::string where = name + ", " + std::to_string(stages) + " stages, step " + std::to_string(h);
  EXPECT_TRUE(solver->solve(at.begin, h, before, last_h, at.scale, counters)) << where;
  EXPECT_EQ(counters.evaluations, stages * counters.newton_iterations) << where;
  // Curved laws are linearised again where their tangents have changed, at most once in each iteration.
  const std::uint64_t once = 1 + stages / 2, times = counters.factorizations / once;
  const bool curved = std::any_of(at.system.joints.begin(), at.system.joints.end(), [](const JointData& joint) { return !joint.law.as_linear(); });
  EXPECT_EQ(counters.factorizations, times * once) << where;
  EXPECT_GE(times, 1u) << where;
  EXPECT_LE(times, curved ? counters.newton_iterations : 1u) << where;
  StageTails tails = sample::room_for_tails(at.system);
  solver->write(at.begin, found, tails);
  const Misfits left = misfits(at, table, h, found);
  EXPECT_LE(left.collocation, 4e-15) << where;
  EXPECT_LE(left.pose, 3e-16) << where;
  EXPECT_LE(left.loss, 1e-14) << where;
  EXPECT_LE(left.force, 1e-14) << where;
  EXPECT_LE(left.motion, 1e-12) << where;  // measured: 4e-13
  EXPECT_LE(left.gap, 2e-11) << where;     // measured: 4e-12
  for (int j = 0; j < at.system.n_joints(); ++j)
    EXPECT_LE(solver->residual(j), 1e-8 * (1 + found.back().gap_accel[j].norm())) << where << ", joint " << at.system.joints[j].name;
  return found;
}

Model at_random(Model model, std::uint64_t seed) {
  Random random(seed);
  Vecs q, v;
  sample::random_state(random, model.bodies.size(), q, v);
  for (std::size_t i = 0; i < q.size(); ++i) {
    sample::put_at(model.bodies[i], q[i][0], q[i][1], q[i][2]);
    model.bodies[i].velocity = Vec2{v[i][0], v[i][1]};
    model.bodies[i].spin = v[i][2];
  }
  return model;
}

Model loaded_four_bar(double k) {
  Model model = sample::four_bar(k, 3000);
  model.gravity = {0, -9.81};
  model.motors = {sample::motor("M", "O2", MotorKind::kEffort, sample::expression("-0.1*rate", {"rate"}))};
  return model;
}

// A servo turns its pin, and a spring pulls on it.
Model driven_pendulum() {
  Model model = sample::pendulum(1e8, 3000);
  model.ground.push_back({"H", {1, 2}, 0});
  model.motors = {sample::motor("W", "pin", MotorKind::kPosition, sample::expression("0.2*sin(3*t)"))};
  model.springs = {sample::spring("S", false, {"ground", "H"}, {"rod", "O"}, 8, 0.7)};
  return model;
}

// A rod that hangs on a rope of 2 m, stretched by `stretch`.
Model on_a_rope(double stretch) {
  Model model = sample::pendulum(1e6, 200);
  model.ground[0].position = {0, 2 + stretch};
  model.joints[0].type = "rope";
  model.joints[0].geometry = {{"length", 2}};
  return model;
}

// Every joint type, servos that follow functions of t, motors with a law, springs, applied forces, a rope; forwards and
// backwards.
TEST(StageSolver, SolutionsOfEverythingSatisfyTheEquations) {
  constexpr int kRope = 7;
  int pulling = 0, slack = 0;
  for (const int stages : {3, 5})
    for (std::uint64_t seed = 0; seed < 6; ++seed)
      for (const double h : {0.003, 0.01, -0.002}) {
        Model model = sample::everything();
        if (seed % 2 == 0) model.joints[kRope].geometry = {{"length", 4}};
        const Start at(at_random(model, seed), 0.7);
        for (const Stage& s : solve_and_check(at, stages, h, "everything")) {
          double taut[2];
          at.system.joints[kRope].law.borders({0, s.gap[kRope], s.gap_rate[kRope]}, taut);
          ++(taut[0] > 0 ? pulling : slack);
        }
      }
  EXPECT_GT(pulling, 10);
  EXPECT_GT(slack, 10);
}

TEST(StageSolver, SolutionsWithStiffJointsSatisfyTheEquations) {
  for (const int stages : {3, 5})
    for (const double h : {0.003, -0.003}) {
      for (const double k : {1e6, 1e8, 1e10}) solve_and_check(Start(loaded_four_bar(k), sample::loaded_start), stages, h, "four-bar");
      solve_and_check(Start(driven_pendulum(), 0.7), stages, h, "driven pendulum");
      solve_and_check(Start(on_a_rope(1e-5)), stages, 0.1 * h, "taut rope");
      solve_and_check(Start(on_a_rope(-0.1)), stages, h, "slack rope");
    }
}

// A prediction from the previous step changes the iteration, not the solution.
TEST(StageSolver, SolutionDoesNotDependOnThePrediction) {
  for (const int stages : {3, 5}) {
    Start at(loaded_four_bar(1e8), [](const Model& model, const System& system) { return sample::settled_start(model, system, 0.05); });
    RadauStepper stepper(at.system, 1e-8, stages);
    stepper.start(at.begin, 1e-4);
    for (int i = 0; i < 5; ++i) ASSERT_TRUE(stepper.step(1));
    at.begin = stepper.state();
    at.scale = stepper.load_scale();
    const double last_h = stepper.state().t - stepper.previous().t, h = 1.3 * last_h;
    const auto with = solve_and_check(at, stages, h, "predicted", &stepper.nodes(), last_h), without = solve_and_check(at, stages, h, "not predicted");
    for (int i = 0; i < stages; ++i) {
      EXPECT_LE(sample::largest_difference(with[i].q, without[i].q), 1e-14);
      EXPECT_LE(sample::largest_difference(with[i].force, without[i].force), 1e-8);  // of some hundred N
    }
  }
}

// --- Failures ---

bool solves(const Start& at, int stages, double h, double tolerance = 1e-6) {
  Counters counters;
  return make_stage_solver(at.system, RadauTable::of(stages), tolerance)->solve(at.begin, h, nullptr, 0, at.scale, counters);
}

// A pendulum whose pin carries a motor with this law.
Start with_motor(const char* law, const std::vector<std::string>& variables) {
  Model model = sample::pendulum(1e8, 3000);
  model.motors = {sample::motor("M", "pin", MotorKind::kEffort, sample::expression(law, variables))};
  return Start(std::move(model));
}

TEST(StageSolver, EquationsWithoutSolutionAreNotSolved) {
  for (const int stages : {3, 5}) {
    EXPECT_TRUE(solves(with_motor("-3*angle", {"angle"}), stages, 0.01));
    // It pushes back from either side of the pendulum's position, with more than gravity: no acceleration fits.
    const Start at = with_motor("if(angle + 0.001 > 0, -200, 200)", {"angle"});
    const auto solver = make_stage_solver(at.system, RadauTable::of(stages), 1e-6);
    Counters counters;
    EXPECT_FALSE(solver->solve(at.begin, 0.05, nullptr, 0, at.scale, counters));
    EXPECT_LE(counters.newton_iterations, 5u);  // the failure is found quickly
  }
}

TEST(StageSolver, SingularMatrixIsAFailure) {
  const Start at(sample::oscillator());
  System massless = at.system;
  massless.bodies[0].mass.setZero();
  for (const int stages : {3, 5}) {
    Counters counters;
    EXPECT_FALSE(make_stage_solver(massless, RadauTable::of(stages), 1e-6)->solve(at.begin, 0.01, nullptr, 0, at.scale, counters));
  }
}

// Values that are not numbers from 0.1 s on: in an applied force, a motor's law, a servo's target.
std::vector<Model> models_that_end_at_a_tenth() {
  std::vector<Model> models;
  for (const char* law : {"sqrt(0.1 - t)", "if(t < 0.1, 1, exp(1e5*t))"}) {
    Model pushed = sample::pendulum(1e8, 3000), motor = pushed, servo = pushed;
    AppliedForce force;
    force.name = "F";
    force.on = {"rod", "O"};
    force.force = {sample::expression(law), Expression::constant(0)};
    pushed.forces = {force};
    motor.motors = {sample::motor("M", "pin", MotorKind::kEffort, sample::expression(law))};
    servo.motors = {sample::motor("W", "pin", MotorKind::kPosition, sample::expression(law))};
    Model free = sample::oscillator();  // without a joint
    free.forces[0].force = {sample::expression(law), Expression::constant(0)};
    models.insert(models.end(), {pushed, motor, servo, free});
  }
  return models;
}

// However few stages it affects; and the solver works again afterwards.
TEST(StageSolver, LoadThatIsNoNumberIsAFailure) {
  for (const Model& model : models_that_end_at_a_tenth())
    for (const int stages : {3, 5}) {
      Start at(model);
      const auto solver = make_stage_solver(at.system, RadauTable::of(stages), 1e-6);
      Counters counters;
      const double h = 0.003;
      for (int beyond = 1; beyond <= stages; ++beyond) {
        at.begin.t = 0;
        EXPECT_TRUE(solver->solve(at.begin, h, nullptr, 0, at.scale, counters));
        const RadauTable& table = RadauTable::of(stages);
        const double before = beyond == stages ? 0 : table.c[stages - 1 - beyond];
        at.begin.t = 0.1 - 0.5 * (before + table.c[stages - beyond]) * h;  // this many stages are beyond 0.1 s
        EXPECT_FALSE(solver->solve(at.begin, h, nullptr, 0, at.scale, counters)) << stages << ", " << beyond << " beyond";
      }
    }
}

TEST(StageSolver, StartThatIsNoNumberIsAFailure) {
  for (const int stages : {3, 5})
    for (Vecs State::*what : {&State::q, &State::v, &State::a, &State::gap, &State::gap_rate, &State::gap_accel}) {
      Start at(sample::pendulum(1e8, 3000));
      (at.begin.*what)[0][1] = std::numeric_limits<double>::quiet_NaN();
      EXPECT_FALSE(solves(at, stages, 0.003));
    }
}

// --- Counts ---

// Bodies held at their centres of mass and turned by springs: the first correction solves linear equations, and the
// second confirms it.
TEST(StageSolver, LinearEquationsTakeTwoIterations) {
  Model model = sample::oscillator();
  model.bodies.push_back(sample::body("other", 3, 0.5, {{"C", {0, 0}, 0}}));
  sample::put_at(model.bodies[0], 1.5, -0.4, 0.2);
  sample::put_at(model.bodies[1], 0.3, 0.2, -0.1);
  model.bodies[0].spin = 0.7;
  model.joints = {sample::joint("J", "slot", {"ground", "O"}, {"mass", "C"}, 300, 4),
                  sample::joint("I", "slot", {"ground", "O"}, {"other", "C"}, 200, 3)};
  model.springs = {sample::spring("T", true, {"mass", "C"}, {"other", "C"}, 80, 9)};
  model.motors = {sample::motor("M", "J", MotorKind::kEffort, sample::expression("4*t - 60*slide - 3*rate + 20*I.slide", {"t", "slide", "rate", "I.slide"})),
                  sample::motor("W", "J", MotorKind::kPosition, sample::expression("0.1*t^2"))};
  for (const int stages : {3, 5})
    for (const double h : {0.001, 0.01, 0.1, 1.0}) {
      const Start at(model, 0.3);
      Counters counters;
      const auto solver = make_stage_solver(at.system, RadauTable::of(stages), 1e-8);
      EXPECT_TRUE(solver->solve(at.begin, h, nullptr, 0, at.scale, counters));
      EXPECT_EQ(counters.newton_iterations, 2u) << stages << " stages, step " << h;
    }
}

// Near rest nothing changes along a step, however long, if its matrix contains everything that holds the bodies: for one
// that hangs, the force of its joint. A gap in the axes of a rotating body takes one more: the matrix neglects the rotation
// of these axes.
TEST(StageSolver, NearRestTwoIterationsAreEnough) {
  const double stretch = 9.81 / 1e6;
  for (const std::string type : {"revolute", "rod", "rope"})
    for (const bool ground_first : {true, false}) {
      Model model = on_a_rope(stretch);
      if (type == "revolute") model.ground[0].position = {0, stretch};
      model.bodies[0].markers[0].position = {0, 0.5};
      sample::put_at(model.bodies[0], 0, -0.5, 0);
      model.bodies[0].velocity = Vec2{1e-7, 0};
      model.joints[0].type = type;
      if (!ground_first) std::swap(model.joints[0].first, model.joints[0].second);
      const Start at(model);
      for (const int stages : {3, 5})
        for (const double h : {0.1, 1.0}) {
          Counters counters;
          const auto solver = make_stage_solver(at.system, RadauTable::of(stages), 1e-7);
          EXPECT_TRUE(solver->solve(at.begin, h, nullptr, 0, at.scale, counters)) << type;
          EXPECT_LE(counters.newton_iterations, type == "revolute" && !ground_first ? 3u : 2u) << type << ", " << stages << " stages, step " << h;
        }
    }
}

// The iteration leaves a fraction of the tolerance, in motion and in joint forces.
TEST(StageSolver, IterationStopsWithinItsTolerance) {
  for (const int stages : {3, 5})
    for (const double h : {0.001, 0.003, 0.01})
      for (const double tolerance : {1e-3, 1e-5, 1e-7}) {
        const Start at(loaded_four_bar(1e8), sample::loaded_start);
        Counters counters;
        const auto solver = make_stage_solver(at.system, RadauTable::of(stages), tolerance);
        ASSERT_TRUE(solver->solve(at.begin, h, nullptr, 0, at.scale, counters));
        auto found = room_for(at.system, stages);
        StageTails tails = sample::room_for_tails(at.system);
        solver->write(at.begin, found, tails);
        const auto exact = solve_and_check(at, stages, h, "four-bar");
        double error = 0;
        for (int i = 0; i < stages; ++i)
          for (std::size_t b = 0; b < at.system.bodies.size(); ++b)
            error = std::max(error, largest_entry(at.system.bodies[b].mass.cwiseProduct(found[i].a[b] - exact[i].a[b]).cwiseQuotient(at.scale.body[b])));
        double force_error = 0;
        for (int i = 0; i < stages; ++i) force_error = std::max(force_error, sample::largest_difference(found[i].force, exact[i].force));
        EXPECT_LE(error, 0.2 * tolerance) << stages << " stages, step " << h;  // measured: 0.05 of both
        EXPECT_LE(force_error, 0.2 * tolerance * at.scale.body[1][0]) << stages << " stages, step " << h;
            }
}

// Iterations of each of 40 steps as chosen by the step control.
// Measured: 139 and at most 7 with three stages, 200 and at most 8 with five.
struct Iterations {
  std::uint64_t sum = 0, most = 0, without_prediction = 0;
};
Iterations iterations_of_four_bar(double k, double tolerance, int stages) {
  const Model model = sample::four_bar(k, 3000);
  const System system = build_system(model);
  RadauStepper stepper(system, tolerance, stages);
  stepper.start(sample::settled_start(model, system, 0.1), 1e-3);
  EXPECT_TRUE(stepper.step(10));
  const auto solver = make_stage_solver(system, stepper.table(), tolerance), other = make_stage_solver(system, stepper.table(), tolerance);
  Iterations found;
  for (int i = 0; i < 40; ++i) {
    const State& begin = stepper.state();
    Counters with, without;
    EXPECT_TRUE(solver->solve(begin, stepper.next_step(), &stepper.nodes(), begin.t - stepper.previous().t, stepper.load_scale(), with));
    other->solve(begin, stepper.next_step(), nullptr, 0, stepper.load_scale(), without);
    found.sum += with.newton_iterations;
    found.most = std::max(found.most, with.newton_iterations);
    found.without_prediction += without.newton_iterations;
    EXPECT_TRUE(stepper.step(10));
  }
  return found;
}

TEST(StageSolver, FourBarTakesFewIterations) {
  for (const double k : {1e8, 1e10}) {
    const Iterations three = iterations_of_four_bar(k, 1e-5, 3);
    EXPECT_LE(three.sum, 165u) << k;
    EXPECT_LE(three.most, 9u) << k;
    EXPECT_LT(three.sum, three.without_prediction) << k;
    const Iterations five = iterations_of_four_bar(k, 1e-8, 5);
    EXPECT_LE(five.sum, 240u) << k;
    EXPECT_LE(five.most, 10u) << k;
    EXPECT_LT(five.sum, five.without_prediction) << k;
  }
}

}  // namespace
}  // namespace pintle
