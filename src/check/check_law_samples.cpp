#include "check/check_law_samples.h"

#include <algorithm>
#include <cmath>

namespace pintle {

namespace {

using S = Planar;

}  // namespace

LawSample law_sample(const JointData& joint, const State& assembled, int j, const CheckState& state) {
  constexpr double kSmall = 1e-6;  // as a fraction of the mechanism's length: gap size where the assembled gap is no guide
  LawSample out;
  const auto resistance = [&joint](double side) -> S::Vec { return respond(joint.law, side * S::Vec::Ones(), S::Vec::Zero()).stiffness.diagonal(); };
  const double side = resistance(1).isZero() ? -1 : 1;
  const S::Vec resisted = resistance(side);
  double gap = kSmall * state.length;
  for (const int k : {0, 1})
    if (resisted[k] > 0) gap = std::max(gap, std::abs(assembled.gap[j][k]));  // a slide is not a gap
  out.gap_size << gap, gap, resisted[2] > 0 ? std::max(std::abs(assembled.gap[j][2]), kSmall) : kSmall;
  out.loaded = side * out.gap_size;
  const Response stretched = respond(joint.law, out.loaded, S::Vec::Zero());
  for (int k = 0; k < S::kDof; ++k) {
    const double stiffness = stretched.stiffness(k, k), c = stretched.damping(k, k);
    out.rate_size[k] = out.gap_size[k] * (c > 0 && stiffness > 0 ? stiffness / c : 1);  // an oil film has no stiffness at rest
  }
  out.gap = assembled.gap[j];
  out.rate = assembled.gap_rate[j];
  if (state.number == 0) return out;
  Noise noise(1000u * static_cast<unsigned>(state.number) + static_cast<unsigned>(j));
  out.gap = 2 * out.gap_size.cwiseProduct(noise.vec());
  out.rate = 2 * out.rate_size.cwiseProduct(noise.vec());
  return out;
}

}  // namespace pintle
