#include "base/text/name_patterns.h"

#include <gtest/gtest.h>

namespace pintle {
namespace {

TEST(NamePatterns, AStarStandsForAnyLettersOrNone) {
  EXPECT_TRUE(matches_pattern("joint.*", "joint.A"));
  EXPECT_TRUE(matches_pattern("joint.A*", "joint.A"));
  EXPECT_TRUE(matches_pattern("*.B*left", "joint.B1left"));
  EXPECT_TRUE(matches_pattern("*a*ab", "aab"));  // the first * must match more letters
  EXPECT_TRUE(matches_pattern("**", ""));
  EXPECT_FALSE(matches_pattern("joint.*", "body.joint.A"));
  EXPECT_FALSE(matches_pattern("*.left", "joint.lefty"));
  EXPECT_FALSE(matches_pattern("", "a"));
}

TEST(NamePatterns, NamesAndPatternsTogether) {
  const NamePatterns chosen({"joint.A", "body.crank*"});
  EXPECT_TRUE(chosen.match("joint.A"));
  EXPECT_TRUE(chosen.match("body.crank7"));
  EXPECT_FALSE(chosen.match("joint.AB"));
  EXPECT_FALSE(NamePatterns({}).match("joint.A"));
}

}  // namespace
}  // namespace pintle
