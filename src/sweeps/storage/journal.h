// The samples that are done, on disk: a file that only grows, each sample a frame with a check sum. Whatever kills the program or
// the machine, what it holds up to the first damaged frame is whole.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "results/disk.h"
#include "sweeps/storage/sample_bytes.h"

namespace pintle {

class Journal {
 public:
  /// Opens the journal of this plan, with what it holds, or begins one. Throws FileError if it is another plan's (unless `force`: then it
  /// begins anew) or if another process has it open.
  Journal(std::filesystem::path path, const std::string& plan, std::uint64_t n_samples, bool force, DiskCalls calls = {});
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;
  ~Journal();

  std::uint64_t n_samples() const { return offsets_.size(); }
  std::uint64_t n_done() const { return n_done_; }
  std::uint64_t n_troubled() const { return n_troubled_; }
  bool has(std::uint64_t sample) const { return offsets_[sample] != 0; }

  /// Adds a sample that it has not.
  void add(std::uint64_t sample, const SampleResult& result);
  /// Writes what was added; `sync`: waits until the disk has it.
  void flush(bool sync);
  /// A sample that it has, after flush().
  SampleResult read(std::uint64_t sample) const;
  /// Closes and removes the file.
  void remove();

 private:
  void open(const std::string& head, bool force);
  void read_frames(std::uint64_t start);
  void note(std::uint64_t sample, SampleStatus status, std::uint64_t offset);

  std::filesystem::path path_;
  DiskCalls calls_;
  int descriptor_ = -1;
  std::vector<std::uint64_t> offsets_;  // of the frames, by sample; 0: not there
  std::uint64_t end_ = 0;               // of the file and what waits to be written
  std::uint64_t n_done_ = 0, n_troubled_ = 0;
  std::string waiting_;
};

}  // namespace pintle
