#include "base/text/did_you_mean.h"

#include <gtest/gtest.h>

namespace pintle {
namespace {

TEST(EditDistance, CountsEdits) {
  EXPECT_EQ(edit_distance("", ""), 0U);
  EXPECT_EQ(edit_distance("", "abc"), 3U);
  EXPECT_EQ(edit_distance("abc", ""), 3U);
  EXPECT_EQ(edit_distance("mass", "mas"), 1U);
  EXPECT_EQ(edit_distance("mass", "mess"), 1U);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
}

TEST(EditDistance, ASwapOfNeighboursIsOneEdit) {
  EXPECT_EQ(edit_distance("mass", "amss"), 1U);
  EXPECT_EQ(edit_distance("angle", "anlge"), 1U);
  EXPECT_EQ(edit_distance("ca", "abc"), 3U);  // each letter is touched once
}

TEST(DidYouMean, FindsTheSlip) {
  const std::vector<std::string> keys{"stiffness", "damping", "angular_stiffness", "angular_damping", "between", "law"};
  EXPECT_EQ(did_you_mean("stifness", keys), "stiffness");
  EXPECT_EQ(did_you_mean("dampnig", keys), "damping");
  EXPECT_EQ(did_you_mean("Law", keys), "law");
  EXPECT_EQ(did_you_mean("angular_stifness", keys), "angular_stiffness");
  EXPECT_EQ(did_you_mean("stiff", keys), "stiffness");
}

TEST(DidYouMean, FindsTheLastOfSeveralWords) {
  const std::vector<std::string> keys{"stiffness", "damping", "free_length", "preload"};
  EXPECT_EQ(did_you_mean("length", keys), "free_length");
  EXPECT_EQ(did_you_mean("ngth", keys), std::nullopt);
}

TEST(DidYouMean, StaysSilentWhenNothingIsClose) {
  const std::vector<std::string> keys{"stiffness", "damping", "x"};
  EXPECT_EQ(did_you_mean("colour", keys), std::nullopt);
  EXPECT_EQ(did_you_mean("y", keys), std::nullopt);
  EXPECT_EQ(did_you_mean("", keys), std::nullopt);
  EXPECT_EQ(did_you_mean(std::string(100000, 'x'), keys), std::nullopt);
  EXPECT_EQ(did_you_mean("x", std::vector<std::string>{}), std::nullopt);
}

TEST(DidYouMean, NearestThenFirstWins) {
  const std::vector<std::string_view> words{"bat", "cat", "cart"};
  EXPECT_EQ(did_you_mean("cat", words), "cat");
  EXPECT_EQ(did_you_mean("hat", words), "bat");
}

}  // namespace
}  // namespace pintle
