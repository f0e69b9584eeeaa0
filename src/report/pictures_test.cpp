// Compares pictures with those in tests/pictures, which were checked by eye. A picture that has changed is written to out/pictures; if it is correct, it
// replaces the old one.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "report/drawn_run_for_tests.h"
#include "report/poses.h"
#include "report/scene.h"
#include "report/still.h"

namespace pintle {
namespace {

constexpr double kPixels = 0.1;  // tolerance of a coordinate, for differences that compilers and processors make to a run

// Where two texts differ by more than rounding does in their numbers; npos: nowhere.
std::size_t first_difference(const std::string& a, const std::string& b) {
  const auto starts_number = [](const std::string& s, std::size_t i) {
    const bool digit = std::isdigit(static_cast<unsigned char>(s[i])) != 0, sign = s[i] == '-' && i + 1 < s.size() && std::isdigit(static_cast<unsigned char>(s[i + 1])) != 0;
    return (digit || sign) && (i == 0 || s[i - 1] != '#');  // a colour is not a number
  };
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (starts_number(a, i) && starts_number(b, j)) {
      char *end_a = nullptr, *end_b = nullptr;
      if (!(std::abs(std::strtod(a.c_str() + i, &end_a) - std::strtod(b.c_str() + j, &end_b)) <= kPixels)) return i;
      i = static_cast<std::size_t>(end_a - a.c_str());
      j = static_cast<std::size_t>(end_b - b.c_str());
      continue;
    }
    if (a[i++] != b[j++]) return i - 1;
  }
  return i == a.size() && j == b.size() ? std::string::npos : i;
}

TEST(Pictures, ADifferenceIsMoreThanRounding) {
  EXPECT_EQ(first_difference("M1.00 2.00L3 4", "M1.04 2.00L3 4"), std::string::npos);
  EXPECT_EQ(first_difference("M1.00 2.00L3 4", "M1.20 2.00L3 4"), 1u);
  EXPECT_EQ(first_difference("M1 2L3 4", "M1 2L3 4Z"), 8u);
  EXPECT_EQ(first_difference("M1 2", "L1 2"), 0u);
  EXPECT_EQ(first_difference("x -1 y", "x 1 y"), 2u);
  EXPECT_NE(first_difference("#e4e4de", "#e5e4de"), std::string::npos);
}

// The picture on a dark background omits the centres of mass.
void expect_as_before(const std::string& name, const drawn::DrawnRun& drawn, bool dark = false) {
  const Scene scene = make_scene(drawn.model, drawn.run.trajectory);
  StillOptions options;
  options.masses = !dark;
  options.dark = dark;
  const std::string now = still_svg(scene, instant_at(scene, drawn.run.trajectory, 0.6 * drawn.model.simulate.duration), options);
  const std::filesystem::path kept = std::string(PINTLE_SOURCE_DIR) + "/tests/pictures/" + name + ".svg";
  const std::string before = std::filesystem::exists(kept) ? read_file(kept.string()) : "";
  const std::size_t at = first_difference(before, now);
  if (at == std::string::npos) return;
  const std::filesystem::path folder = std::string(PINTLE_SOURCE_DIR) + "/out/pictures";
  std::filesystem::create_directories(folder);
  write_file((folder / (name + ".svg")).string(), now);
  ADD_FAILURE() << name << ".svg has changed, first at \"" << now.substr(at > 20 ? at - 20 : 0, 60) << "\". Look at out/pictures/" << name
                << ".svg; if it is right, put it in the place of tests/pictures/" << name << ".svg";
}

class PictureOf : public testing::TestWithParam<const char*> {};

TEST_P(PictureOf, AMechanism) { expect_as_before(GetParam(), drawn::sketch_of_mechanism(GetParam(), 0.05)); }

INSTANTIATE_TEST_SUITE_P(Drawn, PictureOf,
                         testing::Values("air_cylinder", "belt_drive", "cam_follower", "crane_bushing", "crane_hoist", "cross_spring_pendulum", "door_stops", "excavator_boom", "gear_train", "hopper",
                                         "inverted_slider_crank", "jaw_coupling", "lubricated_crank", "quick_return", "robot_arm", "selector_switch", "trammel", "weld_beam", "wheel_over_bump"),
                         [](const auto& mechanism) { return std::string(mechanism.param); });

// What no mechanism of the collection has, on both backgrounds.
TEST(Pictures, Oddments) {
  const drawn::DrawnRun run = drawn::run_of(read_file(PINTLE_SOURCE_DIR "/tests/pictures/oddments.toml"));
  expect_as_before("oddments", run);
  expect_as_before("oddments_dark", run, true);
}

}  // namespace
}  // namespace pintle
