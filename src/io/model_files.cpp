#include "io/model_files.h"

#include "io/document.h"
#include "results/disk.h"

namespace pintle {

FileText ModelFiles::reader() {
  return [this](const std::string& name) {
    const auto known = texts_.find(name);
    return known != texts_.end() ? known->second : texts_.emplace(name, read_file(folder_ / name, kMaxFileBytes)).first->second;
  };
}

}  // namespace pintle
