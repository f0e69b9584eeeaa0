#include "io/variations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/units.h"
#include "io/reading/law_keys.h"
#include "io/text.h"
#include "joints/catalog.h"

namespace pintle {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<std::string> split_path(const std::string& path) {
  std::vector<std::string> parts(1);
  for (const char c : path) {
    if (c == '.') parts.emplace_back();
    else parts.back() += c;
  }
  return parts;
}

std::string word_in(const Table& table, std::string_view key) {
  const Node* node = table.find(key);
  return node == nullptr || node->string() == nullptr ? std::string() : *node->string();
}

class KeySearch {
 public:
  KeySearch(ModelReading& reading, const std::string& path, Spot spot) : reading_(reading), path_(path), spot_(spot), parts_(split_path(path)) {}

  std::optional<VariedKey> find() {
    if (parts_[0] == "parameters" && parts_.size() == 2) return parameter();
    if (parts_[0] == "simulate" && parts_.size() == 2) return key_in(Schema::model().assemble("simulate"));
    if (parts_[0] == "defaults" && parts_.size() == 3 && parts_[1] == "joint") return key_in(Schema::model().assemble("defaults.joint"));
    if (parts_.size() != 3 || !is_section()) return complain("this is not the path of a number", "parameters.NAME, body.NAME.mass, joint.NAME.stiffness");
    const Table* thing = named_thing();
    return thing == nullptr ? std::nullopt : key_in(spec_of_thing(*thing));
  }

  // The law chosen on the command line may have replaced the one that the file's variations refer to.
  bool is_of_another_law() const {
    if (parts_.size() != 3 || parts_[0] != "joint") return false;
    const Node* joints = reading_.root.find("joint");
    const Node* joint = joints == nullptr || joints->table() == nullptr ? nullptr : joints->table()->find(parts_[1]);
    if (joint == nullptr || joint->table() == nullptr) return false;
    return spec_of_thing(*joint->table()).find(parts_[2]) == nullptr && std::any_of(law_catalog().begin(), law_catalog().end(), [this](const LawInfo& law) { return has_key(&law, parts_[2]); });
  }

 private:
  std::optional<VariedKey> complain(std::string because, std::string suggestion) {
    reading_.complaints.add(spot_, path_, in_quotes(path_), std::move(because), std::move(suggestion));
    return std::nullopt;
  }

  // Sections such as [body.NAME], whose keys are numbers; [variation] itself is not one.
  bool is_section() const {
    const std::vector<std::string> children = Schema::model().children(parts_[0]);
    return parts_[0] != "variation" && std::find(children.begin(), children.end(), "*") != children.end();
  }

  const Table* named_thing() {
    const Node* section = reading_.root.find(parts_[0]);
    std::vector<std::string> names;
    if (section != nullptr && section->table() != nullptr) {
      if (const Node* node = section->table()->find(parts_[1])) return node->table();
      for (const Entry& entry : section->table()->entries()) names.push_back(entry.key);
    }
    complain("the model has no " + parts_[0] + " " + in_quotes(parts_[1]), reading_.complaints.did_you_mean(parts_[1], names));
    return nullptr;
  }

  TableSpec spec_of_thing(const Table& thing) const {
    if (parts_[0] == "joint") {
      const std::string law = word_in(thing, "law");
      return Schema::model().assemble("joint.*", word_in(thing, "type"), law.empty() ? "linear" : law, word_in(thing, "friction"), word_in(thing, "stops"));
    }
    if (parts_[0] != "motor") return Schema::model().assemble(parts_[0] + ".*");
    const auto joint = reading_.type_of_joint.find(word_in(thing, "joint"));
    const JointTypeInfo* type = joint == reading_.type_of_joint.end() ? nullptr : find_joint_type(joint->second);
    return Schema::model().assemble("motor.*", type == nullptr || type->free.empty() ? std::string_view() : type->free.front().name);
  }

  std::optional<VariedKey> key_in(const TableSpec& table) {
    const KeySpec* spec = table.find(parts_.back());
    if (spec == nullptr) {
      std::vector<std::string> keys;
      for (const KeySpec& key : table.keys) keys.push_back(key.key);
      return complain("there is no key " + in_quotes(parts_.back()), reading_.complaints.did_you_mean(parts_.back(), keys));
    }
    const bool one_number = spec->type == ValueType::kNumber || spec->type == ValueType::kQuantity || spec->type == ValueType::kExpression;
    if (!one_number || spec->unit == "any")  // a number whose unit depends on others
      return complain("only a key that is one number can vary", "name the number under [parameters], and vary parameters.NAME");
    return VariedKey{spec->unit, spec->dimension, spec->minimum, spec->maximum, spec->minimum_exclusive};
  }

  std::optional<VariedKey> parameter() {
    const auto value = reading_.records.scope.constant(parts_[1]);
    if (!value) return complain("the model has no parameter " + in_quotes(parts_[1]),
                                reading_.complaints.did_you_mean(parts_[1], reading_.records.scope.constant_names));
    const bool pure = value->dimension.any || is_pure(value->dimension);
    return VariedKey{value->dimension.any || (pure && value->dimension.exponents[3] == 0) ? "" : to_unit_text(value->dimension), value->dimension, {}, {}, false};
  }

  ModelReading& reading_;
  const std::string& path_;
  Spot spot_;
  std::vector<std::string> parts_;
};

// One entry of [variation].
class VariationReader {
 public:
  VariationReader(ModelReading& reading, const Entry& entry, bool to_be_drawn)
      : reading_(reading), entry_(entry), to_be_drawn_(to_be_drawn), path_("variation." + quoted_exactly(entry.key)) {}

  std::optional<Variation> read() {
    const std::size_t before = reading_.complaints.size();
    record_ = reading_.records.read(reading_.spec("variation.*"), entry_.value, entry_.key_spot, path_);
    if (reading_.complaints.size() > before) return std::nullopt;
    if (!to_be_drawn_ && KeySearch(reading_, entry_.key, entry_.key_spot).is_of_another_law()) {
      reading_.model.notes.push_back(path_ + ": a key of another law than its joint has, and without effect");
      return std::nullopt;
    }
    const auto key = varied_key(reading_, entry_.key, entry_.key_spot);
    if (!key) return std::nullopt;
    key_ = *key;
    Variation out;
    out.path = entry_.key;
    out.unit = key_.unit;
    const std::string word = record_.word("distribution");
    out.distribution = word == "normal" ? Distribution::kNormal : word == "lognormal" ? Distribution::kLognormal
                       : word == "uniform" ? Distribution::kUniform : Distribution::kTriangular;
    read_numbers(out, word);
    return reading_.complaints.size() > before ? std::nullopt : std::optional(out);
  }

 private:
  void read_numbers(Variation& out, const std::string& word) {
    const bool bell = out.distribution == Distribution::kNormal || out.distribution == Distribution::kLognormal;
    for (const char* name : {"mean", "deviation", "mode", "from", "to"}) {
      const std::string_view key = name;
      const bool limit = key == "from" || key == "to";
      const bool wanted = limit ? !bell : key == "mode" ? word == "triangular" : bell;
      if (wanted && !record_.states(key)) complain(entry_.key_spot, key, "no " + std::string(key), "a " + word + " distribution needs it", std::string(key) + " = " + example());
      if (!wanted && !limit && record_.states(key)) complain(record_.spot(key), key, std::string(key), "a " + word + " distribution does not use it", "delete it");
      check_dimension_of(key);
    }
    out.mean = record_.number("mean");
    out.deviation = record_.number("deviation");
    out.mode = record_.number("mode");
    out.from = std::max(record_.number("from", -kInfinity), key_.minimum.value_or(-kInfinity));
    out.to = std::min(record_.number("to", kInfinity), key_.maximum.value_or(kInfinity));
    check_range(out, bell);
  }

  void check_dimension_of(std::string_view key) {
    if (!record_.states(key)) return;
    const Node& node = *record_.find(key)->node;
    const auto quantity = reading_.records.read_quantity(node, path_ + "." + std::string(key));
    if (!quantity) return;
    if (node.string() != nullptr)
      if (auto problem = reading_.records.frequency_for_speed_error(*node.string(), key_.dimension)) return complain(node.spot, key, describe(node), *problem, kSpeedExample);
    if (auto problem = check_dimension(quantity->dimension, key_.dimension)) complain(node.spot, key, describe(node), *problem, example());
    if ((key == "from" || key == "to") && !key_.allows(quantity->si) && !(key == "from" && quantity->si == key_.minimum))
      complain(node.spot, key, describe(node), "the key itself cannot have this value", "a value inside its range");
  }

  void check_range(const Variation& v, bool bell) {
    if (!(v.from < v.to)) return complain(record_.spot("to"), "to", fmt::format("{:g} to {:g}", v.from, v.to), "the range is empty", "from less than to");
    if (bell && !(v.deviation > 0)) complain(record_.spot("deviation"), "deviation", fmt::format("{:g}", v.deviation), "this must be greater than 0", "\"mean*0.05\"");
    if (v.distribution == Distribution::kLognormal && !(v.mean > 0)) complain(record_.spot("mean"), "mean", fmt::format("{:g}", v.mean), "a lognormal value is positive", "distribution = \"normal\"");
    constexpr double kFarOut = 6;  // in deviations: the part of the distribution beyond this is negligible
    if (bell && (v.from > v.mean + kFarOut * v.deviation || v.to < v.mean - kFarOut * v.deviation))
      complain(record_.spot("mean"), "mean", fmt::format("{:g}", v.mean), fmt::format("almost none of it lies in the range, {:g} to {:g}", v.from, v.to), "a mean inside the range");
    if (v.distribution == Distribution::kTriangular && !(v.from <= v.mode && v.mode <= v.to))
      complain(record_.spot("mode"), "mode", fmt::format("{:g}", v.mode), "the most likely value lies between from and to", "");
  }

  std::string example() const { return key_.unit.empty() ? "0.1" : "\"1 " + key_.unit + "\""; }

  void complain(Spot spot, std::string_view key, std::string found, std::string because, std::string suggestion) {
    reading_.complaints.add(spot, path_ + "." + std::string(key), std::move(found), std::move(because), std::move(suggestion));
  }

  ModelReading& reading_;
  const Entry& entry_;
  bool to_be_drawn_;
  std::string path_;
  Record record_;
  VariedKey key_;
};

}  // namespace

bool VariedKey::allows(double x) const {
  if (minimum && (minimum_exclusive ? x <= *minimum : x < *minimum)) return false;
  return std::isfinite(x) && !(maximum && x > *maximum);
}

std::optional<VariedKey> varied_key(ModelReading& reading, const std::string& path, Spot spot) { return KeySearch(reading, path, spot).find(); }

std::vector<Variation> read_variations(ModelReading& reading, bool to_be_drawn) {
  std::vector<Variation> out;
  for (const Entry& entry : section(reading, "variation").entries())
    if (auto variation = VariationReader(reading, entry, to_be_drawn).read()) out.push_back(std::move(*variation));
  return out;
}

}  // namespace pintle
