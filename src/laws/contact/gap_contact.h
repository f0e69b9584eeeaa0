// A contact along one gap: a cam and its follower, an edge and a body running on it. The joint's displacement consists of the distance of the surfaces
// and their slip along each other. The surfaces press but do not pull, and may have friction.
//
//   d = -e,  d' = -e',  force N on the gap, friction on the slip        theory/contact section 1, theory/cams section 3
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "laws/contact/rubbing_contact.h"
#include "laws/law_part.h"

namespace pintle {

struct GapContactLaw : RubbingContact {
  static constexpr std::string_view kWord = "contact of a gap";

  static GapContactLaw typical() {
    GapContactLaw law;
    law.contact.stiffness = 1e8;
    law.contact.hysteresis = hysteresis_of(ContactModel::kExact, 0.6);
    law.friction.coefficient = 0.1;
    return law;
  }

  template <class T>
  void evaluate(const LawInput<T>& in, LawOutput<T>& out) const {
    const PointForces<T> f = forces<T>(motion(in), in.state, out.state_rate);
    out.force[0] = f.normal;
    out.force[kSlipping] = f.friction;
    out.energy = f.energy;
    out.loss = f.loss;
  }
  void rest(const LawInput<double>& in, double* state) const { RubbingContact::rest(motion(in), state); }
  void borders(const LawInput<double>& in, double* value) const { RubbingContact::borders(motion(in), in.state, value); }
  void cross(int border, const LawInput<double>& in, double* state) const { RubbingContact::cross(border, motion(in), state); }

  /// At the usual depth of a follower: assembly puts it onto the cam.
  Planar::Vec engaged_stiffness() const { return closed_stiffness(); }
  Planar::Vec closed_stiffness() const { return {contact.stiffness_at(ContactForce::kUsualDepth), 0, 0}; }
  double penetration(const Planar::Vec& gap) const { return -gap[0]; }
  std::span<const LawColumn> columns() const {
    static const std::array<LawColumn, 6> all{{{"contact_force", "N", "normal force of the contact"},
                                               {"penetration", "m", "depth by which the surfaces overlap; negative while they are apart"},
                                               {"approach_speed", "m/s", "speed at which this contact began; 0 while apart"},
                                               {"slip", "m/s", "speed of the second surface along the first one"},
                                               {"wear_power", "W", "normal force times speed of slip: its integral is what Archard's law multiplies"},
                                               {"stuck", "", "1 while the surfaces stick, 0 while they slip or are apart"}}};
    return std::span(all).first(grip ? 6 : rubs() ? 5 : 3);
  }
  void observe(const LawInput<double>& in, const Planar::Vec&, double* value) const {
    const ContactMotion<double> at = motion(in);
    value[0] = forces(at, in.state).normal;
    value[1] = at.depth;
    value[2] = in.state[0];
    if (!rubs()) return;
    value[3] = at.slip;
    value[4] = wear_power(value[0], at.slip, in.state);
    if (grip) value[5] = sticks(in.state) ? 1 : 0;
  }

 private:
  static constexpr int kSlipping = 1;          // component of the slip
  template <class T>
  static ContactMotion<T> motion(const LawInput<T>& in) {
    return {T(0.0) - in.gap[0], T(0.0) - in.rate[0], in.rate[kSlipping]};
  }
};

/// A body that runs over an edge may start in the air.
struct RoadContactLaw : GapContactLaw {
  static constexpr bool kStartsFree = true;

  static RoadContactLaw typical() { return {GapContactLaw::typical()}; }
  Planar::Vec engaged_stiffness() const { return Planar::Vec::Zero(); }
};

}  // namespace pintle
