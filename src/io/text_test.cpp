// How messages quote text from a file.
#include "io/text.h"

#include <gtest/gtest.h>

#include <string>

namespace pintle {
namespace {

TEST(Quotes, ALongTextIsCutWhereACharacterBegins) {
  const std::string letters(100, 'a');
  EXPECT_EQ(in_quotes("short"), "\"short\"");
  EXPECT_EQ(in_quotes(letters.substr(0, 60)), '"' + letters.substr(0, 60) + '"');
  EXPECT_EQ(in_quotes(letters), '"' + letters.substr(0, 60) + "\"...");
  EXPECT_EQ(in_quotes(letters.substr(0, 59) + "\u00fcber"), '"' + letters.substr(0, 59) + "\"...");  // the second byte of the letter would be at 60
  EXPECT_EQ(in_quotes(std::string(100, '\x80')), "\"\"...");  // no character begins anywhere
}

TEST(Quotes, SpecialCharactersAreWrittenAsInAFile) {
  EXPECT_EQ(quoted_exactly("a\"b\\c\nd"), "\"a\\\"b\\\\c\\nd\"");
}

}  // namespace
}  // namespace pintle
