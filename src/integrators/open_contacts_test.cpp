#include "integrators/open_contacts.h"

#include <gtest/gtest.h>

#include "integrators/thresholds.h"
#include "laws/tension.h"
#include "system/sample_systems_for_tests.h"

namespace pintle {
namespace {

constexpr double kTaut = 1e6, kLoad = 50;  // [N/m], [N]

System pendulum_on_a_rope() {
  System system = build_system(sample::pendulum(1e8, 0));
  TensionLaw rope;
  rope.k = kTaut;
  system.joints[0].law = BasicLaw<Planar>(rope);
  system.finish();
  return system;
}

// The rope's gap as integrated, how much further apart its bodies are, and the last coefficient of their acceleration along it over a step of 0.1 s.
double error_of(const System& system, double gap, double further, double far, double bend = 0) {
  LoadScale scale;
  scale.body.assign(system.bodies.size(), Planar::Vec::Constant(kLoad));
  const Planar::Vec carried(gap, 0, 0), still = Planar::Vec::Zero();
  const std::vector<double> states(static_cast<std::size_t>(system.n_law_states()));
  const auto kinematics = [&](int) {
    std::vector<Planar::Motion> at_rest;
    system.motions(Vecs(system.bodies.size(), still), Vecs(system.bodies.size(), still), at_rest);
    JointKinematics r = system.kinematics(0, 0, at_rest);
    r.gap = carried + further * Planar::Vec::UnitX();
    return r;
  };
  return OpenContacts(system).error(0.1, [&](int) { return LawPoint{0, carried, still, states.data()}; }, kinematics, [&](int) { return Planar::Vec(bend * Planar::Vec::UnitX()); }, far, scale);
}

TEST(OpenContacts, ASlackRopeIsMeasuredByItsForceOnceItIsTaut) {
  const System system = pendulum_on_a_rope();
  for (const double further : {1e-7, -1e-7}) {
    EXPECT_NEAR(error_of(system, -0.01, further, 0), kTaut * 1e-7 / kLoad, 1e-12);
    EXPECT_NEAR(error_of(system, -0.01, further, 4e-8 / kLastBits), kTaut * 6e-8 / kLoad, 1e-12);
    EXPECT_EQ(error_of(system, -0.01, further, 2e-7 / kLastBits), 0);
    EXPECT_EQ(error_of(system, 1e-5, further, 0), 0) << "its force says what it is wrong by";
  }
}

// A tenth of the displacement in the step by the last coefficient of the bodies' acceleration.
TEST(OpenContacts, WhatAStepDoesNotResolveOfAFlightIsNotKnown) {
  const System system = pendulum_on_a_rope();
  EXPECT_NEAR(error_of(system, -0.01, 0, 0, 1e-4), kTaut * 0.1 * 0.01 * 1e-4 / kLoad, 1e-12);
  EXPECT_NEAR(error_of(system, -0.01, 3e-8, 0, 1e-4), kTaut * 0.1 * 0.01 * 1e-4 / kLoad, 1e-12) << "the larger of the two";
  EXPECT_EQ(error_of(system, 1e-5, 0, 0, 1e-4), 0);
}

TEST(OpenContacts, SpringsAndIdealJointsAreNone) {
  EXPECT_TRUE(OpenContacts(build_system(sample::pendulum(1e8, 0))).empty());
  System system = pendulum_on_a_rope();
  EXPECT_FALSE(OpenContacts(system).empty());
  system.joints[0].ideal = true;
  EXPECT_TRUE(OpenContacts(system).empty());
}

}  // namespace
}  // namespace pintle
