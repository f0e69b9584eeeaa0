#include "bench/curve_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "bench/rotating_pendulum.h"
#include "bench/stored_truths.h"
#include "bench/sundials_methods.h"
#ifdef PINTLE_HAS_SIMBODY
#include "bench/simbody_methods.h"
#endif
#ifdef PINTLE_HAS_MUJOCO
#include "bench/mujoco_methods.h"
#endif

namespace pintle::bench {
namespace {

constexpr int kOutputs = 100;
constexpr double kTightest = 1e-9;    // for the compliant truth
constexpr double kIdealTruth = 1e-12;
constexpr int kStoredLoops = 40;      // N-four-bars with this many or more have a stored truth
constexpr int kDenseBodies = 25;      // with more, dense matrices are hopeless
constexpr int kTreeBodies = 150;      // with more, Simbody's constraints are hopeless, since it solves them densely

std::unique_ptr<ReadyModel> ready(Model model, Equations equations) {
  model.simulate.equations = equations;
  return std::make_unique<ReadyModel>(std::move(model));
}

// Tightens the tolerance while there is time; returns the last run that ended, and its difference from the previous one.
Truth settle_truth(const Problem& problem, const MethodChoice& choice, double from, double to) {
  Truth truth;
  double spent = 0;
  for (double tolerance = from; tolerance > 0.5 * to && !(spent > problem.cap); tolerance *= 0.1) {
    PintleRun run = run_stepper(problem, choice, tolerance);
    spent += run.seconds;
    if (!run.completed) break;
    if (truth.samples) {
      truth.force_doubt = truth.samples->error(run.samples);
      truth.place_doubt = truth.samples->place_error(run.samples);
    }
    truth.samples = std::make_unique<Samples>(std::move(run.samples));
    truth.method = fmt::format("Pintle, {}, tolerance {:.0e}, {} steps", choice.equations == Equations::kIdeal ? "ideal joints" : "order 9", tolerance,
                               run.counters.steps);
  }
  return truth;
}

Problem problem_of(const ReadyModel& model, const MarkerRef& point) {
  Problem problem = model.problem(kOutputs);
  problem.point = model.point(point);
  return problem;
}

}  // namespace

void store_truth(const CurveProblem& about, double tolerance) {
  const auto model = ready(about.model(), Equations::kNewtonian);
  const Problem problem = problem_of(*model, about.point);
  const Truth truth = settle_truth(problem, {Equations::kNewtonian, "radau", 5}, 10 * tolerance, tolerance);
  if (!truth.samples) throw std::runtime_error("no truth of " + about.name);
  fmt::print("{}: {}; positions within {:.1e} m of the previous run\n", about.name, truth.method, truth.place_doubt);
  write_truth(about.name, problem, {truth.method, truth.place_doubt, *truth.samples});
}

CurveCase::CurveCase(CurveProblem problem, const CaseOptions& options) : about_(std::move(problem)), options_(options) {
  compliant_ = ready(about_.model(), Equations::kNewtonian);
  compliant_problem_ = problem_of(*compliant_, about_.point);
  if (about_.ideal) {
    ideal_ = ready(about_.model(), Equations::kIdeal);
    ideal_problem_ = problem_of(*ideal_, about_.point);
  }
  find_compliant_truth();
  if (about_.ideal) find_ideal_truth();
  compliant_problem_.cap = ideal_problem_.cap = options_.cap;
}

void CurveCase::find_compliant_truth() {
  if (about_.loops >= kStoredLoops) {
    if (std::optional<StoredTruth> stored = read_truth(about_.name, compliant_problem_)) {
      compliant_truth_.method = std::move(stored->method);
      compliant_truth_.place_doubt = stored->place_doubt;
      compliant_truth_.samples = std::make_unique<Samples>(std::move(stored->places));
    }
    return;
  }
  compliant_problem_.cap = 3 * options_.cap;
  compliant_truth_ = settle_truth(compliant_problem_, {Equations::kNewtonian, "radau", 5}, 1e-4, kTightest);
  if (compliant_truth_.samples) compliant_problem_.force = compliant_truth_.samples->largest_force();
}

void CurveCase::find_ideal_truth() {
  ideal_problem_.cap = 3 * options_.cap;
  ideal_truth_ = settle_truth(ideal_problem_, {Equations::kIdeal, "dopri5", 3}, 1e-8, kIdealTruth);
  if (about_.loops == 0) return;
  Samples exact(ideal_->system, ideal_problem_.point);
  const auto tops = n_four_bar_tops(about_.loops, ideal_problem_.outputs.back(), kOutputs);
  for (std::size_t i = 1; i < tops.size(); ++i) exact.add_place({tops[i].x, tops[i].y});
  if (ideal_truth_.samples) {
    ideal_truth_.method += fmt::format(", {:.1e} m from the exact motion", ideal_truth_.samples->place_error(exact));
  } else {
    ideal_truth_.method = "the exact motion";
    ideal_truth_.samples = std::make_unique<Samples>(std::move(exact));
  }
}

std::string CurveCase::truths() const {
  std::string out;
  for (const std::string& equations : {kCompliant, kIdeal}) {
    const Truth& t = truth(equations);
    if (!t.samples) continue;
    out += fmt::format("- Reference for {} joints: {}; ", equations, t.method);
    if (t.samples->has_forces()) out += fmt::format("forces within {:.0e} and ", t.force_doubt);
    out += fmt::format("positions within {:.0e} m of the previous run.\n", t.place_doubt);
  }
  return out;
}

std::vector<Contestant> CurveCase::contestants() const {
  std::vector<Contestant> list;
  add_own(list);
  add_sundials(list);
  add_simbody(list);
  add_mujoco(list);
  std::erase_if(list, [](const Contestant& c) { return !c.truth; });
  return list;
}

// To add a method or another measure of its error, add an entry here.
void CurveCase::add_own(std::vector<Contestant>& list) const {
  const auto own = [&](const char* name, const std::string& group, Equations equations, const char* method, int stages, std::vector<double> ladder,
                       ToleranceOf tolerance_of = ToleranceOf::kForces) {
    const bool ideal = has_constraints(equations);
    const Problem* const problem = ideal ? &ideal_problem_ : &compliant_problem_;
    const auto run = [=](double tolerance) { return run_stepper(*problem, {equations, method, stages, tolerance_of}, tolerance).measured(); };
    const std::string& solves = ideal ? kIdeal : kCompliant;
    list.push_back({name, group, solves, run, std::move(ladder), truth(solves).samples.get()});
  };
  own("Pintle, order 5", group::kPintle, Equations::kNewtonian, "radau", 3, decades(-1, -7, 2));
  own("Pintle, order 9", group::kPintle, Equations::kNewtonian, "radau", 5, decades(-2, -9));
  own("Pintle, order 5 of motion", group::kPintle, Equations::kNewtonian, "radau", 3, decades(-1, -7, 2), ToleranceOf::kMotion);
  own("Pintle, order 9 of motion", group::kPintle, Equations::kNewtonian, "radau", 5, decades(-1, -9), ToleranceOf::kMotion);
  own("Pintle, dopri5", group::kExplicit, Equations::kNewtonian, "dopri5", 3, decades(-2, -6));
  own("Pintle, ideal joints", group::kPintleIdeal, Equations::kIdeal, "dopri5", 3, decades(-3, -10));
  own("Penalty, dopri5", group::kPenalty, Equations::kPenalty, "dopri5", 3, decades(-2, -8));
  own("Augmented Lagrangian, trapezoidal rule", group::kAugmented, Equations::kAugmentedLagrangian, "ode23t", 3, decades(-2, -8));
  own("Augmented Lagrangian, HHT", group::kAugmented, Equations::kAugmentedLagrangian, "hht", 3, decades(-2, -8));
  if (n_bodies() <= kDenseBodies) own("Augmented Lagrangian, relative coordinates", group::kAugmented, Equations::kRelativeAugmented, "ode23t", 3, decades(-2, -8));
  if (about_.small)
    list.push_back({"Pintle, whole run", group::kWholeRun, kCompliant,
                    [this](double tolerance) { return whole_run(*compliant_, compliant_problem_, tolerance); }, decades(-2, -6),
                    compliant_truth_.samples.get()});
}

void CurveCase::add_sundials(std::vector<Contestant>& list) const {
  for (const auto& [method, ladder] : peer_ladders(about_.all_peers && !options_.quick)) {
    if (method.code.solver == LinearSolver::kDense && n_bodies() > kDenseBodies) continue;
    list.push_back({method.name, group::kSundials, kCompliant,
                    [this, peer = method](double tolerance) { return run_sundials(peer, compliant_problem_, tolerance); }, ladder,
                    compliant_truth_.samples.get()});
  }
}

#ifdef PINTLE_HAS_SIMBODY
void CurveCase::add_simbody(std::vector<Contestant>& list) const {
  using Method = SimbodyMethod;
  const std::vector<Method> methods{
      {"Simbody, tree and constraints, Runge-Kutta-Merson", Method::Joints::kTree, Method::Integrator::kRungeKuttaMerson},
      {"Simbody, bushings, CPodes BDF", Method::Joints::kBushings, Method::Integrator::kBdf},
      {"Simbody, bushings, Runge-Kutta-Merson", Method::Joints::kBushings, Method::Integrator::kRungeKuttaMerson},
  };
  if (n_bodies() > kTreeBodies) return;
  for (const Method& method : methods) {
    const bool ideal = method.joints == Method::Joints::kTree;
    const Problem* const problem = ideal ? &ideal_problem_ : &compliant_problem_;
    list.push_back({method.name, ideal ? group::kSimbodyIdeal : group::kSimbodyBushings, ideal ? kIdeal : kCompliant, [problem, method](double accuracy) { return run_simbody(method, *problem, accuracy); },
                    decades(-2, -9), truth(ideal ? kIdeal : kCompliant).samples.get()});
  }
}
#else
void CurveCase::add_simbody(std::vector<Contestant>&) const {}
#endif

#ifdef PINTLE_HAS_MUJOCO
void CurveCase::add_mujoco(std::vector<Contestant>& list) const {
  const double end = compliant_problem_.outputs.back();
  std::vector<double> steps;
  for (const double n : {1e3, 3e3, 1e4, 3e4, 1e5, 3e5, 1e6}) steps.push_back(end / n);
  for (const MujocoMethod& method : {MujocoMethod{"MuJoCo, implicit", "implicit"}, MujocoMethod{"MuJoCo, RK4", "RK4"}, MujocoMethod{"MuJoCo, Euler", "Euler"}})
    list.push_back({method.name, group::kMujoco, kIdeal, [this, method](double step) { return run_mujoco(method, ideal_problem_, step); }, steps,
                    ideal_truth_.samples.get()});
}
#else
void CurveCase::add_mujoco(std::vector<Contestant>&) const {}
#endif

}  // namespace pintle::bench
