// A pendulum made in code: a rod is let go from the horizontal, and its pin carries the most at the bottom.
//
// With mass m, the centre of mass at r from the pin and the inertia I about it, energy gives the speed at the bottom,
// w^2 = 2 m g r / (I + m r^2), and the pin carries m g + m w^2 r there. For a uniform rod that is 5/2 m g. The program
// prints both and fails if they differ by more than the pin's compliance explains.
#include <pintle/model.h>
#include <pintle/simulate.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

int main() {
  const double mass = 2, length = 1, gravity = 9.80665;  // [kg], [m], [m/s^2]

  pintle::Body rod;
  rod.name = "rod";
  rod.mass = mass;
  rod.inertia = mass * length * length / 12;
  rod.position = pintle::Vec2{length / 2, 0};
  rod.angle = 0;
  rod.markers = {{.name = "end", .position = {-length / 2, 0}}};

  pintle::Joint pin;
  pin.name = "pin";
  pin.type = "revolute";
  pin.first = {.body = "ground", .marker = "O"};
  pin.second = {.body = "rod", .marker = "end"};
  pin.law.values = {{"stiffness", {1e8}}, {"damping", {3e3}}};

  pintle::Model model;
  model.name = "Pendulum";
  model.gravity = {0, -gravity};
  model.ground = {{.name = "O"}};
  model.bodies = {rod};
  model.joints = {pin};
  model.simulate.duration = 1;
  model.simulate.output_step = 1e-3;

  const pintle::Trajectory run = pintle::simulate(model);
  const double expected = 2.5 * mass * gravity;
  const double peak = run.joints.at(0).peak;
  std::printf("peak pin force %.3f N, of rigid joints %.3f N\n", peak, expected);
  return std::abs(peak - expected) < 1e-3 * expected ? EXIT_SUCCESS : EXIT_FAILURE;
}
