// A planar mechanism as plain numbers, and its integration by Simbody. Simbody's headers do not compile as C++20, nor Pintle's as
// C++17, and Simbody contains an old copy of SUNDIALS under the same names as the new one: so this is a separate module,
// loaded in such a way that it finds its own libraries first.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace pintle::bench::simbody {

using Three = std::array<double, 3>;  // x, y, angle, or the corresponding components

struct Joint {
  int a = -1, b = -1;     // bodies, -1: the ground
  Three F{}, M{};         // frames on them
  bool slides = false;    // prismatic along F's x axis; otherwise a pin
  Three stiffness{}, damping{};
};

struct Link {
  int body = 0, parent = -1, joint = 0;
  bool forward = true;
  double start = 0, rate = 0;  // of the coordinate
};

struct Mechanism {
  std::vector<double> mass, inertia;
  std::vector<Three> q, v;  // at the start
  std::array<double, 2> gravity{};
  std::vector<Joint> joints;
  std::vector<Link> tree;   // empty: free bodies with a bushing at every joint
  std::vector<int> loops;
  int point_body = 0;
  std::array<double, 2> point{};
  /// Springs and motors: forces on the bodies at t, q, v; none if empty.
  std::function<void(double t, const std::vector<Three>& q, const std::vector<Three>& v, std::vector<Three>& Q)> loads;
};

/// Passed at an output time: positions and velocities of free bodies, or forces on the joints' second bodies (fx, fy, 0)
/// and the point.
struct Output {
  double t = 0;
  std::vector<Three> q, v, forces;
  std::array<double, 2> point{};
};

struct Plan {
  bool bdf = false;  // else Runge-Kutta-Merson
  double accuracy = 1e-5;
  std::vector<double> outputs;
  std::function<void(const Output&)> output;
  std::function<bool()> keep_going;
};

struct Result {
  bool completed = false;
  double steps = 0, realizations = 0;
};

extern "C" {
/// `begin` is called when the model is complete and the integration begins.
void pintle_simbody_integrate(const Mechanism& mechanism, const Plan& plan, const std::function<void()>& begin, Result& result);
/// Sets `out` to "major.minor.build".
void pintle_simbody_version(std::string& out);
}

}  // namespace pintle::bench::simbody
