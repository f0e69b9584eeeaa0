// Every input that a fuzzer starts from or has ever found, and every model at hand, through the fuzzers' targets.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "results/disk.h"
#include "tests/fuzz/fuzz_targets.h"

namespace pintle::fuzz {
namespace {

namespace fs = std::filesystem;

const fs::path kTests = fs::path(PINTLE_SOURCE_DIR) / "tests";

int replay(const Target& target, const fs::path& folder, const std::string& extension = {}) {
  int n = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (!entry.is_regular_file() || (!extension.empty() && entry.path().extension() != extension)) continue;
    EXPECT_EQ(target.run(read_file(entry.path())), "") << entry.path();
    ++n;
  }
  return n;
}

class FuzzCorpus : public testing::TestWithParam<Target> {};

TEST_P(FuzzCorpus, KeepsItsPromises) {
  EXPECT_GE(replay(GetParam(), kTests / "fuzz" / GetParam().name), 3);
}

std::string name_of(const testing::TestParamInfo<Target>& target) {
  return target.param.name;
}

INSTANTIATE_TEST_SUITE_P(All, FuzzCorpus, testing::ValuesIn(kTargets), name_of);

TEST(FuzzModels, MechanismsAndBrokenModels) {
  EXPECT_GE(replay({"model_toml", model_toml}, kTests.parent_path() / "mechanisms", ".toml"), 20);
  EXPECT_GE(replay({"model_toml", model_toml}, kTests / "broken", ".toml"), 60);
  EXPECT_GE(replay({"model_json", model_json}, kTests / "broken", ".json"), 5);
}

}  // namespace
}  // namespace pintle::fuzz
