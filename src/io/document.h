// A model file as a tree of tables, arrays and scalars, each knowing where it stands in the text.
// TOML and JSON give the same tree; nothing here knows what the keys mean.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "pintle/complaint.h"

namespace pintle {

/// A spot in one of a document's sources. Line and column count from 1; the column counts characters, not bytes.
struct Spot {
  int source = 0;
  int line = 0;
  int column = 0;
};

struct Node;
struct Entry;

/// Keys and values in the order of the file. Finding a key costs O(log n) in big tables.
class Table {
 public:
  const Node* find(std::string_view key) const;
  Node* find(std::string_view key);
  const Entry* find_entry(std::string_view key) const;
  /// Appends an entry and returns its value. The key must be new.
  Node& append(std::string key, Spot key_spot, Node value);
  const std::vector<Entry>& entries() const { return entries_; }
  bool empty() const { return entries_.empty(); }

 private:
  std::vector<Entry> entries_;
  std::map<std::string, std::size_t, std::less<>> index_;  // used above kSmall entries
};

using Array = std::vector<Node>;

/// One value. A string's spot is its first character inside the quotes, every other value's its first character.
struct Node {
  std::variant<Table, Array, std::string, std::int64_t, double, bool> value;
  Spot spot;

  const Table* table() const { return std::get_if<Table>(&value); }
  Table* table() { return std::get_if<Table>(&value); }
  const Array* array() const { return std::get_if<Array>(&value); }
  const std::string* string() const { return std::get_if<std::string>(&value); }
  const std::int64_t* integer() const { return std::get_if<std::int64_t>(&value); }
  const double* real() const { return std::get_if<double>(&value); }
  const bool* truth() const { return std::get_if<bool>(&value); }
};

struct Entry {
  std::string key;
  Spot key_spot;
  Node value;
};

/// A text that spots point into: the file, or one override of the command line.
struct Source {
  std::string name;
  std::string text;
  std::vector<std::size_t> line_starts;  // byte offset of each line

  Source(std::string source_name, std::string source_text);
  std::string_view line(int number) const;              // without its end; empty when there is no such line
  std::size_t offset_of(int number, int column) const;  // byte offset of a spot
};

struct Document {
  std::vector<Source> sources;
  Node root;  // a table
  std::vector<std::string> notes;  // what changes on the command line have kept and left out

  Place place(Spot spot) const;
  /// The spot in the source of byte `offset` of a string's value, allowing for escapes and multi-line strings.
  Spot inside(const Node& string, std::size_t offset) const;
  Complaint complaint(Spot spot, std::string path, std::string found, std::string because,
                      std::string suggestion = {}) const;
};

/// Greatest depth of nested tables and arrays that is accepted.
inline constexpr int kMaxDepth = 64;
/// Largest file that is accepted [bytes].
inline constexpr std::size_t kMaxFileBytes = std::size_t{64} << 20U;

/// Throws InputError if `text` is too large, empty or not UTF-8.
void check_text(std::string_view text, std::string_view file_name);

/// Reads TOML or JSON, chosen by the extension of `file_name`, else by the first character. Throws InputError.
Document parse_document(std::string_view text, std::string_view file_name);
Document parse_toml(std::string_view text, std::string_view file_name);
/// The same for text that is part of the program: it skips the guard that protects the parser from untrusted input.
Document parse_own_toml(std::string_view text, std::string_view file_name);
Document parse_json(std::string_view text, std::string_view file_name);

/// Equal keys and values; the order of keys and their places in the text do not matter.
bool same_tree(const Node& a, const Node& b);

/// A value as the user would recognise it in a message, at most about 60 characters.
std::string describe(const Node& node);

}  // namespace pintle
