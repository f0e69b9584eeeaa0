#include "io/model_variants.h"

#include <utility>

#include "io/model_reading.h"

namespace pintle {
namespace {

std::vector<std::string> keys_of(const std::string& path) {
  std::vector<std::string> keys(1);
  for (const char c : path) {
    if (c == '.') keys.emplace_back();
    else keys.back() += c;
  }
  return keys;
}

// The node at a path; tables and the key itself are added where the file leaves them to defaults.
Node& node_at(Node& root, const std::vector<std::string>& keys) {
  Node* at = &root;
  for (const std::string& key : keys) {
    Node* next = at->table()->find(key);
    at = next != nullptr ? next : &at->table()->append(key, at->spot, Node{{}, at->spot});
  }
  return *at;
}

}  // namespace

ModelVariants::ModelVariants(Document document, const std::vector<std::string>& paths) : document_(std::move(document)) {
  for (const std::string& path : paths) paths_.push_back(keys_of(path));
}

Model ModelVariants::at(std::span<const double> values) {
  for (std::size_t i = 0; i < paths_.size(); ++i) node_at(document_.root, paths_[i]).value = values[i];
  ModelReading reading(document_);
  read_all(reading);
  reading.complaints.throw_if_any();
  return std::move(reading.model);
}

}  // namespace pintle
