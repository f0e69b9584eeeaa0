#include "integrators/open_contacts.h"

#include <gtest/gtest.h>

#include <tuple>

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

// The error of the gap's own curve does not count: the gap of the bodies' positions replaces it.
TEST(OpenContacts, ASlackRopeFollowsThePositionsOfItsBodies) {
  const System system = pendulum_on_a_rope();
  const std::vector<double> states(static_cast<std::size_t>(system.n_law_states()));
  const Planar::Vec still = Planar::Vec::Zero();
  for (const auto& [gap, further, followed] : {std::tuple(-0.01, 1e-7, true), {-0.01, 1e-16, false}, {1e-5, 1e-7, false}}) {
    const Planar::Vec carried(gap, 0, 0);
    int replaced = 0;
    OpenContacts(system).follow_positions([&](int) { return LawPoint{0, carried, still, states.data()}; },
                                          [&](int) {
                                            std::vector<Planar::Motion> at_rest;
                                            system.motions(Vecs(system.bodies.size(), still), Vecs(system.bodies.size(), still), at_rest);
                                            JointKinematics r = system.kinematics(0, 0, at_rest);
                                            r.gap = carried + further * Planar::Vec::UnitX();
                                            return r;
                                          },
                                          [&](int) { return carried; }, 1, [&](int, const JointKinematics&) { ++replaced; });
    EXPECT_EQ(replaced, followed ? 1 : 0) << gap << " " << further;
  }
}

// A tenth of the displacement in the step by the last coefficient of the bodies' acceleration.
TEST(OpenContacts, WhatAStepDoesNotResolveOfAFlightIsNotKnown) {
  const System system = pendulum_on_a_rope();
  EXPECT_NEAR(error_of(system, -0.01, 0, 0, 1e-4), kTaut * 0.1 * 0.01 * 1e-4 / kLoad, 1e-12);
  EXPECT_NEAR(error_of(system, -0.01, 3e-8, 0, 1e-4), kTaut * 0.1 * 0.01 * 1e-4 / kLoad, 1e-12);
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
