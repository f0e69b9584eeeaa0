#include "dynamics/time_scales.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "dynamics/inverse_dynamics.h"

namespace pintle {
namespace {

// theory/assembly Eq. (5.3). A gap is fast if its slower rate exceeds kFast/span: sweeps of section 4 then gain digits, and their truncation error
// is below (span/kFast)^2 of the force's curvature. Damping settles a rate at once if the faster one exceeds kSettles/span.
constexpr double kFast = 20, kSettles = 100;  // limits on a gap's slower and faster rate, as multiples of 1/span

template <class Vec>
bool any(const std::vector<Vec>& x) {
  return std::any_of(x.begin(), x.end(), [](const Vec& y) { return !y.isZero(); });
}

// Equally stiff directions of a point get the same rates: those of the slowest.
template <class Vec>
void share_slowest_rate(const Vec& engaged, std::span<OwnRates> rates) {
  for (std::size_t i = 0; i < rates.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      OwnRates &a = rates[i], &b = rates[k];
      if (engaged[i] == engaged[k] && a.slow > 0 && b.slow > 0) a = b = b.slow < a.slow ? b : a;
    }
}

}  // namespace

OwnRates own_rates(double m, double c, double k) {
  const double root = c * c - 4 * m * k;
  if (root < 0) return {std::sqrt(k / m), std::sqrt(k / m), c / (2 * m)};
  const double sum = c + std::sqrt(root), slow = 2 * k / sum;
  return {slow, sum / (2 * m), slow};
}

template <class S>
bool BasicTimeScales<S>::any_soft() const { return any(overdamped) || any(resolved); }
template <class S>
bool BasicTimeScales<S>::any_resolved() const { return any(resolved); }

template <class S>
BasicTimeScales<S> all_fast(const BasicSystem<S>& system) {
  const VecsOf<S> none(system.joints.size(), S::Vec::Zero());
  return {none, none, none, {}};
}

template <class S>
BasicTimeScales<S> measure_time_scales(const BasicSystem<S>& system, const BasicState<S>& state, double span) {
  BasicTimeScales<S> time_scales = all_fast(system);
  const BasicEffectiveMasses<S> masses = BasicInverseDynamics<S>(system).effective_masses(state);
  for (std::size_t j = 0; j < masses.closed.size(); ++j) {
    const BasicResponse<S> response = respond(system.joints[j].law, state.gap[j], state.gap_rate[j]);
    OwnRates both[S::kDof];
    for (int i = 0; i < S::kDof; ++i) {
      const double k = response.stiffness(i, i), m = masses.closed[j][i];
      if (k > 0 && m > 0) both[i] = own_rates(m, response.damping(i, i), k);
    }
    share_slowest_rate(system.joints[j].law.engaged_stiffness(), std::span(both).template first<S::kDim>());
    for (int i = 0; i < S::kDof; ++i) {
      const OwnRates& rates = both[i];
      time_scales.slow_rate[j][i] = rates.slow;
      if (rates.slow == 0 || rates.slow * span > kFast) continue;
      const bool settles = rates.fast * span > kSettles;
      (settles ? time_scales.overdamped : time_scales.resolved)[j][i] = 1;
      if (settles || !(masses.alone[j][i] > 0)) continue;
      const OwnRates alone = own_rates(masses.alone[j][i], response.damping(i, i), response.stiffness(i, i));
      time_scales.fastest = std::max(time_scales.fastest, alone.fast);
    }
  }
  time_scales.effective_mass = masses.closed;
  return time_scales;
}

template BasicTimeScales<Planar> all_fast(const BasicSystem<Planar>& system);
template BasicTimeScales<Planar> measure_time_scales(const BasicSystem<Planar>& system, const BasicState<Planar>& state, double span);
PINTLE_IN_SPACE(template BasicTimeScales<Spatial> all_fast(const BasicSystem<Spatial>& system);)
PINTLE_IN_SPACE(template BasicTimeScales<Spatial> measure_time_scales(const BasicSystem<Spatial>& system, const BasicState<Spatial>& state, double span);)

template struct BasicTimeScales<Planar>;
PINTLE_IN_SPACE(template struct BasicTimeScales<Spatial>;)

}  // namespace pintle
