#include "results/run_folder.h"

#include <gtest/gtest.h>

#include <bit>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <limits>

#include "results/sample_run_for_tests.h"
#include "results/sha256.h"
#include "results/summary_json.h"

namespace pintle {
namespace {

namespace fs = std::filesystem;

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const FileError& error) {
    return error.what();
  }
  return "";
}

/// A disk with space for `n_bytes`.
DiskCalls full_after(std::size_t n_bytes) {
  DiskCalls calls;
  calls.write = [room = n_bytes](int descriptor, const void* data, size_t size) mutable -> ssize_t {
    if (room == 0) {
      errno = ENOSPC;
      return -1;
    }
    const ssize_t written = ::write(descriptor, data, std::min(room, size));
    room -= static_cast<std::size_t>(written);
    return written;
  };
  return calls;
}

TEST(RunFolder, ReadsBackWhatWasWritten) {
  const sample::ScratchFolder scratch;
  const Trajectory trajectory = sample::trajectory();
  write_run(trajectory, sample::stamp(), scratch / "run");
  const RunRecord run = read_run(scratch / "run");
  EXPECT_EQ(run.trajectory.values, trajectory.values);
  EXPECT_EQ(summary_json(run.trajectory, run.stamp), summary_json(trajectory, sample::stamp()));
  EXPECT_EQ(run.trajectory.column("joint.O4.angle"), 5);
  EXPECT_EQ(run.trajectory.column("joint.O4.angel"), -1);
  EXPECT_EQ(sample::n_entries(scratch.path()), 1U);
}

TEST(RunFolder, KeepsTheFilesOfTheModel) {
  const sample::ScratchFolder scratch;
  RunStamp stamp = sample::stamp();
  stamp.model_files = {{"data/gas.csv", "sha256:" + sha256("1,2\n"), "1,2\n"}};
  for (int i = 0; i < 2; ++i) write_run(sample::trajectory(), stamp, scratch / "run");  // the second replaces the first
  const RunRecord run = read_run(scratch / "run");
  ASSERT_EQ(run.stamp.model_files.size(), 1U);
  EXPECT_EQ(run.stamp.model_files[0].name, "data/gas.csv");
  EXPECT_EQ(read_model_file(scratch / "run", run.stamp.model_files[0]), "1,2\n");
  write_file(scratch / "run/data/gas.csv", "1,3\n");
  EXPECT_NE(message_of([&] { read_model_file(scratch / "run", run.stamp.model_files[0]); }).find("different hash"), std::string::npos);
  fs::remove(scratch / "run/data/gas.csv");
  EXPECT_NE(message_of([&] { read_model_file(scratch / "run", run.stamp.model_files[0]); }).find("has lost this file"), std::string::npos);
}

// Also if the folder holds a file of the model.
TEST(RunFolder, LeavesFilesOfOthersInFoldersOfTheModel) {
  const sample::ScratchFolder scratch;
  RunStamp stamp = sample::stamp();
  stamp.model_files = {{"data/gas.csv", "sha256:" + sha256("1"), "1"}};
  write_run(sample::trajectory(), stamp, scratch / "run");
  write_file(scratch / "run/data/mine.txt", "mine");
  write_run(sample::trajectory(), stamp, scratch / "run");
  EXPECT_EQ(read_file(scratch / "run/data/mine.txt"), "mine");
  EXPECT_EQ(read_file(scratch / "run/data/gas.csv"), "1");
}

TEST(RunFolder, KeepsEveryBitOfAwkwardNumbers) {
  using Limits = std::numeric_limits<double>;
  const sample::ScratchFolder scratch;
  Trajectory trajectory;
  trajectory.columns = {{"odd, \"quoted\"\r\nname", "N", ""}};
  trajectory.values = {0.1,
                       -0.0,
                       1.0 / 3,
                       Limits::denorm_min(),
                       Limits::max(),
                       Limits::infinity(),
                       -Limits::infinity(),
                       Limits::quiet_NaN(),
                       5e-324,
                       1e22,
                       123456789012345680.0};
  trajectory.energy.drift = Limits::quiet_NaN();
  write_run(trajectory, {}, scratch / "run");
  const RunRecord run = read_run(scratch / "run");
  EXPECT_EQ(run.trajectory.columns[0].name, trajectory.columns[0].name);
  ASSERT_EQ(run.trajectory.values.size(), trajectory.values.size());
  for (std::size_t i = 0; i < trajectory.values.size(); ++i)
    EXPECT_EQ(std::bit_cast<std::uint64_t>(run.trajectory.values[i]),
              std::bit_cast<std::uint64_t>(trajectory.values[i]))
        << trajectory.values[i];
  EXPECT_TRUE(std::isnan(run.trajectory.energy.drift));
}

TEST(RunFolder, SeriesHasTwoHeaderRows) {
  const sample::ScratchFolder scratch;
  Trajectory trajectory;
  trajectory.columns = {{"t", "s", ""}, {"joint.A.angle_rate", "rad/s", ""}};
  trajectory.values = {0, 1.5, 0.001, -2e-7};
  write_run(trajectory, {}, scratch / "run");
  EXPECT_EQ(read_file(scratch / "run/series.csv"), "t,joint.A.angle_rate\r\ns,rad/s\r\n0,1.5\r\n0.001,-2e-07\r\n");
}

TEST(RunFolder, EveryOutcomeSurvives) {
  for (const Outcome outcome :
       {Outcome::kCompleted, Outcome::kToleranceNotMet, Outcome::kInterrupted, Outcome::kFailed}) {
    Trajectory trajectory = sample::trajectory();
    trajectory.outcome = outcome;
    EXPECT_EQ(parse_summary(summary_json(trajectory, {}), "x").run.trajectory.outcome, outcome);
  }
}

TEST(RunFolder, ReplacesAnEarlierRunAndLeavesOtherFilesAlone) {
  const sample::ScratchFolder scratch;
  write_run(sample::trajectory(5), sample::stamp(), scratch / "run");
  write_file(scratch / "run/my notes.txt", "mine");
  fs::create_directories(scratch / "run/plots");
  write_file(scratch / "run/plots/O4.svg", "drawn");
  write_run(sample::trajectory(9), sample::stamp(), scratch / "run");
  EXPECT_EQ(read_run(scratch / "run").trajectory.n_rows(), 9U);
  EXPECT_EQ(read_file(scratch / "run/my notes.txt"), "mine");
  EXPECT_EQ(read_file(scratch / "run/plots/O4.svg"), "drawn");
  EXPECT_EQ(sample::n_entries(scratch.path()), 1U);
}

TEST(RunFolder, EventsOfAnEarlierRunDoNotStayWithOneThatHasNone) {
  const sample::ScratchFolder scratch;
  write_run(sample::trajectory(5), sample::stamp(), scratch / "run");
  write_file(scratch / "run/events.csv", "t,joint,event\n");
  write_file(scratch / "run/model-as-run.json", "{}");
  write_run(sample::trajectory(5), sample::stamp(), scratch / "run");
  EXPECT_FALSE(fs::exists(scratch / "run/events.csv"));
  EXPECT_FALSE(fs::exists(scratch / "run/model-as-run.json"));
}

TEST(RunFolder, RefusesAStrangersFolderUnlessToldSo) {
  const sample::ScratchFolder scratch;
  fs::create_directories(scratch / "thesis");
  write_file(scratch / "thesis/summary.json", "{\"mine\": true}");
  write_file(scratch / "thesis/chapter1.tex", "text");
  const auto write = [&](Overwrite overwrite) { write_run(sample::trajectory(), {}, scratch / "thesis", overwrite); };
  EXPECT_NE(message_of([&] { write(Overwrite::kRunFolder); }).find("--force"), std::string::npos);
  EXPECT_EQ(read_file(scratch / "thesis/summary.json"), "{\"mine\": true}");
  write(Overwrite::kAnyFolder);
  EXPECT_EQ(read_file(scratch / "thesis/chapter1.tex"), "text");
  EXPECT_EQ(read_run(scratch / "thesis").trajectory.n_rows(), 51U);
  EXPECT_EQ(sample::n_entries(scratch.path()), 1U);
}

TEST(RunFolder, KeepsALoneStranger) {
  const sample::ScratchFolder scratch;
  fs::create_directories(scratch / "thesis");
  write_file(scratch / "thesis/chapter.tex", "text");
  write_run(sample::trajectory(), {}, scratch / "thesis", Overwrite::kAnyFolder);
  EXPECT_EQ(sample::n_entries(scratch / "thesis"), 3U);
  EXPECT_EQ(sample::n_entries(scratch.path()), 1U);
}

TEST(RunFolder, RefusesAFileEvenIfForced) {
  const sample::ScratchFolder scratch;
  write_file(scratch / "run", "a file");
  EXPECT_NE(message_of([&] { write_run({}, {}, scratch / "run", Overwrite::kAnyFolder); }).find("is a file"),
            std::string::npos);
  EXPECT_EQ(read_file(scratch / "run"), "a file");
}

TEST(RunFolder, UsesAnEmptyFolderAndFollowsALink) {
  const sample::ScratchFolder scratch;
  fs::create_directories(scratch / "elsewhere/empty");
  fs::create_directory_symlink(scratch / "elsewhere/empty", scratch / "run");
  write_run(sample::trajectory(), {}, (scratch / "run").string() + "/");
  EXPECT_TRUE(fs::is_symlink(scratch / "run"));
  EXPECT_EQ(read_run(scratch / "elsewhere/empty").trajectory.n_rows(), 51U);
  EXPECT_EQ(sample::n_entries(scratch / "elsewhere"), 1U);
}

TEST(RunFolder, FullDiskLeavesTheOldRunAndNoRubbish) {
  const sample::ScratchFolder scratch;
  write_run(sample::trajectory(5), sample::stamp(), scratch / "run");
  for (const std::size_t room : {0, 1, 1000, 5000}) {
    const std::string message = message_of([&] {
      write_run(sample::trajectory(), sample::stamp(), scratch / "run", Overwrite::kRunFolder, full_after(room));
    });
    EXPECT_NE(message.find("No space left"), std::string::npos) << room << ": " << message;
    EXPECT_NE(message.find("Free some space"), std::string::npos) << message;
    EXPECT_EQ(read_run(scratch / "run").trajectory.n_rows(), 5U);
    EXPECT_EQ(sample::n_entries(scratch.path()), 1U);
  }
}

TEST(RunFolder, FailedSyncIsAFailedWrite) {
  const sample::ScratchFolder scratch;
  DiskCalls calls;
  calls.sync = [](int) {
    errno = EIO;
    return -1;
  };
  EXPECT_THROW(write_run(sample::trajectory(), {}, scratch / "run", Overwrite::kRunFolder, calls), FileError);
  EXPECT_EQ(sample::n_entries(scratch.path()), 0U);
}

TEST(RunFolder, DamageIsLocated) {
  const sample::ScratchFolder scratch;
  const auto damaged = [&](const std::string& file, const std::string& old, const std::string& fresh) {
    write_run(sample::trajectory(), sample::stamp(), scratch / "run");
    std::string text = read_file(scratch / "run" / file);
    text.replace(text.find(old), old.size(), fresh);
    write_file(scratch / "run" / file, text);
    return message_of([&] { read_run(scratch / "run"); });
  };
  EXPECT_NE(damaged("series.csv", "\r\n0,300,", "\r\n0,3oo,").find("series.csv:3:3: series"), std::string::npos);
  EXPECT_NE(damaged("series.csv", "\r\n0,300,", "\r\n300,").find("only 5 fields"), std::string::npos);
  EXPECT_NE(damaged("series.csv", "\r\n0,300,", "\r\n0,0,300,").find("more than 6 fields"), std::string::npos);
  EXPECT_NE(damaged("series.csv", "t,joint", "\"t,joint").find("never closed"), std::string::npos);
  EXPECT_NE(damaged("series.csv", "O4.angle", "O5.angle").find("calls it"), std::string::npos);
  EXPECT_NE(damaged("summary.json", "\"rows\": 51", "\"rows\": 52").find("promises 52"), std::string::npos);
  EXPECT_NE(damaged("summary.json", "\"pintle_run\": 1", "\"pintle_run\": 9").find("format 9"), std::string::npos);
  EXPECT_NE(damaged("summary.json", "\"completed\"", "\"perfect\"").find("perfect"), std::string::npos);
  EXPECT_NE(damaged("summary.json", "{", "").find("not a summary"), std::string::npos);
  EXPECT_NE(message_of([&] { read_run(scratch / "none"); }).find("no such run folder"), std::string::npos);
  EXPECT_NE(message_of([&] { read_run(scratch.path()); }).find("not a run folder"), std::string::npos);
}

TEST(RunFolder, EmptySeriesIsAnError) {
  const sample::ScratchFolder scratch;
  write_run(sample::trajectory(), sample::stamp(), scratch / "run");
  for (const char* text : {"", "t\r\n", "\"", "t,\"", "\r\n\r\n"}) {
    write_file(scratch / "run/series.csv", text);
    EXPECT_THROW(read_run(scratch / "run"), FileError) << text;
  }
}

TEST(WriteFile, KeepsTheOldContentOnAFullDisk) {
  const sample::ScratchFolder scratch;
  write_file(scratch / "a.svg", "old");
  EXPECT_THROW(write_file(scratch / "a.svg", "newer", full_after(2)), FileError);
  EXPECT_EQ(read_file(scratch / "a.svg"), "old");
  write_file(scratch / "a.svg", "newer");
  EXPECT_EQ(read_file(scratch / "a.svg"), "newer");
  EXPECT_EQ(sample::n_entries(scratch.path()), 1U);
}

TEST(WriteFile, KeepsPermissionsAndLinks) {
  const sample::ScratchFolder scratch;
  write_file(scratch / "real", "old");
  fs::permissions(scratch / "real", fs::perms::owner_all);
  fs::create_symlink(scratch / "real", scratch / "link");
  write_file(scratch / "link", "new");
  EXPECT_TRUE(fs::is_symlink(scratch / "link"));
  EXPECT_EQ(read_file(scratch / "real"), "new");
  EXPECT_EQ(fs::status(scratch / "real").permissions(), fs::perms::owner_all);
}

TEST(WriteFile, WritesIntoDevices) {
  EXPECT_NO_THROW(write_file("/dev/null", "gone"));
  EXPECT_NE(message_of([] { write_file("/dev/full", "too much"); }).find("No space left"), std::string::npos);
}

TEST(WriteFile, NamesWhatIsWrong) {
  const sample::ScratchFolder scratch;
  EXPECT_NE(message_of([&] { write_file(scratch / "no/where.svg", ""); }).find("No such file"), std::string::npos);
  EXPECT_NE(message_of([&] { write_file(scratch.path(), ""); }).find("Is a directory"), std::string::npos);
  EXPECT_NE(message_of([&] { read_file(scratch / "absent"); }).find("No such file"), std::string::npos);
  EXPECT_NE(message_of([&] { read_file(scratch.path()); }).find("Is a directory"), std::string::npos);
}

}  // namespace
}  // namespace pintle
