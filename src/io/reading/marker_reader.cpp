// Markers: a point and an axis, in Cartesian coordinates or in the paper's polar form.

#include <cmath>
#include <numbers>

#include "base/units.h"
#include "io/reading/record.h"
#include "io/text.h"

namespace pintle {
namespace {

KeySpec part(const char* key, bool is_length) {
  KeySpec spec;
  spec.key = key;
  spec.type = ValueType::kQuantity;
  spec.unit = is_length ? "m" : "rad";
  spec.dimension = is_length ? kLength : kAngle;
  return spec;
}

const KeySpec* find_part(std::string_view key) {
  static const std::array<KeySpec, 5> kParts{part("x", true), part("y", true), part("r", true), part("xi", false),
                                             part("axis", false)};
  for (const KeySpec& spec : kParts) {
    if (spec.key == key) return &spec;
  }
  return nullptr;
}

// The unit vector at an angle; exact at whole quarter turns, so that "180 deg" is exact.
Vec2 direction(double angle) {
  constexpr double kQuarter = std::numbers::pi / 2;
  const double quarters = std::round(angle / kQuarter);
  if (std::abs(quarters) > 1000 || angle != quarters * kQuarter) return {std::cos(angle), std::sin(angle)};
  constexpr std::array<Vec2, 4> kExact{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  return kExact[static_cast<std::size_t>(static_cast<int>(quarters) & 3)];
}

constexpr const char* kForms = "[x, y], [x, y, axis], { x = 0, y = 0, axis = 0 } or { r = 1, xi = 0, axis = 0 }";

}  // namespace

std::optional<Marker> RecordReader::read_marker(const Entry& entry, const std::string& path) {
  Marker marker;
  marker.name = entry.key;
  bool good = false;
  if (const Array* list = entry.value.array()) {
    good = read_marker_list(*list, path, marker);
    if (list->size() != 2 && list->size() != 3) {
      complaints_.add(entry.value.spot, path, describe(entry.value), "a marker has two or three numbers", kForms);
    }
  } else if (const Table* table = entry.value.table()) {
    good = read_marker_table(*table, entry, path, marker);
  } else {
    complaints_.add(entry.value.spot, path, describe(entry.value), "this is not a marker", kForms);
  }
  if (!good) return std::nullopt;
  return marker;
}

bool RecordReader::read_marker_list(const Array& list, const std::string& path, Marker& marker) {
  if (list.size() != 2 && list.size() != 3) return false;
  const std::array<double*, 3> targets{&marker.position[0], &marker.position[1], &marker.axis};
  const std::array<const char*, 3> keys{"x", "y", "axis"};
  bool good = true;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::optional<double> number = read_number(list[i], *find_part(keys[i]), path);
    *targets[i] = number.value_or(0);
    good = good && number.has_value();
  }
  return good;
}

bool RecordReader::read_marker_table(const Table& table, const Entry& entry, const std::string& path, Marker& marker) {
  std::map<std::string, double, std::less<>> parts;
  bool good = true;
  for (const Entry& inner : table.entries()) {
    const std::string inner_path = path + "." + inner.key;
    const KeySpec* spec = find_part(inner.key);
    if (spec == nullptr) {
      complaints_.add(inner.key_spot, inner_path, "unknown key " + in_quotes(inner.key), "markers have no such key",
                      kForms);
      good = false;
    } else {
      const std::optional<double> number = read_number(inner.value, *spec, inner_path);
      parts[inner.key] = number.value_or(0);
      good = good && number.has_value();
    }
  }
  const bool polar = parts.count("r") + parts.count("xi") > 0;
  const bool cartesian = parts.count("x") + parts.count("y") > 0;
  const bool complete = polar ? parts.count("r") == 1 : parts.count("x") + parts.count("y") == 2;
  if (good && (polar == cartesian || !complete)) {
    complaints_.add(entry.key_spot, path,
                    polar && cartesian ? "polar and Cartesian keys together" : "an incomplete marker",
                    "a marker has x and y, or r and xi", kForms);
    return false;
  }
  marker.axis = parts["axis"];
  if (polar) {
    const Vec2 along = direction(parts["xi"]);
    marker.position = {parts["r"] * along[0], parts["r"] * along[1]};
  } else {
    marker.position = {parts["x"], parts["y"]};
  }
  return good;
}

}  // namespace pintle
