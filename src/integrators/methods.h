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
  ToleranceOf tolerance_of = ToleranceOf::kForces;  ///< kMotion: newtonian radau only
  PenaltySettings penalty{};     ///< of Equations::kPenalty
};

/// The method that a model's settings request; "auto" is replaced by the method that it stands for.
MethodChoice resolve_method(const SimulateSettings& settings);

/// Why this method is not available, for the user: not with these equations, or not in this build. Empty: it is.
std::string why_not(const MethodChoice& choice);

/// A stepper on `system`, which must outlive it. Throws std::invalid_argument with the text of `why_not`.
std::unique_ptr<Stepper> make_stepper(const System& system, const MethodChoice& choice, double tolerance);
/// In space: newtonian radau only.
std::unique_ptr<BasicStepper<Spatial>> make_stepper(const BasicSystem<Spatial>& system, const MethodChoice& choice, double tolerance);

}  // namespace pintle
