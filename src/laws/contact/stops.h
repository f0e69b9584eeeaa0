// Stops for the free coordinate of a joint: its angle or slide z may lie between a lower and an upper stop.
//
//   upper: d = z - z_u,  f = -N        lower: d = z_l - z,  f = +N        theory/contact Eqs. (6.1), (6.2)
//
// N(d, d') is the force of a contact, a moment if z is an angle. Each stop has a state of its own, the approach speed while it is touched and 0
// otherwise; touch and let-go are borders. A stop that is not stated is at infinity.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "laws/contact/contact.h"
#include "laws/law_part.h"

namespace pintle {

struct StopContact {
  static constexpr bool kHolds = false, kStops = true;
  static constexpr double kNowhere = std::numeric_limits<double>::infinity();
  ContactForce contact;
  int free = 2;  // component that the stops limit
  double lower = -kNowhere, upper = kNowhere;  // [rad] or [m]

  int n_states() const { return kSides; }
  template <class T>
  void evaluate(const LawInput<T>& in, LawOutput<T>& out) const {
    for (int side = 0; side < kSides; ++side) {
      if (!stands(side)) continue;
      const PointForces<T> f = point_forces<T>(contact, find(in, side), in.state[side]);
      out.force[free] -= sign(side) * f.normal;                                                                  // (6.2)
      out.energy += f.energy;
      out.loss += f.loss;
    }
  }
  /// A coordinate that starts beyond a stop has no approach speed: the floor is used.
  void rest(const LawInput<double>& in, double* state) const {
    for (int side = 0; side < kSides; ++side) state[side] = stands(side) && find(in, side).depth > 0 ? contact.least_approach : 0;
  }

  int n_borders() const { return kBorders * kSides; }
  static constexpr auto kDirections = [] {
    std::array<int, 2 * ContactForce::kBorders> of_both{};
    for (std::size_t i = 0; i < of_both.size(); ++i) of_both[i] = ContactForce::kDirections[i % ContactForce::kBorders];
    return of_both;
  }();
  std::span<const int> border_directions() const { return kDirections; }
  void borders(const LawInput<double>& in, double* value) const {
    for (int side = 0; side < kSides; ++side, value += kBorders) {
      value[0] = -1;
      value[1] = value[2] = 1;
      if (!stands(side)) continue;
      const ContactMotion<double> at = find(in, side);
      contact.borders(at.depth, at.rate, in.state[side], value);
    }
  }
  static std::string border_name(int border, bool rising) { return called(border, rising, border / kBorders == kUpper ? "upper stop" : "lower stop"); }
  void cross(int border, const LawInput<double>& in, double* state) const {
    const int side = border / kBorders;
    contact.cross(border % kBorders, find(in, side).rate, state[side]);
  }

  Planar::Vec closed_stiffness() const { return contact.stiffness_at(ContactForce::kUsualDepth) * Planar::Vec::Unit(free); }
  std::optional<StopBreach> breach(const Planar::Vec& gap) const {
    for (int side = 0; side < kSides; ++side) {
      const double depth = sign(side) * (gap[free] - limit(side));
      if (depth > 0) return StopBreach{side == kUpper, free, limit(side), depth};
    }
    return {};
  }
  std::span<const LawColumn> columns() const {
    static const std::array<LawColumn, 3> turn{{{"stop_moment", "N*m", "moment of the stops on the second body"},
                                                {"stop_depth", "rad", "how far the angle is beyond a stop; negative: to the nearer one"},
                                                {"stop_approach_speed", "rad/s", "rate at which the stop was touched; 0 while apart"}}};
    static const std::array<LawColumn, 3> slide{{{"stop_force", "N", "force of the stops on the second body, along the slide or the stroke"},
                                                 {"stop_depth", "m", "how far the slide or the stroke is beyond a stop; negative: to the nearer one"},
                                                 {"stop_approach_speed", "m/s", "speed at which the stop was touched; 0 while apart"}}};
    return free == 2 ? turn : slide;
  }
  void observe(const LawInput<double>& in, const Planar::Vec&, double* value) const {
    LawOutput<double> out;
    out.clear();
    evaluate(in, out);
    value[0] = out.force[free];
    value[1] = -kNowhere;
    for (int side = 0; side < kSides; ++side)
      if (stands(side)) value[1] = std::max(value[1], find(in, side).depth);
    value[2] = approach_speed(in);
  }

 protected:
  static constexpr int kSides = 2, kUpper = 1, kBorders = ContactForce::kBorders;

  /// Of the touched stop: at most one is touched.
  static double approach_speed(const LawInput<double>& in) { return std::max(in.state[0], in.state[1]); }

  static constexpr double sign(int side) { return side == kUpper ? 1 : -1; }
  // "touch of the upper stop".
  static std::string called(int border, bool rising, const char* what) {
    return std::string(ContactForce::border_name(border % kBorders, rising)) + (border % kBorders < 2 ? " of the " : " at the ") + what;
  }
  double limit(int side) const { return side == kUpper ? upper : lower; }
  bool stands(int side) const { return std::isfinite(limit(side)); }

  // Eq. (6.1).
  template <class T>
  ContactMotion<T> find(const LawInput<T>& in, int side) const {
    return {sign(side) * (in.gap[free] - T(limit(side))), sign(side) * in.rate[free], T(0.0)};
  }
};

/// Stops that return the speed given by their restitution.
struct HardStops : StopContact {
  static constexpr std::string_view kWord = "hard";

  static HardStops typical() {
    HardStops law;
    law.contact.stiffness = 2e4;
    law.contact.exponent = 1;
    law.contact.hysteresis = hysteresis_of(ContactModel::kExact, 0.6);
    law.lower = -1e-3;
    law.upper = 2e-3;
    return law;
  }
};

/// Stops consisting of a spring and a damper that grows over the length of a cushion.
struct CushionedStops : StopContact {
  static constexpr std::string_view kWord = "cushioned";

  static CushionedStops typical() {
    CushionedStops law;
    law.free = 0;
    law.contact.stiffness = 5e4;
    law.contact.exponent = 1.2;
    law.contact.viscous = 800;
    law.contact.cushion = 3e-3;
    law.lower = -5e-4;
    return law;
  }
};

}  // namespace pintle
