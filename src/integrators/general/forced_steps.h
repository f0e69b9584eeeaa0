// Steps that are taken although their error is above the tolerance. theory/penalty section 2.
#pragma once

#include <string>
#include <vector>

namespace pintle {

/// A step that has become so much shorter than the usual one stands before a singular position or a jump of a force: the error does not
/// fall with it.
class ForcedSteps {
 public:
  /// Whether a step of h with this error over the tolerance is one of them.
  bool must_take(double error, double h) const;
  /// Such a step has been taken from `t`. Returns the next one.
  double record_forced_step(double t, double h);
  /// Another step has been taken.
  void record_step(double h);
  /// For the notes of the run: how many, and when the first; nothing where there was none.
  std::vector<std::string> remarks() const;

 private:
  double usual_ = 0, first_ = 0;  // [s]
  int n_ = 0;
};

}  // namespace pintle
