#include "pintle/complaint.h"

#include <gtest/gtest.h>

#include <utility>

namespace pintle {
namespace {

Complaint complain(Place place, std::string path, std::string found, std::string because, std::string suggestion,
                   std::string source_line) {
  Complaint complaint;
  complaint.place = std::move(place);
  complaint.path = std::move(path);
  complaint.found = std::move(found);
  complaint.because = std::move(because);
  complaint.suggestion = std::move(suggestion);
  complaint.source_line = std::move(source_line);
  return complaint;
}

TEST(ComplaintText, ShowsPlaceReasonSuggestionAndCaret) {
  const Complaint complaint =
      complain({"four-bar.toml", 41, 13}, "joint.coupler_pin.stiffness", "-4.0e5 N/m",
               "a negative stiffness feeds energy into the mechanism", "400 N/mm", "stiffness = \"-400 N/mm\"");
  EXPECT_EQ(to_text(complaint),
            "four-bar.toml:41:13: joint.coupler_pin.stiffness\n"
            "    found -4.0e5 N/m: a negative stiffness feeds energy into the mechanism.\n"
            "    try: 400 N/mm\n"
            "  > 41 | stiffness = \"-400 N/mm\"\n"
            "                     ^");
}

TEST(ComplaintText, LeavesOutWhatIsUnknown) {
  EXPECT_EQ(to_text(complain({"a.toml", 0, 0}, "body.b", "", "the mass is missing.", "", "")),
            "a.toml: body.b\n    the mass is missing.");
  EXPECT_EQ(to_text(complain({"a.toml", 3, 0}, "", "x", "", "", "x")), "a.toml:3\n    found x.\n  > 3 | x");
  EXPECT_EQ(to_text(complain({"", 2, 1}, "k", "", "why", "", "")), "line 2:1: k\n    why.");
  EXPECT_EQ(to_text({}), "");
}

TEST(ComplaintText, CaretCountsCharactersAndKeepsTabs) {
  EXPECT_EQ(to_text(complain({"a", 1, 4}, "", "", "b", "", "\t\xC2\xB0\xC2\xB0x")),
            "a:1:4\n    b.\n  > 1 | \t\xC2\xB0\xC2\xB0x\n        \t  ^");
}

TEST(ComplaintText, ControlCharactersDoNotReachTheTerminal) {
  const std::string text = to_text({{"a", 1, 2},
                                    "k\x1B[2J",
                                    "\x1B]0;",
                                    "b\x07",
                                    "c\r",
                                    "d\x1B"
                                    "e"});
  for (const char c : text) EXPECT_TRUE(c == '\n' || static_cast<unsigned char>(c) >= 0x20U);
}

TEST(ComplaintText, LongLineIsCutAroundTheCaret) {
  const std::string line = std::string(400, 'a') + "X" + std::string(400, 'b');
  const std::string text = to_text(complain({"f", 7, 401}, "", "", "w", "", line));
  const std::size_t at_line = text.find("  > 7 | ");
  const std::size_t at_caret_line = text.find('\n', at_line) + 1;
  ASSERT_NE(at_line, std::string::npos);
  EXPECT_LT(text.size(), 300U);
  EXPECT_EQ(text.find('X') - at_line, text.find('^') - at_caret_line);
}

TEST(ComplaintText, ColumnBehindTheLineEndIsHarmless) {
  EXPECT_EQ(to_text(complain({"f", 1, 5}, "", "", "w", "", "ab")), "f:1:5\n    w.\n  > 1 | ab\n            ^");
  EXPECT_LT(to_text(complain({"f", 1, 2000000000}, "", "", "w", "", "ab")).size(), 300U);
}

TEST(InputErrorText, JoinsAllComplaints) {
  const InputError error(
      {complain({"a", 1, 0}, "p", "", "one", "", ""), complain({"a", 2, 0}, "q", "", "two", "", "")});
  EXPECT_STREQ(error.what(), "a:1: p\n    one.\na:2: q\n    two.");
  EXPECT_EQ(error.complaints().size(), 2U);
}

}  // namespace
}  // namespace pintle
