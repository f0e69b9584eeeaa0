// Problems A01 and A02 of the IFToMM library: a pendulum, and N four-bars through singular positions.
#include <fmt/format.h>

#include <cmath>

#include "bench/published/benchmarks.h"
#include "bench/rotating_pendulum.h"

namespace pintle::published {
namespace {

// Bearings of stiffness k, or a way to enforce the joints that have stiffness as constraints.
struct Joints {
  double k = 1e12;
  Equations equations = Equations::kNewtonian;
  const char* method = "auto";
  bool ideal() const { return equations != Equations::kNewtonian; }
};
constexpr Joints kStiffest{}, kIdeal{1e12, Equations::kIdeal}, kPenalty{1e12, Equations::kPenalty}, kTrapezoidal{1e12, Equations::kAugmentedLagrangian, "ode23t"},
    kHht{1e12, Equations::kAugmentedLagrangian, "hht"}, kTree{1e12, Equations::kRelativeAugmented, "ode23t"};

constexpr double kPendulumStep = 0.5e-3, kLoopsStep = 1e-3;  // of the augmented Lagrangian, which its authors use with steps of equal length [s]
constexpr double kAugmentedTolerance = 1e-2;                     // with such steps
constexpr double kA02Frequency = 500;        // of the penalty, at which it stays on the branch: theory/penalty section 4 [rad/s]

void set_equations(const Joints& joints, double step, Model& model) {
  model.simulate.equations = joints.equations;
  model.simulate.method = joints.method;
  if (joints.equations != Equations::kAugmentedLagrangian && joints.equations != Equations::kRelativeAugmented) return;
  model.simulate.max_step = step;
  model.simulate.tolerance = kAugmentedTolerance;
}

std::string text_of(const Joints& joints) {
  if (!has_constraints(joints.equations) || joints.equations == Equations::kIdeal) return joints_text(joints.k, joints.ideal());
  if (joints.equations == Equations::kRelativeAugmented) return "augmented, relative";
  return joints.equations == Equations::kPenalty ? "penalty" : fmt::format("augmented, {}", joints.method == std::string("hht") ? "HHT" : "trapezoidal");
}

// Rows t, x, y of B0 with N loops on the regular branch.
nlohmann::json exact_rows(int n) {
  nlohmann::json rows = nlohmann::json::array();
  for (const bench::CrankTop& top : bench::n_four_bar_tops(n, 10, 100)) rows.push_back({top.t, top.x, top.y});
  return rows;
}

void add(Report& report, const std::string& problem, const Joints& joints, const Trajectory& run, const std::string& measure, double tolerance,
         double error) {
  report.rows.push_back({problem, text_of(joints), measure, tolerance, error, run.counters.steps, run.wall_seconds});
}

}  // namespace

void measure_a01(Report& report) {
  const nlohmann::json facts = read_facts("iftomm_a01");
  const double high = facts["tolerance"]["high precision [m]"], energy = facts["tolerance"]["energy [J]"];
  for (const double end : {10.0, 100.0, 2000.0})
    for (const Joints& joints : {Joints{1e8}, kStiffest, kIdeal, kPenalty, kTrapezoidal, kHht}) {
      if (end > 100 && (joints.ideal() || joints.k == 1e8)) continue;
      if (end > 10 && joints.ideal() && joints.equations != Equations::kIdeal) continue;
      Model model = model_of("bench/published/simple_pendulum");
      set_joints(model, joints.k, 3000 * joints.k / 1e10);
      model.simulate.duration = end;
      model.simulate.output_step = end > 10 ? 0.5 : 0.1;
      model.simulate.tolerance = 1e-7;
      set_equations(joints, kPendulumStep, model);
      Trajectory r;
      if (!run(model, joints.ideal(), report, r)) continue;
      const std::string problem = fmt::format("A01, {} s", end);
      if (end <= 10) add(report, problem, joints, r, "x, y, exact [m]", high, point_error(r, facts["exact"]["rows"], "body.mass", 1, end));
      add(report, problem, joints, r, "x, y, published [m]", high, point_error(r, facts["published"]["rows"], "body.mass", 1, end));
      add(report, problem, joints, r, "energy [J]", energy, energy_error(r));
    }
}

void measure_a02(Report& report) {
  const nlohmann::json facts = read_facts("iftomm_a02");
  const double high = facts["tolerance"]["high precision [m]"], low = facts["tolerance"]["low precision [m]"],
               energy = facts["tolerance"]["energy [J]"];
  for (const int n : {1, 2, 10, 40})
    for (const Joints& joints : {Joints{1e8}, kIdeal, kPenalty, kTrapezoidal, kHht, kTree}) {
      if (n == 10 && joints.ideal() && joints.equations != Equations::kIdeal) continue;
      if (n > 2 && joints.equations == Equations::kRelativeAugmented) continue;  // its matrices are dense
      Model model = model_of(fmt::format("n_four_bar_{}", n));
      set_joints(model, joints.k, 3000);
      set_equations(joints, kLoopsStep, model);
      if (joints.equations == Equations::kPenalty) model.simulate.penalty.frequency = kA02Frequency;
      Trajectory r;
      if (!run(model, joints.ideal(), report, r)) continue;
      const std::string problem = fmt::format("A02, N = {}, 10 s", n);
      const auto known = facts.find(fmt::format("exact_{}", n));
      const nlohmann::json rows = known != facts.end() ? (*known)["rows"] : exact_rows(n);
      add(report, problem, joints, r, "B0 until 2 s, high [m]", high, point_error(r, rows, "body.crank0", 2, 2));
      const char* const whole = joints.ideal() ? "B0 until 10 s, high [m]" : "B0 until 10 s, low [m]";
      const double allowed = joints.ideal() ? high : low;
      add(report, problem, joints, r, whole, allowed, point_error(r, rows, "body.crank0", 2, 10));
      if (n == 40)
        add(report, problem, joints, r, "B0, published [m]", allowed, point_error(r, facts["published"]["rows"], "body.crank0", 2, 10));
      add(report, problem, joints, r, "energy [J]", energy, energy_error(r));
    }
}

}  // namespace pintle::published
