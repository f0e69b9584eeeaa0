#include "results/plots/plot_ticks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

namespace pintle {
namespace {

constexpr double kSteady = 1e-9;  // a range below this fraction of the values counts as zero
constexpr double kRoom = 0.05;  // free space above and below the data, as a fraction of their range

struct Prefix {
  int exponent;
  const char* text;
};
constexpr std::array<Prefix, 7> kPrefixes{{{-9, "n"}, {-6, "µ"}, {-3, "m"}, {0, ""}, {3, "k"}, {6, "M"}, {9, "G"}}};

bool takes_prefix(std::string_view unit, int exponent) {
  constexpr std::array<std::string_view, 6> kUnits{"N", "N*m", "W", "J", "m", "m/s"};
  return (unit == "s" && exponent < 0) || std::find(kUnits.begin(), kUnits.end(), unit) != kUnits.end();
}

void replace_all(std::string& text, std::string_view old, std::string_view fresh) {
  for (std::size_t at = text.find(old); at != std::string::npos; at = text.find(old, at + fresh.size()))
    text.replace(at, old.size(), fresh);
}

}  // namespace

double round_step(double x) {
  const double power = std::pow(10.0, std::floor(std::log10(x)));
  const double digit = x / power;
  return power * (digit < 1.5 ? 1 : digit < 3.5 ? 2 : digit < 7.5 ? 5 : 10);
}

std::vector<double> Axis::ticks() const {
  std::vector<double> result;
  const double slack = 1e-9 * (high - low);
  const auto first = std::ceil((low - slack) / step), last = std::floor((high + slack) / step);
  for (double i = first; i <= last; ++i) result.push_back(i * step + 0.0);  // never -0
  return result;
}

double Axis::share(double value) const {
  if (!log) return (value - low) / (high - low);
  return value > 0 ? (std::log10(value) - low) / (high - low) : std::numeric_limits<double>::quiet_NaN();
}

std::string Axis::label(double tick) const {
  return log ? printed_unit(fmt::format("10^{:.0f}", tick)) : tick_text(tick, step);
}

Axis make_log_axis(double low, double high, int n_ticks) {
  constexpr double kSlack = 1e-9;
  double first = std::floor(std::log10(low) + kSlack), last = std::ceil(std::log10(high) - kSlack);
  if (last <= first) last = first + 1;
  return {first, last, std::ceil((last - first) / n_ticks), true};
}

Axis make_axis(double low, double high, int n_ticks, bool tight) {
  const double size = std::max(std::abs(low), std::abs(high));
  if (high - low <= kSteady * size || high == low) {
    const double margin = size > 0 ? 0.1 * size : 1;
    low -= margin;
    high += margin;
  }
  const double step = round_step((high - low) / n_ticks);
  if (tight) return {low, high, step, false};
  const double margin = kRoom * (high - low);
  const bool from_zero = low >= 0 && low < margin, to_zero = high <= 0 && high > -margin;
  return {from_zero ? 0 : low - margin, to_zero ? 0 : high + margin, step, false};
}

AxisScale scale_for(double largest, const std::string& unit) {
  if (!(largest > 0) || !std::isfinite(largest) || (largest < 1e4 && largest >= 0.1)) return {1, printed_unit(unit)};
  const int exponent = 3 * static_cast<int>(std::floor(std::log10(largest) / 3));
  const int shown = std::clamp(exponent, -9, 9);
  if (takes_prefix(unit, exponent)) {
    const auto prefix =
        std::find_if(kPrefixes.begin(), kPrefixes.end(), [&](const Prefix& p) { return p.exponent == shown; });
    return {std::pow(10.0, shown), prefix->text + printed_unit(unit)};
  }
  if (exponent == 0) return {1, printed_unit(unit)};
  return {std::pow(10.0, exponent), printed_unit(fmt::format("10^{} {}", exponent, unit))};
}

std::string tick_text(double value, double step) {
  const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
  if (decimals > 8) return fmt::format("{:g}", value);
  std::string text = fmt::format("{:.{}f}", std::abs(value) < 1e-9 * step ? 0.0 : std::abs(value), decimals);
  return value < -1e-9 * step ? "−" + text : text;
}

std::string printed_number(const std::string& number) {
  const std::size_t e = number.find('e');
  if (e == std::string::npos) return number;
  const std::string power = printed_unit(fmt::format("10^{}", std::stoi(number.substr(e + 1))));
  return number.substr(0, e) == "1" ? power : number.substr(0, e) + "·" + power;
}

std::string printed_unit(const std::string& unit) {
  std::string text;
  bool raised = false;
  constexpr std::array<const char*, 10> kRaised{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  for (const char c : unit) {
    const bool digit = c >= '0' && c <= '9';
    if (c == '^') {
      raised = true;
    } else if (raised && (digit || c == '-')) {
      text += digit ? kRaised[static_cast<std::size_t>(c - '0')] : "⁻";
    } else {
      raised = false;
      text += c;
    }
  }
  replace_all(text, "*", "·");
  return text;
}

}  // namespace pintle
