// Andrews' squeezer: problem A03 of the IFToMM library, and the Test Set for IVP Solvers with its 27 components.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "bench/published/andrews_components.h"
#include "bench/published/benchmarks.h"

namespace pintle::published {
namespace {

constexpr double kTolerance = 1e-8;
constexpr double kCrank = 0.007;  // O to F [m]

Model andrews(double k, const std::vector<std::string>& overrides = {}) {
  Model model = model_of("andrews", overrides);
  set_joints(model, k, damping_at(k));
  return model;
}

// Largest difference of any joint's force from the table, relative to that joint's peak there; `from` skips rows.
double force_error(const Trajectory& r, const Model& model, const nlohmann::json& forces) {
  double worst = 0;
  for (std::size_t j = 0; j < forces["joints"].size(); ++j) {
    const std::string name = forces["joints"][j];
    const auto joint = std::find_if(model.joints.begin(), model.joints.end(), [&](const Joint& x) { return x.name == name; });
    const std::string column = fmt::format("joint.{}.on_{}.", name, joint->second.body);
    double peak = 0, error = 0;
    for (const auto& at : forces["rows"]) {
      const long row = row_at(r, at[0]);
      if (row < 0) throw std::logic_error("no row at a time of the force table");
      const double x = at[1 + 2 * j], y = at[2 + 2 * j];
      peak = std::max(peak, std::hypot(x, y));
      error = std::max(error, std::hypot(value(r, static_cast<std::size_t>(row), column + "fx[world]") - x,
                                         value(r, static_cast<std::size_t>(row), column + "fy[world]") - y));
    }
    worst = std::max(worst, error / peak);
  }
  return worst;
}

double end_error(const Trajectory& r, const nlohmann::json& rows) {
  double largest = 0;
  for (const auto& at : rows) {
    const auto row = static_cast<std::size_t>(row_at(r, at[0]));
    const double beta = value(r, row, "body.K1.angle");
    largest = std::max({largest, std::abs(kCrank * std::cos(beta) - at[1].get<double>()), std::abs(kCrank * std::sin(beta) - at[2].get<double>())});
  }
  return largest;
}

double digits_between(double a, double exact) {
  return -std::log10(std::max(std::abs(a / exact - 1), 1e-16));
}

struct TimedEnd {
  Components y{};
  std::uint64_t steps = 0;
  double seconds = 0;
};

TimedEnd timed_end(const Model& model, double tolerance) {
  const auto began = std::chrono::steady_clock::now();
  const End end = end_of(model, tolerance);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - began;
  return {end.y, end.steps, spent.count()};
}

double digits_of(const Components& y, const nlohmann::json& exact, std::size_t from, std::size_t to) {
  double least = 16;
  for (std::size_t i = from; i < to; ++i) least = std::min(least, digits_between(y[i], exact[i].get<double>()));
  return least;
}

std::string component_page(const nlohmann::json& facts, const Components& y, const std::string& joints) {
  std::string page = fmt::format("Andrews at t = 0.03 s, {}, component by component\n  {:<10}{:>24}{:>24}{:>24}{:>8}{:>8}\n", joints, "",
                                 "published", "exact", "Pintle", "digits", "(publ.)");
  for (std::size_t i = 0; i < 27; ++i) {
    const double published = facts["published"][i], exact = facts["exact"][i];
    page += fmt::format("  {:<10}{:>24.15g}{:>24.15g}{:>24.15g}{:>8.1f}{:>8.1f}\n", facts["components"][i].get<std::string>(), published, exact, y[i],
                        digits_between(y[i], exact), digits_between(published, exact));
  }
  return page;
}

// The same measures with Lagrange multipliers.
void measure_ideal(Report& report, const nlohmann::json& facts) {
  Model model = andrews(1e12, {"simulate.output_step=0.0025"});
  model.simulate.tolerance = 1e-7;
  Trajectory r;
  if (!run(model, true, report, r)) return;
  report.rows.push_back({"Andrews, IVP", "ideal", "joint forces / peak", 1e-4, force_error(r, model, facts["forces"]), r.counters.steps, r.wall_seconds});
  model.simulate.equations = Equations::kIdeal;
  const TimedEnd end = timed_end(model, 1e-11);
  const double wanted = facts["tolerance"]["scd"];
  const auto add = [&](const char* measure, std::size_t from, std::size_t to) {
    report.rows.push_back({"Andrews, IVP", "ideal", measure, wanted, digits_of(end.y, facts["exact"], from, to), end.steps, end.seconds, true});
  };
  add("scd of 7 angles", 0, 7);
  add("scd of rates", 7, 14);
  add("scd of accelerations", 14, 21);
  add("scd of multipliers", 21, 27);
  report.pages.push_back(component_page(facts, end.y, "ideal joints"));
}

}  // namespace

void measure_a03(Report& report) {
  const nlohmann::json facts = read_facts("iftomm_a03");
  const auto add = [&](double k, bool ideal, const Trajectory& r, const char* measure, const char* tolerance, double error) {
    report.rows.push_back({"A03, 0.05 s", joints_text(k, ideal), measure, facts["tolerance"][tolerance].get<double>(), error, r.counters.steps, r.wall_seconds,
                           false, ideal || k >= 1e12});
  };
  for (const double k : {1e8, 1e10, 1e12, 0.0}) {
    const bool ideal = k == 0;
    Model model = andrews(ideal ? 1e12 : k, {"parameters.beta=-0.062", "simulate.duration=0.05", "simulate.output_step=0.0025"});
    model.simulate.tolerance = 1e-7;
    Trajectory r;
    if (!run(model, ideal, report, r)) continue;
    add(k, ideal, r, "F [m]", "F [m]", end_error(r, facts["exact"]["rows"]));
    add(k, ideal, r, "energy balance [J]", "energy [J]", energy_error(r));
    add(k, ideal, r, "joint forces / peak", "force", force_error(r, model, facts["forces"]));
  }
}

void measure_ivp_andrews(Report& report) {
  const nlohmann::json facts = read_facts("ivp_andrews");
  const double wanted = facts["tolerance"]["scd"];
  TimedEnd before;
  for (const double k : {1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12}) {
    const TimedEnd end = timed_end(andrews(k), kTolerance);
    const auto add = [&](const std::string& joints, const Components& y, const char* measure, std::size_t from, std::size_t to, bool judged) {
      report.rows.push_back({"Andrews, IVP", joints, measure, wanted, digits_of(y, facts["exact"], from, to), end.steps, end.seconds, true, judged});
    };
    const auto add_all = [&](const std::string& joints, const Components& y) {
      add(joints, y, "scd of 7 angles", 0, 7, k >= 1e12);
      add(joints, y, "scd of rates", 7, 14, false);
      add(joints, y, "scd of accelerations", 14, 21, false);
      add(joints, y, "scd of multipliers", 21, 27, false);
    };
    if (k >= 1e12)
      add_all(joints_text(k, false), end.y);
    else
      add(joints_text(k, false), end.y, "scd of 7 angles", 0, 7, false);
    Model model = andrews(k, {"simulate.output_step=0.0025"});
    model.simulate.tolerance = 1e-7;
    Trajectory r;
    run(model, false, report, r);
    report.rows.push_back({"Andrews, IVP", joints_text(k, false), "joint forces / peak", 1e-4, force_error(r, model, facts["forces"]), r.counters.steps,
                           r.wall_seconds, false, k >= 1e12});
    if (k >= 1e12) {
      report.pages.push_back(component_page(facts, end.y, fmt::format("k = {:.0e} N/m", k)));
      const Components limit = extrapolated(before.y, end.y);
      add_all("k to infinity", limit);
      report.pages.push_back(component_page(facts, limit, "extrapolated to k = infinity from 1e11 and 1e12 N/m"));
    }
    before = end;
  }
  measure_ideal(report, facts);
}

}  // namespace pintle::published
