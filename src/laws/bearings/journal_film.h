// A journal bearing with an oil film that is thin compared with its radius and cavitates (Reynolds equation, half film after Gümbel): short,
// after G. B. DuBois and F. W. Ocvirk (NACA Report 1157, 1953), long, after Sommerfeld, or of finite length, between the two, after P. C. Warner
// (J. Basic Engineering 85 (1963) 247-255). All are valid for any motion, through the one velocity that squeezes the film (J. F. Booker,
// Dynamically loaded journal bearings: mobility method of solution, J. Basic Engineering 87 (1965) 537-546):
//
//   u = e' - (w/2) z x e,      h = c - e.n                                        theory/bearings Eqs. (3.1), (3.2)
//   F = -mu R L^3 int (u.n) n / h^3   over the half u.n > 0   (short)              Eq. (3.3)
//   F_i = F_i,long G(3 F_i,short / F_i,long),  G(x) = 1 - tanh(sqrt x)/sqrt x   (finite)   Eq. (3.6)
//   M = -2 pi mu w R^3 L / sqrt(c^2 - e^2) - (e x F)/2                             Eq. (3.9)
//
// F and M act on the second body; e is its position and w its spin relative to the first. Either body may carry the pin. Where the
// film would be thinner than the roughness, its thickness stays at the roughness, and the surfaces touch: a spring takes over.
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <string_view>

#include "laws/law_math.h"
#include "laws/law_part.h"

namespace pintle {

struct JournalFilmLaw {
  static constexpr std::string_view kWord = "journal-bearing";
  double radius = 0.025;           // R [m]
  double length = 0.025;           // L, along the axis [m]
  double clearance = 50e-6;        // c, radial [m]
  double viscosity = 0.03;         // mu, dynamic [Pa*s]
  double roughness = 1e-6;         // 0 < roughness < clearance: the thinnest film [m]
  double contact_stiffness = 1e9;  // of the surfaces where they touch [N/m]
  enum class Flow { kAxial, kAround, kBoth };
  Flow flow = Flow::kAxial;        // of the oil: along the axis (short), around the pin (long), or both

  static JournalFilmLaw typical() { return {}; }

  template <class T>
  void evaluate(const LawInput<T>& in, LawOutput<T>& out) const {
    using namespace law_math;
    const Film<T> film = film_at(in);
    const T touch = film.r - T(clearance - roughness), depth = where_positive(touch, touch, T(0.0));
    const T push = where_positive(touch, divide(contact_stiffness * depth, film.r), T(0.0));               // (3.10)
    for (int k = 0; k < 2; ++k) out.force[k] = film.force[k] - push * in.gap[k];
    out.force[2] = film.moment;
    out.energy = 0.5 * contact_stiffness * (depth * depth);
    out.loss = film.loss;
  }

  int n_borders() const { return 1; }
  /// Positive where the surfaces touch.
  void borders(const LawInput<double>& in, double* value) const { value[0] = std::hypot(in.gap[0], in.gap[1]) - (clearance - roughness); }
  Planar::Vec engaged_stiffness() const { return {contact_stiffness, contact_stiffness, 0}; }
  double lever() const { return radius; }

  std::span<const LawColumn> columns() const {
    static const std::array<LawColumn, 4> film{{{"eccentricity", "-", "distance of pin and bush over the radial clearance; 1 and more: rough surfaces touch"},
                                                {"film_thickness", "m", "least thickness of the film, as smooth surfaces would leave it"},
                                                {"sommerfeld", "-", "Sommerfeld number, viscosity N D L / W (R/c)^2 with N in turns per second; 0 where there is no load"},
                                                {"film_power", "W", "power that the film turns into heat"}}};
    return film;
  }
  void observe(const LawInput<double>& in, const Planar::Vec& force, double* value) const {
    const Film<double> film = film_at(in);
    const double turns = std::abs(in.rate[2]) / (2 * std::numbers::pi), load = std::hypot(force[0], force[1]), slender = radius / clearance;
    value[0] = film.r / clearance;
    value[1] = clearance - film.r;
    value[2] = load > 0 ? viscosity * turns * 2 * radius * length / load * slender * slender : 0;          // (3.8)
    value[3] = film.loss;
  }

 private:
  template <class T>
  struct Film {
    T r, force[2], moment, loss;
  };

  // Quantities common to all films with a given eccentricity, squeezed at u.
  template <class T>
  struct Squeeze {
    T e[2], u[2], speed, D;  // D^2 = c^2 - e^2
  };

  template <class T>
  Film<T> film_at(const LawInput<T>& in) const {
    using namespace law_math;
    Film<T> film;
    film.r = sqrt(in.gap[0] * in.gap[0] + in.gap[1] * in.gap[1]);
    const double most = clearance - roughness;
    const T beyond = film.r - T(most), scale = where_positive(beyond, divide(T(most), film.r), T(1.0)), w = in.rate[2];
    const T e = where_positive(beyond, T(most), film.r);
    Squeeze<T> at;
    for (int k = 0; k < 2; ++k) at.e[k] = scale * in.gap[k];
    at.u[0] = in.rate[0] + 0.5 * (w * at.e[1]);                                                            // (3.1)
    at.u[1] = in.rate[1] - 0.5 * (w * at.e[0]);
    at.speed = sqrt(at.u[0] * at.u[0] + at.u[1] * at.u[1]);
    at.D = sqrt((T(clearance) - e) * (T(clearance) + e));
    half_film(at, film.force);
    const T drag = (2 * std::numbers::pi * viscosity * radius * radius * radius * length) * divide(w, at.D);
    film.moment = -drag - 0.5 * (at.e[0] * film.force[1] - at.e[1] * film.force[0]);                       // (3.9)
    film.loss = drag * w - (film.force[0] * at.u[0] + film.force[1] * at.u[1]);                            // (3.11)
    return film;
  }

  // Without a squeeze velocity, the tangent is the mean over all directions: half that of a film without cavitation.
  template <class T>
  void half_film(const Squeeze<T>& at, T (&force)[2]) const {
    using namespace law_math;
    const T along[2] = {where_positive(at.speed, divide(at.u[0], at.speed), T(1.0)), where_positive(at.speed, divide(at.u[1], at.speed), T(0.0))};
    T squeezed[2], whole[2];
    half_film_resistance(integrals(at, along), squeezed);
    whole_film(at, whole);
    force[0] = where_positive(at.speed, -(at.speed * (squeezed[0] * along[0] - squeezed[1] * along[1])), -0.5 * whole[0]);
    force[1] = where_positive(at.speed, -(at.speed * (squeezed[0] * along[1] + squeezed[1] * along[0])), -0.5 * whole[1]);
  }

  double short_size() const { return viscosity * radius * length * length * length; }
  double long_size() const { return 12 * viscosity * radius * radius * radius * length; }

  // Integrals of cos^a sin^b / h^3 over the half circle about `along`, theory/bearings Eq. (3.4). Those with an odd power of the sine are divided
  // by B, the part of the eccentricity across `along`, with which they vanish.
  template <class T>
  struct Integrals {
    T one, c, s, cc, sc, ss;
    T B;
  };

  // Combines the values of the short and the long film according to the flow.
  template <class T>
  T of_flow(const T& in_short, const T& in_long) const { return flow == Flow::kAxial ? in_short : flow == Flow::kAround ? in_long : between(in_short, in_long); }

  // Resistance of a film with cavitation, along and across the velocity, per unit speed.
  template <class T>
  void half_film_resistance(const Integrals<T>& I, T (&resisted)[2]) const {
    using namespace law_math;
    const T shorts[2] = {short_size() * I.cc, short_size() * I.sc};                                        // (3.3), over B across
    const T along = I.ss - divide(I.B * I.B * (I.s * I.s), I.one), across = divide(I.s * I.c, I.one) - I.sc;
    const T longs[2] = {long_size() * along, long_size() * across};                                        // (3.5), likewise
    for (int k = 0; k < 2; ++k) resisted[k] = of_flow(shorts[k], longs[k]);
    resisted[1] = resisted[1] * I.B;
  }
  // Resistance of a film without cavitation, against u.
  template <class T>
  void whole_film(const Squeeze<T>& at, T (&resisted)[2]) const {
    using namespace law_math;
    const T D2 = at.D * at.D, D3 = D2 * at.D, eu = at.e[0] * at.u[0] + at.e[1] * at.u[1], e2 = at.e[0] * at.e[0] + at.e[1] * at.e[1];
    const double thin = std::numbers::pi * short_size(), thick = std::numbers::pi * long_size();
    const T across_short = divide(T(thin), D3), across_long = divide(T(2 * thick), at.D * (T(2 * clearance * clearance) + e2));   // (3.12)
    const T along_short = across_short + divide(3 * (thin * e2), D3 * D2), along_long = divide(T(thick), D3);
    const T across = of_flow(across_short, across_long), more = of_flow(along_short, along_long) - across, off = e2 - T(kCentred * clearance * clearance);
    const T towards = where_positive(off, divide(more, e2), T(0.0));
    for (int k = 0; k < 2; ++k) resisted[k] = across * at.u[k] + (towards * eu) * at.e[k];
  }
  static constexpr double kCentred = 1e-24;  // as a fraction of the clearance squared: below it the pin has no direction, and the resistance is the same in all

  // Interpolates between the force of a short film and that of a long one.
  template <class T>
  static T between(const T& shorter, const T& longer) {
    return longer * law_math::through(3 * law_math::divide(shorter, longer), leakage, leakage_slope);      // (3.6)
  }
  // G(x) = 1 - tanh(k)/k for x = k^2 > 0, and its derivative; for small x by Lambert's continued fraction of tanh, which is free of cancellation.
  static double leakage(double x) {
    if (x > 1) return 1 - std::tanh(std::sqrt(x)) / std::sqrt(x);
    double rest = 0;
    for (int odd = 19; odd > 1; odd -= 2) rest = x / (odd + rest);
    return rest / (1 + rest);
  }
  static double leakage_slope(double x) {
    const double G = leakage(x);
    return (x * (1 - G) * (1 - G) - G) / (2 * x);
  }

  // By the substitution t = tan(psi/2), h (1 + t^2) = Q = A t^2 - 2 B t + C: N_k is the integral of t^k / Q^3 from -1 to 1. theory/bearings Eq. (3.13)
  template <class T>
  Integrals<T> integrals(const Squeeze<T>& at, const T (&along)[2]) const {
    using namespace law_math;
    const T forward = at.e[0] * along[0] + at.e[1] * along[1], B = at.e[1] * along[0] - at.e[0] * along[1];
    T towards[5], away[5], N[5];
    moments(at.D, forward, B, towards);
    moments_away(at.D, -forward, B, away);
    for (int k = 0; k < 5; ++k) N[k] = where_positive(-forward - at.D, away[k], towards[k]);
    return {2 * (N[0] + 2 * N[2] + N[4]), 2 * (N[0] - N[4]), 4 * (N[1] + N[3]), 2 * (N[0] - 2 * N[2] + N[4]), 4 * (N[1] - N[3]), 8 * N[2], B};
  }
  // Reduced to the integrals I_k of t^k / Q^2 and J of 1/Q. N_1, N_3 and I_1 are divided by B.
  template <class T>
  void moments(const T& D, const T& forward, const T& B, T (&N)[5]) const {
    using namespace law_math;
    const T c(clearance), A = c + forward, C = c - forward, J = divide(atan2(D, -forward), D), W = D * D + forward * forward;
    const T each = divide(T(1.0), W), ends = clearance * (forward * each), B2 = B * B;
    const T half = divide(T(0.5), D * D), quarter = 0.5 * half;
    const T I0 = half * (T(1.0) + ends + A * J), I1 = half * (forward * each + J), I2 = half * (ends - T(1.0) + C * J);
    N[0] = quarter * (each * (clearance * ends + 0.5 * C) + 3 * (A * I0));
    N[1] = quarter * (each * (ends - T(0.5)) + 3 * I0);
    N[2] = quarter * (each * (clearance * ends - 0.5 * A) + 2 * (B2 * I1) + C * I0);
    N[3] = quarter * (each * (ends + T(0.5)) + 3 * I2);
    N[4] = quarter * (each * (clearance * ends - 0.5 * A) + 3 * (C * I2));
  }
  // The same where the pin moves away from its eccentricity, E = -forward > 0: the terms that cancel for small D are removed. Eq. (3.14)
  template <class T>
  void moments_away(const T& D, const T& E, const T& B, T (&N)[5]) const {
    using namespace law_math;
    const T one(1.0), D2 = D * D, E2 = E * E, E3 = E2 * E, C = T(clearance) + E, B2 = B * B, A = divide(D2 + B2, C), W = D2 + E2;
    const T inverse = divide(one, W * W), tilted = divide((W + E2) * inverse, E3);
    const T bent = divide(through(divide(D2, E2), arc_rest, arc_rest_slope), E3 * E2);
    N[0] = 0.25 * (E * inverse + A * (2 * inverse + A * (tilted + 1.5 * bent)));
    N[1] = 0.25 * (inverse + A * (tilted + 1.5 * bent));
    N[2] = 0.25 * (B2 * tilted + divide(one, 3 * E3) + bent * (1.5 * B2 + 0.5 * D2));
    N[3] = 0.25 * (C * (tilted + 1.5 * bent) - inverse);
    N[4] = 0.25 * (C * (A * tilted + 1.5 * (C * bent) + divide(T(2.0), E2 * W)) + E * inverse);
  }
  // (atan(x)/x - 1/(1 + z) - 2 z/3) / z^2 for z = x^2, and its derivative; by the power series where this would cancel.
  static double arc_rest(double z) {
    if (z >= 0.25) return (std::atan(std::sqrt(z)) / std::sqrt(z) - 1 / (1 + z) - 2 * z / 3) / (z * z);
    double sum = 0, power = -1;
    for (int k = 0; k < 28; ++k, power *= -z) sum += power * (2 * k + 4) / (2 * k + 5);
    return sum;
  }
  static double arc_rest_slope(double z) {
    if (z >= 0.25) {
      const double q = 1 / (1 + z), arc = std::atan(std::sqrt(z)) / std::sqrt(z);
      return ((0.5 * (q - arc) / z + q * q - 2.0 / 3) / z - 2 * arc_rest(z)) / z;
    }
    double sum = 0, power = 1;
    for (int k = 1; k < 28; ++k, power *= -z) sum += power * k * (2 * k + 4) / (2 * k + 5);
    return sum;
  }
};

}  // namespace pintle
