// Steps that are taken although their error is above the tolerance. theory/penalty section 2.
#pragma once

#include <string>
#include <vector>

namespace pintle {

/// A step that has become much shorter than the usual one is at a singular position if its error does not decrease with the step; the error at a jump of a force
/// does, in proportion, and the step is shortened until it is within the tolerance, or negligible.
class ForcedSteps {
 public:
  explicit ForcedSteps(double tolerance) : tolerance_(tolerance) {}

  /// Whether an attempt at a step of h with this error, in units of the tolerance, is one of them. Call for every attempt, in their order.
  bool must_take(double error, double h);
  /// Call after such a step from `t`. Returns the length of the next one.
  double record_forced_step(double t, double h);
  /// Call after any other step.
  void record_step(double h);
  /// For the notes of the run: how many there were, and when the first; empty if there were none.
  std::vector<std::string> remarks() const;

 private:
  double tolerance_;
  double usual_ = 0, first_ = 0;                 // [s]
  double refused_error_ = 0, refused_h_ = 0;     // of the last attempt at this step; 0: none
  int n_ = 0;
};

}  // namespace pintle
