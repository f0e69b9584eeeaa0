// The values of each sample: a grid of given values, with random samples at each grid point.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/reading/model_reading.h"
#include "io/variations.h"
#include "pintle/sweep.h"

namespace pintle {

/// A number that takes the given values in turn [SI].
struct SweepAxis {
  std::string path, unit;
  std::vector<double> values;
};

/// Reads "joint.A.stiffness=1e6..1e9 N/m:log:16" or "joint.A.stiffness=1e6,2e6 N/m", the text of the document's source `source`;
/// complains about what is wrong with it. A number without a unit has the unit of the last number, or is SI.
SweepAxis read_axis(ModelReading& reading, const std::string& text, int source);

class SweepPlan {
 public:
  SweepPlan() = default;
  /// Complains about everything that is wrong with the request's own options; `reading` has already read the model.
  SweepPlan(const SweepRequest& request, ModelReading& reading, int first_source);

  std::uint64_t size() const { return grid_points_ * draws(); }
  std::vector<std::string> paths() const;
  std::vector<std::string> units() const;
  /// The values of sample `i` [SI], in the order of the paths: grid points in order, each with its draws. The random values of a draw
  /// depend only on the seed, the path and the draw's number.
  std::vector<double> values(std::uint64_t i) const;
  const std::vector<SweepAxis>& axes() const { return axes_; }

 private:
  std::uint64_t draws() const { return samples_ > 0 ? samples_ : 1; }
  void count_points(const SweepRequest& request, ModelReading& reading, int first_source);
  void shuffle_strata();
  double share(std::size_t variable, std::uint64_t draw) const;

  std::vector<SweepAxis> axes_;
  std::vector<Variation> variations_;
  std::vector<std::uint64_t> streams_;               // of the random numbers, by variation
  std::vector<std::vector<std::uint32_t>> strata_;   // of a Latin hypercube: by variation, by draw
  bool zip_ = false;
  std::uint64_t grid_points_ = 1, samples_ = 0, seed_ = 1;
};

}  // namespace pintle
