// A pin in contact with the surface around or below it: a bush with clearance, the two walls of a slot, one edge.
//
//   bush:  d = |p| - c,  n = p/|p|        p = (x, y), the pin's centre as seen from the bush        theory/contact Eq. (4.1)
//   slot:  d = |y| - c,  n = (0, sign y)
//   edge:  d = R - y,    n = (0, -1)
//   d' = n . p',  v_t = t . p' + R w,  t = (-n_y, n_x)                                             Eq. (4.2)
//   on the second body: force -N n + F_t t, couple R F_t; F_t against the slip v_t                 Eq. (4.3)
//
// The pin, of radius R, is on the second body. Force and slip are those of one point on the pin's surface, so that the moments balance exactly.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>

#include "laws/contact/rubbing_contact.h"
#include "laws/law_part.h"

namespace pintle {

struct PinContact : RubbingContact {
  static constexpr bool kStartsFree = true;
  enum class Shape { kBush, kSlot, kEdge };
  Shape shape = Shape::kBush;
  double clearance = 1e-4;  // c, radial, or to either side [m]
  double radius = 0.01;     // R [m]

  template <class T>
  void evaluate(const LawInput<T>& in, LawOutput<T>& out) const {
    const At<T> at = find(in);
    const PointForces<T> f = forces<T>(at, in.state, out.state_rate);
    out.force[0] = -(f.normal * at.nx) - f.friction * at.ny;
    out.force[1] = -(f.normal * at.ny) + f.friction * at.nx;
    out.force[2] = radius * f.friction;
    out.energy = f.energy;
    out.loss = f.loss;
  }
  void rest(const LawInput<double>& in, double* state) const { RubbingContact::rest(find(in), state); }
  void borders(const LawInput<double>& in, double* value) const { RubbingContact::borders(find(in), in.state, value); }
  void cross(int border, const LawInput<double>& in, double* state) const { RubbingContact::cross(border, find(in), state); }

  double lever() const { return rubs() ? radius : 0; }
  /// A pin apart from an edge stays apart when a mechanism is assembled; a pin with clearance is put in the middle.
  Planar::Vec engaged_stiffness() const {
    return shape == Shape::kEdge ? Planar::Vec::Zero() : closed_stiffness();
  }
  Planar::Vec closed_stiffness() const {
    const double k = contact.stiffness_at(shape == Shape::kEdge ? ContactForce::kUsualDepth : 0.1 * clearance);
    return {shape == Shape::kBush ? k : 0, k, 0};
  }
  double penetration(const Planar::Vec& gap) const {
    LawInput<double> in{};
    std::copy_n(gap.data(), 3, in.gap);
    return find(in).depth;
  }
  std::span<const LawColumn> columns() const {
    static const std::array<LawColumn, 7> all{{{"contact_force", "N", "normal force of the contact"},
                                               {"penetration", "m", "depth by which the surfaces overlap; negative while they are apart"},
                                               {"contact_angle", "rad", "direction in which the second body presses the first, from the x axis of the first marker"},
                                               {"approach_speed", "m/s", "speed at which this contact began; 0 while apart"},
                                               {"slip", "m/s", "speed of the pin's surface along the other one"},
                                               {"wear_power", "W", "normal force times speed of slip: its integral is what Archard's law multiplies"},
                                               {"stuck", "", "1 while the surfaces stick, 0 while they slip or are apart"}}};
    return std::span(all).first(grip ? 7 : 6);
  }
  void observe(const LawInput<double>& in, const Planar::Vec&, double* value) const {
    const At<double> at = find(in);
    value[0] = forces(at, in.state).normal;
    value[1] = at.depth;
    value[2] = std::atan2(at.ny, at.nx);
    value[3] = in.state[0];
    value[4] = at.slip;
    value[5] = wear_power(value[0], at.slip, in.state);
    if (grip) value[6] = sticks(in.state) ? 1 : 0;
  }

 private:
  template <class T>
  struct At : ContactMotion<T> {
    T nx, ny;
  };
  template <class T>
  At<T> find(const LawInput<T>& in) const {
    using namespace law_math;
    const T none(0.0), one(1.0);
    At<T> at;
    if (shape == Shape::kEdge) {
      at.nx = none;
      at.ny = -one;
      at.depth = T(radius) - in.gap[1];
    } else {
      const T x = shape == Shape::kBush ? in.gap[0] : none, y = in.gap[1];
      const T distance = sqrt(x * x + y * y), least = T(kCentred * clearance);  // no direction at the centre, and no force
      const T size = where_positive(distance - least, distance, least);
      at.nx = divide(x, size);
      at.ny = divide(y, size);
      at.depth = distance - T(clearance);
    }
    at.rate = at.nx * in.rate[0] + at.ny * in.rate[1];
    at.slip = at.nx * in.rate[1] - at.ny * in.rate[0] + radius * in.rate[2];
    return at;
  }
  static constexpr double kCentred = 1e-6;  // as a fraction of the clearance: a pin this close to the centre has no direction to the bush, and no force
};

struct ClearanceLaw : PinContact {
  static constexpr std::string_view kWord = "clearance";

  static ClearanceLaw typical() {
    ClearanceLaw law;
    law.contact.stiffness = 1e9;
    law.contact.hysteresis = hysteresis_of(ContactModel::kExact, 0.8);
    law.friction.coefficient = 0.1;
    law.clearance = 2e-4;
    return law;
  }
};

struct EdgeContactLaw : PinContact {
  static constexpr std::string_view kWord = "contact";

  static EdgeContactLaw typical() {
    EdgeContactLaw law;
    law.shape = Shape::kEdge;
    law.contact.stiffness = 1e8;
    law.contact.hysteresis = hysteresis_of(ContactModel::kExact, 0.6);
    law.friction.coefficient = 0.2;
    return law;
  }
};

}  // namespace pintle
