// One model file with many sets of numbers, parsed once.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/document.h"
#include "pintle/model.h"

namespace pintle {

class ModelVariants {
 public:
  /// The document must give a model, and the paths must be of numbers in it.
  ModelVariants(Document document, const std::vector<std::string>& paths);

  /// The model with one number [SI] at each path. Throws InputError where the numbers do not go together.
  Model at(std::span<const double> values);

 private:
  Document document_;
  std::vector<std::vector<std::string>> paths_;
};

}  // namespace pintle
