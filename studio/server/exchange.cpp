#include "studio/server/exchange.h"

#include <algorithm>

namespace pintle::studio {
namespace {

constexpr std::size_t kLongestName = 255;

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }

}  // namespace

std::string Request::header(const std::string& name) const {
  std::string value;
  const auto [begin, end] = headers.equal_range(name);
  for (auto it = begin; it != end; ++it) value += (it == begin ? "" : ",") + it->second;
  return value;
}

std::string decoded(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    char c = text[i];
    if (c == '%') {
      const bool complete = i + 2 < text.size();
      const int high = complete ? hex_digit(text[i + 1]) : -1, low = complete ? hex_digit(text[i + 2]) : -1;
      if (high < 0 || low < 0) throw Refusal(400, "The address has a broken escape.");
      c = static_cast<char>(16 * high + low);
      i += 2;
    }
    if (is_control(c)) throw Refusal(400, "The address has a control character.");
    out += c;
  }
  return out;
}

std::vector<std::string> names_of_path(std::string_view path) {
  const auto refuse = [] { throw Refusal(400, "This path is not inside the folder.", "Use names of files and folders, separated by /."); };
  if (path.empty() || path.front() == '/') refuse();
  std::vector<std::string> names;
  std::size_t at = 0;
  while (at <= path.size()) {
    const std::size_t end = std::min(path.find('/', at), path.size());
    const std::string_view name = path.substr(at, end - at);
    if (name.empty() || name.front() == '.' || name.size() > kLongestName) refuse();
    if (std::any_of(name.begin(), name.end(), [](char c) { return c == '\\' || c == ':' || is_control(c); })) refuse();
    names.emplace_back(name);
    at = end + 1;
  }
  return names;
}

}  // namespace pintle::studio
