// A hydraulic or pneumatic cylinder: the force of its pressures, along the line between its two points.
//
//   f = F(t, x, x'),   Q_c = A_c x',   Q_r = -A_r x',   P = F x'        theory/cylinders Eqs. (1.3), (2.1), (2.2)
//
// The gap, component 0, is the stroke x. The pressures do work P from outside; the joint stores no energy of theirs. The formula changes where
// the formulas of the pressures do.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "laws/chambers.h"
#include "laws/law_part.h"

namespace pintle {

struct PressureLaw {
  static constexpr std::string_view kWord = "pressure";
  static constexpr bool kHolds = false, kRubs = false;
  std::shared_ptr<const Chambers> chambers;

  static PressureLaw typical() {
    return {std::make_shared<const Chambers>(0.05, 0.03, 1e5, ChamberPressure(Expression::constant(2e6)), ChamberPressure(Expression::constant(3e5)))};
  }

  template <class T>
  void evaluate(const LawInput<T>& in, LawOutput<T>& out) const { out.force[0] = chambers->force(in); }
  double supply(const LawInput<double>& in) const { return chambers->force(in) * in.rate[0]; }  // (2.2)

  int n_borders() const { return chambers->cap().n_switches() + chambers->rod().n_switches(); }
  void borders(const LawInput<double>& in, double* value) const {
    chambers->cap().evaluate_switching_functions(in, value);
    chambers->rod().evaluate_switching_functions(in, value + chambers->cap().n_switches());
  }
  std::string border_name(int border, bool) const { return border < chambers->cap().n_switches() ? "kink or jump of cap_pressure" : "kink or jump of rod_pressure"; }

  std::span<const LawColumn> columns() const {
    static const std::array<LawColumn, 9> all{{{"stroke", "m", "how far the rod is out"},
                                               {"stroke_rate", "m/s", "rate of the stroke"},
                                               {"cap_pressure", "Pa", "pressure on the whole piston"},
                                               {"rod_pressure", "Pa", "pressure on the side of the rod"},
                                               {"cap_force", "N", "of the pressure on the whole piston, over that of the surroundings; it pushes the rod out"},
                                               {"rod_force", "N", "of the pressure on the side of the rod, over that of the surroundings; it pushes the rod in"},
                                               {"cap_flow", "m^3/s", "into the chamber of the whole piston"},
                                               {"rod_flow", "m^3/s", "into the chamber of the rod"},
                                               {"hydraulic_power", "W", "power that the pressures deliver"}}};
    return all;
  }
  void observe(const LawInput<double>& in, const Planar::Vec&, double* value) const {
    const double x_rate = in.rate[0];
    value[0] = in.gap[0];
    value[1] = x_rate;
    value[2] = chambers->cap().at(in);
    value[3] = chambers->rod().at(in);
    value[4] = chambers->cap_force(in);
    value[5] = chambers->rod_force(in);
    value[6] = chambers->cap_area() * x_rate;   // (2.1)
    value[7] = -chambers->rod_area() * x_rate;  // (2.1)
    value[8] = supply(in);
  }
};

}  // namespace pintle
