// The integrators of SUNDIALS (CVODE: BDF, Adams; ARKODE: explicit and diagonally implicit Runge-Kutta) on the first-order
// equations of a system, behind one interface: they have the same calls under different names.
// A. C. Hindmarsh et al., ACM Transactions on Mathematical Software 31 (2005) 363-396; D. R. Reynolds et al., same, 49
// (2023) 1-26. Only in builds with SUNDIALS (CMake option PINTLE_SUNDIALS).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "integrators/general/first_order_ode.h"
#include "pintle/trajectory.h"

namespace pintle {

struct SundialsChoice {
  enum class Family { kBdf, kAdams, kExplicitRungeKutta, kImplicitRungeKutta };
  enum class LinearSolver { kDense, kKlu };

  Family family = Family::kBdf;
  int table = 0;                // ARKODE's Butcher table
  int max_order = 5;            // BDF
  bool limit_unstable = false;  // BDF: stability limit detection
  LinearSolver solver = LinearSolver::kDense;
};

/// ARKODE's number for the pair of Dormand and Prince.
int dormand_prince_table();

class SundialsCode {
 public:
  /// Starts at (t, y) with a relative tolerance and an absolute one for each component of y. `equations` must outlive
  /// it. Throws std::runtime_error if the library refuses.
  SundialsCode(const SundialsChoice& choice, FirstOrderOde& equations, double t, const std::vector<double>& y, double relative,
               const std::vector<double>& absolute);
  ~SundialsCode();

  void set_max_step(double h);
  /// No step goes beyond t.
  void stop_at(double t);
  /// Takes one step of its own length. Returns false if it failed; `failure` says why.
  bool step();
  /// Takes steps until t is passed; y is then the solution at t. Call stop_at(t) beforehand to end a step there.
  bool advance_to(double t);
  /// Continues from y at t, as from a start.
  void restart(double t, const std::vector<double>& y);
  /// Whether the last step ended on a root of the equations' switching functions.
  bool at_root() const;
  double t() const;
  const double* y() const;
  /// The solution at a time inside the last step, by the code's own interpolation; null if there is none.
  const double* interpolate(double t);

  void count(Counters& counters) const;
  const std::string& failure() const;

 private:
  struct Workspace;
  std::unique_ptr<Workspace> w_;
};

}  // namespace pintle
