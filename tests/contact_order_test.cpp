// The order of the method across a touch and a release, for a force that is smooth between them. theory/contact section 5.
#include <gtest/gtest.h>
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "integrators/methods.h"
#include "laws/contact/contact.h"
#include "tests/reference_tables.h"

namespace pintle {
namespace {

constexpr double kThrownMass = 2, kWallStiffness = 1e4, kSpeed = 0.5, kRestitution = 0.7, kEnd = 0.5, kTouch = 0.02;

// A block 10 mm above an edge flies towards it.
Model thrown_block() {
  return parse_model(fmt::format(R"toml(
format = 1
gravity = [0, 0]
[simulate]
duration = "1 s"
start = "raw"
[ground.markers]
o = [0, 0]
[body.block]
mass = {}
inertia = 0.01
position = [0, {}]
velocity = [0, -{}]
angle = 0
spin = 0
markers.c = [0, 0]
[joint.edge]
type = "slot"
between = ["ground.o", "block.c"]
law = "contact"
pin_radius = 0
contact_stiffness = {}
contact_exponent = 1
restitution = {}
)toml",
                                 kThrownMass, kSpeed * kTouch, kSpeed, kWallStiffness, kRestitution),
                     "thrown.toml");
}

// Duration of the contact: theory/contact (2.1) for n = 1, from the touch to the approach speed x, gives the depth, and dt = -dx m v/(K d (1 + h x)). In the
// angle of the circle on the range of x from -e to 1 the integrand is smooth and periodic, so that the midpoint rule converges to roundoff.
double contact_time() {
  const double h = hysteresis_of(ContactModel::kExact, kRestitution), middle = 0.5 * (1 - kRestitution), radius = 0.5 * (1 + kRestitution);
  const auto integral = [h](double x) { return x / h - std::log1p(h * x) / (h * h); };  // of x/(1 + h x)
  constexpr int kPoints = 200;
  double sum = 0;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = std::numbers::pi * (i + 0.5) / kPoints, x = middle + radius * std::cos(angle);
    const double depth = kSpeed * std::sqrt(2 * kThrownMass / kWallStiffness * (integral(1) - integral(x)));
    sum += radius * std::sin(angle) * kThrownMass * kSpeed / (kWallStiffness * depth * (1 + h * x));
  }
  return sum * std::numbers::pi / kPoints;
}

struct Flight {
  double steps = 0;  // in contact
  double longest = 0;
  double position = 0, impulse = 0;  // errors [m, N s]
};

Flight fly(int stages, double tolerance, double max_step = 0) {
  const double lasts = contact_time();
  const Model model = thrown_block();
  const Assembly assembly = start_of_run(model);
  const System& system = assembly.system;
  const State& start = assembly.state;
  const auto stepper = make_stepper(system, {.stages = stages}, tolerance);
  if (max_step > 0) stepper->set_max_step(max_step);
  stepper->start(start, max_step > 0 ? max_step : 1e-4);
  Flight out;
  while (stepper->state().t < kEnd) {
    if (!stepper->step(kEnd)) {
      ADD_FAILURE() << stepper->failure();
      break;
    }
    const double from = stepper->previous().t, to = stepper->state().t;
    if (from < kTouch * (1 - 1e-9) || from > (kTouch + lasts) * (1 - 1e-9)) continue;
    ++out.steps;
    out.longest = std::max(out.longest, to - from);
  }
  out.position = std::abs(stepper->state().q[0][1] - kRestitution * kSpeed * (kEnd - kTouch - lasts));
  out.impulse = std::abs(kThrownMass * (stepper->state().v[0][1] + kSpeed) - kThrownMass * (1 + kRestitution) * kSpeed);
  return out;
}

// The slope of the errors over `sizes` in logarithmic scales, by least squares.
double order(const std::vector<double>& sizes, const std::vector<double>& errors) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const double a = std::log(sizes[i]), b = std::log(errors[i]);
    ++n;
    x += a;
    y += b;
    xx += a * a;
    xy += a * b;
  }
  return -(n * xy - x * y) / (n * xx - x * x);
}

// Three stages have order 5, five have order 9. Errors fall from 1e-4 to 1e-12 over the tests; roundoff is 1e-15. Measured: 6.4 and 9.1, as step control
// refines where it matters most.
TEST(ContactOrder, ErrorsFallWithTheStepsOfAContactAtTheFullOrder) {
  for (const int stages : {3, 5}) {
    std::vector<double> steps, position, impulse;
    for (const double tolerance : stages == 3 ? std::vector<double>{1e-2, 1e-3, 1e-4, 1e-5, 1e-6} : std::vector<double>{1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8}) {
      const Flight flight = fly(stages, tolerance);
      steps.push_back(flight.steps);
      position.push_back(flight.position);
      impulse.push_back(flight.impulse);
      EXPECT_GT(flight.position, 1e-14);
      EXPECT_GT(flight.impulse, 1e-14);
    }
    EXPECT_GT(order(steps, position), 0.9 * (2 * stages - 1)) << stages;
    EXPECT_GT(order(steps, impulse), 0.9 * (2 * stages - 1)) << stages;
  }
}

// The same with the longest step: the short ones after the touch are not representative of the others. Measured: 5.5.
TEST(ContactOrder, ErrorsFallWithTheLongestStepAtTheFullOrder) {
  std::vector<double> parts, position, impulse;
  for (const double n : {8.0, 12.0, 16.0, 24.0, 32.0, 48.0, 64.0}) {
    const double longest = contact_time() / n;
    const Flight flight = fly(3, 100 * std::pow(n, -4), longest);
    EXPECT_NEAR(flight.longest, longest, 1e-9 * longest) << n;  // it is what limits the steps
    parts.push_back(n);
    position.push_back(flight.position);
    impulse.push_back(flight.impulse);
    EXPECT_GT(flight.position, 1e-14);
  }
  EXPECT_GT(order(parts, position), 4.5);
  EXPECT_GT(order(parts, impulse), 4.5);
}

}  // namespace
}  // namespace pintle
