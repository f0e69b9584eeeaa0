// What the script of a report's page works on, as JSON: the drawing, the columns, and which of them belong together.
#pragma once

#include <string>
#include <vector>

#include "pintle/model.h"
#include "pintle/results.h"
#include "report/scene.h"

namespace pintle {

/// Which part of a run a page carries.
struct PageContent {
  std::vector<std::size_t> rows;     ///< in the order of time; all, or so many that the page stays of a sane size
  std::vector<std::size_t> columns;  ///< those that cannot be had from others; the first is the time
};

/// At most about `most_values` numbers. Of a thinned run the first and last row stay, and those where a joint has its peak.
PageContent choose_content(const Trajectory& trajectory, std::size_t most_values);

/// One JSON object, without any "<", so that it can stand in a script element.
std::string page_data(const Scene& scene, const RunRecord& run, const PageContent& content);

/// Doubles, eight bytes each with the lowest first, in base 64.
std::string base64(const std::vector<double>& values);

}  // namespace pintle
