// A slider with clearance knows its position under a load: on one wall, or tilted between both.
#include "laws/contact/guide_contact.h"

#include <gtest/gtest.h>

#include <cmath>

#include "laws/law.h"

namespace pintle {
namespace {

GuideContactLaw smooth_guide() {
  GuideContactLaw guide = GuideContactLaw::typical();
  guide.friction.coefficient = 0;
  return guide;
}

TEST(GuideContact, KnowsWhereItLiesUnderALoad) {
  const GuideContactLaw guide = smooth_guide();
  const BasicLaw<Planar> law(guide);
  for (const Planar::Vec& load : {Planar::Vec(0, 100, 0), Planar::Vec(0, -100, 1), Planar::Vec(0, 0.2, 0.02), Planar::Vec(0, -0.2, -0.02), Planar::Vec(0, 0, 3), Planar::Vec(0, 100, 2.499)}) {
    const std::optional<Planar::Vec> gap = law.gap_under(load);
    ASSERT_TRUE(gap);
    const Planar::Vec force = respond(law, *gap, Planar::Vec(Planar::Vec::Zero())).force;
    EXPECT_LT((force - load).norm(), 1e-4 * load.norm()) << load.transpose() << ": " << force.transpose();  // the tilt within the guide is small but not zero
  }
}

// With the whole load at one end, the other end touches the same wall. Without a load: in the middle.
TEST(GuideContact, AnEndThatCarriesNothingLiesOnTheOtherOnesSide) {
  const GuideContactLaw guide = smooth_guide();
  const std::optional<Planar::Vec> gap = guide.gap_under({0, 100, 50 * guide.length});
  ASSERT_TRUE(gap);
  EXPECT_NEAR((*gap)[1] - 0.5 * guide.length * std::sin((*gap)[2]), -guide.clearance, 1e-12);
  EXPECT_EQ(*guide.gap_under(Planar::Vec::Zero()), Planar::Vec(Planar::Vec::Zero()));
}

}  // namespace
}  // namespace pintle
