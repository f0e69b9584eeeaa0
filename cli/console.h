// Standard output and standard error: who is reading, and did it arrive.
#pragma once

#include <string_view>

namespace pintle::cli {

/// A person at a terminal that understands escapes.
bool is_terminal(int descriptor);

/// Colour only on a terminal, and never where NO_COLOR is set.
bool wants_colour(int descriptor);

/// To standard output. Throws FileError if it does not arrive (a full disk, for example).
void print_out(std::string_view text);

/// To standard error.
void print_error(std::string_view text);

/// A line on standard error that rewrites itself, for a person who watches.
class StatusLine {
 public:
  StatusLine() = default;
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;
  ~StatusLine() { clear(); }

  void show(std::string_view text);
  /// Wipes the line, so that other output may follow.
  void clear();

 private:
  bool shown_ = false;
};

}  // namespace pintle::cli
