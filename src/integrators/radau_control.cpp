#include "integrators/radau_control.h"

#include <fmt/format.h>

namespace pintle {

std::string no_step_message(const System& system, double t, double h, std::vector<std::pair<double, int>> residuals) {
  constexpr std::size_t kNamed = 3;
  const auto rank = [](double x) { return std::isfinite(x) ? x : std::numeric_limits<double>::infinity(); };
  std::stable_sort(residuals.begin(), residuals.end(), [&](const auto& a, const auto& b) { return rank(a.first) > rank(b.first); });
  std::string text = fmt::format("the step size has shrunk to nothing at t = {:.9g} s, step {:.3g} s", t, h);
  for (std::size_t i = 0; i < std::min(kNamed, residuals.size()); ++i)
    text += fmt::format("; joint {} (residual {:.3g} m/s^2)", system.joints[residuals[i].second].name, residuals[i].first);
  return text;
}

}  // namespace pintle
