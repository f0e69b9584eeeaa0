#include "run/errors/suppressed_instability.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>

#include "base/constants.h"
#include "integrators/general/motion_jacobian.h"
#include "integrators/radau/radau_table.h"
#include "linalg/dense_factors.h"

namespace pintle {
namespace {

constexpr int kParts = 64;          // parts of a run, in each of which the longest step is examined: 2 ms for a four-bar with friction, whose run takes 30 ms. With half or twice as many the same modes are found
constexpr int kMostUnknowns = 120;  // upper limit on positions, velocities and states: the time to examine them grows with the cube of their number
constexpr double kOfPeriod = 1;     // longest step that follows a vibration, in radians of it. With half of it tests/models/chair_whose_foot_chatters.toml takes 1.2 times as many steps at 1e-4, with twice it 0.9 times, for the same peaks

// The function of stability, R(z): by what a step multiplies a solution of y' = lambda y, z = lambda h. The method is stiffly accurate.
double growth_in_step(const RadauTable& table, std::complex<double> z) {
  const Eigen::MatrixXcd I = Eigen::MatrixXcd::Identity(table.n, table.n);
  const Eigen::VectorXcd y = (I - z * table.A.topLeftCorner(table.n, table.n).cast<std::complex<double>>()).partialPivLu().solve(Eigen::VectorXcd::Ones(table.n));
  return std::abs(y[table.n - 1]);
}

// Whether forces may feed vibrations: friction, and loads that depend on the motion.
template <class S>
bool may_feed(const BasicSystem<S>& system) {
  return std::any_of(system.joints.begin(), system.joints.end(), [](const BasicJointData<S>& joint) { return joint.law.has_friction() || joint.law.rubs_where_it_holds(); }) ||
         std::any_of(system.loads.begin(), system.loads.end(), [](const BasicLoadData<S>& load) {
           return std::any_of(load.signals.begin(), load.signals.end(), [](const BasicSignal<S>& signal) { return !signal.is_time; });
         });
}

}  // namespace

double longest_following_step(const SuppressedMode& mode) { return kOfPeriod / mode.frequency; }

std::string note_on_suppressed(const SuppressedMode& mode, double duration, bool followed) {
  const double step = longest_following_step(mode);
  return fmt::format("forces that depend on the motion, such as friction, make a vibration of {:.3g} Hz grow from about t = {:.3g} s, by a factor e in {:.2g} s: {}", mode.frequency / kTurn, mode.from, 1 / mode.rate,
                     followed ? "steps were made short enough to follow it"
                              : fmt::format("following it would take {:.1g} steps. Those of this run damp it, which the stated errors do not include; max_step = \"{:.1g} s\" follows it", duration / step, step));
}

template <class S>
BasicSuppressedInstability<S>::BasicSuppressedInstability(const BasicSystem<S>& system, double duration) : system_(&system), part_(duration / kParts) {
  if constexpr (S::kDim == 2) {
    if (motion_unknowns(system) <= kMostUnknowns && may_feed(system)) looks_.resize(kParts);
  }
}

template <class S>
void BasicSuppressedInstability<S>::reset() {
  for (Look& look : looks_) look.h = 0;
}

template <class S>
void BasicSuppressedInstability<S>::see_step(const BasicState<S>& now, double h, int stages) {
  if (looks_.empty()) return;
  Look& look = looks_[static_cast<std::size_t>(std::clamp((now.t - 0.5 * h) / part_, 0.0, kParts - 1.0))];
  if (!(h > look.h)) return;
  look = {now, h, stages};
}

template <class S>
SuppressedMode BasicSuppressedInstability<S>::fastest_suppressed_mode(const Look& look) const {
  SuppressedMode out;
  GeneralEigen eigen;
  if constexpr (S::kDim == 2) {
    if (!eigen.compute(motion_jacobian(*system_, look.end), GeneralEigen::Vectors::kLeftOut)) return out;
  }
  const auto& lambda = eigen.eigenvalues();
  const double least = kResolvedEigenvalue * lambda.cwiseAbs().maxCoeff();
  const RadauTable& table = RadauTable::of(look.stages);
  for (Eigen::Index i = 0; i < lambda.size(); ++i) {
    const double rate = lambda[i].real();
    if (!(rate > out.rate) || std::abs(lambda[i]) < least || lambda[i].imag() < 0) continue;
    if (growth_in_step(table, lambda[i] * look.h) >= 1) continue;
    out.rate = rate;
    out.frequency = std::abs(lambda[i]);
  }
  return out;
}

template <class S>
std::optional<SuppressedMode> BasicSuppressedInstability<S>::growing_mode() const {
  std::optional<SuppressedMode> out;
  double grown = 0, from = 0;
  SuppressedMode fastest;
  for (std::size_t i = 0; i < looks_.size(); ++i) {
    const Look& look = looks_[i];
    if (!(look.h > 0)) continue;  // a longer step, which counts for another part, has passed it
    const SuppressedMode here = fastest_suppressed_mode(look);
    if (!(here.rate > 0)) {
      grown = 0;
      fastest = {};
      continue;
    }
    if (!(grown > 0)) from = static_cast<double>(i) * part_;
    grown += here.rate * std::max(part_, look.h);
    if (here.rate > fastest.rate) fastest = here;
    fastest.from = from;
    if (grown > 1 && (!out || fastest.rate > out->rate)) out = fastest;
  }
  return out;
}

template class BasicSuppressedInstability<Planar>;
PINTLE_IN_SPACE(template class BasicSuppressedInstability<Spatial>;)

}  // namespace pintle
