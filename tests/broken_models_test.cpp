// The models of tests/broken through the program: each ends with the exit code, the place, the reason and the advice that tests/broken/expected.toml promises;
// none crashes it or takes long.
#include <gtest/gtest.h>

#include <toml++/toml.h>
#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "cli/sandbox_for_tests.h"
#include "pintle/read_model.h"

namespace pintle::sample {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = fs::path(PINTLE_SOURCE_DIR) / "tests" / "broken";

struct Expected {
  std::string file;
  int exit = 0;
  std::string at, path, because, suggestion;
};

std::vector<Expected> all_expected() {
  std::vector<Expected> all;
  for (const auto& [key, node] : toml::parse_file((kFolder / "expected.toml").string())) {
    const toml::table& table = *node.as_table();
    const auto text = [&table](const char* name) { return table[name].value_or(std::string()); };
    all.push_back({std::string(key.str()), table["exit"].value_or(0), text("at"), text("path"), text("because"),
                   text("suggestion")});
  }
  return all;
}

std::string test_name(const testing::TestParamInfo<Expected>& info) {
  std::string name = info.param.file;
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

class BrokenModel : public testing::TestWithParam<Expected> {
 protected:
  BrokenModel() { fs::copy_file(kFolder / GetParam().file, sandbox_ / GetParam().file); }
  Answer run() { return sandbox_.shell("timeout 60 \"$PINTLE\" run " + GetParam().file + " --quiet --out out"); }
  Sandbox sandbox_;
};

TEST_P(BrokenModel, EndsAsPromised) {
  const Expected& expected = GetParam();
  const Answer answer = run();
  EXPECT_EQ(answer.exit_code, expected.exit) << answer.error;
  EXPECT_EQ(answer.out, "");
  EXPECT_FALSE(holds(answer.error, "internal error")) << answer.error;
  EXPECT_TRUE(holds(answer.error, expected.file + (expected.at.empty() ? "" : ":" + expected.at))) << answer.error;
  EXPECT_TRUE(holds(answer.error, expected.because)) << answer.error;
  EXPECT_TRUE(holds(answer.error, expected.suggestion)) << answer.error;
  EXPECT_FALSE(expected.because.empty());
  EXPECT_FALSE(expected.suggestion.empty());
}

// Exit code 3: one complaint contains all of it, and none of the others lacks a place, a reason or advice.
TEST_P(BrokenModel, IsLocatedAndExplained) {
  const Expected& expected = GetParam();
  if (expected.exit != 3 || expected.file.starts_with("duration_missing")) return;
  try {
    parse_model(read_file(kFolder / expected.file), expected.file);
    FAIL() << "no complaint";
  } catch (const InputError& error) {
    EXPECT_LE(error.complaints().size(), 3U);
    const auto is_it = [&expected](const Complaint& c) {
      return fmt::format("{}:{}", c.place.line, c.place.column) == expected.at && c.path == expected.path &&
             holds(c.because, expected.because) && holds(c.suggestion, expected.suggestion);
    };
    EXPECT_TRUE(std::any_of(error.complaints().begin(), error.complaints().end(), is_it)) << error.what();
    for (const Complaint& c : error.complaints()) {
      EXPECT_GE(c.place.line, 1) << to_text(c);
      EXPECT_GE(c.place.column, 1) << to_text(c);
      EXPECT_FALSE(c.because.empty() || c.suggestion.empty()) << to_text(c);
    }
  }
}

// Exit code 5: the results up to the failure are there, and say so.
TEST_P(BrokenModel, KeepsResultsUpToTheFailure) {
  if (GetParam().exit != 5) return;
  run();
  const Trajectory trajectory = read_run(sandbox_ / "out").trajectory;
  EXPECT_EQ(trajectory.outcome, Outcome::kFailed);
  EXPECT_GE(trajectory.n_rows(), 1U);
  EXPECT_TRUE(holds(trajectory.message, "t = ")) << trajectory.message;
  EXPECT_TRUE(holds(trajectory.message, "joint") || holds(trajectory.message, "force")) << trajectory.message;
}

INSTANTIATE_TEST_SUITE_P(All, BrokenModel, testing::ValuesIn(all_expected()), test_name);

TEST(BrokenModels, AreAllListed) {
  std::set<std::string> listed, there;
  for (const Expected& expected : all_expected()) listed.insert(expected.file);
  for (const auto& entry : fs::directory_iterator(kFolder))
    if (entry.path().filename() != "expected.toml") there.insert(entry.path().filename());
  EXPECT_EQ(listed, there);
  EXPECT_GE(there.size(), 100U);
}

TEST(BrokenModels, AHugeFileIsRefusedAtOnce) {
  Sandbox sandbox;
  const Answer answer = sandbox.shell("truncate -s 8G huge.toml; timeout 60 \"$PINTLE\" run huge.toml");
  EXPECT_EQ(answer.exit_code, 3) << answer.error;
  EXPECT_TRUE(holds(answer.error, "huge.toml:1:1")) << answer.error;
  EXPECT_TRUE(holds(answer.error, "at most 64 MB")) << answer.error;
}

TEST(BrokenModels, ManyMistakesAreAllNamed) {
  Sandbox sandbox;
  std::string text = "format = 1\n[body.a]\nmass = 1\ninertia = 1\n[parameters]\n";
  for (int i = 0; i < 20000; ++i) text += fmt::format("p{} = \"1 parsec\"\n", i);
  sandbox.write("many.toml", text);
  const Answer answer = sandbox.shell("timeout 60 \"$PINTLE\" run many.toml");
  EXPECT_EQ(answer.exit_code, 3);
  EXPECT_TRUE(holds(answer.error, "many.toml:20005:")) << answer.error.substr(0, 1000);
}

TEST(BrokenModels, WhatIsNoFile) {
  Sandbox sandbox;
  fs::create_directory(sandbox / "folder.toml");
  for (const char* model : {"absent.toml", "folder.toml", "''"}) {
    const Answer answer = sandbox.pintle(fmt::format("run {}", model));
    EXPECT_EQ(answer.exit_code, 6) << model;
    EXPECT_FALSE(answer.error.empty());
  }
}

}  // namespace
}  // namespace pintle::sample
