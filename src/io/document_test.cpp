#include "io/document.h"

#include <gtest/gtest.h>

#include "results/disk.h"

namespace pintle {
namespace {

const Node& at(const Document& document, std::initializer_list<const char*> path) {
  const Node* node = &document.root;
  for (const char* key : path) node = node->table()->find(key);
  return *node;
}

void expect_spot(const Spot& spot, int line, int column) {
  EXPECT_EQ(spot.line, line);
  EXPECT_EQ(spot.column, column);
}

std::string first_complaint(const std::string& text, const std::string& file) {
  try {
    parse_document(text, file);
  } catch (const InputError& error) {
    const Place& place = error.complaints().front().place;
    return std::to_string(place.line) + ":" + std::to_string(place.column) + " " + error.complaints().front().found;
  }
  return "none";
}

TEST(Document, TomlKeepsTheOrderOfKeys) {
  const Document document = parse_document("z = 1\na = 2\n[m]\ny = 3\nb = 4\n[c.d]\n[c.a]\n", "x.toml");
  std::string order;
  for (const Entry& entry : document.root.table()->entries()) order += entry.key;
  for (const Entry& entry : at(document, {"m"}).table()->entries()) order += entry.key;
  for (const Entry& entry : at(document, {"c"}).table()->entries()) order += entry.key;
  EXPECT_EQ(order, "zamcybda");
}

TEST(Document, TomlValuesKnowTheirPlaces) {
  const Document document = parse_document("\"é\" = \"ü m\"\nb = [1, 'two']\nc = { d = true }\n", "x.toml");
  expect_spot(at(document, {"b"}).spot, 2, 5);
  expect_spot((*at(document, {"b"}).array())[1].spot, 2, 10);
  expect_spot(at(document, {"c", "d"}).spot, 3, 11);
}

// The schema is read without the guard, which it does not need.
TEST(Document, TheGuardHasNothingAgainstTheSchema) {
  const std::string schema = read_file(PINTLE_SOURCE_DIR "/schema/model.schema.toml");
  EXPECT_TRUE(same_tree(parse_toml(schema, "model.schema.toml").root, parse_own_toml(schema, "model.schema.toml").root));
}

TEST(Document, JsonValuesKnowTheirPlaces) {
  const Document document = parse_document("{\"a\": 1,\n \"b\": [true, \"x\"],\n \"é\": {\"c\": -2.5e1}}", "x.json");
  expect_spot(at(document, {"a"}).spot, 1, 7);
  expect_spot((*at(document, {"b"}).array())[1].spot, 2, 15);
  expect_spot(at(document, {"é", "c"}).spot, 3, 13);
  EXPECT_EQ(*at(document, {"é", "c"}).real(), -25);
}

TEST(Document, OffsetsInStringsBecomePlaces) {
  const std::string text = "a = \"\\u00b5\\tx\"\nb = '\\tx'\nc = \"\"\"\none\ntwo\"\"\"\nd = \"µx\"\n";
  const Document document = parse_document(text, "x.toml");
  expect_spot(document.inside(at(document, {"a"}), 3), 1, 14);  // two bytes of µ, one of the tab
  expect_spot(document.inside(at(document, {"b"}), 2), 2, 8);
  expect_spot(document.inside(at(document, {"c"}), 4), 5, 1);
  expect_spot(document.inside(at(document, {"d"}), 2), 6, 7);
}

TEST(Document, JsonStringsKnowAllEscapes) {
  const Document document = parse_document(R"({"a": "\"\\\/\b\f\n\r\t\u00e9\ud83d\ude00"})", "x.json");
  EXPECT_EQ(*at(document, {"a"}).string(), "\"\\/\b\f\n\r\té😀");
}

TEST(Document, TheFormIsFoundWithoutAnEnding) {
  EXPECT_NE(parse_document(" {\"a\": 1}", "-").root.table()->find("a"), nullptr);
  EXPECT_NE(parse_document("a = 1", "-").root.table()->find("a"), nullptr);
  EXPECT_NE(parse_document("\xEF\xBB\xBF"
                           "a = 1",
                           "x.toml")
                .root.table()
                ->find("a"),
            nullptr);
}

TEST(Document, BigTablesFindTheirKeys) {
  std::string text;
  for (int i = 0; i < 100; ++i) text += "k" + std::to_string(i) + " = " + std::to_string(i) + "\n";
  const Document document = parse_document(text, "x.toml");
  EXPECT_EQ(*at(document, {"k57"}).integer(), 57);
  EXPECT_EQ(document.root.table()->find("k100"), nullptr);
}

TEST(Document, UnreadableTextIsLocated) {
  EXPECT_EQ(first_complaint("", "x.toml"), "1:1 an empty file");
  EXPECT_EQ(first_complaint("a = 1\nb = \"é\xff\"", "x.toml"), "2:7 a byte that is not UTF-8");
  EXPECT_EQ(first_complaint("a = 1\na = 2\n", "x.toml").substr(0, 6), "2:1 a ");
  EXPECT_EQ(first_complaint("a = 25 mm\n", "x.toml"), "1:8 \"mm\"");
  EXPECT_EQ(first_complaint("# é\na.é = 1\n", "x.toml"), "2:3 \"é\"");
  EXPECT_EQ(first_complaint("b = 1\n[ = ]\n", "x.toml"), "2:3 \"=\"");
  EXPECT_EQ(first_complaint("b = [1, }\n", "x.toml"), "1:9 \"}\"");
  EXPECT_EQ(first_complaint("b = { c = 1,\n d = 2 }\n", "x.toml"), "1:13 the end of the line");
  EXPECT_EQ(first_complaint("b = \n", "x.toml"), "1:5 the end of the line");
  EXPECT_EQ(first_complaint("b\n", "x.toml"), "1:2 the end of the line");
  EXPECT_EQ(first_complaint("b = [1", "x.toml"), "1:7 the end of the file");
  EXPECT_EQ(first_complaint("[[\n", "x.toml"), "1:3 the end of the line");
  EXPECT_EQ(first_complaint("a = 1979-05-27\n", "x.toml"), "1:5 a date or a time");
  EXPECT_EQ(first_complaint("a = nan\n", "x.toml"), "1:5 nan");
  EXPECT_EQ(first_complaint("{\"a\": 1e999}", "x.json"), "1:7 1e999");
  EXPECT_EQ(first_complaint("{\"a\": null}", "x.json"), "1:7 null");
  EXPECT_EQ(first_complaint("{\"a\": 1, \"a\": 2}", "x.json"), "1:10 a second definition of the same key");
  EXPECT_EQ(first_complaint("{\"a\": 01}", "x.json"), "1:7 \"01\"");
  EXPECT_EQ(first_complaint("{\"a\": \"\n\"}", "x.json"), "1:8 a string without closing quotes");
  EXPECT_EQ(first_complaint("{\"a\": \"\\ud800\"}", "x.json"), "1:14 an unknown escape");
  EXPECT_EQ(first_complaint("{\"a\": 1} x", "x.json"), "1:10 text after the closing brace");
  EXPECT_EQ(first_complaint("{\"a\": [1, 2}", "x.json"), "1:12 \"}\"");
}

TEST(Document, EndlessNestingIsRefused) {
  std::string dots = "a";
  for (int i = 0; i < 100000; ++i) dots += ".a";
  EXPECT_EQ(first_complaint("b = 1\n" + dots + " = 1", "x.toml"), "2:1 a key of too many dotted parts");
  EXPECT_EQ(first_complaint("[" + dots + "]", "x.toml"), "1:2 a key of too many dotted parts");
  EXPECT_NE(first_complaint("a = " + std::string(100000, '['), "x.toml"), "none");
  EXPECT_EQ(first_complaint("{\"a\": " + std::string(100000, '['), "x.json").substr(0, 5), "1:71 ");
  EXPECT_NE(first_complaint("a = " + std::string(100, '[') + std::string(100, ']'), "x.toml"), "none");
}

}  // namespace
}  // namespace pintle
