// Problems A01 and A02 of the IFToMM library: a pendulum, and N four-bars through singular positions.
#include <fmt/format.h>

#include "bench/published/benchmarks.h"

namespace pintle::published {
namespace {

struct Joints {
  double k;
  bool ideal;
};
constexpr Joints kJoints[] = {{1e8, false}, {1e10, false}, {1e12, false}, {0, true}};

void add(Report& report, const std::string& problem, const Joints& joints, const Trajectory& run, const std::string& measure, double tolerance,
         double error) {
  report.rows.push_back({problem, joints_text(joints.k, joints.ideal), measure, tolerance, error, run.counters.steps, run.wall_seconds});
}

}  // namespace

void measure_a01(Report& report) {
  const nlohmann::json facts = read_facts("iftomm_a01");
  const double high = facts["tolerance"]["high precision [m]"], energy = facts["tolerance"]["energy [J]"];
  for (const double end : {10.0, 100.0, 2000.0})
    for (const Joints& joints : kJoints) {
      Model model = model_of("bench/published/simple_pendulum");
      set_joints(model, joints.k, 3000 * joints.k / 1e10);
      model.simulate.duration = end;
      model.simulate.output_step = end > 10 ? 0.5 : 0.1;
      model.simulate.tolerance = end > 100 ? 1e-9 : 1e-8;
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
    for (const Joints& joints : kJoints) {
      Model model = model_of(fmt::format("n_four_bar_{}", n));
      set_joints(model, joints.k, 3000);
      Trajectory r;
      if (!run(model, joints.ideal, report, r)) continue;
      const std::string problem = fmt::format("A02, N = {}, 10 s", n);
      const auto exact = facts.find(fmt::format("exact_{}", n));
      if (exact != facts.end()) {
        add(report, problem, joints, r, "B0 until 2 s, high [m]", high, point_error(r, (*exact)["rows"], "body.crank0", 2, 2));
        add(report, problem, joints, r, "B0 until 10 s, low [m]", low, point_error(r, (*exact)["rows"], "body.crank0", 2, 10));
      }
      if (n == 40)
        add(report, problem, joints, r, "B0, published [m]", low, point_error(r, facts["published"]["rows"], "body.crank0", 2, 10));
      add(report, problem, joints, r, "energy [J]", energy, energy_error(r));
    }
}

}  // namespace pintle::published
