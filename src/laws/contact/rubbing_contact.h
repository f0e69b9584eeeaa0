// Two surfaces at one point: the normal force of their contact, and friction along it, with a ramp or with stiction.
//
// States: the approach speed while they touch, 0 while they are apart; with stiction also those of StickSlip, which are reset at every touch, and where a
// vanished force returns. Touch and let-go are borders; with stiction, stick and slip too. theory/contact sections 1 and 3.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include "laws/contact/contact.h"
#include "laws/friction/stick_slip.h"

namespace pintle {

struct RubbingContact {
  ContactForce contact;
  RampedFriction friction;
  std::optional<StickSlip> grip{};  // friction with stiction, instead of the ramp

  bool rubs() const { return friction.coefficient > 0 || grip; }
  int n_states() const { return grip ? 1 + StickSlip::kStates : 1; }
  template <class T>
  PointForces<T> forces(const ContactMotion<T>& at, const T* state, T* state_rate) const {
    using namespace law_math;
    PointForces<T> f = point_forces<T>(contact, at, state[0]);
    if (grip) {
      const StickSlipForce<T> along = grip->force(at.slip, pressing(f.normal), state + 1);
      const T none(0.0);
      f.friction = where_positive(state[0], -along.friction, none);
      f.energy += where_positive(state[0], along.energy, none);
      f.loss += where_positive(state[0], along.loss, none);
      state_rate[1] = where_positive(state[0], along.stretch_rate, none);
    } else {
      f.friction = friction.force(pressing(f.normal), at.slip);
      f.loss -= f.friction * at.slip;
    }
    return f;
  }
  PointForces<double> forces(const ContactMotion<double>& at, const double* state) const {
    double state_rate[1 + StickSlip::kStates];
    return forces<double>(at, state, state_rate);
  }
  /// Surfaces that start in contact have no approach speed: the floor is used.
  void rest(const ContactMotion<double>& at, double* state) const {
    state[0] = at.depth > 0 ? contact.least_approach : 0;
    if (grip) grip->rest(at.slip, 0, state + 1);
  }

  int n_borders() const { return grip ? ContactForce::kBorders + StickSlip::kBorders : ContactForce::kBorders; }
  int border_direction(int border) const { return border < ContactForce::kBorders ? ContactForce::kDirections[border] : StickSlip::kDirections[border - ContactForce::kBorders]; }
  void borders(const ContactMotion<double>& at, const double* state, double* value) const {
    contact.borders(at.depth, at.rate, state[0], value);
    if (!grip) return;
    value += ContactForce::kBorders;
    if (state[0] > 0) grip->borders(at.slip, pressing(point_forces<double>(contact, at, state[0]).normal), state + 1, value);
    else value[0] = value[1] = value[2] = 1;
  }
  static constexpr std::string_view border_name(int border, bool rising) {
    return border < ContactForce::kBorders ? ContactForce::border_name(border, rising) : StickSlip::border_name(border - ContactForce::kBorders);
  }
  void cross(int border, const ContactMotion<double>& at, double* state) const {
    if (border >= ContactForce::kBorders) return grip->cross(border - ContactForce::kBorders, at.slip, pressing(point_forces<double>(contact, at, state[0]).normal), state + 1);
    contact.cross(border, at.rate, state[0]);
    if (grip && border != ContactForce::kLetGo) grip->rest(at.slip, 0, state + 1);
  }
  /// The power that Archard's law multiplies: surfaces that stick move only by their springs.
  double wear_power(double normal, double slip, const double* state) const { return sticks(state) ? 0 : std::max(0.0, normal) * std::abs(slip); }
  bool sticks(const double* state) const { return grip && state[0] > 0 && StickSlip::sticks(state + 1); }

 private:
  // An attractive normal force causes no friction.
  template <class T>
  static T pressing(const T& normal) { return law_math::where_positive(normal, normal, T(0.0)); }
};

}  // namespace pintle
