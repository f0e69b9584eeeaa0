// What is wrong with a user's input, where, why, and what to try.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace pintle {

/// A place in a text. Line and column count from 1; 0 means unknown.
struct Place {
  std::string file;
  int line = 0;
  int column = 0;
};

/// One complaint. `path` is the key in the model ("joint.A.stiffness"), `found` quotes the input, `because` says why it
/// is wrong, `suggestion` says what to try (may be empty). `source_line` is the line of the text above the caret.
struct Complaint {
  Place place;
  std::string path;
  std::string found;
  std::string because;
  std::string suggestion;
  std::string source_line;
};

/// One complaint as text: `file:line:column: path`, then the found/because line, the source line and a caret.
std::string to_text(const Complaint& complaint);

/// All complaints about one input, thrown together.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<Complaint> complaints);
  const std::vector<Complaint>& complaints() const { return complaints_; }

 private:
  std::vector<Complaint> complaints_;
};

}  // namespace pintle
