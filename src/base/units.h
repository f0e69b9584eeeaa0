// Units and dimensions: symbols with their SI factors, and the arithmetic and names of dimensions.
//
// The radian is carried along so that messages can say "an angle", but it never decides whether two dimensions agree:
// rad and 1 are interchangeable, as are N*m/rad and N*m.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "pintle/expression.h"

namespace pintle {

/// `symbol` times `factor` is the SI value.
struct Unit {
  double factor = 1;
  Dimension dimension;
};

inline constexpr Dimension kBareNumber{{0, 0, 0, 0}, true};
inline constexpr Dimension kPureNumber{{0, 0, 0, 0}, false};
inline constexpr Dimension kLength{{1, 0, 0, 0}, false};
inline constexpr Dimension kMass{{0, 1, 0, 0}, false};
inline constexpr Dimension kTime{{0, 0, 1, 0}, false};
inline constexpr Dimension kAngle{{0, 0, 0, 1}, false};
inline constexpr Dimension kLinearSpeed{{1, 0, -1, 0}, false};
inline constexpr Dimension kAcceleration{{1, 0, -2, 0}, false};
inline constexpr Dimension kAngularSpeed{{0, 0, -1, 1}, false};
inline constexpr Dimension kInertia{{2, 1, 0, 0}, false};
inline constexpr Dimension kForce{{1, 1, -2, 0}, false};
inline constexpr Dimension kTorque{{2, 1, -2, 0}, false};
inline constexpr Dimension kStiffness{{0, 1, -2, 0}, false};
inline constexpr Dimension kDamping{{0, 1, -1, 0}, false};
inline constexpr Dimension kAngularStiffness{{2, 1, -2, -1}, false};
inline constexpr Dimension kAngularDamping{{2, 1, -1, -1}, false};

/// The unit written `symbol` ("mm", "kN", "deg"; no products), if there is one.
std::optional<Unit> find_unit(std::string_view symbol);
bool is_unit_symbol(std::string_view word);
/// Every symbol, in the manual's order.
std::span<const std::string_view> unit_symbols();

/// The unit given by a whole text: symbols joined by *, / and whole exponents, with parentheses: "N*m*s/rad",
/// "kg/(m*s)". The empty text is the pure number. Nothing if it is not a unit.
std::optional<Unit> parse_unit(std::string_view text);

/// Products and powers of known dimensions; nothing if an exponent leaves the range of -100 to 100.
std::optional<Dimension> product(const Dimension& a, const Dimension& b);
std::optional<Dimension> quotient(const Dimension& a, const Dimension& b);
std::optional<Dimension> power(const Dimension& a, int exponent);

/// Whether these agree. Bare numbers fit everything, and the radian does not count.
bool fits(const Dimension& found, const Dimension& wanted);
/// Whether this is a number or an angle.
bool is_pure(const Dimension& dimension);

/// In units: "m", "N/m", "kg*m/s^3", "1" for a pure number.
std::string to_unit_text(const Dimension& dimension);
/// In words and units: "a length [m]", "a bare number", "a quantity in [kg*m/s^3]".
std::string to_words(const Dimension& dimension);

/// Nothing if `found` may be used where `wanted` is required, otherwise the reason: "a mass [kg] is expected here, not a length [m]".
std::optional<std::string> check_dimension(const Dimension& found, const Dimension& wanted);

}  // namespace pintle
