// The finished samples on disk: an append-only file in which each sample is a frame with a checksum. Whatever kills the program or
// the machine, everything before the first damaged frame is intact.
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
  /// Opens the journal of this plan with its content, or starts a new one. Throws FileError if it belongs to another plan (unless `force`: then it
  /// starts anew) or if another process has it open.
  Journal(std::filesystem::path path, const std::string& plan, std::uint64_t n_samples, bool force, DiskCalls calls = {});
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;
  ~Journal();

  std::uint64_t n_samples() const { return offsets_.size(); }
  std::uint64_t n_done() const { return n_done_; }
  std::uint64_t n_troubled() const { return n_troubled_; }
  bool has(std::uint64_t sample) const { return offsets_[sample] != 0; }

  /// Adds a sample that the journal does not have yet.
  void add(std::uint64_t sample, const SampleResult& result);
  /// Writes what was added; `sync`: waits until it is on the disk.
  void flush(bool sync);
  /// A sample that the journal has, after flush().
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
  std::vector<std::uint64_t> offsets_;  // of the frames, by sample; 0: absent
  std::uint64_t end_ = 0;               // of the file including what is still to be written
  std::uint64_t n_done_ = 0, n_troubled_ = 0;
  std::string waiting_;
};

}  // namespace pintle
