// A request to the server of the studio, and what it answers, apart from how they travel.
#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pintle::studio {

struct Request {
  std::string method;                          // "GET"
  std::string target;                          // as sent: path and query, percent-encoded
  std::multimap<std::string, std::string> headers;  // names in lower case
  std::string body;

  /// The header's value, empty when it is absent. A header that comes twice counts as its values joined by a comma.
  std::string header(const std::string& name) const;
  bool has(const std::string& name) const { return headers.contains(name); }
};

struct Reply {
  int status = 200;
  std::string type = "application/json";
  std::string body;
  std::vector<std::pair<std::string, std::string>> headers;
};

/// A request that is refused: the status, what is wrong, what to try.
class Refusal : public std::runtime_error {
 public:
  Refusal(int with_status, const std::string& message, std::string what_to_try = {})
      : std::runtime_error(message), status(with_status), hint(std::move(what_to_try)) {}
  int status;
  std::string hint;
};

/// Percent-decoded once. Throws Refusal for a broken escape, a NUL or another control character.
std::string decoded(std::string_view text);

/// The names on the way of a path below a folder: "a/b.toml". Throws Refusal for anything that could lead elsewhere: an absolute
/// path, "..", a backslash, an empty or hidden name.
std::vector<std::string> names_of_path(std::string_view path);

}  // namespace pintle::studio
