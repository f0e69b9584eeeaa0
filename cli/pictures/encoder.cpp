#include "cli/pictures/encoder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "cli/interrupt.h"
#include "pintle/results.h"
#include "results/disk.h"

extern char** environ;

namespace pintle::cli {
namespace fs = std::filesystem;
namespace {

std::vector<std::string> command(const fs::path& film, FilmForm form, int width, int height, double frames_per_second, int n_samples) {
  const std::string rate = fmt::format("{}", frames_per_second);
  std::vector<std::string> words{"ffmpeg", "-hide_banner", "-loglevel", "error", "-y", "-f", "rawvideo", "-pix_fmt", "bgr0", "-video_size",
                                 fmt::format("{}x{}", width, height), "-framerate", rate, "-i", "pipe:0", "-an"};
  const auto add = [&words](std::initializer_list<const char*> more) { words.insert(words.end(), more.begin(), more.end()); };
  // A palette made for the film; flat colours need no dithering. A palette from all frames would require storing them all until the end.
  const std::string palette = fmt::format("split[a][b];[a]trim=end_frame={0},palettegen=stats_mode=full[p];[b]trim=start_frame={0},setpts=PTS-STARTPTS[c];"
                                          "[c][p]paletteuse=dither=none:diff_mode=rectangle", n_samples);
  if (form == FilmForm::kGif)
    add({"-filter_complex", palette.c_str(), "-loop", "0", "-f", "gif"});
  else
    add({"-c:v", "libvpx-vp9", "-crf", "26", "-b:v", "0", "-pix_fmt", "yuv420p", "-deadline", "good", "-cpu-used", "4", "-row-mt", "1", "-f", "webm"});
  words.push_back("file:" + film.string());
  return words;
}

}  // namespace

FilmEncoder::FilmEncoder(const fs::path& film, FilmForm form, int width, int height, double frames_per_second, int n_samples) : file_(film) {
  start(command(file_.fresh(), form, width, height, frames_per_second, n_samples));
}

FilmEncoder::~FilmEncoder() {
  if (frames_ >= 0) ::close(frames_);
  if (process_ > 0) {
    ::kill(process_, SIGKILL);
    wait();
  }
  if (complaints_ >= 0) ::close(complaints_);
}

void FilmEncoder::start(const std::vector<std::string>& words) {
  ::signal(SIGPIPE, SIG_IGN);  // an encoder that ends early then causes a failed write instead of killing this program
  int pipe_ends[2];
  if (::pipe2(pipe_ends, O_CLOEXEC) != 0) throw file_error(file_.target(), "write", errno);
  std::FILE* complaints = std::tmpfile();
  if (complaints) complaints_ = ::fcntl(::fileno(complaints), F_DUPFD_CLOEXEC, 3);
  if (complaints) std::fclose(complaints);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, pipe_ends[0], STDIN_FILENO);
  if (complaints_ >= 0) posix_spawn_file_actions_adddup2(&actions, complaints_, STDERR_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);  // Ctrl-C reaches only this program, which then ends the encoder
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const int failed = ::posix_spawnp(&process_, "ffmpeg", &actions, &attributes, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  ::close(pipe_ends[0]);
  frames_ = pipe_ends[1];
  if (!failed) return;
  process_ = -1;
  ::close(frames_);
  if (complaints_ >= 0) ::close(complaints_);
  if (failed == ENOENT)
    throw FileError("ffmpeg: not found, but films need it.\n    Install it: apt-get install ffmpeg. A still as SVG or PNG works without it: --still TIME.");
  throw FileError(fmt::format("ffmpeg: cannot be started: {}.", std::strerror(failed)));
}

bool FilmEncoder::wait() {
  int status = 0;
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) continue;
  process_ = -1;
  ended_by_ = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

void FilmEncoder::fail() {
  if (frames_ >= 0) ::close(frames_);
  frames_ = -1;
  if (process_ > 0) wait();
  std::string why(400, '\0');
  const ssize_t n = complaints_ >= 0 ? ::pread(complaints_, why.data(), why.size(), 0) : 0;
  why.resize(n > 0 ? static_cast<std::size_t>(n) : 0);
  while (!why.empty() && (why.back() == '\n' || why.back() == '.')) why.pop_back();
  if (why.empty() && ended_by_ != 0) why = fmt::format("it was ended by signal {} ({})", ended_by_, ::strsignal(ended_by_));
  throw FileError(fmt::format("{}: ffmpeg could not write the film{}{}.", file_.target().string(), why.empty() ? "" : ": ", why));
}

void FilmEncoder::add(const Pixels& frame) {
  const unsigned char* from = frame.bytes.data();
  for (std::size_t left = frame.bytes.size(); left > 0;) {
    const ssize_t n = ::write(frames_, from, left);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail();
    from += n;
    left -= static_cast<std::size_t>(n);
  }
}

bool FilmEncoder::finish() {
  ::close(frames_);
  frames_ = -1;
  siginfo_t ended{};  // polled at short intervals, so that Ctrl-C is noticed
  while (::waitid(P_PID, static_cast<id_t>(process_), &ended, WEXITED | WNOHANG | WNOWAIT) == 0 && ended.si_pid == 0) {
    if (interrupted()) return false;
    ::usleep(20'000);
  }
  if (!wait()) fail();
  file_.publish();
  return true;
}

}  // namespace pintle::cli
