#include "io/reading/choose_law.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "base/text/utf8.h"
#include "io/reading/law_keys.h"
#include "io/reading/overrides.h"
#include "io/text.h"
#include "laws/catalog.h"

namespace pintle {
namespace {

/// One "key=value" of the text, and where it begins [bytes].
struct Piece {
  std::string key, value;
  std::size_t at = 0;
  bool whole = false;  // it has an equals sign
};

/// The pieces between commas, ignoring commas inside quotes and brackets.
std::vector<Piece> pieces_of(const std::string& text) {
  std::vector<Piece> pieces;
  int depth = 0;
  char quote = '\0';
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= text.size(); ++i) {
    const char c = i < text.size() ? text[i] : ',';
    if (i < text.size() && quote != '\0') {
      if (c == quote) quote = '\0';
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '[' || c == '(' || c == '{') {
      ++depth;
    } else if (c == ']' || c == ')' || c == '}') {
      --depth;
    } else if (c == ',' && (depth <= 0 || i == text.size())) {
      while (begin < i && text[begin] == ' ') ++begin;
      const std::string piece = text.substr(begin, i - begin);
      const std::size_t equals = piece.find('=');
      const bool whole = equals != std::string::npos;
      pieces.push_back({piece.substr(0, equals), whole ? piece.substr(equals + 1) : "", begin, whole});
      begin = i + 1;
    }
  }
  return pieces;
}

std::string chosen_word(const Table& table, std::string_view key) {
  const Node* node = table.find(key);
  return node == nullptr || node->string() == nullptr ? std::string() : *node->string();
}

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

class LawChange {
 public:
  LawChange(Document& document, int source, Complaints& complaints)
      : document_(document), source_(source), complaints_(complaints), text_(document.sources[static_cast<std::size_t>(source)].text), pieces_(pieces_of(text_)) {}

  void make() {
    Table* joint = find_joint();
    if (joint == nullptr) return;
    const std::size_t word_at_byte = pieces_.front().at + pieces_.front().key.size() + 1;
    Node word = read_override_value(pieces_.front().value, source_, spot(word_at_byte).column);
    word_ = word.string() == nullptr ? "" : *word.string();
    law_ = find_law(word_);
    const bool no_friction = word_ == "none";
    const LawRole role = law_ != nullptr ? law_->role : no_friction ? LawRole::kFriction : LawRole::kHolds;
    const std::string key(key_of(role));
    former_ = chosen_word(*joint, key);
    if (former_.empty() && role == LawRole::kHolds) former_ = "linear";
    if (law_ != nullptr || no_friction) leave_out_former_keys(*joint, role);
    put(*joint, key, spot(pieces_.front().at), std::move(word));
    for (std::size_t i = 1; i < pieces_.size(); ++i) state(*joint, pieces_[i]);
    if (law_ != nullptr) note(*joint, role);
  }

 private:
  Spot spot(std::size_t byte) const { return {source_, 1, 1 + static_cast<int>(count_characters(std::string_view(text_).substr(0, byte)))}; }

  Table* find_joint() {
    constexpr std::string_view kSection = "joint";
    const std::string& path = pieces_.front().key;
    const std::size_t dot = path.find('.');
    name_ = dot == std::string::npos ? "" : path.substr(dot + 1);
    if (path.substr(0, dot) != kSection || !is_bare_key(name_) || pieces_.front().value.empty()) {
      complaints_.add(spot(0), "", in_quotes(text_), "a law is chosen as joint.NAME=law, with keys behind commas", "joint.A=linear,stiffness=1e7");
      return nullptr;
    }
    Node* section = document_.root.table()->find(kSection);
    static const Table kEmpty;
    Node* joint = section == nullptr || section->table() == nullptr ? nullptr : section->table()->find(name_);
    if (joint == nullptr) complain_of_unknown_name(complaints_, section == nullptr || section->table() == nullptr ? kEmpty : *section->table(), std::string(kSection), name_, spot(dot + 1));
    return joint == nullptr ? nullptr : joint->table();
  }

  static void put(Table& table, const std::string& key, Spot key_spot, Node value) {
    if (Node* old = table.find(key)) *old = std::move(value);
    else table.append(key, key_spot, std::move(value));
  }

  // The keys that only the former law has.
  void leave_out_former_keys(Table& joint, LawRole role) {
    const LawInfo* former = find_law(former_);
    const auto stays = [&](std::string_view key) {
      for (const LawRole other : {LawRole::kHolds, LawRole::kFriction, LawRole::kStops, LawRole::kDetent}) {
        const std::string word = chosen_word(joint, key_of(other));
        if (other != role && has_key(find_law(word.empty() && other == LawRole::kHolds ? "linear" : word), key)) return true;
      }
      return has_key(law_, key);
    };
    Table kept;
    for (const Entry& entry : joint.entries()) {
      if (has_key(former, entry.key) && !stays(entry.key)) left_out_.push_back(entry.key);
      else kept.append(entry.key, entry.key_spot, entry.value);
    }
    joint = std::move(kept);
  }

  void state(Table& joint, const Piece& piece) {
    if (!piece.whole) {
      complaints_.add(spot(piece.at), "joint." + name_, in_quotes(piece.key), "a key of a law has a value", (piece.key.empty() ? "key" : piece.key) + "=1");
      return;
    }
    if (law_ != nullptr && !has_key(law_, piece.key) && piece.key != key_of(LawRole::kFriction)) {  // the law beside which friction stands may not allow it
      std::vector<std::string> keys;
      for (const KeyInfo& info : law_->keys) keys.emplace_back(info.key);
      complaints_.add(spot(piece.at), "joint." + name_ + "." + piece.key, in_quotes(piece.key), "the law " + word_ + " has no such key", complaints_.did_you_mean(piece.key, keys));
      return;
    }
    stated_.push_back(piece.key);
    put(joint, piece.key, spot(piece.at), read_override_value(piece.value, source_, spot(piece.at + piece.key.size() + 1).column));
  }

  void note(const Table& joint, LawRole role) {
    const Node* defaults = document_.root.table()->find("defaults");
    const Node* of_joints = defaults == nullptr || defaults->table() == nullptr ? nullptr : defaults->table()->find("joint");
    const JointTypeInfo* type = find_joint_type(chosen_word(joint, "type"));
    std::vector<std::string> kept, by_default;
    for (const KeyInfo& info : law_->keys) {
      const std::string key(info.key);
      if (std::find(stated_.begin(), stated_.end(), key) != stated_.end() || (type != nullptr && !has_effect(info, *type))) continue;
      if (joint.find(key) != nullptr) kept.push_back(key);
      else if (of_joints != nullptr && of_joints->table() != nullptr && of_joints->table()->find(key) != nullptr) by_default.push_back(key);
    }
    std::string text = fmt::format("joint {}: {} {}", name_, key_of(role), word_);
    if (!former_.empty() && former_ != word_) text += " instead of " + former_;
    if (!kept.empty()) text += "; with the joint's own " + listed(kept);
    if (!by_default.empty()) text += "; with " + listed(by_default) + " of defaults.joint";
    if (!left_out_.empty()) text += "; without " + listed(left_out_) + ", which it does not have";
    document_.notes.push_back(std::move(text));
  }

  Document& document_;
  int source_;
  Complaints& complaints_;
  std::string text_;
  std::vector<Piece> pieces_;
  std::string name_, word_, former_;
  const LawInfo* law_ = nullptr;
  std::vector<std::string> left_out_, stated_;
};

}  // namespace

void choose_law(Document& document, int source, Complaints& complaints) { LawChange(document, source, complaints).make(); }

}  // namespace pintle
