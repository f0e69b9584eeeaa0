#include "run/check_settings.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <string>

namespace pintle {
namespace {

void demand(bool good, const std::string& complaint) {
  if (!good) throw std::invalid_argument(complaint);
}

}  // namespace

void check_settings(const SimulateSettings& settings) {
  const auto positive = [](double x) { return x > 0 && std::isfinite(x); };
  demand(positive(settings.duration), fmt::format("duration is {} s: set a time above 0", settings.duration));
  demand(positive(settings.tolerance), fmt::format("tolerance is {}: set a number above 0, such as 1e-5", settings.tolerance));
  demand(settings.output_step >= 0, fmt::format("output_step is {} s: set a time above 0, or 0 for 500 rows", settings.output_step));
  demand(settings.output_step == 0 || settings.duration / settings.output_step <= kMostRows, fmt::format("output_step is {} s: this would give more than 10 million rows of results", settings.output_step));
  demand(settings.max_step >= 0, fmt::format("max_step is {} s: set a time above 0, or 0 for none", settings.max_step));
}

}  // namespace pintle
