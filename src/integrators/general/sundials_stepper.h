// The general integrators ode45, ode15s and ode113 of the paper, from SUNDIALS. theory/solvers section 2.
#pragma once

#include <memory>
#include <string>

#include "integrators/stepper.h"

namespace pintle {

/// Whether this build has SUNDIALS.
bool has_sundials();

/// A stepper for "ode45", "ode15s" or "ode113"; null for other names, and in a build without SUNDIALS.
std::unique_ptr<Stepper> make_sundials_stepper(const System& system, const std::string& method, double tolerance);

}  // namespace pintle
