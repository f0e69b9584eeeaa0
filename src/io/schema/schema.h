// The model format as schema/model.schema.toml and the catalogs of laws and joint types state it.
#pragma once

#include <deque>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/key_info.h"
#include "io/document.h"
#include "joints/catalog.h"
#include "pintle/expression.h"

namespace pintle {

enum class ValueType {
  kInteger,
  kText,
  kWord,
  kWords,
  kNumber,
  kQuantity,
  kQuantities,
  kExpression,
  kExpressions,
  kTruth,
  kMarker,
  kMarkerName,
  kMarkerNames,
  kJointName,
  kTableName,
  kColumn,
};

/// One key of a table.
struct KeySpec {
  std::string key;
  ValueType type = ValueType::kText;
  std::string type_word;  ///< the type as the schema calls it
  std::string unit;       ///< "" for a pure number, "any" for parameters, "m or rad" where it depends on the kind of joint
  Dimension dimension;    ///< of the unit; `any` for "any"
  std::string meaning;
  std::string otherwise;         ///< what an absent key means, in words
  std::optional<Node> fallback;  ///< value of an absent key
  std::optional<double> minimum;
  std::optional<double> maximum;
  bool minimum_exclusive = false;
  bool required = false;
  bool per_component = false;          ///< a list is allowed: one entry per linear gap component
  std::size_t count = 0;               ///< entries of a list; 0: any number
  std::vector<std::string> words;      ///< allowed words; empty: any
  std::vector<std::pair<std::string, std::string>> synonyms;  ///< words that are accepted too, and the allowed ones they stand for
  std::vector<std::pair<std::string, std::string>> meant;     ///< words that are not accepted, and the allowed ones that are suggested for them
  std::vector<std::string> variables;  ///< of expressions
};

/// One table. `path` has * where the user chooses the name: "body.*.markers".
struct TableSpec {
  std::string path;
  std::string when;    ///< for things of this kind only; "": for all
  std::string called;  ///< such things in words: "gear joints"
  std::string meaning;
  std::vector<KeySpec> keys;
  std::optional<KeySpec> entries;     ///< a table of names that the user chooses, each with a value like this
  std::vector<std::string> children;  ///< keys of the tables in it, "*" for names that the user chooses (if assembled)
  bool law_keys = false;
  bool joint_type_keys = false;

  const KeySpec* find(std::string_view key) const;
};

class Schema {
 public:
  /// The format of this program, read once.
  static const Schema& model();

  /// All tables, in the order of the file.
  std::vector<TableSpec> tables() const;

  /// Everything that may stand at `path` in a thing of kind `when`: the keys for all, those of this kind, and those of
  /// the catalogs (of all laws when `law` is empty, else of it, of `friction`, of `stops` and of `detent`). The table must exist.
  TableSpec assemble(std::string_view path, std::string_view when = {}, std::string_view law = {}, std::string_view friction = {}, std::string_view stops = {},
                     std::string_view detent = {}) const;

  /// The tables that may stand in the table at `path`, by key; "*" for names that the user chooses.
  std::vector<std::string> children(std::string_view path) const;

  /// The kinds of things at `path` that alone have `key`, in words: "gear joints".
  std::vector<std::string> kinds_with(std::string_view path, std::string_view key) const;

  /// The paths of the tables that have `key`, whatever the kind: "" is the model itself, above every table.
  std::vector<std::string> tables_with(std::string_view key) const;

 private:
  /// A table as the file states it: what it holds is read when it is asked for. Most models use half of them.
  struct LazyTable {
    std::string path, when;
    std::string_view text;
    mutable std::once_flag once;
    mutable TableSpec read;

    const TableSpec& spec() const;
  };

  explicit Schema(std::string_view text);
  std::deque<LazyTable> tables_;
};

/// A key of a catalog as a key of the format, in a joint of type `type`; null: in any.
KeySpec spec_of(const KeyInfo& info, const JointTypeInfo* type = nullptr);

}  // namespace pintle
