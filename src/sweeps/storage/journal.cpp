#include "sweeps/storage/journal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <stdexcept>
#include <utility>

namespace pintle {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostWaiting = std::size_t{1} << 20U;
constexpr std::size_t kReadAtOnce = std::size_t{1} << 22U;

std::string head_of(const std::string& plan, std::uint64_t n_samples) {
  return fmt::format("pintle sweep journal 1\nplan {}\nsamples {}\n\n", plan, n_samples);
}

std::string read_at(int descriptor, std::uint64_t offset, std::size_t size, const fs::path& path) {
  struct stat file {};
  if (::fstat(descriptor, &file) != 0) throw file_error(path, "read", errno);
  const auto end = static_cast<std::uint64_t>(file.st_size);
  size = end > offset ? std::min<std::uint64_t>(size, end - offset) : 0;
  std::string bytes(size, '\0');
  std::size_t have = 0;
  while (have < size) {
    const ssize_t n = ::pread(descriptor, bytes.data() + have, size - have, static_cast<off_t>(offset + have));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw file_error(path, "read", errno);
    if (n == 0) break;
    have += static_cast<std::size_t>(n);
  }
  bytes.resize(have);
  return bytes;
}

}  // namespace

Journal::Journal(fs::path path, const std::string& plan, std::uint64_t n_samples, bool force, DiskCalls calls)
    : path_(std::move(path)), calls_(std::move(calls)), offsets_(n_samples, 0) {
  descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor_ < 0) throw file_error(path_, "open", errno);
  try {
    open(head_of(plan, n_samples), force);
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

Journal::~Journal() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void Journal::open(const std::string& head, bool force) {
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)  // some network disks do not support locks
    throw FileError(fmt::format("{}: another pintle sweep is writing it.\n    try: wait for it, or another --out", path_.string()));
  const std::string found = read_at(descriptor_, 0, head.size(), path_);
  const bool same = found == head;
  const bool torn = head.compare(0, found.size(), found) == 0;  // empty, or the process was killed while starting it
  if (!same && !torn && !force)
    throw FileError(fmt::format("{}: this is the journal of another sweep, with other values, another model or other options.\n"
                                "    try: the command that started it to continue it, another --out, or --force to discard it",
                                path_.string()));
  if (same && !force) return read_frames(head.size());
  if (::ftruncate(descriptor_, 0) != 0) throw file_error(path_, "write", errno);
  waiting_ = head;
  end_ = head.size();
  flush(true);
}

// Everything from the first damaged frame on is cut off: those samples are computed again.
void Journal::read_frames(std::uint64_t start) {
  end_ = start;  // end of the valid part
  std::string bytes;
  for (std::size_t used = 0;;) {
    const std::size_t before = used;
    if (const auto frame = read_frame(bytes, used)) {
      if (frame->sample >= offsets_.size()) break;
      if (!has(frame->sample)) note(frame->sample, frame->result.status, end_);
      end_ += used - before;
      continue;
    }
    const std::size_t left = bytes.size() - used;
    std::string more = read_at(descriptor_, end_, std::max(kReadAtOnce, frame_length(std::string_view(bytes).substr(used))), path_);
    if (more.size() <= left) break;
    bytes = std::move(more);
    used = 0;
  }
  if (::ftruncate(descriptor_, static_cast<off_t>(end_)) != 0) throw file_error(path_, "write", errno);
}

void Journal::note(std::uint64_t sample, SampleStatus status, std::uint64_t offset) {
  offsets_[sample] = offset;
  ++n_done_;
  if (status != SampleStatus::kCompleted) ++n_troubled_;
}

void Journal::add(std::uint64_t sample, const SampleResult& result) {
  if (sample >= offsets_.size() || has(sample)) throw std::logic_error("a sample is computed twice");
  const std::size_t before = waiting_.size();
  append_frame(waiting_, sample, result);
  note(sample, result.status, end_);
  end_ += waiting_.size() - before;
  if (waiting_.size() > kMostWaiting) flush(false);
}

void Journal::flush(bool sync) {
  for (std::size_t done = 0; done < waiting_.size();) {
    const ssize_t n = calls_.write(descriptor_, waiting_.data() + done, waiting_.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw file_error(path_, "write", errno);
    done += static_cast<std::size_t>(n);
  }
  waiting_.clear();
  if (sync && calls_.sync(descriptor_) != 0 && errno != EINVAL) throw file_error(path_, "write", errno);
}

SampleResult Journal::read(std::uint64_t sample) const {
  const std::uint64_t offset = offsets_[sample];
  const std::string head = read_at(descriptor_, offset, kFrameHead, path_);
  const std::string bytes = read_at(descriptor_, offset, frame_length(head), path_);
  std::size_t at = 0;
  auto frame = read_frame(bytes, at);
  if (!frame || frame->sample != sample) throw FileError(path_.string() + ": it was damaged while in use.\n    try: the same command again");
  return std::move(frame->result);
}

void Journal::remove() {
  ::unlink(path_.c_str());
  ::close(descriptor_);
  descriptor_ = -1;
}

}  // namespace pintle
