// Standard output and standard error: who is reading, and whether the output arrived.
#pragma once

#include <string_view>

namespace pintle::cli {

/// Whether a person reads it, at a terminal that understands escapes.
bool is_terminal(int descriptor);

/// Colour only on a terminal, and never if NO_COLOR is set.
bool wants_colour(int descriptor);

/// Writes to standard output. Throws FileError if it does not arrive (because of a full disk, for example).
void print_out(std::string_view text);

/// Writes to standard error.
void print_error(std::string_view text);

/// A line on standard error that overwrites itself, for a person watching.
class StatusLine {
 public:
  StatusLine() = default;
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;
  ~StatusLine() { clear(); }

  void show(std::string_view text);
  /// Clears the line, so that other output may follow.
  void clear();

 private:
  bool shown_ = false;
};

}  // namespace pintle::cli
