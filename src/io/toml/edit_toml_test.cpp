// Changes of values in a file's text.
#include "io/toml/edit_toml.h"

#include <gtest/gtest.h>

#include "io/document.h"
#include "pintle/complaint.h"

namespace pintle {
namespace {

constexpr const char* kText = R"(# head
[joint.A]   # a pin
type = "revolute"
stiffness = "1e8 N/m"   # of its catalog
list = [ 1,  # one
  2 ]

[joint.B]
type = "slot" # last

[simulate]
duration = 1
)";

TEST(EditToml, ReplacesAValueAndNothingElse) {
  const std::string text = with_value(kText, "m.toml", {"joint", "A", "stiffness"}, "\"2e9 N/m\"");
  std::string expected = kText;
  expected.replace(expected.find("1e8"), 3, "2e9");
  EXPECT_EQ(text, expected);
}

TEST(EditToml, AddsALineAtTheEndOfTheTable) {
  const std::string text = with_value(kText, "m.toml", {"joint", "B", "damping"}, "\"500 N*s/m\"");
  std::string expected = kText;
  expected.insert(expected.find("\n\n[simulate]"), "\ndamping = \"500 N*s/m\"");
  EXPECT_EQ(text, expected);
  EXPECT_EQ(with_value(text, "m.toml", {"joint", "B", "damping"}, "\"500 N*s/m\""), text);
}

TEST(EditToml, ReplacesAListOverSeveralLines) {
  const std::string text = with_value(kText, "m.toml", {"joint", "A", "list"}, "[3]");
  EXPECT_NE(text.find("list = [3]\n\n[joint.B]"), std::string::npos) << text;
}

TEST(EditToml, RefusesAnInlineTable) {
  EXPECT_THROW(with_value("[joint]\nA = { type = \"revolute\" }\n", "m.toml", {"joint", "A", "stiffness"}, "1"), InputError);
}

TEST(EditToml, KnowsJson) {
  const std::string text = with_value("{\"joint\": {\"A\": {\"type\": \"revolute\"}}}", "m.json", {"joint", "A", "stiffness"}, "\"2e9 N/m\"");
  const Document document = parse_document(text, "m.json");
  const Node* joint = document.root.table()->find("joint")->table()->find("A");
  EXPECT_EQ(*joint->table()->find("stiffness")->string(), "2e9 N/m");
}

}  // namespace
}  // namespace pintle
