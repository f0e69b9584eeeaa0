// Bearings in whole runs: where loads settle, when whirl begins, when play is used up.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <complex>
#include <string>

#include "base/constants.h"
#include "laws/bearings/journal_film.h"
#include "laws/law.h"
#include "tests/reference_tables.h"

namespace pintle {
namespace {

using reference::completed;

// A rotor in one oil film, pressed down by a load, its spin held by a servo.
struct Rotor {
  double mass, spin, load, viscosity, radius = 0.025, length = 0.02, clearance = 40e-6;

  // S (L/D)^2 = (1-e^2)^2 / (pi e sqrt(pi^2 (1-e^2) + 16 e^2)): theory/bearings Eq. (3.8)
  double eccentricity() const {
    const double slender = length / (2 * radius), turns = spin / (2 * kPi);
    const double S = viscosity * turns * 2 * radius * length / load * std::pow(radius / clearance, 2) * slender * slender;
    double low = 1e-9, high = 1 - 1e-9;
    for (int i = 0; i < 200; ++i) {
      const double e = 0.5 * (low + high);
      ((1 - e * e) * (1 - e * e) / (kPi * e * std::sqrt(kPi * kPi * (1 - e * e) + 16 * e * e)) > S ? low : high) = e;
    }
    return low;
  }
  // Position of the centre: ahead of the load, which points down, in the direction of the spin.
  Eigen::Vector2d place() const {
    const double e = eccentricity(), attitude = std::atan(kPi * std::sqrt(1 - e * e) / (4 * e));
    return clearance * e * Eigen::Vector2d(std::sin(attitude), -std::cos(attitude));
  }
  Model model(const Eigen::Vector2d& start, double duration, double step) const {
    return parse_model(fmt::format(R"toml(
format = 1
name = "Rotor in an oil film"
gravity = [0, 0]
[simulate]
duration = {}
output_step = {}
tolerance = 1e-7
start = "raw"
[ground.markers]
bush = [0, 0]
[body.rotor]
mass = {}
inertia = 0.05
position = [{}, {}]
velocity = [0, 0]
angle = 0
spin = {}
markers.pin = [0, 0]
[joint.film]
type = "revolute"
between = ["ground.bush", "rotor.pin"]
law = "journal-bearing"
film = "short"
journal_radius = {}
bearing_length = {}
radial_clearance = {}
viscosity = {}
roughness = 1e-7
[motor.drive]
joint = "film"
speed = {}
[force.load]
on = "rotor.pin"
force = [0, {}]
)toml", duration, step, mass, start[0], start[1], spin, radius, length, clearance, viscosity, spin, -load), "rotor.toml");
  }
  // The largest real part of the roots of m s^2 + C s + K, with the tangents of the law where the load rests.
  double growth() const {
    JournalFilmLaw film;
    film.radius = radius;
    film.length = length;
    film.clearance = clearance;
    film.viscosity = viscosity;
    film.roughness = 1e-7;
    const Law law = film;
    LawTangents at;
    const Eigen::Vector2d p = place();
    const Planar::Vec gap(p[0], p[1], 0), rate(0, 0, spin);
    law.linearize({0, gap, rate, nullptr}, at);
    Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
    A.topRightCorner<2, 2>().setIdentity();
    A.bottomLeftCorner<2, 2>() = -at.stiffness.topLeftCorner<2, 2>() / mass;
    A.bottomRightCorner<2, 2>() = -at.damping.topLeftCorner<2, 2>() / mass;
    return A.eigenvalues().real().maxCoeff();
  }
};

TEST(OilFilm, ALoadedRotorSettlesWhereTheClosedFormSays) {
  for (const double load : {150.0, 560.0, 4000.0}) {
    const Rotor rotor{5, 150, load, 0.04};
    const Trajectory run = completed(rotor.model({0, 0}, 0.4, 0.01));
    const std::size_t last = run.n_rows() - 1;
    const Eigen::Vector2d place(run.at(last, run.column("body.rotor.x")), run.at(last, run.column("body.rotor.y"))), wanted = rotor.place();
    EXPECT_LT((place - wanted).norm(), 1e-6 * rotor.clearance) << load;
    EXPECT_NEAR(run.at(last, run.column("joint.film.eccentricity")), rotor.eccentricity(), 1e-6);
    EXPECT_LT(run.energy.drift, 1e-6 * run.energy.dissipated);
  }
}

// The speed at which a rigid rotor begins to whirl, from the roots of its linearised equations; runs on either side grow and decay as the roots say.
TEST(OilFilm, ARotorWhirlsAboveItsThresholdAndNotBelow) {
  Rotor rotor{20, 3000, 3000, 0.01};
  double low = 1000, high = 10000;
  for (int i = 0; i < 60; ++i) {
    rotor.spin = 0.5 * (low + high);
    (rotor.growth() > 0 ? high : low) = rotor.spin;
  }
  const double threshold = low;
  for (const double factor : {0.95, 1.05}) {
    rotor.spin = factor * threshold;
    const double rate = rotor.growth(), turn = 2 * kPi / rotor.spin;
    const Eigen::Vector2d rest = rotor.place(), start = rest + Eigen::Vector2d(1e-4, 0) * rotor.clearance;
    const Trajectory run = completed(rotor.model(start, 40 * turn, turn / 20));
    const auto largest = [&](double from, double to) {
      double most = 0;
      for (std::size_t i = 0; i < run.n_rows(); ++i)
        if (run.at(i, 0) >= from * turn && run.at(i, 0) <= to * turn)
          most = std::max(most, std::hypot(run.at(i, run.column("body.rotor.x")) - rest[0], run.at(i, run.column("body.rotor.y")) - rest[1]));
      return most;
    };
    const double measured = std::log(largest(35, 40) / largest(5, 10)) / (30 * turn);
    EXPECT_GT(rate * (factor - 1), 0);
    EXPECT_NEAR(measured, rate, 0.03 * std::abs(rate)) << factor << " of " << threshold;
  }
}

// Raimondi and Boyd's chart for L/D = 1: an eccentricity of 0.6 at a Sommerfeld number of 0.121. The unbalance, 10 um of 40 kg at 3000 rpm, adds 39.5 N to 5165 N.
TEST(OilFilm, ARotorInAFilmOfFiniteLengthStandsWhereTheChartSays) {
  const Trajectory run = completed(reference::mechanism("oil_film_rotor"));
  double eccentricity = 0, sommerfeld = 0, most = 0;
  constexpr std::size_t kRows = 40;  // the last turn
  for (std::size_t i = run.n_rows() - kRows; i < run.n_rows(); ++i) {
    eccentricity += reference::value(run, i, "joint.bearing.eccentricity") / kRows;
    sommerfeld += reference::value(run, i, "joint.bearing.sommerfeld") / kRows;
    most = std::max(most, std::hypot(reference::value(run, i, "joint.bearing.on_rotor.fx[world]"), reference::value(run, i, "joint.bearing.on_rotor.fy[world]")));
  }
  EXPECT_NEAR(sommerfeld, 0.121, 1e-3);
  EXPECT_NEAR(eccentricity, 0.6, 0.01);
  const double unbalance = 40 * 10e-6 * std::pow(100 * kPi, 2);
  EXPECT_NEAR(most, 5165 + unbalance, 0.02 * unbalance);
}

constexpr const char* kLoose = R"toml(
format = 1
name = "Ring in its play"
[simulate]
duration = "30 ms"
output_step = "0.1 ms"
start = "raw"
[ground.markers]
housing = [0, 0]
[body.ring]
mass = 2
inertia = 0.01
position = [0, 0]
velocity = [0, 0]
angle = 0
spin = 0
markers.axis = [0, 0]
[joint.bearing]
type = "revolute"
between = ["ground.housing", "ring.axis"]
law = "rolling-bearing"
stiffness = "1e7 N/m"
damping = 0
play = "60 um"
)toml";

// With the film's tangents at the first guess alone, its passes of order 9 took steps of 0.03 ms: 20,788 in all.
TEST(OilFilm, BesideAWornPinTakesLongSteps) {
  const Trajectory run = reference::completed(reference::test_model("crank_press_with_film_and_play"));
  EXPECT_LT(run.counters.steps, 8000u);  // measured: 4930
}

// It falls 30 micrometres, rebounds from a spring, and comes back: nothing is lost.
TEST(RollingBearing, FallsThroughItsPlayAndReboundsWhenItShould) {
  const Trajectory run = completed(parse_model(kLoose, "loose.toml"));
  const double h = 30e-6, k = 1e7, m = 2, speed = std::sqrt(2 * kStandardGravity * h), w = std::sqrt(k / m), touch = speed / kStandardGravity;
  const double contact = 2 * (kPi - std::atan(speed * w / kStandardGravity)) / w, flight = 2 * touch;
  const auto times = [&](double first) { return static_cast<std::uint64_t>((0.03 - first) / (contact + flight)) + 1; };
  EXPECT_EQ(run.counters.events, run.counters.passes * (times(touch) + times(touch + contact)));
  const int y = run.column("body.ring.y");
  for (std::size_t i = 0; i < run.n_rows(); ++i) {
    const double since = std::fmod(run.at(i, 0) + touch, contact + flight);  // since the last release
    if (since < flight) EXPECT_NEAR(run.at(i, y), -0.5 * kStandardGravity * std::pow(since - touch, 2), 1e-9) << run.at(i, 0);
    else EXPECT_LT(run.at(i, y), -h + 1e-9);
  }
  EXPECT_LT(run.energy.drift, 1e-6 * run.energy.kinetic_peak);
}

// A start carries its load: the ring begins where the play is used up, and stays there.
TEST(RollingBearing, StartsWhereItsLoadHolds) {
  for (const bool play : {true, false}) {
    Model model = parse_model(kLoose, "loose.toml");
    model.simulate.start = Start::kAssembled;
    auto& keys = model.joints[0].law.values;
    keys["balls"] = {8};
    keys["ball_diameter"] = {0.01};
    keys["damping"] = {3500};
    if (!play) keys["play"] = {0};
    const Trajectory run = completed(model);
    const double Q = (play ? 5 : 4.37) * 2 * kStandardGravity / 8, depth = 1e-3 * 4.36e-4 * std::pow(Q, 2.0 / 3) / std::cbrt(10.0) + (play ? 30e-6 : 0);
    for (const std::size_t i : {std::size_t{0}, run.n_rows() - 1}) {
      EXPECT_NEAR(run.at(i, run.column("body.ring.y")), -depth, 1e-8 * depth) << i;
      EXPECT_NEAR(run.at(i, run.column("joint.bearing.element_load")), Q, 1e-6 * Q) << i;
    }
  }
}

// A pin with a measured force curve carries a load at the displacement of the table.
TEST(Table, CarriesALoadAtTheDisplacementOfItsPoint) {
  Model model = parse_model(kLoose, "loose.toml");
  model.simulate.start = Start::kAssembled;
  const double weight = 2 * kStandardGravity;
  model.joints[0].law = {"table", {{"displacement", {0, 1e-5, 3e-5, 1e-4}}, {"force", {0, 0.2 * weight, weight, 9 * weight}}, {"damping", {500}}}};
  const Trajectory run = completed(model);
  for (const std::size_t i : {std::size_t{0}, run.n_rows() - 1}) EXPECT_NEAR(run.at(i, run.column("body.ring.y")), -3e-5, 1e-11) << i;
}

// The load F sin(wt) and the angle a sin(wt) pass through zero together, where neither the magnitude of the force nor the speed is smooth at the same instants.
TEST(BearingLoads, ALoadInPhaseWithTheSwing) {
  for (const char* tolerance : {"1e-4", "1e-6"}) {
    const Trajectory run = completed(reference::test_model("swinging_roller_bearing", {std::string("simulate.tolerance=") + tolerance}));
    ASSERT_EQ(run.bearings.size(), 1u);
    const LoadSummary& pin = run.joints.front();
    const double p = 10.0 / 3, stated = std::max(pin.error_estimate, 2e-5 * 1000);  // the servo lags by that much
    EXPECT_NEAR(pin.mean, 2000 / kPi, stated) << tolerance;
    EXPECT_NEAR(run.bearings.front().equivalent_load, 1000 * std::pow(p + 1, -1 / p), stated) << tolerance;
  }
}

}  // namespace
}  // namespace pintle
