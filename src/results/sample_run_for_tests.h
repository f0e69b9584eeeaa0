// A small invented run, and a scratch folder, for the tests of this room and of the program.
#pragma once

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "pintle/results.h"

namespace pintle::sample {

/// An oscillating force at one joint: n_rows rows over 0.5 s.
inline Trajectory trajectory(std::size_t n_rows = 51) {
  Trajectory result;
  result.columns = {{"t", "s", "time"},
                    {"joint.O4.on_rocker.fx[world]", "N", "force on rocker at joint O4, along world x"},
                    {"joint.O4.on_rocker.fy[world]", "N", "force on rocker at joint O4, along world y"},
                    {"joint.O4.on_ground.fx[world]", "N", "force on ground at joint O4, along world x"},
                    {"joint.O4.on_ground.fy[world]", "N", "force on ground at joint O4, along world y"},
                    {"joint.O4.angle", "rad", "angle of rocker from ground"}};
  for (std::size_t i = 0; i < n_rows; ++i) {
    const double t = 0.5 * static_cast<double>(i) / static_cast<double>(n_rows - 1);
    const double fx = 300 * std::cos(25 * t), fy = -120 * std::sin(50 * t) + 1.0 / 3;
    for (const double value : {t, fx, fy, -fx, -fy, 0.3 * std::sin(25 * t)}) result.values.push_back(value);
  }
  result.joints = {{.name = "O4",
                    .type = "revolute",
                    .first_body = "ground",
                    .second_body = "rocker",
                    .peak = 312.25,
                    .rms = 224.1,
                    .mean = 210.7,
                    .peak_time = 0.123,
                    .error_estimate = 1.5e-4,
                    .relative_error_estimate = 4.8e-7},
                   {.name = "slide",
                    .type = "prismatic",
                    .first_body = "rocker",
                    .second_body = "block",
                    .peak = 8.5,
                    .rms = 4.25,
                    .mean = 4,
                    .peak_time = 0.25,
                    .has_moment = true,
                    .peak_moment = 1.25,
                    .rms_moment = 0.5,
                    .mean_moment = 0.25,
                    .error_estimate = 2e-3,
                    .relative_error_estimate = 2.4e-4}};
  result.springs = {{.name = "S", .type = "spring", .first_body = "ground", .second_body = "rocker", .peak = 12}};
  result.motors = {{.name = "M",
                    .joint = "O2",
                    .unit = "N*m",
                    .peak_effort = 10.5,
                    .rms_effort = 4,
                    .mean_effort = 2,
                    .peak_power = 105,
                    .mean_power = 20,
                    .work = 10,
                    .effort_error = 3e-4}};
  result.bearings = {{.joint = "O4", .path = 1.2, .swing = 0.6, .mean_speed = 2.4, .equivalent_load = 250, .life = 1000, .wants = {"state static_load_rating (C0) for a static safety"}, .remarks = {}}};
  result.energy = {
      .kinetic_start = 5e6, .kinetic_end = 5e6, .kinetic_peak = 5e6, .dissipated = 0.03, .supplied = 10, .drift = 2e-5};
  result.counters = {
      .steps = 18, .rejected = 2, .newton_iterations = 61, .evaluations = 90, .factorizations = 40, .passes = 2};
  result.method = "radau";
  result.tolerance = 1e-5;
  result.wall_seconds = 3.5e-4;
  result.t_end = 0.5;
  result.notes = {"rocker was moved by 0.2 mm to close the loop"};
  return result;
}

inline RunStamp stamp() {
  return {"Four-bar, section 8", "four_bar.toml", "sha256:00", "0.1.0", "pintle run four_bar.toml"};
}

/// A new folder in the system's temporary folder, removed at the end of the test.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "pintle-test-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw FileError("no temporary folder");
    path_ = name;
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

/// Number of entries in a folder, including hidden ones.
inline std::size_t n_entries(const std::filesystem::path& folder) {
  std::size_t n = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++n;
  return n;
}

}  // namespace pintle::sample
