#include <utility>

#include "io/model_files.h"
#include "io/reading/model_reading.h"
#include "io/reading/overrides.h"
#include "io/variations.h"
#include "pintle/read_model.h"
#include "results/disk.h"

namespace pintle {
namespace {

Model model_of(const Document& document, const FileText& files) {
  ModelReading reading(document, files);
  read_all(reading);
  read_variations(reading, false);
  reading.complaints.throw_if_any();
  return std::move(reading.model);
}

}  // namespace

void read_all(ModelReading& reading) {
  reading.model.notes = reading.complaints.document().notes;
  read_parameters(reading);
  read_tables(reading);
  read_settings(reading);
  read_bodies(reading);
  read_joints(reading);
  read_loads(reading);
  read_motors(reading);
  check_record(reading);
}

Model parse_model(std::string_view text, std::string_view file_name, const std::vector<std::string>& overrides, const FileText& files) {
  Document document = parse_document(text, file_name);
  apply_overrides(document, overrides);
  return model_of(document, files);
}

Model read_model(const std::string& path, const std::vector<std::string>& overrides) {
  return parse_model(read_file(path, kMaxFileBytes + 1), path, overrides, ModelFiles(path).reader());
}

}  // namespace pintle
