#include "integrators/open_contacts.h"

#include <gtest/gtest.h>

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

// Where the rope has been integrated to, and how much further away its bodies are.
double error_of(const System& system, double gap, double further, double rounding) {
  LoadScale scale;
  scale.body.assign(system.bodies.size(), Planar::Vec::Constant(kLoad));
  const Planar::Vec carried(gap, 0, 0), still = Planar::Vec::Zero();
  const std::vector<double> states(static_cast<std::size_t>(system.n_law_states()));
  return OpenContacts(system).error([&](int) { return LawPoint{0, carried, still, states.data()}; }, [&](int) { return Planar::Vec(carried + further * Planar::Vec::UnitX()); },
                                    rounding, scale);
}

TEST(OpenContacts, ASlackRopeIsMeasuredByItsForceOnceItIsTaut) {
  const System system = pendulum_on_a_rope();
  for (const double further : {1e-7, -1e-7}) {
    EXPECT_NEAR(error_of(system, -0.01, further, 0), kTaut * 1e-7 / kLoad, 1e-12);
    EXPECT_NEAR(error_of(system, -0.01, further, 4e-8), kTaut * 6e-8 / kLoad, 1e-12);
    EXPECT_EQ(error_of(system, -0.01, further, 2e-7), 0);
    EXPECT_EQ(error_of(system, 1e-5, further, 0), 0) << "its force says what it is wrong by";
  }
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
