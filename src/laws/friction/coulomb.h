// Dry friction with stiction in the free directions of a joint. As everywhere here, a stuck joint is not a constraint but a direction held by a force
// law, which makes the forces of several stuck joints unique.
#pragma once

#include <array>
#include <cmath>

#include "laws/friction/friction.h"
#include "laws/friction/stick_slip.h"

namespace pintle {

struct CoulombLaw : Friction {
  static constexpr std::string_view kWord = "coulomb";
  double stiffness = 1e8, damping = 3e3;  // of the spring and damper that hold while it sticks [N/m], [N*s/m]
  int starts_to_slip = 0;                 // direction in which it slips from the start; 0: at rest it sticks

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
  void rest(const LawInput<double>& in, double* state) const { surfaces().rest(slip(in), starts_to_slip, state); }
  /// For pins and slides: bodies that roll on each other are not held by stiction between them.
  std::optional<Stiction> stiction(const double* state) const {
    if (normal > 0 || !StickSlip::sticks(state)) return {};
    return Stiction{free, radius * radius * stiffness};
  }
  bool set_stuck(const LawInput<double>& in, double force, double* state) const { return surfaces().set_stuck(-force / radius, load(in), state); }
  void start_slipping(double force) { starts_to_slip = force < 0 ? 1 : -1; }

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
  StickSlip surfaces() const { return {kinetic, static_coefficient, viscous, stiffness, damping}; }
};

}  // namespace pintle
