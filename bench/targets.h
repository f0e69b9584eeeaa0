// The program's targets, each next to the measured value.
#pragma once

#include <map>
#include <string>

#include "bench/result_table.h"
#include "bench/scaling.h"
#include "bench/work_precision.h"

namespace pintle::bench {

/// Judges only the problems that were measured. No scaling: null; no turns: 0.
ResultTable judge_targets(const std::map<std::string, const WorkPrecision*>& works, const Scaling* scaling, double turns_per_second);

}  // namespace pintle::bench
