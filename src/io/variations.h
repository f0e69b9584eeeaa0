// Values that vary by chance, as [variation] states them, and which keys of a model can be varied at all.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/reading/model_reading.h"

namespace pintle {

enum class Distribution { kNormal, kLognormal, kUniform, kTriangular };

/// A number of the model that follows a distribution, cut off at `from` and `to`. SI.
struct Variation {
  std::string path;  ///< "joint.A.stiffness"
  std::string unit;
  Distribution distribution = Distribution::kNormal;
  double mean = 0, deviation = 0;  ///< normal, lognormal: of the value itself, before it is cut off
  double mode = 0;                 ///< triangular
  double from = 0, to = 0;         ///< infinite where nothing limits it; the key's own range is in them
};

/// A key of the model that is one number.
struct VariedKey {
  std::string unit;  ///< "" for a pure number
  Dimension dimension;
  std::optional<double> minimum, maximum;
  bool minimum_exclusive = false;
  bool allows(double x) const;
};

/// What stands at `path`. Complains, at `spot`, where nothing does or it is not one number. Everything else must have been read.
std::optional<VariedKey> varied_key(ModelReading& reading, const std::string& path, Spot spot);

/// The table [variation]; complains about what is wrong with it. Everything else must have been read. Unless values are `to_be_drawn`, keys of another law than
/// their joint has are passed over with a note.
std::vector<Variation> read_variations(ModelReading& reading, bool to_be_drawn);

}  // namespace pintle
