// Every file of the collection is read without a complaint, states how long to run, and is described in its README.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "pintle/complaint.h"
#include "pintle/read_model.h"

namespace pintle {
namespace {

namespace fs = std::filesystem;

const fs::path kCollection = fs::path(PINTLE_SOURCE_DIR) / "mechanisms";

std::vector<std::string> mechanism_names() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(kCollection))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::string text_of(const fs::path& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string complaints_of(const fs::path& path) {
  try {
    read_model(path.string());
    return {};
  } catch (const InputError& error) {
    std::string all;
    for (const Complaint& complaint : error.complaints()) all += to_text(complaint) + "\n";
    return all;
  }
}

class MechanismFile : public testing::TestWithParam<std::string> {
 protected:
  fs::path path() const { return kCollection / (GetParam() + ".toml"); }
};

TEST_P(MechanismFile, IsReadWithoutComplaint) { EXPECT_EQ(complaints_of(path()), ""); }

TEST_P(MechanismFile, SaysHowLongToRun) {
  const Model model = read_model(path().string());
  EXPECT_GT(model.simulate.duration, 0);
  EXPECT_FALSE(model.name.empty());
  EXPECT_FALSE(model.bodies.empty());
  EXPECT_FALSE(model.joints.empty());
}

// A mechanism of the collection starts from a stated position, so that assembly cannot pick another branch.
TEST_P(MechanismFile, StatesEveryPosition) {
  for (const Body& body : read_model(path().string()).bodies) {
    EXPECT_TRUE(body.position) << body.name;
    EXPECT_TRUE(body.angle) << body.name;
  }
}

TEST_P(MechanismFile, ExplainsItself) {
  const std::string text = text_of(path());
  EXPECT_EQ(text.rfind("# ", 0), 0u);
  EXPECT_NE(text.find("# Look at: "), std::string::npos);
  EXPECT_NE(text.find("# Numbers: "), std::string::npos);
  EXPECT_NE(text_of(kCollection / "README.md").find("(" + GetParam() + ".toml)"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Collection, MechanismFile, testing::ValuesIn(mechanism_names()),
                         [](const auto& file) { return file.param; });

}  // namespace
}  // namespace pintle
