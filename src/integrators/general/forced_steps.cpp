#include "integrators/general/forced_steps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "integrators/thresholds.h"

namespace pintle {
namespace {

constexpr double kShort = 0.1;    // fraction of the usual step: shorter ones are taken with any error, since it does not fall with the step; to a jump, this times the tolerance
constexpr double kNext = 2;       // ratio of the next step to one that was taken in this way

}  // namespace

bool ForcedSteps::must_take(double error, double h, bool to_a_stop) const { return error > 1 && h < kShort * usual_ * (to_a_stop ? tolerance_ : 1) && std::isfinite(error); }

double ForcedSteps::record_forced_step(double t, double h) {
  if (n_++ == 0) first_ = t;
  return kNext * h;
}

void ForcedSteps::record_step(double h) { usual_ = std::max(h, kForget * usual_); }

std::vector<std::string> ForcedSteps::remarks() const {
  if (n_ == 0) return {};
  return {fmt::format("{} steps were taken with an error above the tolerance, the first at t = {:.6g} s: singular positions or jumps of forces", n_, first_)};
}

}  // namespace pintle
