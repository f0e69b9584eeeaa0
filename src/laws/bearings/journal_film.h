// A journal bearing with an oil film that is thin against its radius and cavitates (Reynolds equation, half film after Gümbel): short, after
// G. B. DuBois and F. W. Ocvirk (NACA Report 1157, 1953), or long, after Sommerfeld. Both for any motion, by the one velocity that squeezes the
// film (J. F. Booker, Dynamically loaded journal bearings: mobility method of solution, J. Basic Engineering 87 (1965) 537-546):
//
//   u = e' - (w/2) z x e,      h = c - e.n                                        theory/bearings Eqs. (3.1), (3.2)
//   F = -mu R L^3 int (u.n) n / h^3   over the half u.n > 0   (short)              Eq. (3.3)
//   M = -2 pi mu w R^3 L / sqrt(c^2 - e^2) - (e x F)/2                             Eq. (3.7)
//
// F and M act on the second body, e is its place and w its spin against the first: either may carry the pin. Where the film would be
// thinner than the roughness it stays as thick as that, and the surfaces touch: a spring takes over.
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
  bool long_film = false;          // no flow along the axis; else none around it

  static JournalFilmLaw typical() { return {}; }

  template <class T>
  void evaluate(const LawInput<T>& in, LawOutput<T>& out) const {
    using namespace law_math;
    const Film<T> film = film_at(in);
    const T touch = film.r - T(clearance - roughness), depth = where_positive(touch, touch, T(0.0));
    const T push = where_positive(touch, divide(contact_stiffness * depth, film.r), T(0.0));               // (3.8)
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
    value[2] = load > 0 ? viscosity * turns * 2 * radius * length / load * slender * slender : 0;          // (3.6)
    value[3] = film.loss;
  }

 private:
  template <class T>
  struct Film {
    T r, force[2], moment, loss;
  };

  // What the film of a given eccentricity, squeezed at u, has in common.
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
    film.moment = -drag - 0.5 * (at.e[0] * film.force[1] - at.e[1] * film.force[0]);                       // (3.7)
    film.loss = drag * w - (film.force[0] * at.u[0] + film.force[1] * at.u[1]);                            // (3.9)
    return film;
  }

  // Where nothing squeezes, the tangent is the mean of those on all sides: half that of a film that does not cavitate.
  template <class T>
  void half_film(const Squeeze<T>& at, T (&force)[2]) const {
    using namespace law_math;
    const T along[2] = {where_positive(at.speed, divide(at.u[0], at.speed), T(1.0)), where_positive(at.speed, divide(at.u[1], at.speed), T(0.0))};
    T squeezed[2], whole[2];
    (long_film ? long_film_resistance(at, along, squeezed) : short_film_resistance(at, along, squeezed));
    whole_film(at, whole);
    force[0] = where_positive(at.speed, -(at.speed * (squeezed[0] * along[0] - squeezed[1] * along[1])), -0.5 * whole[0]);
    force[1] = where_positive(at.speed, -(at.speed * (squeezed[0] * along[1] + squeezed[1] * along[0])), -0.5 * whole[1]);
  }

  // Integrals of cos^a sin^b / h^3 over the half circle about `along`, theory/bearings Eq. (3.4).
  template <class T>
  struct Integrals {
    T one, c, s, cc, sc, ss;
  };

  template <class T>
  void short_film_resistance(const Squeeze<T>& at, const T (&along)[2], T (&resisted)[2]) const {
    const Integrals<T> I = integrals(at, along);
    const double size = viscosity * radius * length * length * length;
    resisted[0] = size * I.cc;                                                                             // (3.3)
    resisted[1] = size * I.sc;
  }
  template <class T>
  void long_film_resistance(const Squeeze<T>& at, const T (&along)[2], T (&resisted)[2]) const {
    const Integrals<T> I = integrals(at, along);
    const double size = 12 * viscosity * radius * radius * radius * length;
    resisted[0] = size * (I.ss - law_math::divide(I.s * I.s, I.one));                                      // (3.5)
    resisted[1] = size * (law_math::divide(I.s * I.c, I.one) - I.sc);
  }
  // A film that does not cavitate, against u.
  template <class T>
  void whole_film(const Squeeze<T>& at, T (&resisted)[2]) const {
    using namespace law_math;
    const T D3 = at.D * at.D * at.D, eu = at.e[0] * at.u[0] + at.e[1] * at.u[1];
    const T e2 = at.e[0] * at.e[0] + at.e[1] * at.e[1];
    const T around = T(2 * clearance * clearance) + e2;
    const double size = std::numbers::pi * viscosity * radius * length * (long_film ? 12 * radius * radius : length * length);
    const T straight = long_film ? divide(T(2.0), at.D * around) : divide(T(1.0), D3);
    const T towards = long_film ? divide(T(3.0), D3 * around) : divide(T(3.0), D3 * at.D * at.D);
    for (int k = 0; k < 2; ++k) resisted[k] = size * (straight * at.u[k] + (towards * eu) * at.e[k]);       // (3.10)
  }

  // By t = tan(psi/2), with which h (1 + t^2) = Q = A t^2 - 2 B t + C: N_k of t^k / Q^3 from -1 to 1. theory/bearings Eq. (3.11)
  template <class T>
  Integrals<T> integrals(const Squeeze<T>& at, const T (&along)[2]) const {
    using namespace law_math;
    const T forward = at.e[0] * along[0] + at.e[1] * along[1], B = at.e[1] * along[0] - at.e[0] * along[1];
    T towards[5], away[5], N[5];
    moments(at.D, forward, B, towards);
    moments_away(at.D, -forward, B, away);
    for (int k = 0; k < 5; ++k) N[k] = where_positive(-forward - at.D, away[k], towards[k]);
    return {2 * (N[0] + 2 * N[2] + N[4]), 2 * (N[0] - N[4]), 4 * (N[1] + N[3]), 2 * (N[0] - 2 * N[2] + N[4]), 4 * (N[1] - N[3]), 8 * N[2]};
  }
  // Reduced to the integrals I_k of t^k / Q^2 and J of 1/Q.
  template <class T>
  void moments(const T& D, const T& forward, const T& B, T (&N)[5]) const {
    using namespace law_math;
    const T c(clearance), A = c + forward, C = c - forward, J = divide(atan2(D, -forward), D), W = D * D + forward * forward;
    const T p = divide(c + B, 2 * W), m = divide(c - B, 2 * W), p2 = p * p, m2 = m * m;  // 1/Q at t = 1 and -1
    const T half = divide(T(0.5), D * D), quarter = 0.5 * half;
    const T I0 = half * ((A - B) * p + (A + B) * m + A * J);
    const T I1 = half * ((B - C) * p + (B + C) * m + B * J);
    const T I2 = half * ((B - C) * p - (B + C) * m + C * J);
    N[0] = quarter * ((A - B) * p2 + (A + B) * m2 + 3 * (A * I0));
    N[1] = quarter * ((B - C) * p2 + (B + C) * m2 + 3 * (B * I0));
    N[2] = quarter * ((B - C) * p2 - (B + C) * m2 + 2 * (B * I1) + C * I0);
    N[3] = quarter * ((A - B) * p2 - (A + B) * m2 + 3 * (B * I2));
    N[4] = quarter * ((B - C) * p2 - (B + C) * m2 + 3 * (C * I2));
  }
  // The same where the pin moves out of its eccentricity, E = -forward > 0: what cancels for small D is taken out. Eq. (3.12)
  template <class T>
  void moments_away(const T& D, const T& E, const T& B, T (&N)[5]) const {
    using namespace law_math;
    const T one(1.0), D2 = D * D, E2 = E * E, E3 = E2 * E, C = T(clearance) + E, B2 = B * B, A = divide(D2 + B2, C), W = D2 + E2;
    const T inverse = divide(one, W * W), tilted = divide((W + E2) * inverse, E3);
    const T bent = divide(through(divide(D2, E2), arc_rest, arc_rest_slope), E3 * E2);
    N[0] = 0.25 * (E * inverse + A * (2 * inverse + A * (tilted + 1.5 * bent)));
    N[1] = 0.25 * (B * (inverse + A * (tilted + 1.5 * bent)));
    N[2] = 0.25 * (B2 * tilted + divide(one, 3 * E3) + bent * (1.5 * B2 + 0.5 * D2));
    N[3] = 0.25 * (B * (C * (tilted + 1.5 * bent) - inverse));
    N[4] = 0.25 * (C * (A * tilted + 1.5 * (C * bent) + divide(T(2.0), E2 * W)) + E * inverse);
  }
  // (atan(x)/x - 1/(1 + z) - 2 z/3) / z^2 of z = x^2, and its derivative; by the power series where that would cancel.
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
