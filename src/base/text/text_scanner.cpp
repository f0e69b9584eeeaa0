#include "base/text/text_scanner.h"

#include <array>
#include <limits>
#include <locale>
#include <sstream>
#include <string>

namespace pintle {
namespace {

constexpr std::string_view kDegree = "\xC2\xB0";
constexpr std::string_view kMicro = "\xC2\xB5";

struct Spelling {
  std::string_view text;
  char symbol;
};

// Longer spellings first.
constexpr std::array<Spelling, 13> kOperators{{
    {"<=", 'l'},
    {">=", 'g'},
    {"\xE2\x88\x92", '-'},  // minus sign
    {"\xE2\x8B\x85", '*'},  // dot operator
    {"\xC2\xB7", '*'},      // middle dot
    {"\xC3\x97", '*'},      // multiplication sign
    {"+", '+'},
    {"-", '-'},
    {"*", '*'},
    {"/", '/'},
    {"^", '^'},
    {"<", '<'},
    {">", '>'},
}};

std::size_t skip_digits(std::string_view text, std::size_t at) {
  while (at < text.size() && is_digit(text[at])) ++at;
  return at;
}

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

}  // namespace

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_word_start(char c) {
  return is_letter(c) || c == '_';
}
bool is_word_part(char c) {
  return is_word_start(c) || is_digit(c);
}

std::size_t skip_blanks(std::string_view text, std::size_t at) {
  while (at < text.size() && std::string_view(" \t\r\n").find(text[at]) != std::string_view::npos) ++at;
  return at;
}

std::string_view word_at(std::string_view text, std::size_t at) {
  if (at >= text.size() || !is_word_start(text[at])) return {};
  std::size_t end = at + 1;
  while (end < text.size() && is_word_part(text[end])) ++end;
  return text.substr(at, end - at);
}

std::string_view symbol_at(std::string_view text, std::size_t at) {
  if (at >= text.size()) return {};
  const std::string_view rest = text.substr(at);
  if (rest.starts_with(kDegree)) return rest.substr(0, kDegree.size());
  if (rest.starts_with(kMicro)) return rest.substr(0, kMicro.size() + word_at(rest, kMicro.size()).size());
  return word_at(text, at);
}

std::string_view number_at(std::string_view text, std::size_t at) {
  std::size_t end = skip_digits(text, at);
  std::size_t n_digits = end - at;
  if (end < text.size() && text[end] == '.') {
    const std::size_t fraction = skip_digits(text, end + 1);
    n_digits += fraction - (end + 1);
    end = fraction;
  }
  if (n_digits == 0) return {};
  if (end < text.size() && (text[end] == 'e' || text[end] == 'E')) {
    std::size_t exponent = end + 1;
    if (exponent < text.size() && (text[exponent] == '+' || text[exponent] == '-')) ++exponent;
    if (exponent < text.size() && is_digit(text[exponent])) end = skip_digits(text, exponent);
  }
  return text.substr(at, end - at);
}

double to_number(std::string_view number) {
  std::istringstream stream{std::string(number)};
  stream.imbue(std::locale::classic());
  double value = 0;
  if (stream >> value) return value;
  return value == 0 ? 0 : std::numeric_limits<double>::infinity();
}

std::optional<OperatorAt> operator_at(std::string_view text, std::size_t at) {
  if (at >= text.size()) return std::nullopt;
  for (const Spelling& spelling : kOperators) {
    if (text.substr(at).starts_with(spelling.text)) return OperatorAt{spelling.symbol, spelling.text.size()};
  }
  return std::nullopt;
}

}  // namespace pintle
