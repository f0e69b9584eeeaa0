#include "integrators/unresolved_ringing.h"

#include <algorithm>
#include <cmath>

#include "integrators/radau/step_error.h"

namespace pintle {

double ringing_force(double m, double c, double k, double rate) { return k * std::abs(rate) / (std::sqrt(k / m) + std::max(c, 0.0) / m); }

namespace {

// The largest force(m, c, k, rate) over the load scale, of the components whose vibration the step does not resolve.
template <class S, class Force>
double largest_unresolved(const BasicSystem<S>& system, int j, const BasicLawPoint<S>& at, const BasicJointKinematics<S>& r, const typename S::Vec& last, double h, int n,
                          const BasicLoadScale<S>& scale, Force&& force) {
  const BasicJointData<S>& joint = system.joints[j];
  if (joint.ideal) return 0;
  BasicLawTangents<S> tangents;
  joint.law.linearize(at, tangents);
  const typename S::Vec mobility = system.own_mobility(joint.at, r), load = load_in_gap_axes(joint.at, scale);
  const double of_rate = h / (2 * n - 1), slowest = kGapError / of_rate;
  double largest = 0;
  for (int c = 0; c < S::kDof; ++c) {
    const double k = tangents.stiffness(c, c);
    if (!(k > 0) || !(k * mobility[c] > slowest * slowest)) continue;
    largest = std::max(largest, force(1 / mobility[c], tangents.damping(c, c), k, of_rate * last[c]) / load[c]);
  }
  return largest;
}

}  // namespace

template <class S>
double unresolved_ringing(const BasicSystem<S>& system, int j, const BasicLawPoint<S>& at, const BasicJointKinematics<S>& r, const typename S::Vec& last, double h, int n,
                          const BasicLoadScale<S>& scale) {
  return largest_unresolved(system, j, at, r, last, h, n, scale, ringing_force);
}

template <class S>
double unresolved_motion(const BasicSystem<S>& system, int j, const BasicLawPoint<S>& at, const BasicJointKinematics<S>& r, const typename S::Vec& last, double h, int n,
                         const BasicLoadScale<S>& scale) {
  return largest_unresolved(system, j, at, r, last, h, n, scale, [h, n](double m, double, double, double rate) { return m * std::abs(rate) / (h * n * (n + 1)); });
}

template double unresolved_ringing<Planar>(const BasicSystem<Planar>& system, int j, const BasicLawPoint<Planar>& at, const BasicJointKinematics<Planar>& r, const Planar::Vec& last, double h, int n, const BasicLoadScale<Planar>& scale);
PINTLE_IN_SPACE(template double unresolved_ringing<Spatial>(const BasicSystem<Spatial>& system, int j, const BasicLawPoint<Spatial>& at, const BasicJointKinematics<Spatial>& r, const Spatial::Vec& last, double h, int n, const BasicLoadScale<Spatial>& scale);)
template double unresolved_motion<Planar>(const BasicSystem<Planar>& system, int j, const BasicLawPoint<Planar>& at, const BasicJointKinematics<Planar>& r, const Planar::Vec& last, double h, int n, const BasicLoadScale<Planar>& scale);
PINTLE_IN_SPACE(template double unresolved_motion<Spatial>(const BasicSystem<Spatial>& system, int j, const BasicLawPoint<Spatial>& at, const BasicJointKinematics<Spatial>& r, const Spatial::Vec& last, double h, int n, const BasicLoadScale<Spatial>& scale);)

}  // namespace pintle
