#include "start/time_scales.h"

#include <algorithm>
#include <cmath>

#include "start/preload.h"

namespace pintle {
namespace {

using S = Planar;

// theory/assembly Eq. (5.3). A gap is fast when its slower rate is this many times 1/span: then sweeps of section 4 gain digits, and what they leave
// out is below (span/kFast)^2 of the force's curvature. Damping settles a rate at once when the faster one is kSettles times.
constexpr double kFast = 20, kSettles = 100;

struct Rates {
  double slow = 0, fast = 0;  // [1/s]
};

// theory/assembly Eq. (5.2): the roots of m s^2 + c s + k = 0 in magnitude.
Rates own_rates(double m, double c, double k) {
  const double root = c * c - 4 * m * k;
  if (root < 0) return {std::sqrt(k / m), std::sqrt(k / m)};
  const double sum = c + std::sqrt(root);
  return {2 * k / sum, sum / (2 * m)};
}

bool any(const Vecs& x) {
  return std::any_of(x.begin(), x.end(), [](const S::Vec& y) { return !y.isZero(); });
}

}  // namespace

bool TimeScales::any_soft() const { return any(overdamped) || any(resolved); }
bool TimeScales::any_resolved() const { return any(resolved); }

TimeScales all_fast(const System& system) {
  const Vecs none(system.joints.size(), S::Vec::Zero());
  return {none, none, none};
}

TimeScales measure_time_scales(const System& system, const State& state, double span) {
  TimeScales time_scales = all_fast(system);
  const EffectiveMasses masses = InverseDynamics(system).effective_masses(state);
  for (std::size_t j = 0; j < masses.closed.size(); ++j) {
    const Response response = respond(system.joints[j].law, state.gap[j], state.gap_rate[j]);
    Rates both[S::kDof];
    for (int i = 0; i < S::kDof; ++i) {
      const double k = response.stiffness(i, i), m = masses.closed[j][i];
      if (k > 0 && m > 0) both[i] = own_rates(m, response.damping(i, i), k);
    }
    // Both directions of a point are treated alike: the slower decides.
    if (both[0].slow > 0 && both[1].slow > 0) both[0] = both[1] = both[0].slow < both[1].slow ? both[0] : both[1];
    for (int i = 0; i < S::kDof; ++i) {
      const Rates& rates = both[i];
      time_scales.slow_rate[j][i] = rates.slow;
      if (rates.slow == 0 || rates.slow * span > kFast) continue;
      const bool settles = rates.fast * span > kSettles;
      (settles ? time_scales.overdamped : time_scales.resolved)[j][i] = 1;
      if (settles || !(masses.alone[j][i] > 0)) continue;
      const Rates alone = own_rates(masses.alone[j][i], response.damping(i, i), response.stiffness(i, i));
      time_scales.fastest = std::max(time_scales.fastest, alone.fast);
    }
  }
  return time_scales;
}

}  // namespace pintle
