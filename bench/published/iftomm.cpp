// Problems A01 and A02 of the IFToMM library: a pendulum, and N four-bars through singular positions.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "bench/published/benchmarks.h"

namespace pintle::published {
namespace {

struct Joints {
  double k;
  bool ideal;
};
constexpr Joints kStiffest{1e12, false}, kIdeal{1e12, true};  // ideal: what has stiffness is a constraint

// Rows t, x, y of B0 with N loops on the regular branch: a rotating pendulum, by the classical Runge-Kutta method.
nlohmann::json exact_rows(int n) {
  const double J = (n + 1) / 3.0 + n, S = (n + 1) / 2.0 + n, h = 1e-4;
  const auto accel = [&](double angle) { return -9.81 * S / J * std::cos(angle); };
  double angle = std::numbers::pi / 2, spin = -1;
  nlohmann::json rows = nlohmann::json::array({{0.0, 0.0, 1.0}});
  for (int row = 1; row <= 100; ++row) {
    for (int i = 0; i < 1000; ++i) {
      const double a1 = accel(angle), s1 = spin, a2 = accel(angle + h / 2 * s1), s2 = spin + h / 2 * a1, a3 = accel(angle + h / 2 * s2),
                   s3 = spin + h / 2 * a2, a4 = accel(angle + h * s3), s4 = spin + h * a3;
      angle += h / 6 * (s1 + 2 * s2 + 2 * s3 + s4);
      spin += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    }
    rows.push_back({0.1 * row, std::cos(angle), std::sin(angle)});
  }
  return rows;
}

void add(Report& report, const std::string& problem, const Joints& joints, const Trajectory& run, const std::string& measure, double tolerance,
         double error) {
  report.rows.push_back({problem, joints_text(joints.k, joints.ideal), measure, tolerance, error, run.counters.steps, run.wall_seconds});
}

}  // namespace

void measure_a01(Report& report) {
  const nlohmann::json facts = read_facts("iftomm_a01");
  const double high = facts["tolerance"]["high precision [m]"], energy = facts["tolerance"]["energy [J]"];
  for (const double end : {10.0, 100.0, 2000.0})
    for (const Joints& joints : {Joints{1e8, false}, kStiffest, kIdeal}) {
      if (end > 100 && (joints.ideal || joints.k == 1e8)) continue;
      Model model = model_of("bench/published/simple_pendulum");
      set_joints(model, joints.k, 3000 * joints.k / 1e10);
      model.simulate.duration = end;
      model.simulate.output_step = end > 10 ? 0.5 : 0.1;
      model.simulate.tolerance = 1e-7;
      Trajectory r;
      if (!run(model, joints.ideal, report, r)) continue;
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
    for (const Joints& joints : {Joints{1e8, false}, kIdeal}) {
      Model model = model_of(fmt::format("n_four_bar_{}", n));
      set_joints(model, joints.k, 3000);
      Trajectory r;
      if (!run(model, joints.ideal, report, r)) continue;
      const std::string problem = fmt::format("A02, N = {}, 10 s", n);
      const auto known = facts.find(fmt::format("exact_{}", n));
      const nlohmann::json rows = known != facts.end() ? (*known)["rows"] : exact_rows(n);
      add(report, problem, joints, r, "B0 until 2 s, high [m]", high, point_error(r, rows, "body.crank0", 2, 2));
      const char* const whole = joints.ideal ? "B0 until 10 s, high [m]" : "B0 until 10 s, low [m]";
      const double allowed = joints.ideal ? high : low;
      add(report, problem, joints, r, whole, allowed, point_error(r, rows, "body.crank0", 2, 10));
      if (n == 40)
        add(report, problem, joints, r, "B0, published [m]", allowed, point_error(r, facts["published"]["rows"], "body.crank0", 2, 10));
      add(report, problem, joints, r, "energy [J]", energy, energy_error(r));
    }
}

}  // namespace pintle::published
