// A detent: a ball, pressed by a spring, that sinks into notches of the part moving past it.
//
//   f = -r (F_0 + k y) y'(u),   V = F_0 y + 1/2 k y^2,   u = r (z - z_0)       theory/contact Eq. (8.1)
//
// z is the free coordinate of the joint, r the radius at which the ball runs (1 for slides), y(u) the lift of the ball by the notch. The slope of the
// force has a kink where the ball reaches the edge of a notch and where it leaves it: these are borders.
#pragma once

#include <array>
#include <cmath>
#include <span>
#include <string_view>

#include "laws/law_math.h"
#include "laws/law_part.h"

namespace pintle {

/// The lift of the ball as a function of its position along the surface, with slope and curvature.
struct BallLift {
  double y, slope, curvature;  // [m], [-], [1/m]
};

/// Ball and notches.
struct NotchProfile {
  double ball = 3e-3, notch = 5e-3, width = 6e-3;  // R, rho, w [m]
  double pitch = 0;                                // from notch to notch; 0: only one [m]

  double half_angle_sine() const { return width / (2 * notch); }              // sin phi (8.2)
  double edge() const { return (notch - ball) * half_angle_sine(); }          // u_1, where the ball reaches the edge (8.2)
  /// The position relative to the nearest notch.
  double from_notch(double u) const { return pitch > 0 ? u - pitch * std::round(u / pitch) : u; }
  BallLift at(double u) const;
};

struct DetentLaw {
  static constexpr std::string_view kWord = "ball-detent";
  static constexpr bool kHolds = false, kRubs = false;
  int free = 2;
  double radius = 0.02;                // r [m]; 1 for slides
  double place = 0;                    // z_0 [rad] or [m]
  NotchProfile profile;
  double preload = 20, rate = 5e3;     // F_0 [N], k [N/m]

  static DetentLaw typical() {
    DetentLaw law;
    law.free = 0;
    law.radius = 1;
    law.place = 1e-3;
    law.profile.pitch = 9e-3;
    return law;
  }

  template <class T>
  void evaluate(const LawInput<T>& in, LawOutput<T>& out) const {
    const T u = along(in);
    out.force[free] = -radius * law_math::through(u, [this](double x) { return push(x); }, [this](double x) { return push_slope(x); });
    out.energy = law_math::through(u, [this](double x) { return energy(x); }, [this](double x) { return push(x); });
  }

  int n_borders() const { return 2; }
  void borders(const LawInput<double>& in, double* value) const {
    const double from = std::abs(profile.from_notch(along(in)));
    value[0] = from - profile.edge();
    value[1] = from - 0.5 * profile.width;
  }
  std::string_view border_name(int border, bool rising) const {
    if (border == 0) return rising ? "ball on the edge of a notch" : "ball in a notch";
    return rising ? "ball out of a notch" : "ball over the edge of a notch";
  }

  /// Both sides and the middle of every notch.
  Bends bends() const {
    const double side = 0.5 * profile.width / radius;
    return {{place - side, place, place + side}, profile.pitch / radius};
  }

  std::span<const LawColumn> columns() const {
    static constexpr const char* kLift = "how far the notches have lifted the ball";
    static const std::array<LawColumn, 2> turn{{{"detent", "N*m", "moment of the detent on the second body"}, {"detent_lift", "m", kLift}}};
    static const std::array<LawColumn, 2> slide{{{"detent", "N", "force of the detent on the second body, along the slide"}, {"detent_lift", "m", kLift}}};
    return free == 2 ? turn : slide;
  }
  void observe(const LawInput<double>& in, const Planar::Vec&, double* value) const {
    value[0] = -radius * push(along(in));
    value[1] = profile.at(along(in)).y;
  }

 private:
  template <class T>
  T along(const LawInput<T>& in) const { return radius * (in.gap[free] - T(place)); }
  // V, V' and V'' along u.
  double energy(double u) const {
    const double y = profile.at(u).y;
    return (preload + 0.5 * rate * y) * y;  // (8.1)
  }
  double push(double u) const {
    const BallLift lift = profile.at(u);
    return (preload + rate * lift.y) * lift.slope;  // (8.1)
  }
  double push_slope(double u) const {
    const BallLift lift = profile.at(u);
    return rate * lift.slope * lift.slope + (preload + rate * lift.y) * lift.curvature;
  }
};

}  // namespace pintle
