// What the laws of friction in joints have in common: the slip speed, the normal load, and the reported columns.
//
//   v = r w (pins) or the rate of the slide (sliders, slots);      N = |reaction| + N_0                             theory/joints Eq. (3.14)
//   a slide with a guide:  N = |F/2 + M/L| + |F/2 - M/L| + N_0 = max(|F|, 2 |M|/L) + N_0           Eq. (3.15)
//
//   a cam, an edge:  v the slip of the surfaces, N = |F| + N_0, F the force between them          theory/cams section 3
//   teeth:           v = l w, w the turn of one gear relative to the other,  N = |F|/cos alpha + N_0   theory/joints section 2.5
//   seals of a cylinder:   N = N_0 + A_s (|p_c - p_0| + |p_r - p_0|)                               theory/cylinders Eq. (3.1)
//
// F is the force across a slide and M its moment about the second marker, the middle of the guide: they press its edges, both on the
// same side or one on either side. The reaction is that of the laws before this one in the same joint.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string_view>

#include "laws/chambers.h"
#include "laws/law_math.h"
#include "laws/law_part.h"

namespace pintle {

struct Friction {
  static constexpr bool kHolds = false;
  int free = 2;                      // component that slips: 2 of a pin, 1 of surfaces, 0 of a slider or slot
  double radius = 0.01;              // of the pin; l for teeth, the mean distance of their contact from the pitch point [m]; 1 for slides
  double normal = 0;                 // normal load per force across the gap, for surfaces and teeth, which have one gap; 0: other joints [-]
  double guide = 0;                  // length L of a slide's guide [m]; 0: the moment adds no load
  double preload = 0;                // N_0 [N]
  double kinetic = 0.1, static_coefficient = 0.15;  // coefficients [-]
  double viscous = 0;                // friction per unit slip speed and load [s/m]
  double seal_area = 0;              // A_s, area on which pressure presses the seals of a cylinder [m^2]
  std::shared_ptr<const Chambers> chambers{};  // chambers of that cylinder

  template <class T>
  T slip(const LawInput<T>& in) const { return radius * in.rate[free]; }

  /// N.
  template <class T>
  T load(const LawInput<T>& in) const {
    using namespace law_math;
    const T* f = in.before;
    if (chambers) return T(preload) + seal_area * chambers->on_seals(in);                                     // cylinders (3.1)
    if (normal > 0) return T(preload) + normal * abs(f[0]);
    if (free == 2) return T(preload) + sqrt(f[0] * f[0] + f[1] * f[1]);                                       // (3.14)
    if (!(guide > 0)) return T(preload) + abs(f[1]);
    const T half = 0.5 * f[1], edge = (1 / guide) * f[2];
    return T(preload) + abs(half + edge) + abs(half - edge);                                                  // (3.15)
  }

  /// Sets `out` to a friction F that opposes the slip.
  template <class T>
  void rub(const T& friction, const T& slip, LawOutput<T>& out) const {
    out.force[free] = -radius * friction;
    out.loss = friction * slip;
  }

  double lever() const { return free == 2 ? radius : 0; }
  std::span<const LawColumn> columns() const {
    static const std::array<LawColumn, 2> pin{{{"friction", "N*m", "moment of friction on the second body"}, {"friction_power", "W", "power that friction turns into heat"}}};
    static const std::array<LawColumn, 2> slide{{{"friction", "N", "force of friction on the second body, along what slides"}, {"friction_power", "W", "power that friction turns into heat"}}};
    return free == 2 ? pin : slide;
  }
  /// In the free direction no other force acts.
  void observe(const LawInput<double>& in, const Planar::Vec& force, double* value) const {
    value[0] = force[free];
    value[1] = -force[free] * in.rate[free];
  }

 protected:
  /// The columns of `columns`, plus whether the joint sticks.
  std::span<const LawColumn> columns_with_mode() const {
    static const auto with_mode = [](const Friction& friction) {
      const auto all = friction.columns();
      return std::array<LawColumn, 3>{all[0], all[1], {"stuck", "", "1 while the joint sticks, 0 while it slips"}};
    };
    static const std::array<LawColumn, 3> pin = with_mode(Friction{}), slide = with_mode(Friction{.free = 0});
    return free == 2 ? pin : slide;
  }
  /// Coefficient of steady slip, falling from the static to the kinetic one with the square of the speed over the Stribeck speed. Eq. (3.12)
  template <class T>
  T stribeck_coefficient(const T& v, double stribeck) const {
    const T relative = (1 / stribeck) * v;
    return T(kinetic) + (static_coefficient - kinetic) * law_math::exp(-(relative * relative));
  }
};

}  // namespace pintle
