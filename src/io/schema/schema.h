// The model format as defined by schema/model.schema.toml and the catalogs of laws and joint types.
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
  std::string type_word;  ///< the name of the type in the schema
  std::string unit;       ///< "" for a pure number, "any" for parameters, "m or rad" where it depends on the kind of joint
  Dimension dimension;    ///< of the unit; `any` for "any"
  std::string meaning;
  std::string otherwise;         ///< what it means when the key is absent, in words
  std::optional<Node> fallback;  ///< value when the key is absent
  std::optional<double> minimum;
  std::optional<double> maximum;
  bool minimum_exclusive = false;
  bool required = false;
  bool per_component = false;          ///< a list is allowed: one entry per linear gap component
  std::size_t count = 0;               ///< entries of a list; 0: any number
  std::vector<std::string> words;      ///< allowed words; empty: any
  std::vector<std::pair<std::string, std::string>> synonyms;  ///< words that are also accepted, and the allowed words they stand for
  std::vector<std::pair<std::string, std::string>> meant;     ///< words that are not accepted, and the allowed words suggested for them
  std::vector<std::string> variables;  ///< that expressions may use
};

/// One table. `path` has * in place of names that the user chooses: "body.*.markers".
struct TableSpec {
  std::string path;
  std::string when;    ///< for things of this kind only; "": for all
  std::string called;  ///< such things in words: "gear joints"
  std::string meaning;
  std::vector<KeySpec> keys;
  std::optional<KeySpec> entries;     ///< for a table of user-chosen names, the form of each value
  std::vector<std::string> children;  ///< keys of the tables in it, "*" for user-chosen names (if assembled)
  bool law_keys = false;
  bool joint_type_keys = false;

  const KeySpec* find(std::string_view key) const;
};

class Schema {
 public:
  /// The format of this program; read once.
  static const Schema& model();

  /// All tables, in the order of the file.
  std::vector<TableSpec> tables() const;

  /// Everything that may appear at `path` in a thing of kind `when`: the keys common to all kinds, those of this kind, and
  /// those of the catalogs (all laws if `law` is empty, else this law with `friction`, `stops` and `detent`). The table must exist.
  TableSpec assemble(std::string_view path, std::string_view when = {}, std::string_view law = {}, std::string_view friction = {}, std::string_view stops = {},
                     std::string_view detent = {}) const;

  /// The tables allowed in the table at `path`, by key; "*" for user-chosen names.
  std::vector<std::string> children(std::string_view path) const;

  /// The kinds of things at `path` that have `key`, if not all of them do, in words: "gear joints".
  std::vector<std::string> kinds_with(std::string_view path, std::string_view key) const;

  /// The paths of the tables that have `key`, of any kind; "" is the model itself, above all tables.
  std::vector<std::string> tables_with(std::string_view key) const;

 private:
  /// The text of a table in the schema, which is parsed only on request: most models use half of them.
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

/// A catalog key as a key of the format, for a joint of type `type`; null: for any joint.
KeySpec spec_of(const KeyInfo& info, const JointTypeInfo* type = nullptr);

}  // namespace pintle
