#include "base/text/utf8.h"

#include <gtest/gtest.h>

namespace pintle {
namespace {

TEST(Utf8, CountsCharacters) {
  EXPECT_EQ(count_characters(""), 0U);
  EXPECT_EQ(count_characters("abc"), 3U);
  EXPECT_EQ(count_characters("90\xC2\xB0 \xE2\x88\x92 \xF0\x9F\x98\x80"), 7U);
}

TEST(Utf8, CutsOneCharacter) {
  EXPECT_EQ(character_at("a\xC2\xB0z", 0), "a");
  EXPECT_EQ(character_at("a\xC2\xB0z", 1), "\xC2\xB0");
  EXPECT_EQ(character_at("a", 1), "");
  EXPECT_EQ(character_at("\x80\x80\x80\x80\x80\x80", 0).size(), 4U);
}

TEST(Utf8, PrintableKeepsTabsOnly) {
  EXPECT_EQ(printable("a\tb\nc\x1B\x7F"), "a\tb c  ");
}

}  // namespace
}  // namespace pintle
