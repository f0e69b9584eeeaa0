#include "base/units.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "base/constants.h"
#include "base/unit_scanner.h"

namespace pintle {
namespace {

struct UnitEntry {
  std::string_view symbol;
  Unit unit;
};

constexpr Dimension kPerTime{{0, 0, -1, 0}, false};
constexpr Dimension kPower{{2, 1, -3, 0}, false};
constexpr Dimension kPressure{{-1, 1, -2, 0}, false};
constexpr double kPound = 0.45359237;  // international avoirdupois pound, exact [kg]
constexpr double kInch = 0.0254;       // exact [m]
constexpr double kPoundForce = kPound * kStandardGravity;  // [N]
constexpr double kFoot = 12 * kInch;                       // [m]

constexpr std::array kUnits{
    UnitEntry{"m", {1, kLength}},
    UnitEntry{"mm", {1e-3, kLength}},
    UnitEntry{"cm", {1e-2, kLength}},
    UnitEntry{"dm", {1e-1, kLength}},
    UnitEntry{"km", {1e3, kLength}},
    UnitEntry{"um", {1e-6, kLength}},
    UnitEntry{"\xC2\xB5m", {1e-6, kLength}},
    UnitEntry{"nm", {1e-9, kLength}},
    UnitEntry{"in", {kInch, kLength}},
    UnitEntry{"ft", {kFoot, kLength}},
    UnitEntry{"kg", {1, kMass}},
    UnitEntry{"g", {1e-3, kMass}},
    UnitEntry{"mg", {1e-6, kMass}},
    UnitEntry{"ug", {1e-9, kMass}},
    UnitEntry{"\xC2\xB5g", {1e-9, kMass}},
    UnitEntry{"t", {1e3, kMass}},
    UnitEntry{"lb", {kPound, kMass}},
    UnitEntry{"oz", {kPound / 16, kMass}},
    UnitEntry{"slug", {kPoundForce / kFoot, kMass}},
    UnitEntry{"s", {1, kTime}},
    UnitEntry{"ms", {1e-3, kTime}},
    UnitEntry{"us", {1e-6, kTime}},
    UnitEntry{"\xC2\xB5s", {1e-6, kTime}},
    UnitEntry{"ns", {1e-9, kTime}},
    UnitEntry{"min", {60, kTime}},
    UnitEntry{"h", {3600, kTime}},
    UnitEntry{"N", {1, kForce}},
    UnitEntry{"kN", {1e3, kForce}},
    UnitEntry{"MN", {1e6, kForce}},
    UnitEntry{"mN", {1e-3, kForce}},
    UnitEntry{"uN", {1e-6, kForce}},
    UnitEntry{"\xC2\xB5N", {1e-6, kForce}},
    UnitEntry{"nN", {1e-9, kForce}},
    UnitEntry{"lbf", {kPoundForce, kForce}},
    UnitEntry{"ozf", {kPoundForce / 16, kForce}},
    UnitEntry{"kip", {1e3 * kPoundForce, kForce}},
    UnitEntry{"J", {1, kTorque}},
    UnitEntry{"kJ", {1e3, kTorque}},
    UnitEntry{"mJ", {1e-3, kTorque}},
    UnitEntry{"W", {1, kPower}},
    UnitEntry{"kW", {1e3, kPower}},
    UnitEntry{"mW", {1e-3, kPower}},
    UnitEntry{"hp", {550 * kFoot * kPoundForce, kPower}},
    UnitEntry{"Pa", {1, kPressure}},
    UnitEntry{"kPa", {1e3, kPressure}},
    UnitEntry{"MPa", {1e6, kPressure}},
    UnitEntry{"GPa", {1e9, kPressure}},
    UnitEntry{"bar", {1e5, kPressure}},
    UnitEntry{"psi", {kPoundForce / (kInch * kInch), kPressure}},
    UnitEntry{"ksi", {1e3 * kPoundForce / (kInch * kInch), kPressure}},
    UnitEntry{"Hz", {1, kPerTime}},
    UnitEntry{"kHz", {1e3, kPerTime}},
    UnitEntry{"rad", {1, kAngle}},
    UnitEntry{"mrad", {1e-3, kAngle}},
    UnitEntry{"deg", {kTurn / 360, kAngle}},
    UnitEntry{"\xC2\xB0", {kTurn / 360, kAngle}},
    UnitEntry{"rev", {kTurn, kAngle}},
    UnitEntry{"rpm", {kTurn / 60, kAngularSpeed}},
    UnitEntry{"mph", {5280 * kFoot / 3600, kLinearSpeed}},
};

constexpr auto kSymbols = [] {
  std::array<std::string_view, kUnits.size()> symbols;
  for (std::size_t i = 0; i < kUnits.size(); ++i) symbols[i] = kUnits[i].symbol;
  return symbols;
}();

struct DimensionName {
  Dimension dimension;
  std::string_view words;
  std::string_view unit;
};

// Dimensions that have a name. If two differ only by radians, the one without radians comes first.
constexpr std::array kNames{
    DimensionName{kPureNumber, "a pure number", "1"},
    DimensionName{kAngle, "an angle", "rad"},
    DimensionName{kLength, "a length", "m"},
    DimensionName{kMass, "a mass", "kg"},
    DimensionName{kTime, "a time", "s"},
    DimensionName{{{2, 0, 0, 0}, false}, "an area", "m^2"},
    DimensionName{{{3, 0, 0, 0}, false}, "a volume", "m^3"},
    DimensionName{kLinearSpeed, "a speed", "m/s"},
    DimensionName{kAcceleration, "an acceleration", "m/s^2"},
    DimensionName{kPerTime, "a frequency", "1/s"},
    DimensionName{kAngularSpeed, "an angular speed", "rad/s"},
    DimensionName{{{0, 0, -2, 1}, false}, "an angular acceleration", "rad/s^2"},
    DimensionName{kInertia, "a moment of inertia", "kg*m^2"},
    DimensionName{kForce, "a force", "N"},
    DimensionName{kTorque, "a torque or an energy", "N*m"},
    DimensionName{kAngularStiffness, "an angular stiffness", "N*m/rad"},
    DimensionName{kPower, "a power", "W"},
    DimensionName{kPressure, "a pressure", "Pa"},
    DimensionName{kStiffness, "a stiffness", "N/m"},
    DimensionName{kDamping, "a damping", "N*s/m"},
    DimensionName{{{2, 1, -1, 0}, false}, "an angular momentum", "N*m*s"},
    DimensionName{kAngularDamping, "an angular damping", "N*m*s/rad"},
    DimensionName{{{1, 1, -1, 0}, false}, "an impulse", "N*s"},
};

const DimensionName* find_name(const Dimension& dimension) {
  const auto it = std::find_if(kNames.begin(), kNames.end(),
                               [&](const DimensionName& name) { return name.dimension == dimension; });
  return it == kNames.end() ? nullptr : &*it;
}

std::optional<Dimension> combined(const Dimension& a, const Dimension& b, int times_b) {
  Dimension result;
  for (std::size_t i = 0; i < result.exponents.size(); ++i) {
    const int exponent = a.exponents[i] + times_b * b.exponents[i];
    if (exponent < -100 || exponent > 100) return std::nullopt;
    result.exponents[i] = static_cast<std::int8_t>(exponent);
  }
  return result;
}

void append_power(std::string& text, std::string_view joint, std::string_view symbol, int exponent) {
  text.append(joint).append(symbol);
  if (exponent != 1) text.append("^").append(std::to_string(exponent));
}

// In base units: the numerator, then one divisor after another.
std::string spelled_out(const Dimension& dimension) {
  constexpr std::array<std::size_t, 4> kOrder{1, 0, 2, 3};
  constexpr std::array<std::string_view, 4> kBase{"m", "kg", "s", "rad"};
  std::string above;
  std::string below;
  for (const std::size_t i : kOrder) {
    const int exponent = dimension.exponents[i];
    if (exponent > 0) append_power(above, above.empty() ? "" : "*", kBase[i], exponent);
    if (exponent < 0) append_power(below, "/", kBase[i], -exponent);
  }
  return (above.empty() ? "1" : above) + below;
}

}  // namespace

std::optional<Unit> find_unit(std::string_view symbol) {
  const auto it =
      std::find_if(kUnits.begin(), kUnits.end(), [&](const UnitEntry& entry) { return entry.symbol == symbol; });
  if (it == kUnits.end()) return std::nullopt;
  return it->unit;
}

bool is_unit_symbol(std::string_view word) {
  return find_unit(word).has_value();
}

std::span<const std::string_view> unit_symbols() {
  return kSymbols;
}

std::optional<Unit> parse_unit(std::string_view text) {
  const auto none = [](std::string_view, const Unit& = {}) { return false; };
  if (text.empty() || text == "1") return Unit{1, kPureNumber};
  const bool is_inverse = text.starts_with("1/");
  const UnitScan scan = scan_unit(text, is_inverse ? 2 : 0, none, none);
  if (!scan.found || scan.end != text.size()) return std::nullopt;
  if (!is_inverse) return scan.unit;
  const std::optional<Dimension> dimension = quotient(kPureNumber, scan.unit.dimension);
  if (!dimension) return std::nullopt;
  return Unit{1 / scan.unit.factor, *dimension};
}

std::optional<Dimension> product(const Dimension& a, const Dimension& b) {
  return combined(a, b, 1);
}
std::optional<Dimension> quotient(const Dimension& a, const Dimension& b) {
  return combined(a, b, -1);
}

std::optional<Dimension> power(const Dimension& a, int exponent) {
  if (exponent < -100 || exponent > 100) return std::nullopt;
  return combined(kPureNumber, a, exponent);
}

bool fits(const Dimension& found, const Dimension& wanted) {
  if (found.any || wanted.any) return true;
  return std::equal(found.exponents.begin(), found.exponents.begin() + 3, wanted.exponents.begin());
}

bool is_pure(const Dimension& dimension) {
  return fits(dimension, kPureNumber);
}

std::string to_unit_text(const Dimension& dimension) {
  if (dimension.any) return "1";
  const DimensionName* name = find_name(dimension);
  return name ? std::string(name->unit) : spelled_out(dimension);
}

std::string to_words(const Dimension& dimension) {
  if (dimension.any) return "a bare number";
  if (dimension == kPureNumber) return "a pure number";
  const DimensionName* name = find_name(dimension);
  if (!name) return "a quantity in [" + spelled_out(dimension) + "]";
  return std::string(name->words) + " [" + std::string(name->unit) + "]";
}

std::optional<std::string> check_dimension(const Dimension& found, const Dimension& wanted) {
  if (fits(found, wanted)) return std::nullopt;
  std::string problem = to_words(wanted) + " is expected here, not " + to_words(found);
  const auto weighs = [](const Dimension& mass, const Dimension& force) {
    const std::optional<Dimension> weight = product(mass, kAcceleration);
    return weight && fits(*weight, force);
  };
  if (weighs(found, wanted)) problem += "; g, kg, oz and lb are masses: the forces are N, ozf and lbf";
  if (weighs(wanted, found)) problem += "; N, ozf and lbf are forces: the masses are g, kg, oz and lb";
  const std::optional<Dimension> inverse = quotient(kPureNumber, found);
  if (inverse && fits(*inverse, wanted)) problem += "; a unit belongs to the number before it, so that parentheses are needed in (3*4/12) " + to_unit_text(wanted);
  return problem;
}

}  // namespace pintle
