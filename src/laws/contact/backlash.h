// A mesh with play between its flanks: two stops for the slip of its pitch circles.
//
//   front flank: d = g - j/2,  f = -N        rear flank: d = -g - j/2,  f = +N        theory/contact Eqs. (7.1), (6.2)
//
// g is the gap of the mesh, theory/joints Eqs. (2.12), (2.13), and j the circumferential play. Between the stops the teeth are apart.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <string_view>

#include "laws/contact/stops.h"

namespace pintle {

struct BacklashLaw : StopContact {
  static constexpr std::string_view kWord = "backlash";
  static constexpr bool kHolds = true, kStops = false, kStartsFree = true;

  BacklashLaw() { free = 0; }
  /// j [m].
  void set_play(double play) {
    upper = 0.5 * play;
    lower = -upper;
  }
  static BacklashLaw typical() {
    BacklashLaw law;
    law.contact.stiffness = 2e8;
    law.contact.exponent = 1;
    law.contact.hysteresis = hysteresis_of(ContactModel::kExact, 0.8);
    law.set_play(1e-3);
    return law;
  }

  static std::string border_name(int border, bool rising) { return called(border, rising, border / kBorders == kUpper ? "front flank" : "rear flank"); }
  Planar::Vec engaged_stiffness() const { return {contact.stiffness_at(0.1 * upper), 0, 0}; }
  double penetration(const Planar::Vec& gap) const { return std::abs(gap[0]) - upper; }
  std::span<const LawColumn> columns() const {
    static const std::array<LawColumn, 4> all{{{"tooth_force", "N", "force between the flanks, along the pitch circles"},
                                               {"flank", "", "1 while the front flank carries, -1 while the rear one does, 0 while the gears are apart"},
                                               {"play_left", "m", "play that is left to the nearer flank; negative: how far the flanks are pressed together"},
                                               {"approach_speed", "m/s", "speed at which the flanks met; 0 while apart"}}};
    return all;
  }
  void observe(const LawInput<double>& in, const Planar::Vec&, double* value) const {
    LawOutput<double> out;
    out.clear();
    evaluate(in, out);
    value[0] = std::abs(out.force[0]);
    value[1] = out.force[0] == 0 ? 0 : out.force[0] < 0 ? 1 : -1;
    value[2] = upper - std::abs(in.gap[0]);
    value[3] = approach_speed(in);
  }
};

}  // namespace pintle
