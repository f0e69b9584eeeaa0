// Models shared by the tests of several directories: the pendulum and the four-bar of the paper's sections 7 and 8, and
// one with everything that a model can contain.
#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "base/random_for_tests.h"
#include "pintle/model.h"
#include "system/build.h"

namespace pintle::sample {

/// An expression of the named variables, regardless of their dimensions.
Expression expression(const std::string& text, const std::vector<std::string>& variables = {"t"});

Joint joint(const std::string& name, const std::string& type, const MarkerRef& first, const MarkerRef& second, double k, double c);

Body body(const std::string& name, double mass, double inertia, const std::vector<Marker>& markers);

void put_at(Body& b, double x, double y, double angle);

/// A uniform rod of 1 m and 1 kg on a pin, initially horizontal. Section 7; g along -y, the angle from the +x axis.
Model pendulum(double k, double c, double g = 9.81);

/// Angles and their rates of the four-bar of section 8 with the crank at theta2, turning at 10 rad/s; B above the line A-O4.
struct FourBarPose {
  double theta2 = 0, theta3 = 0, theta4 = 0, omega3 = 0, omega4 = 0;

  explicit FourBarPose(double crank_angle) : theta2(crank_angle) {
    const double ax = std::cos(theta2), ay = std::sin(theta2), dx = 6 - ax, dy = -ay, d = std::hypot(dx, dy);
    theta3 = std::atan2(dy, dx) + std::acos(d / 8);  // coupler and follower are both 4 m long
    const double bx = ax + 4 * std::cos(theta3), by = ay + 4 * std::sin(theta3);
    theta4 = std::atan2(by, bx - 6);
    // 10 J a + 4 omega3 J u3 = 4 omega4 J u4
    const double s = std::sin(theta3 - theta4);
    omega3 = 10 * std::sin(theta4 - theta2) / (4 * s);
    omega4 = 10 * std::sin(theta3 - theta2) / (4 * s);
  }
};

/// The four-bar of section 8 without gravity, in its exact position with consistent velocities.
Model four_bar(double k, double c, double theta2 = std::numbers::pi / 3);

Spring spring(const std::string& name, bool torsion, const MarkerRef& first, const MarkerRef& second, double k, double c);

Motor motor(const std::string& name, const std::string& of, MotorKind kind, Expression law);

/// Six bodies with every joint type, springs, motors of every kind and applied forces; soft, for use at any state.
/// `free`: nothing touches the ground, and there is neither gravity nor an applied force.
Model everything(bool free = false);

/// Marks the joints of these names as ideal.
System with_ideal(System system, const std::vector<std::string>& names);

Eigen::VectorXd random_vector(Random& random, int n, double size);

/// Positions and velocities of all bodies at random, no two centres of mass close to each other.
void random_state(Random& random, std::size_t n_bodies, Vecs& q, Vecs& v);

}  // namespace pintle::sample
