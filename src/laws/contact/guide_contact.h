// A slider with clearance in its guide, touching it with its two ends: it may move across, tilt, and lie on both walls.
//
//   x_i = x + l_i cos a,  y_i = y + l_i sin a,  l = (L/2, -L/2)      theory/contact Eq. (4.4)
//   d_i = |y_i| - c,  n_i = sign y_i,  v_i = x_i'                    Eq. (4.5)
//
// Each end has a contact of its own, with its own states; force and friction act at that point.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "laws/contact/rubbing_contact.h"
#include "laws/law_part.h"

namespace pintle {

struct GuideContactLaw : RubbingContact {
  static constexpr std::string_view kWord = "clearance";
  static constexpr bool kStartsFree = true;
  double clearance = 1e-4;  // c, to either side [m]
  double length = 0.05;     // L, between the ends [m]

  static GuideContactLaw typical() {
    GuideContactLaw law;
    law.contact.stiffness = 1e9;
    law.contact.hysteresis = hysteresis_of(ContactModel::kExact, 0.7);
    law.friction.coefficient = 0.15;
    law.clearance = 2e-4;
    return law;
  }

  int n_states() const { return kEnds * RubbingContact::n_states(); }
  template <class T>
  void evaluate(const LawInput<T>& in, LawOutput<T>& out) const {
    for (int i = 0; i < kEnds; ++i) {
      const End<T> end = find(in, i);
      const PointForces<T> f = forces<T>(end, in.state + first_state(i), out.state_rate + first_state(i));
      const T across = -(f.normal * end.side);
      out.force[0] += f.friction;
      out.force[1] += across;
      out.force[2] += end.arm_x * across - end.arm_y * f.friction;
      out.energy += f.energy;
      out.loss += f.loss;
    }
  }
  void rest(const LawInput<double>& in, double* state) const {
    for (int i = 0; i < kEnds; ++i) RubbingContact::rest(find(in, i), state + first_state(i));
  }

  int n_borders() const { return kEnds * RubbingContact::n_borders(); }
  int border_direction(int border) const { return RubbingContact::border_direction(border % RubbingContact::n_borders()); }
  void borders(const LawInput<double>& in, double* value) const {
    for (int i = 0; i < kEnds; ++i) RubbingContact::borders(find(in, i), in.state + first_state(i), value + i * RubbingContact::n_borders());
  }
  std::string border_name(int border, bool rising) const {
    const int n = RubbingContact::n_borders();
    return std::string(border < n ? "front " : "rear ") + std::string(RubbingContact::border_name(border % n, rising));
  }
  void cross(int border, const LawInput<double>& in, double* state) const {
    const int n = RubbingContact::n_borders(), i = border / n;
    RubbingContact::cross(border % n, find(in, i), state + first_state(i));
  }

  Planar::Vec engaged_stiffness() const {
    const double k = contact.stiffness_at(0.1 * clearance);
    return {0, 2 * k, 0.5 * k * length * length};
  }
  /// Each end lies on the side to which its share of the load presses it; an end without a share lies on the other end's side.
  std::optional<Planar::Vec> gap_under(const Planar::Vec& force) const {
    const std::array<double, kEnds> share{0.5 * force[1] + force[2] / length, 0.5 * force[1] - force[2] / length};
    const double least = kNoShare * std::max(std::abs(share[0]), std::abs(share[1]));
    std::array<double, kEnds> across{};
    for (int i = 0; i < kEnds; ++i) {
      const double decides = std::abs(share[i]) > least ? share[i] : share[1 - i];
      across[i] = decides == 0 ? 0 : std::copysign(clearance + contact.depth_at(std::abs(share[i])), -decides);
    }
    return Planar::Vec(0, 0.5 * (across[0] + across[1]), std::asin(std::clamp((across[0] - across[1]) / length, -1.0, 1.0)));
  }
  double penetration(const Planar::Vec& gap) const {
    LawInput<double> in{};
    std::copy_n(gap.data(), 3, in.gap);
    return std::max(find(in, 0).depth, find(in, 1).depth);
  }
  std::span<const LawColumn> columns() const {
    static const std::array<LawColumn, 11> all{{{"contact_force_front", "N", "normal force at the end ahead, along the guide's axis"},
                                                {"contact_force_rear", "N", "normal force at the other end"},
                                                {"penetration_front", "m", "depth by which the end ahead overlaps a wall; negative while apart"},
                                                {"penetration_rear", "m", "the same of the other end"},
                                                {"approach_speed_front", "m/s", "speed at which the contact of the end ahead began; 0 while apart"},
                                                {"approach_speed_rear", "m/s", "the same of the other end"},
                                                {"wear_power", "W", "normal forces times speeds of slip"},
                                                {"stuck_front", "", "1 while the end ahead sticks, 0 while it slips or is apart"},
                                                {"stuck_rear", "", "the same of the other end"},
                                                {"friction", "N", "force of friction at both ends"},
                                                {"stuck", "", "1 while one end sticks or both, and none slips"}}};
    return std::span(all).first(grip ? 11 : 7);
  }
  void observe(const LawInput<double>& in, const Planar::Vec&, double* value) const {
    double wear = 0, along = 0;
    int stuck = 0, touching = 0;
    for (int i = 0; i < kEnds; ++i) {
      const End<double> end = find(in, i);
      const double* end_state = in.state + first_state(i);
      const PointForces<double> f = forces(end, end_state);
      value[i] = f.normal;
      value[2 + i] = end.depth;
      value[4 + i] = end_state[0];
      wear += wear_power(f.normal, end.slip, end_state);
      along += f.friction;
      if (end_state[0] > 0) ++touching;
      if (sticks(end_state)) ++stuck;
      if (grip) value[7 + i] = sticks(end_state) ? 1 : 0;
    }
    value[6] = wear;
    if (!grip) return;
    value[9] = along;
    value[10] = stuck > 0 && stuck == touching ? 1 : 0;
  }

 private:
  int first_state(int end) const { return end * RubbingContact::n_states(); }
  static constexpr int kEnds = 2;
  static constexpr double kNoShare = 1e-9;  // as a fraction of the other end's share: less is rounding
  template <class T>
  struct End : ContactMotion<T> {
    T side, arm_x, arm_y;
  };
  template <class T>
  End<T> find(const LawInput<T>& in, int i) const {
    using namespace law_math;
    const double reach = i == 0 ? 0.5 * length : -0.5 * length;
    End<T> end;
    end.arm_x = reach * cos(in.gap[2]);
    end.arm_y = reach * sin(in.gap[2]);
    const T y = in.gap[1] + end.arm_y;
    end.side = where_positive(y, T(1.0), T(-1.0));
    end.depth = abs(y) - T(clearance);
    end.rate = end.side * (in.rate[1] + end.arm_x * in.rate[2]);
    end.slip = in.rate[0] - end.arm_y * in.rate[2];
    return end;
  }
};

}  // namespace pintle
