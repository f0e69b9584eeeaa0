// What the program is to reach, each beside what was measured.
#pragma once

#include <map>
#include <string>

#include "bench/result_table.h"
#include "bench/scaling.h"
#include "bench/work_precision.h"

namespace pintle::bench {

/// Of the problems that were measured; others are not judged. No scaling: null; no turns: 0.
ResultTable judge_targets(const std::map<std::string, const WorkPrecision*>& works, const Scaling* scaling, double turns_per_second);

}  // namespace pintle::bench
