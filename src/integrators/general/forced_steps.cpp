#include "integrators/general/forced_steps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "integrators/thresholds.h"

namespace pintle {
namespace {

constexpr double kShort = 0.1;    // fraction of the usual step: shorter ones are taken with an error that does not fall with the step; and with any error, of that times the tolerance
constexpr double kNext = 2;       // ratio of the next step to one that was taken in this way

}  // namespace

bool ForcedSteps::must_take(double error, double h) {
  const double short_h = kShort * usual_;
  const bool falls = !(refused_h_ > h) || error < refused_error_ * std::sqrt(h / refused_h_);
  refused_error_ = error;
  refused_h_ = h;
  return error > 1 && h < short_h && (!falls || h < tolerance_ * short_h) && std::isfinite(error);
}

double ForcedSteps::record_forced_step(double t, double h) {
  if (n_++ == 0) first_ = t;
  refused_h_ = 0;
  return kNext * h;
}

void ForcedSteps::record_step(double h) {
  usual_ = std::max(h, kForget * usual_);
  refused_h_ = 0;
}

std::vector<std::string> ForcedSteps::remarks() const {
  if (n_ == 0) return {};
  return {fmt::format("{} steps were taken with an error above the tolerance, the first at t = {:.6g} s: singular positions or jumps of forces", n_, first_)};
}

}  // namespace pintle
