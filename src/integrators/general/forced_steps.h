// Steps that are taken although their error is above the tolerance. theory/penalty section 2.
#pragma once

#include <string>
#include <vector>

namespace pintle {

/// A step that has become much shorter than the usual one is at a singular position or a jump of a force: the error does not
/// decrease with the step.
class ForcedSteps {
 public:
  explicit ForcedSteps(double tolerance) : tolerance_(tolerance) {}

  /// Whether a step of h with this error, in units of the tolerance, is one of them. `to_a_stop`: its length is what is left to a time at which a load may jump. There
  /// the error falls in proportion to the step, which is taken when this is negligible.
  bool must_take(double error, double h, bool to_a_stop) const;
  /// Call after such a step from `t`. Returns the length of the next one.
  double record_forced_step(double t, double h);
  /// Call after any other step.
  void record_step(double h);
  /// For the notes of the run: how many there were, and when the first; empty if there were none.
  std::vector<std::string> remarks() const;

 private:
  double tolerance_;
  double usual_ = 0, first_ = 0;  // [s]
  int n_ = 0;
};

}  // namespace pintle
