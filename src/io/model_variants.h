// One model file with many sets of numbers: it is parsed once, and only what depends on the numbers is read again.
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
  /// The document must give a model, and each path must lead to a number in it.
  ModelVariants(const Document& document, const std::vector<std::string>& paths, const FileText& files = {});
  ModelVariants(const ModelVariants& other);
  ModelVariants& operator=(const ModelVariants&) = delete;
  ~ModelVariants();

  /// The model with one number [SI] at each path. Throws InputError where the numbers are inconsistent.
  Model at(std::span<const double> values);
  /// Whether [simulate] or gravity may depend on the values.
  bool settings_vary() const { return settings_; }

 private:
  // Positions in the model of the things of one kind that are read again.
  using Places = std::vector<std::size_t>;

  void begin_reading();
  void leave_out_what_stays();
  Places keep_dependent(std::string_view section, std::size_t before = 0);
  bool depends(const Node& node) const;

  std::vector<std::vector<std::string>> paths_;
  std::vector<std::string> units_;    // of varied parameters, as they follow a number: a constant without its dimension would not fit where it is used
  std::set<std::string> parameters_;  // those that change, and tables
  Document changing_;                 // the file without what stays the same
  Model base_;
  std::map<std::string, std::set<std::string>, std::less<>> markers_of_;
  std::map<std::string, std::string, std::less<>> type_of_joint_;
  std::map<std::string, NamedTable, std::less<>> named_tables_;
  FileText files_;
  Places bodies_, joints_, springs_, forces_, motors_;
  bool all_joints_ = false;                 // the joint defaults change
  bool settings_ = false, ground_ = false, tables_ = false;  // these change
  std::unique_ptr<ModelReading> reading_;
};

}  // namespace pintle
