#include "integrators/dense/force_samples.h"

#include <cmath>
#include <numbers>

#include "linalg/dense_factors.h"

namespace pintle {

ForceSamples::ForceSamples(const RadauTable& table) {
  Eigen::MatrixXd powers(kAll, kAll);
  for (int i = 0; i < kAll; ++i) {
    x[i] = 0.5 * (1 - std::cos(std::numbers::pi * i / (kAll - 1)));
    for (int k = 0; k < kAll; ++k) powers(i, k) = std::pow(x[i], k);
    for (int node = 0; node <= table.n; ++node) {
      value[i][node] = once[i][node] = twice[i][node] = 0;
      for (int k = 0; k <= table.n; ++k) {
        const double c = table.to_powers(k, node);
        value[i][node] += c * std::pow(x[i], k);
        once[i][node] += c * std::pow(x[i], k + 1) / (k + 1);
        twice[i][node] += c * std::pow(x[i], k + 2) / ((k + 1) * (k + 2));
      }
    }
  }
  const Eigen::MatrixXd inverse = inverse_of(powers);
  for (int k = 0; k < kAll; ++k)
    for (int i = 0; i < kAll; ++i) to_powers[k][i] = inverse(k, i);
}

const ForceSamples& ForceSamples::of(const RadauTable& table) {
  static const ForceSamples of_three(RadauTable::of(3)), of_five(RadauTable::of(5));
  return table.n == 3 ? of_three : of_five;
}

}  // namespace pintle
