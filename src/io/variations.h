// Values that vary randomly, as stated in [variation], and which keys of a model can be varied at all.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/reading/model_reading.h"

namespace pintle {

enum class Distribution { kNormal, kLognormal, kUniform, kTriangular };

/// A number of the model that follows a distribution truncated at `from` and `to`. SI.
struct Variation {
  std::string path;  ///< "joint.A.stiffness"
  std::string unit;
  Distribution distribution = Distribution::kNormal;
  double mean = 0, deviation = 0;  ///< normal, lognormal: of the value itself, before truncation
  double mode = 0;                 ///< triangular
  double from = 0, to = 0;         ///< infinite if there is no limit; the key's own range is included
};

/// A key of the model that holds a single number.
struct VariedKey {
  std::string unit;  ///< "" for a pure number
  Dimension dimension;
  std::optional<double> minimum, maximum;
  bool minimum_exclusive = false;
  bool allows(double x) const;
};

/// The key at `path`. Complains, at `spot`, if there is nothing or not a single number. Everything else must have been read.
std::optional<VariedKey> varied_key(ModelReading& reading, const std::string& path, Spot spot);

/// The table [variation]; complains about what is wrong with it. Everything else must have been read. Unless values are `to_be_drawn`, keys that belong to a law
/// other than the joint's are skipped with a note.
std::vector<Variation> read_variations(ModelReading& reading, bool to_be_drawn);

}  // namespace pintle
