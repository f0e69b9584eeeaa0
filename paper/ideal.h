// The paper's pendulum and four-bar with ideal joints, in closed form: what the compliant results are measured by. Nothing of
// the library is used.
#pragma once

#include <array>

namespace pintle::paper {

/// A uniform rod of 1 kg and 1 m on a pin, let go at 90 deg from rest, g = 9.81 m/s^2; x points down. Eqs. (21)-(23) of the paper.
struct IdealPendulum {
  double theta, speed, fx, fy;  ///< angle, |angular velocity|; force of the ground on the rod
};
IdealPendulum ideal_pendulum(double t);
/// The same at a given angle, |theta| <= 90 deg.
IdealPendulum ideal_pendulum_at(double theta);

struct Force {
  double x = 0, y = 0;
};

/// The four-bar of section 8 on the branch where the coupler's far end is above the line from the crank's end to O4.
struct IdealFourBar {
  double theta3, theta4, omega2, omega3, omega4, alpha2, alpha3, alpha4;
  std::array<Force, 4> force;  ///< O2 on crank, A on coupler, B on follower, O4 on follower
};
/// At crank angle theta2 of the motion that passes theta_start with omega_start. No gravity: kinetic energy is constant.
IdealFourBar ideal_four_bar(double theta2, double theta_start, double omega_start);

/// Columns of a run with these forces, in the same order, without ".fx[world]".
extern const std::array<const char*, 4> kFourBarPins;

}  // namespace pintle::paper
