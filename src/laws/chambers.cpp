#include "laws/chambers.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace pintle {

ChamberPressure::ChamberPressure(Expression expression) : expression_(std::move(expression)) {
  for (const std::string& variable : expression_.variables()) {
    const auto known = std::find(kVariables.begin(), kVariables.end(), variable);
    if (known == kVariables.end()) throw std::invalid_argument("a pressure cannot read '" + variable + "'");
    reads_.push_back(static_cast<int>(known - kVariables.begin()));
  }
}

std::array<double, 3> ChamberPressure::values(const double (&x)[3]) const {
  std::array<double, 3> values{};
  for (std::size_t i = 0; i < reads_.size(); ++i) values[i] = x[reads_[i]];
  return values;
}

law_math::Slopes<3, 1> ChamberPressure::slopes(const double (&x)[3]) const {
  law_math::Slopes<3, 1> out;
  const std::array<double, 3> at = values(x);
  std::array<double, 3> gradient{};
  out.value[0] = expression_.gradient(std::span(at).first(reads_.size()), std::span(gradient).first(reads_.size()));
  for (std::size_t i = 0; i < reads_.size(); ++i) out.slope[0][reads_[i]] = gradient[i];
  return out;
}

void ChamberPressure::evaluate_switching_functions(const LawInput<double>& in, double* value) const {
  if (n_switches() == 0) return;
  const std::array<double, 3> at = values({in.t, in.gap[0], in.rate[0]});
  expression_.evaluate_switching_functions(std::span(at).first(reads_.size()), value);
}

Chambers::Chambers(double bore, double rod_diameter, double ambient, ChamberPressure cap, ChamberPressure rod)
    : bore_(bore), rod_diameter_(rod_diameter), ambient_(ambient), cap_(std::move(cap)), rod_(std::move(rod)) {}

}  // namespace pintle
