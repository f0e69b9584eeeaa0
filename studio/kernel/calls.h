// What the studio asks the kernel: a call by its name, with JSON in, and JSON with arrays of numbers out. docs/reference/studio.md
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace pintle::studio {

/// `text` is {"value": ...} or {"fault": {"message", "hint", ...}}. Where the value has {"f64": i}, arrays[i] is meant.
struct Answer {
  std::string text;
  std::vector<std::vector<double>> arrays;
};

/// Told how far a run is, as JSON; false ends the run, which keeps what it has.
using OnProgress = std::function<bool(std::string_view)>;

/// The calls, and the sessions that some of them open. Nothing is thrown: every error is a fault.
class Kernel {
 public:
  Kernel();
  ~Kernel();
  Kernel(const Kernel&) = delete;
  Kernel& operator=(const Kernel&) = delete;

  Answer call(std::string_view name, std::string_view arguments, const OnProgress& on_progress = {});

 private:
  struct Sessions;
  std::unique_ptr<Sessions> sessions_;
};

/// An answer in one piece: the length of the text (4 bytes, little-endian), the number of arrays (4), the length of each (4),
/// zeros up to a multiple of 8, the numbers of all arrays (8 each), the text.
std::string packed(const Answer& answer);

}  // namespace pintle::studio
