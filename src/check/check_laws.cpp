// Laws: tangents against differences; force as energy gradient, losses, powers, finite numbers.
#include <algorithm>
#include <cmath>

#include "check/check_batteries.h"
#include "check/check_differences.h"
#include "check/check_law_samples.h"

namespace pintle {
namespace {

using S = Planar;

template <class Use>
void for_each_sample(const System& system, const State& assembled, const std::vector<CheckState>& states, Use&& use) {
  for (const CheckState& state : states)
    for (int j = 0; j < system.n_joints(); ++j) {
      const JointData& joint = system.joints[j];
      const CheckPlace place{joint.servo >= 0 ? "motor" : "joint", joint.name, state.number};
      use(joint.law, law_sample(joint, assembled, j, state), place);
    }
}

// Typical forces of a law: those of its elastic part at the sample's sizes.
S::Vec typical_force(const Law& law, const LawSample& at) {
  return respond(law, at.loaded, S::Vec::Zero()).force.cwiseAbs();
}

void downhill(const Law& law, const LawSample& at, const CheckPlace& place, Comparisons& tally) {
  constexpr double kRounding = 1e-8;  // as a fraction of the energy, with a margin: differences cannot resolve less
  const Response r = respond(law, at.gap, S::Vec::Zero());
  const S::Vec size = typical_force(law, at);
  for (int k = 0; k < S::kDof; ++k)
    tally.slope(
        Eigen::VectorXd::Constant(1, -r.force[k]),
        [&](double s) -> Eigen::VectorXd {
          return Eigen::VectorXd::Constant(1, respond(law, at.gap + s * S::Vec::Unit(k), S::Vec::Zero()).energy);
        },
        1e-3 * at.gap_size[k], std::max(size[k], kRounding * r.energy / (1e-3 * at.gap_size[k])), place);
}

// The power that the law's force takes from the bodies is stored or lost.
void powers(const Law& law, const LawSample& at, const CheckPlace& place, Comparisons& account, Comparisons& loss) {
  const Response r = respond(law, at.gap, at.rate);
  const double stored = -respond(law, at.gap, S::Vec::Zero()).force.dot(at.rate), given = r.force.dot(at.rate);
  const double size = r.force.cwiseAbs().dot(at.rate.cwiseAbs()) + std::abs(stored) + std::abs(r.loss);
  account.vanishes(given + stored + r.loss, size, place);
  loss.vanishes(std::min(0.0, r.loss), size, place);
}

double not_finite(const Response& r) {
  return r.force.allFinite() && r.stiffness.allFinite() && r.damping.allFinite() && std::isfinite(r.energy) &&
                 std::isfinite(r.loss)
             ? 0
             : 1;
}

}  // namespace

void check_law_slopes(const System& system, const State& assembled, const std::vector<CheckState>& states,
                      CheckBattery& battery) {
  Comparisons stiffness("law stiffness", kSlopeTolerance), damping("law damping", kSlopeTolerance);
  for_each_sample(system, assembled, states, [&](const Law& law, const LawSample& at, const CheckPlace& place) {
    const Response r = respond(law, at.gap, at.rate), typical = respond(law, at.loaded, S::Vec::Zero());
    for (int k = 0; k < S::kDof; ++k) {
      const S::Vec unit = S::Vec::Unit(k);
      stiffness.slope(
          -r.stiffness.col(k), [&](double s) -> Eigen::VectorXd { return respond(law, at.gap + s * unit, at.rate).force; },
          1e-3 * at.gap_size[k], typical.stiffness.cwiseAbs().maxCoeff() * 1e-3, place);
      damping.slope(
          -r.damping.col(k), [&](double s) -> Eigen::VectorXd { return respond(law, at.gap, at.rate + s * unit).force; },
          1e-3 * at.rate_size[k], typical.damping.cwiseAbs().maxCoeff() * 1e-3, place);
    }
  });
  battery.items.push_back(stiffness.item());
  battery.items.push_back(damping.item());
}

void check_law_energy(const System& system, const State& assembled, const std::vector<CheckState>& states,
                      CheckBattery& battery) {
  Comparisons potential("force = -energy gradient", kSlopeTolerance),
      account("power = stored + dissipated, per law", kIdentityTolerance), loss("dissipation not negative", kIdentityTolerance),
      finite("finite at zero and large gaps", 0);
  for_each_sample(system, assembled, states, [&](const Law& law, const LawSample& at, const CheckPlace& place) {
    downhill(law, at, place, potential);
    powers(law, at, place, account, loss);
    finite.vanishes(not_finite(respond(law, S::Vec::Zero(), S::Vec::Zero())), 1, place);
    finite.vanishes(not_finite(respond(law, 1e6 * at.gap_size, 1e6 * at.rate_size)), 1, place);
  });
  for (const Comparisons* c : {&potential, &account, &loss, &finite}) battery.items.push_back(c->item());
}

}  // namespace pintle
