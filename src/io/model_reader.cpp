#include <cerrno>
#include <fstream>
#include <utility>
#include <system_error>

#include "io/model_reading.h"
#include "io/overrides.h"
#include "pintle/read_model.h"

namespace pintle {
namespace {

std::string text_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::system_error(errno, std::generic_category(), path);
  std::string text(kMaxFileBytes + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (file.bad()) throw std::system_error(errno, std::generic_category(), path);
  text.resize(static_cast<std::size_t>(file.gcount()));
  return text;
}

Model model_of(const Document& document) {
  Reading reading(document);
  read_parameters(reading);
  read_settings(reading);
  read_bodies(reading);
  read_joints(reading);
  read_loads(reading);
  read_motors(reading);
  reading.complaints.throw_if_any();
  return std::move(reading.model);
}

}  // namespace

Model parse_model(std::string_view text, std::string_view file_name, const std::vector<std::string>& overrides) {
  Document document = parse_document(text, file_name);
  apply_overrides(document, overrides);
  return model_of(document);
}

Model read_model(const std::string& path, const std::vector<std::string>& overrides) {
  return parse_model(text_of_file(path), path, overrides);
}

}  // namespace pintle
