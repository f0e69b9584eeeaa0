#include "io/model_files.h"

#include <algorithm>

#include "io/document.h"
#include "results/disk.h"

namespace pintle {

std::vector<std::string> files_named_in(const Document& document) {
  std::vector<std::string> names;
  const Node* tables = document.root.table()->find("table");
  if (tables == nullptr || tables->table() == nullptr) return names;
  for (const Entry& entry : tables->table()->entries()) {
    const Node* file = entry.value.table() == nullptr ? nullptr : entry.value.table()->find("file");
    const std::string* name = file == nullptr ? nullptr : file->string();
    if (name != nullptr && std::find(names.begin(), names.end(), *name) == names.end()) names.push_back(*name);
  }
  return names;
}

FileText ModelFiles::reader() {
  return [this](const std::string& name) {
    const auto known = texts_.find(name);
    return known != texts_.end() ? known->second : texts_.emplace(name, read_file(folder_ / name, kMaxFileBytes)).first->second;
  };
}

}  // namespace pintle
