// The separating force of teeth: apart from carrying load they push each other apart, because of their pressure angle alpha.
//
//   f_1 = |f_0| tan alpha                                                                  theory/joints Eq. (2.19)
//
// f_0 is the force of the laws before this one, along the pitch circles; component 1 is the opening of the mesh, theory/joints Eq. (2.20). Where f_0 changes sign the
// teeth change flanks, and f_1 has a kink. Steps end there, because f_1 acts between pins that carry it and accelerates next to nothing.
#pragma once

#include <array>
#include <cmath>
#include <span>
#include <string_view>

#include "laws/law_math.h"
#include "laws/law_part.h"

namespace pintle {

struct SeparatingForce {
  static constexpr std::string_view kWord = "separating-force";
  static constexpr bool kHolds = false, kRubs = false, kOnReactionAlone = true;
  double pressure_angle = 0.35;  // [rad]

  static SeparatingForce typical() { return {}; }

  template <class T>
  void evaluate(const LawInput<T>& in, LawOutput<T>& out) const { out.force[1] = std::tan(pressure_angle) * law_math::abs(in.before[0]); }

  int n_borders() const { return 1; }
  void borders(const LawInput<double>& in, double* value) const { value[0] = in.before[0]; }
  std::string_view border_name(int, bool) const { return "other flank"; }

  std::span<const LawColumn> columns() const {
    static const std::array<LawColumn, 2> all{{{"radial_force", "N", "with which the teeth push both apart, by their pressure angle"}, {"normal_force", "N", "on the flank of a tooth"}}};
    return all;
  }
  void observe(const LawInput<double>&, const Planar::Vec& force, double* value) const {
    const double tangential = std::abs(force[0]);
    value[0] = tangential * std::tan(pressure_angle);
    value[1] = tangential / std::cos(pressure_angle);
  }
};

}  // namespace pintle
