#include "laws/contact/detent.h"

namespace pintle {

// On the arc of the notch the ball's centre moves on a circle about the notch's centre, on the edge on a circle about the edge. Its slope is tan psi on both. Eqs. (8.2), (8.3)
BallLift NotchProfile::at(double u) const {
  const double from = from_notch(u), side = from < 0 ? -1 : 1, distance = std::abs(from);
  const double round = notch - ball, bottom = round * (1 - std::sqrt(1 - half_angle_sine() * half_angle_sine()));
  const double cos_edge = std::sqrt(1 - half_angle_sine() * half_angle_sine());
  if (distance <= edge()) {
    const double s = distance / round, c = std::sqrt(1 - s * s);
    return {round * s * s / (1 + c), side * s / c, 1 / (round * c * c * c)};
  }
  if (distance >= 0.5 * width) return {bottom + ball * (1 - cos_edge), 0, 0};
  const double s = (0.5 * width - distance) / ball, c = std::sqrt(1 - s * s);
  return {bottom + ball * (c - cos_edge), side * s / c, -1 / (ball * c * c * c)};
}

}  // namespace pintle
