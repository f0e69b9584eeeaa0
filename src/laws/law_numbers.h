// Input and output of a force law, over any number type T: plain numbers, lanes (one number per stage, or per variant), and dual numbers,
// which give the tangents.
#pragma once

#include "base/dual.h"
#include "simd/lanes.h"

namespace pintle {

/// Limit on the states of all laws of one joint together.
inline constexpr int kMostLawStates = 12;

/// Everything that a joint knows. Gap and rate are the relative pose of M as seen from F and its rate, in F's axes: (x, y, angle) in the
/// plane, D components in a space of D degrees of freedom. Free components are included like held ones. A gap that is a function (rods,
/// gears) is component 0.
template <class T, int D = 3>
struct LawInput {
  T t;                       // [s]
  T gap[D], rate[D];         // [m, m, rad] and per second
  T before[D];               // force on the second body due to the laws before this one in the same joint [N, N, N*m]
  const T* state = nullptr;  // the law's own states
};

template <class T, int D = 3>
struct LawOutput {
  T force[D];                    // on the second body, conjugate to the gap, for held and free components [N, N, N*m]
  T state_rate[kMostLawStates];  // of the law's own states
  T energy, loss;                // stored energy [J]; lost power [W]

  /// Nothing acts; the rates of the first `states` states are zero.
  void clear(int states = kMostLawStates) {
    for (T& f : force) f = T(0.0);
    for (int z = 0; z < states; ++z) state_rate[z] = T(0.0);
    energy = loss = T(0.0);
  }
};

/// Derivatives by gap, rate and states: for laws with few states, and for all laws.
template <int D>
using FewDual = Dual<2 * D + 2>;
template <int D>
using ManyDual = Dual<2 * D + kMostLawStates>;

/// Calls use(T) for every number type for which the laws of a space S are compiled.
#define PINTLE_LAW_NUMBERS(use) use(double) use(FewDual<S::kDof>) use(ManyDual<S::kDof>) use(Lanes<3>) use(Lanes<5>) use(Lanes<8>)

}  // namespace pintle
