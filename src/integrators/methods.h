// The integration methods by the words of the model file.
#pragma once

#include <memory>
#include <string>

#include "integrators/stepper.h"
#include "pintle/model.h"

namespace pintle {

struct MethodChoice {
  Equations equations = Equations::kNewtonian;
  std::string method = "radau";  ///< never "auto"
  int stages = 3;                ///< of radau, 3 or 5
};

/// What "auto" stands for.
std::string usual_method(Equations equations);

/// A stepper on `system`, which must outlive it. Throws std::invalid_argument for a method that these equations do not have.
std::unique_ptr<Stepper> make_stepper(const System& system, const MethodChoice& choice, double tolerance);

}  // namespace pintle
