// A contact along one gap: a cam and its follower. The joint's displacement is the distance of the surfaces; they press and do not pull.
//
//   d = -e,  d' = -e',  force N on the gap        theory/contact section 1, theory/cams section 3
//
// Its state is the approach speed while they touch, 0 while they are apart; touch and let-go are borders. Without friction: a gap does not
// tell how the surfaces slip.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "laws/contact/contact.h"
#include "laws/law_part.h"

namespace pintle {

struct GapContactLaw {
  static constexpr std::string_view kWord = "contact of a gap";
  ContactForce contact;

  static GapContactLaw typical() {
    GapContactLaw law;
    law.contact.stiffness = 1e8;
    law.contact.hysteresis = hysteresis_of(ContactModel::kExact, 0.6);
    return law;
  }

  int n_states() const { return 1; }
  template <class T>
  void evaluate(const LawInput<T>& in, LawOutput<T>& out) const {
    const PointForces<T> f = point_forces<T>(contact, motion(in), in.state[0]);
    out.force[0] = f.normal;
    out.energy = f.energy;
    out.loss = f.loss;
  }
  void rest(const LawInput<double>& in, double* state) const { state[0] = in.gap[0] < 0 ? contact.least_approach : 0; }

  int n_borders() const { return 3; }
  static constexpr std::array<int, 3> kDirections{1, -1, 0};
  std::span<const int> border_directions() const { return kDirections; }
  void borders(const LawInput<double>& in, double* value) const { contact.borders(-in.gap[0], -in.rate[0], in.state[0], value); }
  static constexpr std::string_view border_name(int border, bool rising) { return ContactForce::border_name(border, rising); }
  void cross(int border, const LawInput<double>& in, double* state) const { contact.cross(border, -in.rate[0], state[0]); }

  /// At the depth that a follower usually has: assembly puts it onto the cam.
  Planar::Vec engaged_stiffness() const { return {contact.stiffness_at(kUsualDepth), 0, 0}; }
  double penetration(const Planar::Vec& gap) const { return -gap[0]; }
  std::span<const LawColumn> columns() const {
    static const std::array<LawColumn, 3> all{{{"contact_force", "N", "normal force of the contact"},
                                               {"penetration", "m", "depth by which the surfaces overlap; negative while they are apart"},
                                               {"approach_speed", "m/s", "speed at which this contact began; 0 while apart"}}};
    return all;
  }
  void observe(const LawInput<double>& in, const Planar::Vec&, double* value) const {
    value[0] = point_forces<double>(contact, motion(in), in.state[0]).normal;
    value[1] = -in.gap[0];
    value[2] = in.state[0];
  }

 private:
  static constexpr double kUsualDepth = 1e-6;  // [m]
  template <class T>
  static ContactMotion<T> motion(const LawInput<T>& in) {
    return {T(0.0) - in.gap[0], T(0.0) - in.rate[0], T(0.0)};
  }
};

}  // namespace pintle
