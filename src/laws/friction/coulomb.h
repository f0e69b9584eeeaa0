// Dry friction with stiction of what a joint leaves free. As everywhere here a stuck joint is no constraint but a direction held by a force law, which
// makes the forces of several of them unique.
#pragma once

#include <array>
#include <cmath>

#include "laws/friction/friction.h"
#include "laws/friction/stick_slip.h"

namespace pintle {

struct CoulombLaw : Friction {
  static constexpr std::string_view kWord = "coulomb";
  double stiffness = 1e8, damping = 3e3;  // of what holds while it sticks [N/m], [N*s/m]

  static CoulombLaw typical() { return {}; }

  int n_states() const { return StickSlip::kStates; }
  template <class T>
  void evaluate(const LawInput<T>& in, LawOutput<T>& out) const {
    const T v = slip(in);
    const StickSlipForce<T> f = surfaces().force(v, load(in), in.state);
    rub(f.friction, v, out);
    out.state_rate[0] = f.stretch_rate;
    out.energy = f.energy;
    out.loss = f.loss;
  }
  void rest(const LawInput<double>& in, double* state) const { StickSlip::rest(slip(in), state); }
  int sticking_component() const { return component_of_pin_or_slide(); }
  bool stick(const LawInput<double>& in, double force, double* state) const { return surfaces().stick(-force / radius, load(in), state); }

  int n_borders() const { return StickSlip::kBorders; }
  void borders(const LawInput<double>& in, double* value) const { surfaces().borders(slip(in), load(in), in.state, value); }
  std::array<int, 3> border_directions() const { return StickSlip::kDirections; }
  std::string_view border_name(int border, bool) const { return StickSlip::border_name(border); }
  void cross(int border, const LawInput<double>& in, double* state) const { surfaces().cross(border, slip(in), load(in), state); }

  std::span<const LawColumn> columns() const { return columns_with_mode(); }
  void observe(const LawInput<double>& in, const Planar::Vec& force, double* value) const {
    Friction::observe(in, force, value);
    value[2] = StickSlip::sticks(in.state) ? 1 : 0;
  }

 private:
  StickSlip surfaces() const { return {kinetic, stuck, viscous, stiffness, damping}; }
};

}  // namespace pintle
