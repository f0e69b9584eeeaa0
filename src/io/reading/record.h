// The values of one table of the model file, checked against its schema.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/expression/expression_parser.h"
#include "io/complaints.h"
#include "io/schema/schema.h"
#include "pintle/model.h"

namespace pintle {

/// The value of a key: as many numbers, words or expressions as its type requires. `node` is null for a default.
struct Value {
  const Node* node = nullptr;
  std::vector<double> numbers;
  std::vector<std::string> words;
  std::vector<Expression> expressions;
};

/// A table's values by key. A key without value is either absent and has no default, or its value was complained about.
class Record {
 public:
  const Value* find(std::string_view key) const;
  bool states(std::string_view key) const;  ///< the file has this key, with a valid value
  double number(std::string_view key, double otherwise = 0) const;
  std::optional<double> maybe_number(std::string_view key) const;
  std::optional<Vec2> maybe_pair(std::string_view key) const;
  std::string word(std::string_view key) const;
  Expression expression(std::string_view key, std::size_t index = 0) const;
  /// Where the value stands, or the table if it is absent.
  Spot spot(std::string_view key) const;

  Spot table_spot;
  std::string path;
  std::map<std::string, Value, std::less<>> values;
  std::set<std::string> refused;  ///< keys in the file whose values were complained about
  std::vector<std::string> waiting;  ///< keys of a law other than the stated one
};

/// Reads and checks values, complaining about each that is wrong.
class RecordReader {
 public:
  explicit RecordReader(Complaints& complaints) : complaints_(complaints) {}

  /// The constants available to expressions, and those of them that are frequencies.
  ParseScope scope;
  std::vector<std::string> frequencies;
  /// Variables of expressions beyond the schema's own; called with the expression's text if it may read joints.
  std::function<void(std::string_view text, std::vector<std::pair<std::string, Dimension>>& variables)> joint_variables;

  /// All values of the table `node` at `path`, whose key is at `key_spot`. `kind` says in words what it is, for
  /// messages ("a gear").
  Record read(const TableSpec& spec, const Node& node, Spot key_spot, const std::string& path,
              const std::string& kind = {});

  /// A number in SI units, if the node holds one of the key's dimension and within its range.
  std::optional<double> read_number(const Node& node, const KeySpec& spec, const std::string& path);
  /// The same before dimension and range are checked.
  std::optional<Quantity> read_quantity(const Node& node, const std::string& path);
  /// Whether the text states a frequency: a number of hertz or one per minute, or a constant that is one, and no angle.
  bool is_frequency(std::string_view text) const;
  /// Why the text cannot stand for a quantity of this dimension, if that is a rotational speed and the text a frequency: the user means turns per second, or per
  /// minute, the unit system 1/s, where a radian is 1.
  std::optional<std::string> frequency_for_speed_error(std::string_view text, const Dimension& wanted) const;
  std::optional<Marker> read_marker(const Entry& entry, const std::string& path);
  /// Whether the node is a table. Complains if not.
  bool is_table(const Node& node, const std::string& path);

  Complaints& complaints() { return complaints_; }

 private:
  /// Complains about keys that the table cannot have. Returns the keys of which they are probably misspellings.
  std::set<std::string> check_keys(const TableSpec& spec, const Table& table, Record& record, const std::string& kind);
  std::string complain_of_key(const TableSpec& spec, const Table& table, const Entry& entry, const Record& record, const std::string& kind);
  std::optional<Value> read_value(const Node& node, const KeySpec& spec, const std::string& path);
  bool read_words(const Node& node, const KeySpec& spec, const std::string& path, Value& value);
  bool read_word(const Node& node, const KeySpec& spec, const std::string& path, Value& value);
  bool read_truth(const Node& node, const KeySpec& spec, const std::string& path, Value& value);
  bool read_integer(const Node& node, const KeySpec& spec, const std::string& path, Value& value);
  bool read_numbers(const Node& node, const KeySpec& spec, const std::string& path, Value& value);
  bool read_expression(const Node& node, const KeySpec& spec, const std::string& path, Value& value);
  bool is_function_of_time(const Node& node, const KeySpec& spec) const;
  bool read_function_of_time(const Node& node, const KeySpec& spec, const std::string& path, Value& value);
  bool read_list(const Node& node, const KeySpec& spec, const std::string& path, Value& value);
  bool in_range(double number, const Node& node, const KeySpec& spec, const std::string& path);
  std::optional<std::string> wrong_dimension(const Dimension& found, const KeySpec& spec) const;
  bool read_marker_table(const Table& table, const Entry& entry, const std::string& path, Marker& marker);
  bool read_marker_list(const Array& list, const std::string& path, Marker& marker);
  void complain(const ParseProblem& problem, const Node& node, const std::string& path);
  void set_variables(const KeySpec& spec, std::string_view text);

  /// Another key of the table being read that allows this word; "" if there is none.
  std::string other_key_that_allows(const KeySpec& spec, const std::string& word) const;

  Complaints& complaints_;
  const TableSpec* table_ = nullptr;  ///< the table being read
};

/// What to write instead of a frequency.
/// Whether the text has the unit of a frequency, Hz, kHz or, where it is not the function, min.
bool mentions_frequency(std::string_view text);
inline constexpr const char* kSpeedExample = "\"120 rpm\", \"2 rev/s\" or \"4*pi rad/s\"";

/// Why a key cannot have this number; "" if it can.
std::string range_problem(double number, const KeySpec& spec);

}  // namespace pintle
