// The journal: whatever is cut off or damaged, everything before that is intact, and nothing occurs twice.
#include "sweeps/storage/journal.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <cmath>
#include <fstream>
#include <limits>

#include "results/sample_run_for_tests.h"

namespace pintle {
namespace {

constexpr std::uint64_t kSamples = 12;

SampleResult result_of(std::uint64_t i) {
  SampleResult r;
  const auto x = static_cast<double>(i);
  r.steps = 10 + i;
  r.passes = 2;
  if (i == 5) {
    r.status = SampleStatus::kNotAssembled;
    r.message = "the loop cannot close";
    return r;
  }
  r.joints = {{100 + x, 0.1 * x, 0, 1e-3}, {1 / (x + 1), 0, x, std::numeric_limits<double>::quiet_NaN()}};
  r.series = {x, -x, 0.5};
  return r;
}

void expect_same(const SampleResult& a, const SampleResult& b) {
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.message, b.message);
  EXPECT_EQ(a.steps, b.steps);
  EXPECT_EQ(a.series, b.series);
  ASSERT_EQ(a.joints.size(), b.joints.size());
  for (std::size_t j = 0; j < a.joints.size(); ++j) {
    EXPECT_EQ(a.joints[j].force, b.joints[j].force);
    EXPECT_EQ(std::isnan(a.joints[j].error), std::isnan(b.joints[j].error));
  }
}

// A disk that syncs immediately.
DiskCalls quick_disk() {
  DiskCalls calls;
  calls.sync = [](int) { return 0; };
  return calls;
}

void put_file(const std::filesystem::path& path, std::string_view bytes) {
  std::filesystem::remove(path);  // some file systems sync a file that is truncated to zero
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

class JournalOfTwelve : public testing::Test {
 protected:
  JournalOfTwelve() {
    Journal journal(path_, "plan", kSamples, false);
    for (const std::uint64_t i : {3, 0, 1, 5, 2, 11}) journal.add(i, result_of(i));
    journal.flush(true);
    whole_ = read_file(path_);
  }
  // The existing samples can be read, the rest can be added, and all of them exist at the next start.
  void expect_usable() {
    std::uint64_t before = 0;
    {
      Journal journal(path_, "plan", kSamples, false, quick_disk());
      before = journal.n_done();
      std::uint64_t found = 0;
      for (std::uint64_t i = 0; i < kSamples; ++i) {
        if (journal.has(i)) {
          ++found;
          expect_same(journal.read(i), result_of(i));
        } else {
          journal.add(i, result_of(i));
        }
      }
      EXPECT_EQ(found, before);
      journal.flush(false);
    }
    const Journal again(path_, "plan", kSamples, false, quick_disk());
    EXPECT_EQ(again.n_done(), kSamples);
    EXPECT_EQ(again.n_troubled(), 1u);
    for (std::uint64_t i = 0; i < kSamples; ++i) expect_same(again.read(i), result_of(i));
  }
  sample::ScratchFolder folder_;
  std::filesystem::path path_ = folder_ / "sweep.h5.part";
  std::string whole_;
};

TEST_F(JournalOfTwelve, GoesOnWhereItWas) {
  EXPECT_EQ(Journal(path_, "plan", kSamples, false).n_done(), 6u);
  expect_usable();
}

TEST_F(JournalOfTwelve, MayBeCutOffAtEveryByte) {
  for (std::size_t size = 0; size <= whole_.size(); ++size) {
    put_file(path_, std::string_view(whole_).substr(0, size));
    expect_usable();
  }
}

TEST_F(JournalOfTwelve, ADamagedByteCostsOnlyWhatFollows) {
  const std::size_t head = whole_.find("\n\n") + 2;
  for (std::size_t at = head; at < whole_.size(); at += 3) {
    std::string damaged = whole_;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    put_file(path_, damaged);
    expect_usable();
  }
}

TEST_F(JournalOfTwelve, OfAnotherPlanIsRefusedUnlessForced) {
  EXPECT_THROW(Journal(path_, "other", kSamples, false), FileError);
  EXPECT_THROW(Journal(path_, "plan", kSamples + 1, false), FileError);
  EXPECT_EQ(read_file(path_), whole_);
  write_file(folder_ / "notes.txt", "not a journal");
  EXPECT_THROW(Journal(folder_ / "notes.txt", "plan", kSamples, false), FileError);
  EXPECT_EQ(Journal(path_, "other", kSamples, true).n_done(), 0u);
}

TEST_F(JournalOfTwelve, BelongsToOneProcess) {
  const Journal first(path_, "plan", kSamples, false);
  EXPECT_THROW(Journal(path_, "plan", kSamples, false), FileError);
}

TEST_F(JournalOfTwelve, AFullDiskIsAnErrorAndLeavesItWhole) {
  DiskCalls full;
  full.write = [](int, const void*, size_t) -> ssize_t {
    errno = ENOSPC;
    return -1;
  };
  {
    Journal journal(path_, "plan", kSamples, false, full);
    journal.add(7, result_of(7));
    EXPECT_THROW(journal.flush(false), FileError);
  }
  expect_usable();
}

TEST(Crc32, IsTheUsualOne) { EXPECT_EQ(crc32("123456789"), 0xCBF43926U); }

}  // namespace
}  // namespace pintle
