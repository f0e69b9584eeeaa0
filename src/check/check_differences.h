// Derivatives against central differences, and statistics of the agreement.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <string_view>

#include "pintle/check.h"

namespace pintle {

/// The place of a comparison.
struct CheckPlace {
  std::string_view kind, name;  // "joint", "A"
  int state = 0;                // 0: as assembled
};

/// Comparisons of one kind; keeps the worst one and its place.
class Comparisons {
 public:
  Comparisons(std::string what, double tolerance) { item_.what = std::move(what), item_.tolerance = tolerance; }

  using Curve = std::function<Eigen::VectorXd(double)>;
  /// Is `slope` the derivative of `curve` at 0? The mismatch is relative to `scale` or to the slope, whichever is
  /// larger. Starts with fourth-order differences over steps of `step` and shrinks them while they disagree, so that a
  /// sharp bend is not taken for a mistake. There is no verdict if the one-sided slopes differ at every step (a kink),
  /// or if the differences converge to `slope` with the steps, as at the ends of a smooth step.
  void slope(const Eigen::VectorXd& slope, const Curve& curve, double step, double scale, const CheckPlace& place);
  /// Columns of `slopes` against curve(column, s), all relative to the matrix's scale, or to `floor` if that is larger.
  template <class CurveOfColumn>
  void slopes(const Eigen::MatrixXd& slopes, CurveOfColumn&& curve, const Eigen::VectorXd& steps, double floor,
              const CheckPlace& place) {
    const double scale = slopes.size() > 0 ? std::max(floor, slopes.cwiseAbs().maxCoeff()) : floor;
    for (int c = 0; c < slopes.cols(); ++c)
      slope(
          slopes.col(c), [&](double s) -> Eigen::VectorXd { return curve(c, s); }, steps[c], scale, place);
  }
  /// `error` should be zero, relative to `scale`.
  void vanishes(double error, double scale, const CheckPlace& place);

  const CheckItem& item() const { return item_; }

 private:
  void count(double mismatch, const CheckPlace& place);
  CheckItem item_;
};

}  // namespace pintle
