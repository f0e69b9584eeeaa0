// The data for the script of a report's page, as JSON: the drawing, the columns, and which of them belong together.
#pragma once

#include <string>
#include <vector>

#include "pintle/model.h"
#include "pintle/results.h"
#include "report/scene.h"

namespace pintle {

/// The part of a run that a page contains.
struct PageContent {
  std::vector<std::size_t> rows;     ///< in the order of time; all, or as many as keep the page to a reasonable size
  std::vector<std::size_t> columns;  ///< those that cannot be derived from others; the first is the time
};

/// At most about `most_values` numbers. A thinned run keeps its first and last rows and those at the joints' peaks.
PageContent choose_content(const Trajectory& trajectory, std::size_t most_values);

/// One JSON object without any "<", so that it can be placed in a script element.
std::string page_data(const Scene& scene, const RunRecord& run, const PageContent& content);

/// Doubles of eight bytes each, lowest byte first, in base 64.
std::string base64(const std::vector<double>& values);

}  // namespace pintle
