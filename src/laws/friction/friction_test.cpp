// Friction laws: values by hand, normal loads, refused values.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "laws/friction/brown_mcphee.h"
#include "laws/catalog.h"
#include "laws/friction/coulomb.h"
#include "laws/law.h"
#include "laws/friction/stribeck.h"

namespace pintle {
namespace {

using Vec = Planar::Vec;

// A slide on a spring that provides the reaction, at the speed v along it.
template <class P>
double friction_law_force(P law, const Vec& reaction, double v) {
  law.free = 0;
  law.radius = 1;
  Law joint(LinearLaw{{0, 1e6, 1e3}, {0, 0, 0}});
  joint.add(std::make_unique<LawPartOf<P>>(law));
  const Vec gap(0, -reaction[1] / 1e6, -reaction[2] / 1e3), rate(v, 0, 0);
  double state = 0;
  joint.rest({0, gap, rate, &state}, &state);
  return joint.force({0, gap, rate, &state})[0];
}

TEST(BrownMcPheeLaw, ByHand) {
  BrownMcPheeLaw law;
  law.viscous = 2;
  const Vec pressed(0, 100, 0);
  // The second term is 1 at v_t and 2 / 1.75^2 at twice that; the viscous one is 0.002 and 0.004 of the load.
  EXPECT_NEAR(friction_law_force(law, pressed, 1e-3), -100 * (0.1 * std::tanh(4.0) + 0.05 + 0.002), 1e-12);
  EXPECT_NEAR(friction_law_force(law, pressed, -2e-3), 100 * (0.1 * std::tanh(8.0) + 0.05 * 0.65306122448979592 + 0.004), 1e-12);
  EXPECT_NEAR(friction_law_force(law, pressed, 10), -100 * (0.1 + 20), 1e-9 * 2000);
}

TEST(StribeckLaw, ByHand) {
  StribeckLaw law;
  law.preload = 7;
  const Vec pressed(0, -93, 0);
  EXPECT_NEAR(friction_law_force(law, pressed, 1e-4), -100 * (0.1 + 0.05 * std::exp(-0.01)) * 0.76159415595576489, 1e-12);
  EXPECT_NEAR(friction_law_force(law, pressed, -1e-3), 100 * (0.1 + 0.05 / M_E) * std::tanh(10.0), 1e-12);
  EXPECT_NEAR(friction_law_force(law, pressed, 1), -10, 1e-12);
}

// A slide with a normal load of 100 N: it breaks at 15 N, a stretch of 150 um, and slips with 10 N. Where the slip reverses it sticks, with
// continuous friction.
TEST(CoulombLaw, SticksBreaksAndSticksAgain) {
  CoulombLaw law;
  law.free = 0;
  law.radius = 1;
  law.stiffness = 1e5;
  law.damping = 50;
  Law joint(LinearLaw{{0, 1e6, 0}, {0, 0, 0}});
  joint.add(std::make_unique<LawPartOf<CoulombLaw>>(law));
  double state[2], rate[2], before[3], after[3], lost = 0;
  const Vec gap(0.5, -1e-4, 0), still = Vec::Zero(), creep(1e-4, 0, 0), slip(0.2, 0, 0), back(-1e-9, 0, 0);
  const auto at = [&](const Vec& speed) { return LawPoint{0, gap, speed, state}; };
  const auto crosses = [&](const Vec& speed) {
    joint.borders(at(speed), after);
    bool any = false;
    for (int b = 0; b < joint.n_borders(); ++b) {
      const int direction = joint.parts()[0]->border_direction(b);
      if ((before[b] > 0) == (after[b] > 0) || (direction != 0 && (direction > 0) != (after[b] > 0))) continue;
      joint.cross(at(speed), 0, b, state, lost);
      any = true;
    }
    return any;
  };
  joint.rest(at(still), state);
  EXPECT_EQ(joint.force(at(still))[0], 0);
  joint.borders(at(still), before);
  EXPECT_NEAR(before[0], 15, 1e-8);
  state[0] = 149e-6;
  EXPECT_FALSE(crosses(still));
  EXPECT_NEAR(joint.force(at(creep))[0], -14.9 - 50e-4, 1e-9);
  joint.state_rates(at(creep), rate);
  EXPECT_EQ(rate[0], 1e-4);
  state[0] = 151e-6;
  EXPECT_TRUE(crosses(still));
  EXPECT_NEAR(joint.force(at(slip))[0], -10, 1e-9);
  EXPECT_NEAR(joint.loss(at(slip)), 2, 1e-9);
  joint.state_rates(at(slip), rate);
  EXPECT_EQ(rate[0], 0);

  joint.borders(at(slip), before);
  EXPECT_FALSE(crosses(slip));
  EXPECT_TRUE(crosses(back));
  EXPECT_NEAR(joint.force(at(back))[0], -10, 1e-9);
  EXPECT_NEAR(state[0], 100e-6, 1e-12);
  EXPECT_NEAR(lost, 0.5 * 1e5 * (151e-6 * 151e-6 - state[0] * state[0]), 1e-12);  // energy of the spring, which broke and sticks again
}

// Loaded to 12 N by its spring, moving back at 2 mm/s while the normal load falls to 60 N, which holds 9 N and gives 6 N of kinetic friction: it continues to be pushed back, by
// the kinetic friction, and sticks again when the spring force has fallen to that.
TEST(StickSlip, AFrictionThatBreaksOnTheWayBackRebounds) {
  const StickSlip surfaces{0.1, 0.15, 0, 1e5, 0};
  double state[StickSlip::kStates] = {120e-6, 0}, border[StickSlip::kBorders];
  const double back = -2e-3, N = 60;
  surfaces.borders(back, N, state, border);
  EXPECT_LT(border[0], 0);
  surfaces.cross(0, back, N, state);
  const StickSlipForce<double> f = surfaces.force(back, N, state);
  EXPECT_NEAR(f.friction, 6, 1e-12);
  EXPECT_EQ(f.stretch_rate, back);
  EXPECT_NEAR(f.energy, 0.5 * 1e5 * 120e-6 * 120e-6, 1e-15);
  EXPECT_NEAR(f.loss, 2e-3 * (12 - 6), 1e-12);  // the spring gives 24 mW, of which 12 mW drive the bodies
  surfaces.borders(back, N, state, border);
  EXPECT_NEAR(border[1], 6, 1e-9);
  EXPECT_GT(border[2], 0);
  state[0] = 59.9e-6;
  surfaces.borders(back, N, state, border);
  EXPECT_LT(border[1], 0);
  surfaces.cross(1, back, N, state);
  EXPECT_TRUE(StickSlip::sticks(state));
  EXPECT_EQ(state[0], 59.9e-6);
}

// Without a normal load they do not stick again: stuck with more than they can carry, no border would ever release them.
TEST(StickSlip, WhatReboundsUnderNoLoadSlipsOn) {
  const StickSlip surfaces{0.1, 0.15, 0, 1e8, 3e3};
  double state[StickSlip::kStates] = {-1.08e-11, -2}, border[StickSlip::kBorders];
  surfaces.cross(1, 1.08e-8, 0, state);
  EXPECT_FALSE(StickSlip::sticks(state));
  EXPECT_EQ(surfaces.force(1.0, 0.0, state).friction, 0);
  surfaces.borders(1.08e-8, 0, state, border);
  EXPECT_GT(*std::min_element(border, border + StickSlip::kBorders), 0);
}

// It may turn forward before that, and then slips like any other.
TEST(StickSlip, WhatReboundsMayTurnForward) {
  const StickSlip surfaces{0.1, 0.15, 0, 1e5, 0};
  double state[StickSlip::kStates] = {-120e-6, 0}, border[StickSlip::kBorders];
  surfaces.cross(0, 1e-3, 60, state);
  EXPECT_NEAR(surfaces.force(1e-3, 60.0, state).friction, -6, 1e-12);
  surfaces.borders(-1e-9, 60, state, border);
  EXPECT_LT(border[2], 0);
  surfaces.cross(2, -1e-9, 60, state);
  const StickSlipForce<double> f = surfaces.force(-0.1, 60.0, state);
  EXPECT_NEAR(f.friction, -6, 1e-12);
  EXPECT_EQ(f.stretch_rate, 0);
  EXPECT_NEAR(f.loss, 0.6, 1e-12);
}

// At a start slow slips have no meaning: without a normal load, the damper of a stuck joint would push by more than the surfaces can carry.
TEST(Coulomb, BeginsWithoutFrictionWhereNothingPresses) {
  CoulombLaw law;
  law.free = 0;
  law.radius = 1;
  Law joint(LinearLaw{{0, 1e6, 0}, {0, 0, 0}});
  joint.add(std::make_unique<LawPartOf<CoulombLaw>>(law));
  double state[2], border[StickSlip::kBorders];
  const Vec gap = Vec::Zero(), slow(1e-8, 0, 0);
  joint.rest({0, gap, slow, state}, state);
  EXPECT_TRUE(StickSlip::sticks(state));
  EXPECT_NEAR(joint.force({0, gap, slow, state})[0], 0, 1e-18);
  joint.borders({0, gap, slow, state}, border);
  EXPECT_GT(border[0], 0);
}

// 100 N across a guide of 50 mm: a moment below 2.5 N m leaves both edges loaded on the same side, 10 N m load them with 200 N each.
TEST(Friction, MomentPressesTheEdgesOfAGuide) {
  StribeckLaw law;
  for (const double moment : {0.0, 2.4, -2.4, 10.0, -10.0}) {
    law.guide = 0.05;
    const double load = std::abs(moment) < 2.5 ? 100 : 400;
    EXPECT_NEAR(friction_law_force(law, {0, 100, moment}, 1), -0.1 * load, 1e-12) << moment;
    EXPECT_NEAR(friction_law_force(law, {0, -100, moment}, 1), -0.1 * load, 1e-12) << moment;
    law.guide = 0;
    EXPECT_NEAR(friction_law_force(law, {0, 100, moment}, 1), -10, 1e-12) << moment;
  }
}

TEST(Friction, RefusesAPinWithoutRadiusOrWithAGuideAndSlipHeldMoreFirmlyThanRest) {
  for (const char* word : {"lugre", "coulomb", "brown-mcphee", "stribeck"}) {
    const LawInfo& info = *find_law(word);
    const std::map<std::string, std::vector<double>> guide{{"guide_length", {0.1}}, {"pin_radius", {0.01}}}, pin{{"pin_radius", {0.01}}}, weak{{"static_friction", {0.05}}}, none;
    LawSetting at;
    at.values = &none;
    at.keys = info.keys;
    at.joint_type = "revolute";
    at.held = {true, true, false};
    at.free = {false, false, true};
    EXPECT_EQ(info.fault(at).key, "pin_radius");
    at.values = &pin;
    EXPECT_EQ(info.fault(at).key, "");
    at.values = &guide;
    EXPECT_EQ(info.fault(at).key, "guide_length");
    at.free = {true, false, false};
    at.held = {false, true, true};
    EXPECT_EQ(info.fault(at).key, "");
    at.values = &weak;
    EXPECT_EQ(info.fault(at).key, "static_friction");
  }
}

}  // namespace
}  // namespace pintle
