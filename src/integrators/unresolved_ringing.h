// The part that a step after an event does not resolve of the vibrations that begin there. theory/time section 3.4.
#pragma once

#include "integrators/load_scale.h"
#include "system/system.h"

namespace pintle {

/// The largest deviation of the force of a joint of stiffness k, damping c and effective mass m from the one that its load requires, if its gap starts with the
/// right force and with an error `rate` of its rate [N or N*m]: for an undamped joint that of a vibration, sqrt(k m) times the rate. theory/time Eq. (3.24).
double ringing_force(double m, double c, double k, double rate);

/// The same for joint j over the load scale, with the effective mass of its own two bodies. at, r: of the last stage of a step of h with n stages; last: the last
/// Legendre coefficient of the gap's accelerations at its stages, which gives the error at the start of the curve through their rates. Only for components so fast that
/// Eq. (3.13) shows less; for others it would be rounding over a short step.
template <class S>
double unresolved_ringing(const BasicSystem<S>& system, int j, const BasicLawPoint<S>& at, const BasicJointKinematics<S>& r, const typename S::Vec& last, double h, int n,
                          const BasicLoadScale<S>& scale);

/// What the same curve misses of the motion: the integral of its error `rate` over the step, over the path that the scale of the motion, (3.15), allows for. theory/time Eq. (3.26).
template <class S>
double unresolved_motion(const BasicSystem<S>& system, int j, const BasicLawPoint<S>& at, const BasicJointKinematics<S>& r, const typename S::Vec& last, double h, int n,
                         const BasicLoadScale<S>& scale);

}  // namespace pintle
