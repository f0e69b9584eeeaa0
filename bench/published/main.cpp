// pintle-published: published benchmark problems, each measured as in its source.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>

#include "bench/published/benchmarks.h"
#include "results/text_table.h"

namespace pintle::published {
namespace {

struct Problem {
  const char *name, *facts;
  void (*measure)(Report&);
};
constexpr Problem kProblems[] = {{"a01", "iftomm_a01", measure_a01},
                                 {"a02", "iftomm_a02", measure_a02},
                                 {"a03", "iftomm_a03", measure_a03},
                                 {"andrews", "ivp_andrews", measure_ivp_andrews}};

void print(const Report& report) {
  using Align = TextTable::Align;
  TextTable table;
  for (const char* head : {"problem", "joints", "measure"}) table.add_column(head, Align::kLeft);
  for (const char* head : {"tolerance", "found", "steps", "ms"}) table.add_column(head, Align::kNumber);
  table.add_column("", Align::kLeft);
  for (const Row& row : report.rows)
    table.add_row({row.problem, row.joints, row.measure, row.digits ? fmt::format(">= {:.0f} digits", row.tolerance) : fmt::format("{:.0e}", row.tolerance),
                   row.digits ? fmt::format("{:.1f}", row.error) : fmt::format("{:.1e}", row.error), fmt::format("{}", row.steps),
                   fmt::format("{:.1f}", 1e3 * row.seconds), row.passes() ? "pass" : row.judged ? "FAIL" : "compliance"});
  fmt::print("{}\n", table.text());
  for (const std::string& page : report.pages) fmt::print("{}\n", page);
  for (const std::string& line : report.skipped) fmt::print("skipped: {}\n", line);
}

void print_sources(const nlohmann::json& facts) {
  fmt::print("{}\n", facts["title"].get<std::string>());
  for (const auto& source : facts["source"]) fmt::print("  source: {}\n", source.get<std::string>());
  fmt::print("  measure: {}\n  tolerance: {}\n\n", facts["measure"].get<std::string>(), facts["tolerance"]["source"].get<std::string>());
}

int run_program(int argc, char** argv) {
  CLI::App app("Published benchmark problems; sources and data are in bench/published/*.json.", "pintle-published");
  std::vector<std::string> names;
  app.add_option("problems", names, "a01, a02, a03, andrews (default: all)")
      ->check(CLI::IsMember({"a01", "a02", "a03", "andrews"}));
  CLI11_PARSE(app, argc, argv);
  int failed = 0;
  for (const Problem& problem : kProblems) {
    if (!names.empty() && std::find(names.begin(), names.end(), problem.name) == names.end()) continue;
    print_sources(read_facts(problem.facts));
    Report report;
    problem.measure(report);
    print(report);
    for (const Row& row : report.rows) failed += row.judged && !row.passes();
  }
  fmt::print("{} of the measures missed their tolerance ('compliance': expected, the joints are too soft for it)\n", failed);
  return failed == 0 ? 0 : 1;
}

}  // namespace
}  // namespace pintle::published

int main(int argc, char** argv) {
  try {
    return pintle::published::run_program(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "pintle-published: {}\n", error.what());
    return 1;
  }
}
