#include "io/writers.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "io/schema/schema.h"
#include "io/test_models.h"
#include "joints/catalog.h"
#include "laws/catalog.h"
#include "results/disk.h"

namespace pintle {
namespace {

void expect_round_trips(const std::string& text, const std::string& name) {
  const Document original = parse_document(text, name);
  const std::string json = to_json(original);
  const Document twin = parse_json(json, "x.json");
  EXPECT_TRUE(same_tree(original.root, twin.root)) << json;
  const std::string toml = to_toml(twin);
  const Document back = parse_toml(toml, "x.toml");
  EXPECT_TRUE(same_tree(original.root, back.root)) << toml;
  EXPECT_EQ(to_toml(back), toml);
  EXPECT_TRUE(nlohmann::json::accept(json)) << json;
}

TEST(Writers, ATreeComesBackTheSame) {
  expect_round_trips(kFullModel, "full.toml");
}

TEST(Writers, OddTreesComeBackToo) {
  expect_round_trips(R"toml("a b" = 1
"" = "quote \" slash \\ tab \t bell \u0007 é"
c = [[1, 2.0], [], {}, { x = [ { y = 'z' } ] }]
d.e.f.g = true
big = 9223372036854775807
small = -1e-300
minus = -0.0
lines = "a\nb\r\nc\"\"\""
tail = "a\\\n"
[[t]]
u = 1
[[t]]
u = 2
[p.q.r]
s = 1
[empty]
)toml",
                     "odd.toml");
}

TEST(Writers, JsonScalarsAfterObjectsStayAtTheirLevel) {
  expect_round_trips(R"({"a": {"b": {"c": 1}, "d": 2}, "e": 3, "f": {}})", "x.json");
}

TEST(Writers, TheCollectionComesBackAndFormatsStably) {
  for (const auto& file :
       std::filesystem::directory_iterator(std::filesystem::path(PINTLE_SOURCE_DIR) / "mechanisms")) {
    if (file.path().extension() != ".toml") continue;
    const std::string text = read_file(file.path());
    expect_round_trips(text, file.path().string());
    const std::string once = format_toml(text, "x.toml");
    EXPECT_EQ(format_toml(once, "x.toml"), once) << file.path();
  }
}

TEST(Format, PutsLayoutInOrder) {
  const std::string text =
      "\n\n# head\n  a=1   # one\nlong_key   =   [1,2 ,3]#two\n\n\n\n b = {x=1,y  =[ 2 ]}\n"
      "# about t\n[ t ]  # comment\nc . d = 'x'  \n[[ u ]]\n[[u]]\ne = [ # first\n 1,\n\n\n   [ 2,\n3 ], # last\n]\n"
      "s = \"\"\"\n  kept = as   it is\n\"\"\"\nempty = {  }\n\n";
  const std::string wanted =
      "# head\na = 1                 # one\nlong_key = [1, 2, 3]  #two\n\nb = { x = 1, y = [2] }\n\n"
      "# about t\n[t]  # comment\nc.d = 'x'\n\n[[u]]\n\n[[u]]\ne = [  # first\n  1,\n\n  [2,\n    3],  # last\n]\n"
      "s = \"\"\"\n  kept = as   it is\n\"\"\"\nempty = {}\n";
  EXPECT_EQ(format_toml(text, "x.toml"), wanted);
  EXPECT_EQ(format_toml(wanted, "x.toml"), wanted);
}

TEST(Format, KeepsEveryComment) {
  const std::string formatted = format_toml(kFullModel, "x.toml");
  EXPECT_NE(formatted.find("name = \"Four-bar\"  # with extras\n"), std::string::npos);
  EXPECT_EQ(format_toml(formatted, "x.toml"), formatted);
}

TEST(Format, WindowsLineEndsBecomePlain) {
  EXPECT_EQ(format_toml("a=1\r\n\r\nb=2 # c\r\n", "x.toml"), "a = 1\n\nb = 2  # c\n");
}

TEST(Format, RefusesWhatIsNotToml) {
  EXPECT_THROW(format_toml("a = = 1", "x.toml"), InputError);
}

// Every key of the schema and the catalogs.
std::vector<std::string> all_keys() {
  std::vector<std::string> keys;
  for (const TableSpec& table : Schema::model().tables()) {
    for (const KeySpec& key : table.keys) keys.push_back(key.key);
  }
  for (const JointTypeInfo& type : joint_type_catalog()) {
    keys.emplace_back(type.word);
    for (const KeyInfo& key : type.keys) keys.emplace_back(key.key);
  }
  for (const LawInfo& law : law_catalog()) {
    keys.emplace_back(law.word);
    for (const KeyInfo& key : law.keys) keys.emplace_back(key.key);
  }
  return keys;
}

TEST(JsonSchema, IsJsonAndMentionsEveryKey) {
  const std::string text = json_schema();
  const nlohmann::json schema = nlohmann::json::parse(text);
  EXPECT_EQ(schema["$schema"], "http://json-schema.org/draft-07/schema#");
  for (const std::string& key : all_keys()) EXPECT_NE(text.find('"' + key + '"'), std::string::npos) << key;
  const auto& joint = schema["properties"]["joint"]["additionalProperties"];
  EXPECT_EQ(joint["properties"]["stiffness"]["exclusiveMinimum"], 0);
  EXPECT_EQ(joint["properties"]["type"]["enum"].size(), joint_type_catalog().size());
  EXPECT_EQ(joint["additionalProperties"], false);
  EXPECT_EQ(schema["properties"]["body"]["additionalProperties"]["required"], nlohmann::json({"mass", "inertia"}));
}

TEST(ReferencePage, MentionsEveryKeyAndIsTheOneInTheDocs) {
  const std::string page = reference_markdown();
  for (const std::string& key : all_keys()) EXPECT_NE(page.find('`' + key + '`'), std::string::npos) << key;
  const auto path = std::filesystem::path(PINTLE_SOURCE_DIR) / "docs" / "reference" / "model-file.md";
  EXPECT_EQ(page, read_file(path)) << "renew it with: pintle schema --reference --out docs/reference/model-file.md";
}

}  // namespace
}  // namespace pintle
