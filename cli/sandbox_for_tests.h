// A folder in which the program is run, and its answers: for the tests of the command line.
#pragma once

#include <fmt/format.h>
#include <sys/wait.h>

#include <cstdlib>
#include <string>

#include "results/disk.h"
#include "results/sample_run_for_tests.h"

namespace pintle::sample {

struct Answer {
  int exit_code = -1;
  std::string out, error;
};

class Sandbox {
 public:
  /// Runs a shell command in the folder; $PINTLE is the program.
  Answer shell(const std::string& command) {
    const std::string line = fmt::format("cd '{}' && PINTLE='{}' && export TERM=xterm && {{ {} ; }} > .out 2> .error",
                                         folder_.path().string(), PINTLE_BINARY, command);
    const int status = std::system(line.c_str());
    Answer answer;
    answer.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    answer.out = read_file(folder_ / ".out");
    answer.error = read_file(folder_ / ".error");
    return answer;
  }
  Answer pintle(const std::string& words) { return shell("\"$PINTLE\" " + words); }

  void write(const std::string& name, std::string_view text) { write_file(folder_ / name, text); }
  std::string read(const std::string& name) const { return read_file(folder_ / name); }
  bool has(const std::string& name) const { return std::filesystem::exists(folder_ / name); }
  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }

 private:
  ScratchFolder folder_;
};

/// A bob of 1 kg, 1 m from its pin, horizontal at the start; tests look for its comment.
inline std::string pendulum_toml(const std::string& duration, const std::string& output_step) {
  return fmt::format(R"(format = 1
name = "Pendulum"
[simulate]
duration = "{}"
output_step = "{}"
[ground.markers]
O = [0, 0]
[body.bob]
mass = "1 kg"
inertia = "0.1 kg*m^2"
position = [1, 0]
angle = 0
markers.O = [-1, 0]
[joint.pin]  # its bearing
type = "revolute"
between = ["ground.O", "bob.O"]
)",
                     duration, output_step);
}

/// Runs a shell command and sends it the signal after some seconds; in the foreground, so that it gets only one. Exit code: the command's.
inline std::string signalled(const char* signal, double seconds, const std::string& command) {
  return fmt::format("timeout --foreground --preserve-status -s {} {} {}", signal, seconds, command);
}

inline bool holds(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

}  // namespace pintle::sample
