// The joint laws by the word used in model files: reader, schema, reference page and studio follow from the entries. A law is made
// known by one call of register_law; those that come with the program are in catalog.cpp.
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

/// What a law does in a joint. Each joint has one that holds it; friction, stops and a detent may act beside it in what it leaves free.
enum class LawRole { kHolds, kFriction, kStops, kDetent };
/// The key of a joint that chooses its law of this role: "law", "friction", "stops", "detent".
std::string_view key_of(LawRole role);

/// The joint that a law is made for, and the values of its keys.
struct LawSetting {
  std::string_view joint_type;
  std::array<bool, 3> held{};  // components of the relative pose; a gap that is a function stands in the first
  std::array<bool, 3> free{};
  bool one_sided = false;      // the joint pulls and does not push
  double lower_end = -std::numeric_limits<double>::infinity();  // of what it leaves free: those of a stroke [m]
  double upper_end = std::numeric_limits<double>::infinity();
  double pressure_angle = 0;   // of teeth [rad]
  std::shared_ptr<const Chambers> chambers{};  // of a cylinder, where the law is made
  const std::map<std::string, std::vector<double>>* values = nullptr;
  std::span<const KeyInfo> keys;
  std::vector<std::string_view> stated{};  // by the joint itself, where a model is read

  /// Takes from a joint's geometry what laws ask of it, where it is there: ends from the stroke, the pressure angle.
  void take(const std::map<std::string, double>& geometry);
  /// A value as stated, or the key's default; of a list the entry for this place, or its last one.
  double number(std::string_view key, std::size_t place = 0) const;
  bool states(std::string_view key) const { return std::find(stated.begin(), stated.end(), key) != stated.end(); }
  /// A list as stated; empty where there is none.
  std::vector<double> list(std::string_view key) const;
  /// `linear` of the held lengths, in their order, and `angular` of the angle where that is held.
  Planar::Vec by_component(std::string_view linear, std::string_view angular) const;
};

/// Why values do not go together; no key: they do.
struct LawFault {
  std::string key, why, remedy;
};

struct LawInfo {
  std::string_view word;
  std::string_view meaning;
  std::span<const KeyInfo> keys;
  LawRole role = LawRole::kHolds;
  bool stiffens = false;                        // `pintle stiffen` may raise its key stiffness
  bool rubs = false;                            // it has its own friction, and takes none beside it
  std::span<const std::string_view> joints{};   // types that it suits; empty: all
  void (*make)(const LawSetting& setting, Law& law) = nullptr;  // adds itself
  LawFault (*fault)(const LawSetting& setting) = nullptr;
  /// Where the second marker is in the axes of the first while nothing acts, of joints that select from the pose [m]; their gap counts from there.
  Planar::Point (*rest)(const LawSetting& setting) = nullptr;
};

/// Every law, in the manual's order.
std::span<const LawInfo> law_catalog();

/// The law called `word`, or nullptr.
const LawInfo* find_law(std::string_view word);

/// Makes a law known, before the first model is read. Throws std::logic_error when there is one of that word.
void register_law(const LawInfo& info);

/// Whether a joint of this type may have the law.
bool suits(const LawInfo& law, std::string_view joint_type);

}  // namespace pintle
