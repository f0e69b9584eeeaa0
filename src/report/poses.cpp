#include "report/poses.h"

#include <algorithm>
#include <cmath>

namespace pintle {
namespace {

double between(const Trajectory& trajectory, std::size_t row, double share, int column) {
  const auto place = static_cast<std::size_t>(column);
  const double a = trajectory.at(row, place);
  return share > 0 ? a + share * (trajectory.at(row + 1, place) - a) : a;
}

}  // namespace

Pose pose_of(const BodyTrack& track, const Trajectory& trajectory, std::size_t row) {
  if (!track.recorded()) return {};
  const double angle = trajectory.at(row, static_cast<std::size_t>(track.angle));
  return {trajectory.at(row, static_cast<std::size_t>(track.x)), trajectory.at(row, static_cast<std::size_t>(track.y)),
          std::cos(angle), std::sin(angle)};
}

Instant instant_at(const Scene& scene, const Trajectory& trajectory, double t) {
  const std::size_t n = trajectory.n_rows();
  std::size_t low = 0, high = n;  // low: the last row that is not after t
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (trajectory.at(middle, 0) <= t ? low : high) = middle;
  }
  const bool last = low + 1 >= n;
  const double step = last ? 0 : trajectory.at(low + 1, 0) - trajectory.at(low, 0);
  const double share = step > 0 ? std::clamp((t - trajectory.at(low, 0)) / step, 0.0, 1.0) : 0.0;
  Instant instant;
  instant.t = last ? trajectory.at(low, 0) : std::max(t, trajectory.at(low, 0));
  for (const BodyTrack& track : scene.bodies) {
    if (!track.recorded()) {
      instant.poses.emplace_back();
      continue;
    }
    const double angle = between(trajectory, low, share, track.angle);
    instant.poses.push_back({between(trajectory, low, share, track.x), between(trajectory, low, share, track.y),
                             std::cos(angle), std::sin(angle)});
  }
  for (const ForceArrow& arrow : scene.arrows)
    instant.forces.push_back({between(trajectory, low, share, arrow.fx), between(trajectory, low, share, arrow.fy)});
  for (const LoadArrow& load : scene.loads)
    instant.loads.push_back({between(trajectory, low, share, load.fx), between(trajectory, low, share, load.fy)});
  return instant;
}

ColumnIndex::ColumnIndex(const std::vector<Column>& columns) {
  for (std::size_t i = 0; i < columns.size(); ++i) places_.emplace(columns[i].name, static_cast<int>(i));
}

int ColumnIndex::find(const std::string& name) const {
  const auto found = places_.find(name);
  return found == places_.end() ? -1 : found->second;
}

}  // namespace pintle
