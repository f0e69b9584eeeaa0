#include "results/disk.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>

namespace pintle {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kBufferSize = std::size_t{1} << 18;

std::string_view advice(int error_number) {
  switch (error_number) {
    case ENOSPC:
      return "Free some space, or choose another place with --out.";
    case EDQUOT:
      return "The disk quota is used up: free some space, or choose another place with --out.";
    case EFBIG:
      return "The file would exceed the size limit (see ulimit -f): raise it, or ask for fewer rows (output_step).";
    case EACCES:
    case EPERM:
    case EROFS:
      return "Check the permissions, or choose another place.";
    case ENOENT:
      return "Check the spelling of the path.";
    default:
      return "";
  }
}

/// The folder that holds `path`, never empty.
fs::path parent_of(const fs::path& path) {
  const fs::path parent = path.parent_path();
  return parent.empty() ? fs::path(".") : parent;
}

/// The real path of `path`: links resolved, no trailing slash; it need not exist.
fs::path real_place(const fs::path& path) {
  std::error_code error;
  fs::path place = fs::weakly_canonical(fs::absolute(path), error);
  if (error) throw file_error(path, "resolve", error.value());
  return place.has_filename() ? place : place.parent_path();
}

/// An unused name next to `target`, tried with `make` until it does not exist yet.
template <class Make>
fs::path unused_sibling(const fs::path& target, const Make& make) {
  for (int attempt = 0; attempt < 1000; ++attempt) {
    const fs::path path =
        parent_of(target) / fmt::format(".{}.{}-{}.tmp", target.filename().string(), ::getpid(), attempt);
    if (make(path)) return path;
    if (errno != EEXIST) throw file_error(path, "create", errno);
  }
  throw file_error(target, "find a temporary name beside", EEXIST);
}

/// Makes a rename in `folder` survive a power cut. Some file systems cannot do this; that is not an error.
void sync_folder(const fs::path& folder, const DiskCalls& calls) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  calls.sync(descriptor);
  ::close(descriptor);
}

/// Swaps two folders atomically if the system supports it; otherwise returns false.
bool exchange([[maybe_unused]] const fs::path& a, [[maybe_unused]] const fs::path& b) {
#ifdef RENAME_EXCHANGE
  return ::renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) == 0;
#else
  return false;
#endif
}

/// Swaps them by three renames, which are undone if one fails.
void exchange_in_steps(const fs::path& fresh, const fs::path& target) {
  const fs::path aside = fresh.string() + ".old";
  if (std::rename(target.c_str(), aside.c_str()) != 0) throw file_error(target, "replace", errno);
  if (std::rename(fresh.c_str(), target.c_str()) != 0) {
    const int why = errno;
    std::rename(aside.c_str(), target.c_str());
    throw file_error(target, "replace", why);
  }
  if (std::rename(aside.c_str(), fresh.c_str()) != 0) throw file_error(aside, "rename", errno);
}

/// Moves entries that only the old folder has into the new one. False if something could not be moved.
bool move_strangers(const fs::path& from, const fs::path& to) {
  std::error_code unreadable;
  bool all = true;
  for (const fs::directory_entry& entry : fs::directory_iterator(from, unreadable)) {
    const fs::path destination = to / entry.path().filename();
    std::error_code absent;
    const bool both_folders = entry.is_directory(absent) && !entry.is_symlink(absent) && fs::is_directory(fs::symlink_status(destination, absent));
    if (both_folders) all = move_strangers(entry.path(), destination) && all;
    if (fs::exists(fs::symlink_status(destination, absent))) continue;
    all = std::rename(entry.path().c_str(), destination.c_str()) == 0 && all;
  }
  return all && !unreadable;
}

/// Pipes, terminals and devices cannot be replaced by renaming, so they are written to directly.
bool is_special(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

void write_all(int descriptor, std::string_view text, const fs::path& path, const DiskCalls& calls) {
  while (!text.empty()) {
    const ssize_t written = calls.write(descriptor, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw file_error(path, "write", errno);
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

void write_special(const fs::path& path, std::string_view text, const DiskCalls& calls) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) throw file_error(path, "open", errno);
  try {
    write_all(descriptor, text, path, calls);
  } catch (...) {
    ::close(descriptor);
    throw;
  }
  if (::close(descriptor) != 0) throw file_error(path, "write", errno);
}

}  // namespace

DiskCalls::DiskCalls() : write(::write), sync(::fsync) {}

FileError file_error(const fs::path& path, std::string_view doing, int error_number) {
  std::string text = fmt::format("{}: cannot {} it: {}.", path.string(), doing, std::strerror(error_number));
  if (const std::string_view hint = advice(error_number); !hint.empty()) text += fmt::format("\n    {}", hint);
  return FileError(text);
}

NewFile::NewFile(const fs::path& path, const DiskCalls& calls, const fs::path& shown) : shown_(shown.empty() ? path : shown), calls_(calls) {
  descriptor_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor_ < 0) throw file_error(shown_, "create", errno);
  buffer_.reserve(kBufferSize);
}

NewFile::~NewFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void NewFile::append(std::string_view text) {
  buffer_.append(text);
  if (buffer_.size() >= kBufferSize) flush();
}

void NewFile::flush() {
  write_all(descriptor_, buffer_, shown_, calls_);
  buffer_.clear();
}

void NewFile::close() {
  flush();
  if (calls_.sync(descriptor_) != 0 && errno != EINVAL) throw file_error(shown_, "write", errno);
  const int closed = ::close(descriptor_);
  descriptor_ = -1;
  if (closed != 0) throw file_error(shown_, "write", errno);
}

NewFolder::NewFolder(const fs::path& target, const DiskCalls& calls) : target_(real_place(target)), calls_(calls) {
  std::error_code error;
  fs::create_directories(target_.parent_path(), error);
  if (error) throw file_error(target_.parent_path(), "create", error.value());
  path_ = unused_sibling(target_, [](const fs::path& path) { return ::mkdir(path.c_str(), 0777) == 0; });
}

NewFolder::~NewFolder() {
  std::error_code ignored;
  if (!published_) fs::remove_all(path_, ignored);
}

void NewFolder::publish(const std::vector<std::string>& outdated) {
  sync_folder(path_, calls_);
  if (!fs::exists(target_)) {
    if (std::rename(path_.c_str(), target_.c_str()) != 0) throw file_error(target_, "create", errno);
    published_ = true;
  } else {
    if (!exchange(path_, target_)) exchange_in_steps(path_, target_);
    published_ = true;  // from here on path_ holds the old content
    std::error_code ignored;
    for (const std::string& name : outdated) fs::remove(path_ / name, ignored);
    if (!move_strangers(path_, target_))
      throw FileError(fmt::format("{}: other files of the old folder could not be moved back; they are in {}.",
                                  target_.string(), path_.string()));
    fs::remove_all(path_, ignored);
  }
  sync_folder(target_.parent_path(), calls_);
}

void write_file(const fs::path& path, std::string_view text, const DiskCalls& calls) {
  if (is_special(path)) return write_special(path, text, calls);
  Replacement file(path, calls);
  NewFile fresh(file.fresh(), calls, path);
  fresh.append(text);
  fresh.close();
  file.publish();
}

Replacement::Replacement(const fs::path& target, const DiskCalls& calls) : shown_(target), target_(real_place(target)), calls_(calls) {
  if (fs::is_directory(target_)) throw file_error(target, "write", EISDIR);
  fresh_ = unused_sibling(target_, [](const fs::path& name) {
    const bool unused = ::access(name.c_str(), F_OK) != 0;
    errno = EEXIST;
    return unused;
  });
}

Replacement::~Replacement() {
  if (!published_) ::unlink(fresh_.c_str());
}

void Replacement::publish() {
  struct stat old {};
  if (::stat(target_.c_str(), &old) == 0) ::chmod(fresh_.c_str(), old.st_mode & 07777);
  if (std::rename(fresh_.c_str(), target_.c_str()) != 0) throw file_error(shown_, "replace", errno);
  published_ = true;
  sync_folder(parent_of(target_), calls_);
}

std::string read_file(const fs::path& path, std::size_t at_most) {
  check_readable(path);
  std::FILE* file = std::fopen(path.c_str(), "rbe");
  if (file == nullptr) throw file_error(path, "read", errno);
  std::string text;
  std::string chunk(kBufferSize, '\0');
  while (text.size() < at_most) {
    const std::size_t n = std::fread(chunk.data(), 1, std::min(chunk.size(), at_most - text.size()), file);
    if (n == 0) break;
    text.append(chunk, 0, n);
  }
  const bool failed = std::ferror(file) != 0;
  const int why = errno;
  std::fclose(file);
  if (failed) throw file_error(path, "read", why);
  return text;
}

void check_readable(const fs::path& path) {
  if (::access(path.c_str(), R_OK) != 0) throw file_error(path, "read", errno);
  if (fs::is_directory(path)) throw file_error(path, "read", EISDIR);
}

}  // namespace pintle
