// The mechanisms of the work-precision curves.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "pintle/model.h"

namespace pintle::bench {

struct CurveProblem {
  std::string name;      // in files and options
  std::string title;
  std::function<Model()> model;
  MarkerRef point;       // point whose position is measured
  std::string remark{};  // difference from the model of the collection
  int loops = 0;         // of the N-four-bar; 0: another mechanism
  bool ideal = true;     // ideal joints have a unique solution
  bool all_peers = false;  // every promising method of SUNDIALS, not only the best few
  bool small = true;     // whole runs and dense peers are worthwhile
};

/// In the order of the tables.
std::vector<CurveProblem> curve_problems();

}  // namespace pintle::bench
