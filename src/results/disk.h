// Writing to disk so that a reader sees either the old content or the new, never half of it: temporary sibling, sync, rename.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "pintle/results.h"

namespace pintle {

/// The system calls that can fail when a disk is full or broken; tests substitute failing ones.
struct DiskCalls {
  std::function<ssize_t(int, const void*, size_t)> write;  ///< as write(2)
  std::function<int(int)> sync;                            ///< as fsync(2)
  DiskCalls();
};

/// A FileError that names the path, the system's reason and what to try.
FileError file_error(const std::filesystem::path& path, std::string_view doing, int error_number);

/// A new file, buffered. Nothing is guaranteed until close() has returned.
class NewFile {
 public:
  /// Errors name `shown`, if given: the final name of `path`.
  NewFile(const std::filesystem::path& path, const DiskCalls& calls, const std::filesystem::path& shown = {});
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;
  ~NewFile();

  void append(std::string_view text);
  void close();  ///< flushes and syncs

 private:
  void flush();

  std::filesystem::path shown_;
  const DiskCalls& calls_;
  std::string buffer_;
  int descriptor_ = -1;
};

/// A folder that is filled under a temporary name and appears under its final name on publish(). If destroyed before that,
/// it leaves no trace.
class NewFolder {
 public:
  NewFolder(const std::filesystem::path& target, const DiskCalls& calls);
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;
  ~NewFolder();

  const std::filesystem::path& path() const { return path_; }  ///< the temporary one, to write files into
  /// Replaces the target; entries of the old target that the new folder lacks are moved over, except those that are `outdated`.
  void publish(const std::vector<std::string>& outdated = {});

 private:
  std::filesystem::path target_, path_;
  const DiskCalls& calls_;
  bool published_ = false;
};

/// A file that is written under a temporary name next to its target and replaces it on publish(). If destroyed before that,
/// it leaves no trace. Throws FileError if the target is a folder.
class Replacement {
 public:
  explicit Replacement(const std::filesystem::path& target, const DiskCalls& calls = {});
  Replacement(const Replacement&) = delete;
  Replacement& operator=(const Replacement&) = delete;
  ~Replacement();

  const std::filesystem::path& target() const { return shown_; }  ///< as given
  const std::filesystem::path& fresh() const { return fresh_; }   ///< the path to write to; no such file exists yet
  void publish();                                                 ///< links are followed, and the old file's mode is kept

 private:
  std::filesystem::path shown_, target_, fresh_;
  DiskCalls calls_;
  bool published_ = false;
};

/// Writes `text` to `path` in one atomic replacement, or directly if `path` is a pipe or a device.
void write_file(const std::filesystem::path& path, std::string_view text, const DiskCalls& calls = {});

/// The file, or its first `at_most` bytes. Throws FileError.
std::string read_file(const std::filesystem::path& path, std::size_t at_most = std::string::npos);

/// Throws FileError if `path` cannot be opened for reading.
void check_readable(const std::filesystem::path& path);

}  // namespace pintle
