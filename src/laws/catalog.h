// The joint laws by the word used in model files: reader, schema, reference page and studio are generated from the entries. A law
// is registered by one call of register_law; the built-in ones are in catalog.cpp.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/key_info.h"
#include "laws/law.h"

namespace pintle {

class Chambers;

/// The role of a law in a joint. Each joint has one law that holds it; friction, stops and a detent may act in addition, in the free directions.
enum class LawRole { kHolds, kFriction, kStops, kDetent };
/// The key of a joint that chooses its law for this role: "law", "friction", "stops", "detent".
std::string_view key_of(LawRole role);

/// The joint for which a law is made, and the values of its keys.
struct LawSetting {
  std::string_view joint_type;
  std::array<bool, 3> held{};  // components of the relative pose; a gap that is a function is component 0
  std::array<bool, 3> free{};
  bool one_sided = false;      // the joint pulls but does not push
  double lower_end = -std::numeric_limits<double>::infinity();  // of the free coordinate: the ends of a stroke [m]
  double upper_end = std::numeric_limits<double>::infinity();
  double pressure_angle = 0;   // of teeth [rad]
  std::shared_ptr<const Chambers> chambers{};  // of a cylinder, at the time the law is made
  const std::map<std::string, std::vector<double>>* values = nullptr;
  std::span<const KeyInfo> keys;
  std::vector<std::string_view> stated{};  // keys stated by the joint itself, while a model is read

  /// Takes from a joint's geometry the values that laws need, if present: ends from the stroke, the pressure angle.
  void take(const std::map<std::string, double>& geometry);
  /// A value as stated, or the key's default; for a list the entry at this place, or the last one.
  double number(std::string_view key, std::size_t place = 0) const;
  bool states(std::string_view key) const { return std::find(stated.begin(), stated.end(), key) != stated.end(); }
  /// A list as stated; empty if there is none.
  std::vector<double> list(std::string_view key) const;
  /// `linear` for the held lengths, in their order, and `angular` for the angle if it is held.
  Planar::Vec by_component(std::string_view linear, std::string_view angular) const;
};

/// Why values are inconsistent; an empty key: they are consistent.
struct LawFault {
  std::string key, why, remedy;
};

struct LawInfo {
  std::string_view word;
  std::string_view meaning;
  std::span<const KeyInfo> keys;
  LawRole role = LawRole::kHolds;
  bool stiffens = false;                        // `pintle stiffen` may raise its key stiffness
  bool yields = false;                          // flexible on purpose: it remains a force law where other linear joints are ideal
  bool rubs = false;                            // it has its own friction and allows no other
  std::span<const std::string_view> joints{};   // joint types for which it is suitable; empty: all
  void (*make)(const LawSetting& setting, Law& law) = nullptr;  // adds the law to `law`
  LawFault (*fault)(const LawSetting& setting) = nullptr;
  /// Position of the second marker in the axes of the first in the unloaded state, for joints that select from the pose [m]; their gap counts from there.
  Planar::Point (*rest)(const LawSetting& setting) = nullptr;
};

/// Every law, in the manual's order.
std::span<const LawInfo> law_catalog();

/// The law called `word`, or nullptr.
const LawInfo* find_law(std::string_view word);

/// Registers a law, before the first model is read. Throws std::logic_error if a law with this word exists.
void register_law(const LawInfo& info);

/// Whether a joint of this type may have the law.
bool suits(const LawInfo& law, std::string_view joint_type);

}  // namespace pintle
