// Whole sweeps: the file agrees with single runs, and is the same to the last bit on any number of threads and after any interruption.
#include "pintle/sweep.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <thread>

#include "pintle/complaint.h"
#include "pintle/read_model.h"
#include "pintle/simulate.h"
#include "results/sample_run_for_tests.h"
#include "sweeps/storage/sweep_file.h"
#include "sweeps/sweep_models_for_tests.h"
#include "sweeps/sweep_report.h"
#include "sweeps/worker_pool.h"

namespace pintle {
namespace {

class SlowSweep : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_hdf5()) GTEST_SKIP() << kNoHdf5;
  }
  SweepRun to(const std::string& name, int threads = 1) const { return {folder_ / name, threads, false, "pintle sweep pendulum.toml"}; }
  std::string bytes(const std::string& name) const { return read_file(folder_ / name); }

  static SweepRequest draws(std::uint64_t samples) {
    SweepRequest r = sample::request({});
    r.samples = samples;
    r.overrides = {"simulate.duration=20 ms"};
    return r;
  }
  sample::ScratchFolder folder_;
};

TEST_F(SlowSweep, HoldsWhatSingleRunsGive) {
  SweepRequest r = sample::request({"joint.pin.stiffness=1e6..1e9 N/m:log:3", "body.bob.mass=1,2"});
  r.series = {"joint.pin.on_bob.fy[world]"};
  EXPECT_EQ(sweep(r, to("a.h5")).end, SweepEnd::kFinished);
  const SweepTable table = read_sweep(folder_ / "a.h5");
  EXPECT_EQ(table.joints, std::vector<std::string>{"pin"});
  EXPECT_EQ(table.paths, (std::vector<std::string>{"joint.pin.stiffness", "body.bob.mass"}));
  EXPECT_EQ(table.units, (std::vector<std::string>{"N/m", "kg"}));
  ASSERT_EQ(table.n_samples(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    const Model model = parse_model(r.model_text, r.model_name,
                                    {fmt::format("joint.pin.stiffness={}", table.values[2 * i]), fmt::format("body.bob.mass={}", table.values[2 * i + 1])});
    const Trajectory run = simulate(model);
    EXPECT_EQ(table.force[i], run.joints[0].peak);
    EXPECT_EQ(table.time[i], run.joints[0].peak_time);
    EXPECT_EQ(table.error[i], run.joints[0].error_estimate);
    EXPECT_EQ(table.steps[i], run.counters.steps);
  }
}

// Chunks that a thread has finished before it throws are collected first.
TEST_F(SlowSweep, AFaultInAThreadLosesNoFinishedChunk) {
  const SweepJob job(draws(100));
  std::atomic<int> given = 0;
  WorkerPool pool(job, 1, [&given]() -> std::optional<std::uint64_t> {
    if (given++ > 0) throw std::runtime_error("no more");
    return 0;
  });
  while (!pool.idle() && given < 2) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_EQ(pool.take(10).size(), 1u);
  EXPECT_FALSE(pool.idle());
  EXPECT_THROW(pool.take(10), std::runtime_error);
}

TEST_F(SlowSweep, IsTheSameOnAnyNumberOfThreads) {
  for (const int threads : {1, 2, 5}) sweep(draws(100), to(std::to_string(threads), threads));
  EXPECT_EQ(bytes("1"), bytes("2"));
  EXPECT_EQ(bytes("1"), bytes("5"));
}

TEST_F(SlowSweep, GoesOnAfterAnyCutWithoutChangingABit) {
  const SweepRequest r = draws(1500);
  sweep(r, to("whole.h5"));
  int calls = 0;
  const SweepOutcome stopped = sweep(r, to("cut.h5"), [&](const SweepProgress&) { return ++calls < 1; });
  ASSERT_EQ(stopped.end, SweepEnd::kInterrupted);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "cut.h5"));
  const std::string journal = bytes("cut.h5.part");
  for (const double share : {0.0, 0.3, 0.77, 1.0}) {
    std::filesystem::remove(folder_ / "cut.h5");
    write_file(folder_ / "cut.h5.part", journal.substr(0, static_cast<std::size_t>(share * static_cast<double>(journal.size()))));
    const SweepOutcome outcome = sweep(r, to("cut.h5", 2));
    EXPECT_EQ(outcome.end, SweepEnd::kFinished);
    if (share == 1) {
      EXPECT_EQ(outcome.progress.resumed, stopped.progress.done);
    }
    EXPECT_EQ(bytes("cut.h5"), bytes("whole.h5"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "cut.h5.part"));
  }
}

TEST_F(SlowSweep, AFinishedFileIsKept) {
  sweep(draws(20), to("a.h5"));
  const std::string before = bytes("a.h5");
  write_file(folder_ / "a.h5.part", "left by a kill");
  EXPECT_EQ(sweep(draws(20), to("a.h5")).end, SweepEnd::kFinishedBefore);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.h5.part"));
  EXPECT_THROW(sweep(draws(21), to("a.h5")), FileError);
  EXPECT_EQ(bytes("a.h5"), before);
  SweepRun run = to("a.h5");
  run.force = true;
  EXPECT_EQ(sweep(draws(21), run).end, SweepEnd::kFinished);
  EXPECT_EQ(read_sweep(folder_ / "a.h5").n_samples(), 21u);
  write_file(folder_ / "b.h5", "something else");
  EXPECT_THROW(sweep(draws(20), to("b.h5")), FileError);
  EXPECT_THROW(read_sweep(folder_ / "b.h5"), FileError);
}

// With the pin at 1.2 m and the bob held at 1 m, the joint cannot close.
TEST_F(SlowSweep, SamplesThatFailAreResults) {
  SweepRequest r = sample::request({"parameters.gap=0,0.2,-2"});
  r.model_text.replace(r.model_text.find("[simulate]"), 0, "gap = \"0 m\"\nheavy = \"1 kg*(1 + gap/(1 m))\"\n");
  r.model_text.replace(r.model_text.find("angle = 0"), 9, "angle = 0\nhold = [\"x\", \"y\", \"angle\"]");
  r.model_text.replace(r.model_text.find("O = [0, 0]"), 10, "O = [\"gap\", 0]");
  r.model_text.replace(r.model_text.find("mass = \"1 kg\""), 13, "mass = \"heavy\"");
  const SweepOutcome outcome = sweep(r, to("a.h5"));
  EXPECT_EQ(outcome.end, SweepEnd::kFinished);
  EXPECT_EQ(outcome.progress.troubled, 2u);
  const SweepTable table = read_sweep(folder_ / "a.h5");
  EXPECT_EQ(static_cast<SampleStatus>(table.status[0]), SampleStatus::kCompleted);
  EXPECT_EQ(static_cast<SampleStatus>(table.status[1]), SampleStatus::kNotAssembled);
  EXPECT_EQ(static_cast<SampleStatus>(table.status[2]), SampleStatus::kModelError);
  EXPECT_EQ(table.troubled, (std::vector<std::uint64_t>{1, 2}));
  EXPECT_TRUE(sample::contains(table.messages[1], "body.bob.mass")) << table.messages[1];
  EXPECT_TRUE(std::isnan(table.force[1]));
  const std::string text = sweep_text(table, false);
  EXPECT_TRUE(sample::contains(text, "2 of 3 samples did not end as \"completed\": 1 not_assembled, 1 model_error")) << text;
  EXPECT_TRUE(sample::contains(text, "cannot be assembled from the stated positions: joint pin (revolute) stays open by 0.2 m")) << text;
}

// Chaos is not a failure: the peaks are kept, without an error where it is unknown.
TEST_F(SlowSweep, AChaoticSampleKeepsItsPeaks) {
  SweepRequest r;
  r.model_name = "double_pendulum.toml";
  r.model_text = read_file(std::string(PINTLE_SOURCE_DIR) + "/mechanisms/double_pendulum.toml");
  r.vary = {"simulate.duration=1,30 s"};
  EXPECT_EQ(sweep(r, to("a.h5")).progress.troubled, 1u);
  const SweepTable table = read_sweep(folder_ / "a.h5");
  EXPECT_EQ(static_cast<SampleStatus>(table.status[0]), SampleStatus::kCompleted);
  EXPECT_EQ(static_cast<SampleStatus>(table.status[1]), SampleStatus::kHorizon);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_GT(table.force[k], 19.62) << k;
  for (std::size_t k = 0; k < 2; ++k) EXPECT_LT(table.error[k], 1) << k;
  EXPECT_TRUE(std::isnan(table.error[2]) && std::isnan(table.error[3]));
  EXPECT_EQ(peak_statistics(table)[0].most_sample, 1u);
  EXPECT_TRUE(std::isnan(peak_statistics(table)[0].worst_error));  // not that of the other sample
  EXPECT_TRUE(sample::contains(sweep_text(table, false), "1 of 2 samples did not end as \"completed\": 1 horizon")) << sweep_text(table, false);
}

SweepTable table_of(std::size_t n) {
  SweepTable table;
  table.paths = {"joint.pin.stiffness"};
  table.units = {"N/m"};
  table.joints = {"pin"};
  for (std::size_t i = 0; i < n; ++i) {
    table.values.push_back(1e6 * static_cast<double>(i + 1));
    table.force.push_back(static_cast<double>((i * 37) % n + 1));  // 1 to n in scrambled order
    table.error.push_back(1e-3);
    table.time.push_back(0);
    table.moment.push_back(0);
    table.status.push_back(0);
    table.steps.push_back(1);
  }
  return table;
}

TEST(SweepReport, StatisticsAreThoseOfTheSamples) {
  const SweepTable table = table_of(100);
  const PeakStatistics s = peak_statistics(table)[0];
  EXPECT_EQ(s.least, 1);
  EXPECT_EQ(s.median, 50.5);  // the mean of the middle two
  EXPECT_NEAR(s.high, 95.05, 1e-12);
  EXPECT_EQ(s.most, 100);
  EXPECT_EQ(s.least_sample, 0u);
  EXPECT_EQ(table.force[s.most_sample], 100);
  EXPECT_DOUBLE_EQ(s.worst_error, 1e-3);
}

// Samples that are integrated once have no error estimate of their own.
TEST(SweepReport, TheErrorIsThatOfTheSamplesThatAreChecked) {
  SweepTable table = table_of(4);
  const double worst = peak_statistics(table)[0].worst_error;
  table.error[1] = table.error[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_DOUBLE_EQ(peak_statistics(table)[0].worst_error, worst);
}

// The error of a joint without load is measured as in a run: relative to a fraction of what other joints carry.
TEST(SweepReport, AnErrorOfAJointThatCarriesNothingIsMeasuredByTheOthers) {
  SweepTable table = table_of(2);
  table.joints = {"pin", "lift"};
  table.force = {100, 2.6e-15, 50, 2.6e-15};
  table.error = {1e-3, 8.6e-14, 1e-3, 8.6e-14};
  EXPECT_DOUBLE_EQ(peak_statistics(table)[0].worst_error, 2e-5);
  EXPECT_DOUBLE_EQ(peak_statistics(table)[1].worst_error, 8.6e-14 / (1e-4 * 50));
}

// Peaks of a chaotic motion are one random outcome; those of a run that failed are not the sample's.
TEST(SweepReport, ChaoticSamplesCountAndBrokenOnesDoNot) {
  SweepTable table = table_of(3);
  for (const auto& [status, most] : {std::pair{SampleStatus::kHorizon, 3}, {SampleStatus::kToleranceNotMet, 3}, {SampleStatus::kRunaway, 2}, {SampleStatus::kEnergyOpen, 2}, {SampleStatus::kFailed, 2}}) {
    table.status[1] = static_cast<std::uint8_t>(status);
    table.force = {1, 3, 2};
    EXPECT_EQ(peak_statistics(table)[0].most, most) << to_text(status);
    EXPECT_TRUE(sample::contains(sweep_json(table, "a.h5"), fmt::format("\"{}\": 1", to_text(status))));
  }
}

TEST(SweepReport, PlotsOneOrTwoVaryingValues) {
  SweepTable table = table_of(60);
  ASSERT_TRUE(sweep_plot(table));
  EXPECT_TRUE(sample::contains(to_svg(*sweep_plot(table)), "joint.pin.stiffness"));
  table.paths.push_back("body.bob.mass");
  table.units.push_back("kg");
  std::vector<double> both;
  for (std::size_t i = 0; i < 60; ++i) both.insert(both.end(), {table.values[i], static_cast<double>(i % 3)});
  table.values = both;
  ASSERT_TRUE(sweep_plot(table));
  const Panel panel = sweep_plot(table)->panels[0];
  ASSERT_EQ(panel.curves.size(), 3u);
  // Each curve has the samples of its own mass, ordered by stiffness.
  for (std::size_t mass = 0; mass < 3; ++mass) {
    ASSERT_EQ(panel.curves[mass].x.size(), 20u);
    for (std::size_t k = 0; k < 20; ++k) {
      EXPECT_EQ(panel.curves[mass].x[k], 1e6 * static_cast<double>(3 * k + mass + 1));
      EXPECT_EQ(panel.curves[mass].y[k], table.force[3 * k + mass]);
    }
  }
}

// Only the first line of a message is shown, and the next one too if the first ends with a colon.
TEST(SweepReport, MessagesAreShortened) {
  SweepTable table = table_of(3);
  table.status = {3, 3, 3};
  table.troubled = {0, 1, 2};
  table.messages = {"it broke off\nwhere it was", "the positions do not close:\n  joint A is open by 3 mm\n  joint B too", ":"};
  const std::string text = sweep_text(table, false);
  EXPECT_TRUE(sample::contains(text, "it broke off\n")) << text;
  EXPECT_FALSE(sample::contains(text, "where it was"));
  EXPECT_TRUE(sample::contains(text, "the positions do not close: joint A is open by 3 mm\n")) << text;
  EXPECT_FALSE(sample::contains(text, "joint B too"));
}

TEST(SweepReport, ManyPowersOfTenHaveALogarithmicAxis) {
  EXPECT_FALSE(sweep_plot(table_of(19))->panels[0].log_x);
  EXPECT_TRUE(sweep_plot(table_of(25))->panels[0].log_x);
}

}  // namespace
}  // namespace pintle
