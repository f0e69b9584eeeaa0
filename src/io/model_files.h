// The files that a model names, read from the model's folder.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "pintle/read_model.h"

namespace pintle {

struct Document;

/// The files that a model names, each once.
std::vector<std::string> files_named_in(const Document& document);

/// Keeps what it has read: a run copies it into its folder.
class ModelFiles {
 public:
  /// For the model in this file.
  explicit ModelFiles(const std::filesystem::path& model) : folder_(model.parent_path()) {}

  /// For parse_model(); valid as long as this object exists. Its FileErrors name the path.
  FileText reader();
  /// By name.
  const std::map<std::string, std::string>& texts() const { return texts_; }

 private:
  std::filesystem::path folder_;
  std::map<std::string, std::string> texts_;
};

}  // namespace pintle
