// A document as JSON: indented by two spaces per level, lists of scalars on one line.

#include <algorithm>

#include "io/text.h"
#include "io/writers.h"

namespace pintle {
namespace {

bool is_scalar(const Node& node) {
  return node.table() == nullptr && node.array() == nullptr;
}

class JsonWriter {
 public:
  void write(const Node& node, int level) {
    if (const Table* table = node.table()) {
      write_table(*table, level);
    } else if (const Array* array = node.array()) {
      write_array(*array, level);
    } else if (const std::string* string = node.string()) {
      text += quoted_exactly(*string);
    } else if (const bool* truth = node.truth()) {
      text += *truth ? "true" : "false";
    } else {
      text += number_text(node);
    }
  }

  std::string text;

 private:
  void new_line(int level) {
    text += '\n';
    text.append(static_cast<std::size_t>(2 * level), ' ');
  }

  void write_table(const Table& table, int level) {
    if (table.empty()) {
      text += "{}";
      return;
    }
    char before = '{';
    for (const Entry& entry : table.entries()) {
      text += before;
      before = ',';
      new_line(level + 1);
      text += quoted_exactly(entry.key) + ": ";
      write(entry.value, level + 1);
    }
    new_line(level);
    text += '}';
  }

  void write_array(const Array& array, int level) {
    const bool one_line = std::all_of(array.begin(), array.end(), is_scalar);
    text += '[';
    for (std::size_t i = 0; i < array.size(); ++i) {
      if (i > 0) text += one_line ? ", " : ",";
      if (!one_line) new_line(level + 1);
      write(array[i], level + 1);
    }
    if (!one_line) new_line(level);
    text += ']';
  }
};

}  // namespace

std::string to_json(const Document& document) {
  JsonWriter writer;
  writer.write(document.root, 0);
  return writer.text + '\n';
}

}  // namespace pintle
