// What rows miss is said, and nothing where they miss nothing.
#include "run/record/missed_peaks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pintle/simulate.h"
#include "system/build.h"
#include "system/sample_systems_for_tests.h"

namespace pintle {
namespace {

bool says(const Trajectory& run, const std::string& what) {
  return std::any_of(run.notes.begin(), run.notes.end(), [&](const std::string& note) { return note.find(what) != std::string::npos; });
}

// The pin's force is largest as the rod hangs down, at 0.484 s.
TEST(MissedPeaks, NamesTheJointWhosePeakTheRowsMiss) {
  Model model = sample::pendulum(2e8, 3500);
  model.simulate.duration = 0.9;
  for (const double step : {0.3, 0.005}) {
    model.simulate.output_step = step;
    EXPECT_EQ(says(simulate(model), "output rows miss a peak: joint pin carries 24.5"), step > 0.1) << step;
  }
}

TEST(MissedPeaks, LooksAtNoJointThatCarriesNextToNothing) {
  const Model model = sample::four_bar(1e8, 3000);
  const System system = build_system(model);
  State state;
  state.force.assign(system.joints.size(), Planar::Vec(1000, 0, 0));
  state.force[1] = {1, 0, 0};
  MissedPeaks watch(system);
  watch.add_row(state, 0, 1);
  state.t = 1e-3;
  state.force[1] = {9, 0, 0};
  watch.add_step(state, 1e-3);
  EXPECT_EQ(watch.note(0.01), "");
  state.force[2] = {0, 1020, 0};
  watch.add_step(state, 1e-3);
  EXPECT_EQ(watch.note(0.01), "output rows miss a peak: joint " + system.joints[2].name +
                                  " carries 1020 N at t = 0.001 s, the rows show at most 1000 N; peaks, means and work in the tables are those of the rows. "
                                  "output_step = \"0.0002 s\" resolves it");
}

// Power 1 + cos(2 pi t): over ten periods 10 J. Rows at its peaks make 20 J of it.
TEST(MissedPeaks, AddsUpThePowerOfTheRows) {
  const System system = build_system(sample::pendulum(2e8, 3500));
  for (const int rows : {10, 40}) {
    MissedPeaks watch(system);
    State state;
    state.force.assign(system.joints.size(), Planar::Vec::Zero());
    for (int i = 0; i <= rows; ++i) {
      state.t = 10.0 * i / rows;
      state.supplied = 5 + state.t + std::sin(2 * std::numbers::pi * state.t) / (2 * std::numbers::pi);
      watch.add_row(state, 1 + std::cos(2 * std::numbers::pi * state.t), 1);
    }
    EXPECT_EQ(watch.note(10.0 / rows).find("output rows are too far apart: their power integrates to 20 J, but 10 J were supplied") == 0, rows == 10) << watch.note(1);
    EXPECT_EQ(watch.note(10.0 / rows).empty(), rows == 40);
  }
}

}  // namespace
}  // namespace pintle
