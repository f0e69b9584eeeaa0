// Coulomb friction made smooth at rest, with Stribeck's drop from static to kinetic: a function of the slip speed alone, without
// states. S. Andersson, A. Soderberg, S. Bjorklund, Friction models for sliding dry, boundary and mixed lubricated contacts, Tribology
// International 40 (2007) 580-587.
//
//   F = N (mu(v) tanh(v / v_t) + mu_v v),     mu(v) = mu_k + (mu_s - mu_k) exp(-(v / v_s)^2)     theory/joints Eqs. (3.16), (3.12)
//
// It carries no load at rest: under a load below N mu_s the joint creeps, at v_t artanh(load / (N mu_s)) or slower, by design.
#pragma once

#include "laws/friction/friction.h"

namespace pintle {

struct StribeckLaw : Friction {
  static constexpr std::string_view kWord = "stribeck";
  double stribeck = 1e-3;    // v_s [m/s]
  double transition = 1e-4;  // v_t [m/s]

  static StribeckLaw typical() { return {}; }

  template <class T>
  void evaluate(const LawInput<T>& in, LawOutput<T>& out) const {
    const T v = slip(in);
    rub(load(in) * (stribeck_coefficient(v, stribeck) * law_math::tanh((1 / transition) * v) + viscous * v), v, out);  // (3.16)
  }
};

}  // namespace pintle
