// One model file with many sets of numbers, parsed once; only what depends on them is read again.
#pragma once

#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "io/reading/model_reading.h"

namespace pintle {

class ModelVariants {
 public:
  /// The document must give a model, and the paths must be of numbers in it.
  ModelVariants(const Document& document, const std::vector<std::string>& paths, const FileText& files = {});
  ModelVariants(const ModelVariants& other);
  ModelVariants& operator=(const ModelVariants&) = delete;
  ~ModelVariants();

  /// The model with one number [SI] at each path. Throws InputError where the numbers do not go together.
  Model at(std::span<const double> values);

 private:
  // Things of one kind that are read again, by their places in the model.
  using Places = std::vector<std::size_t>;

  void begin_reading();
  void leave_out_what_stays();
  Places keep_dependent(std::string_view section, std::size_t before = 0);
  bool depends(const Node& node) const;

  std::vector<std::vector<std::string>> paths_;
  std::set<std::string> parameters_;  // that change, and tables
  Document changing_;                 // the file without what stays as it is
  Model base_;
  std::map<std::string, std::set<std::string>, std::less<>> markers_of_;
  std::map<std::string, std::string, std::less<>> type_of_joint_;
  std::map<std::string, NamedTable, std::less<>> named_tables_;
  FileText files_;
  Places bodies_, joints_, springs_, forces_, motors_;
  bool all_joints_ = false;                 // their defaults change
  bool settings_ = false, ground_ = false, tables_ = false;  // change
  std::unique_ptr<ModelReading> reading_;
};

}  // namespace pintle
