// The curves as tables, pictures and a page.
#pragma once

#include <string>
#include <vector>

#include "bench/curve_problems.h"
#include "bench/machine.h"
#include "bench/result_table.h"
#include "bench/targets.h"
#include "bench/work_precision.h"

namespace pintle::bench {

/// Milliseconds that each group of methods needs for a given error.
ResultTable price_table(const WorkPrecision& work, Measure measure, const std::string& title);

/// Force error and position error against time, with one curve for the best of each group.
std::string picture(const WorkPrecision& work, const std::string& title, const std::string& subtitle);

/// The results of one problem.
struct ProblemReport {
  CurveProblem problem;
  std::string truths;  // which, and their uncertainty
  std::vector<ResultTable> tables;
};

/// The page for docs/benchmarks, with its pictures next to it as <name>.svg.
std::string curves_page(const std::vector<ProblemReport>& problems, const ResultTable& targets, const nlohmann::ordered_json& machine);

}  // namespace pintle::bench
