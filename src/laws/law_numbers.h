// What goes into a force law and what comes out of it, over any number type T: plain numbers, lanes (one number per stage, or per variant),
// and dual numbers, from which the tangents come.
#pragma once

#include "base/dual.h"
#include "simd/lanes.h"

namespace pintle {

/// States that the laws of one joint may have together.
inline constexpr int kMostLawStates = 12;

/// Everything that a joint knows. Gap and rate are the relative pose of M as seen from F and its rate, in F's axes: (x, y, angle). What
/// the joint leaves free stands there like what it holds. A gap that is a function (rods, gears) stands in component 0.
template <class T>
struct LawInput {
  T t;                       // [s]
  T gap[3], rate[3];         // [m, m, rad] and per second
  T before[3];               // force on the second body of the laws before this one in the same joint [N, N, N*m]
  const T* state = nullptr;  // the law's own
};

template <class T>
struct LawOutput {
  T force[3];                    // on the second body, conjugate to the gap, held and free components alike [N, N, N*m]
  T state_rate[kMostLawStates];  // of the law's own states
  T energy, loss;                // stored [J]; power that is lost [W]

  void clear() {
    for (T& f : force) f = T(0.0);
    for (T& z : state_rate) z = T(0.0);
    energy = loss = T(0.0);
  }
};

/// Derivatives by gap, rate and states: of laws with few states, and of all.
using FewDual = Dual<8>;
using ManyDual = Dual<6 + kMostLawStates>;

/// Calls use(T) for every number type that laws are compiled for.
#define PINTLE_LAW_NUMBERS(use) use(double) use(FewDual) use(ManyDual) use(Lanes<3>) use(Lanes<5>) use(Lanes<8>)

}  // namespace pintle
