#include "run/recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text/name_patterns.h"

namespace pintle {
namespace {

constexpr double kRows = 500;              // rows of a run whose output step is not stated
constexpr double kMostForces = 1e7;        // upper limit on joints times rows if the output step is not stated: 480 MB for two passes
constexpr std::size_t kSmall = 1000;       // bodies and joints: with fewer everything is kept
constexpr double kMostNumbers = 2e7, kMostColumns = 1e5;  // upper limits for a table that is kept by default
constexpr double kPerBody = 6, kPerJoint = 8;  // approximate number of columns

}  // namespace

double output_step_of(const SimulateSettings& settings, std::size_t n_joints) {
  if (settings.output_step > 0) return settings.output_step;
  const double rows = n_joints == 0 ? kRows : std::clamp(std::floor(kMostForces / static_cast<double>(n_joints)), 20.0, kRows);
  return settings.duration / rows;
}

Recording choose_recording(const Model& model, const System& system) {
  const std::size_t n_bodies = system.bodies.size(), n_joints = system.joints.size();
  Recording out{std::vector<bool>(n_bodies, true), std::vector<bool>(n_joints, true), ""};
  const std::vector<std::string>& wanted = model.simulate.record;
  if (std::find(wanted.begin(), wanted.end(), "all") != wanted.end()) return out;
  if (wanted.empty()) {
    const double step = output_step_of(model.simulate, n_joints);
    const double columns = kPerBody * static_cast<double>(n_bodies) + kPerJoint * static_cast<double>(n_joints);
    const bool many = columns > kMostColumns || columns * model.simulate.duration / step > kMostNumbers;
    if (n_bodies + n_joints <= kSmall || !many) return out;
    out.note = fmt::format("series.csv omits the columns of {} bodies and {} joints: list those you need in simulate.record; "
                           "summary.json has peak, mean, RMS and error of every joint", n_bodies, n_joints);
  }
  const NamePatterns chosen(wanted);
  for (std::size_t i = 0; i < n_bodies; ++i) out.body[i] = chosen.match("body." + system.bodies[i].name);
  for (std::size_t j = 0; j < n_joints; ++j) out.joint[j] = chosen.match("joint." + system.joints[j].name);
  return out;
}

}  // namespace pintle
