#include "studio/kernel/exchange.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <new>

#include "base/text/utf8.h"
#include "pintle/results.h"
#include "pintle/simulate.h"

namespace pintle::studio {
namespace {

[[noreturn]] void malformed(const char* key, const char* wanted) {
  throw CallFault(fmt::format("The call lacks \"{}\" ({}).", key, wanted), "This is a fault of the page: reload it.");
}

// Characters from the complaint's column on that are meant: a word, or what is between the quotes.
int length_at(const Complaint& complaint) {
  const std::string& line = complaint.source_line;
  if (complaint.place.column <= 0) return 1;
  std::size_t at = 0;
  char before = 0;
  for (int i = 1; i < complaint.place.column && at < line.size(); ++i) {
    before = line[at];
    at += character_at(line, at).size();
  }
  const bool quoted = before == '"' || before == '\'';
  int length = 0;
  while (at < line.size()) {
    const char c = line[at];
    if (quoted ? c == before : std::string_view(" \t,]}=#\r").find(c) != std::string_view::npos) break;
    at += character_at(line, at).size();
    ++length;
  }
  return std::max(length, 1);
}

Json input_fault(const InputError& error) {
  const std::vector<Complaint>& complaints = error.complaints();
  if (complaints.empty()) return fault(error.what(), "");
  const Json first = to_json(complaints.front());
  const std::string more = complaints.size() > 1 ? fmt::format(" (and {} more)", complaints.size() - 1) : "";
  const std::string& key = complaints.front().path;
  Json out = fault(fmt::format("{}{}{}{}", key, key.empty() ? "" : ": ", first["message"].get<std::string>(), more), first["hint"]);
  out["where"] = {{"line", first["line"]}, {"column", first["column"]}, {"key", first["key"]}};
  out["complaints"] = to_json(complaints);
  return out;
}

}  // namespace

std::string text_argument(const Exchange& call, const char* key) {
  const auto it = call.arguments.find(key);
  if (it == call.arguments.end() || !it->is_string()) malformed(key, "a string");
  return it->get<std::string>();
}

double number_argument(const Json& arguments, const char* key) {
  const auto it = arguments.find(key);
  if (it == arguments.end() || !it->is_number() || !std::isfinite(it->get<double>())) malformed(key, "a number");
  return it->get<double>();
}

std::array<double, 2> point_argument(const Json& arguments, const char* key) {
  const auto it = arguments.find(key);
  const auto number = [](const Json& x) { return x.is_number() && std::isfinite(x.get<double>()); };
  if (it == arguments.end() || !it->is_array() || it->size() != 2 || !number((*it)[0]) || !number((*it)[1])) malformed(key, "two numbers");
  return {(*it)[0].get<double>(), (*it)[1].get<double>()};
}

FileText files_argument(const Exchange& call) {
  const auto it = call.arguments.find("files");
  if (it == call.arguments.end()) return {};
  return [files = *it](const std::string& name) {
    const auto file = files.find(name);
    if (file == files.end() || !file->is_string()) throw FileError(fmt::format("{}: the page does not have this file", name));
    return file->get<std::string>();
  };
}

std::string name_for(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && text[first] == '{' ? "model.json" : "model.toml";
}

Json to_json(const Complaint& complaint) {
  std::string message = complaint.found.empty() ? "" : "found " + complaint.found;
  if (!message.empty() && !complaint.because.empty()) message += ": ";
  message += complaint.because;
  return {{"severity", "error"},
          {"line", complaint.place.line},
          {"column", complaint.place.column},
          {"length", length_at(complaint)},
          {"key", complaint.path},
          {"message", message},
          {"hint", complaint.suggestion}};
}

Json to_json(const std::vector<Complaint>& complaints) {
  Json out = Json::array();
  for (const Complaint& complaint : complaints) out.push_back(to_json(complaint));
  return out;
}

Json fault(const std::string& message, const std::string& hint, const std::vector<std::string>& joints) {
  Json out = {{"message", message}, {"hint", hint}};
  if (!joints.empty()) out["joints"] = joints;
  return out;
}

Json current_fault() {
  try {
    throw;
  } catch (const CallFault& error) {
    return fault(error.what(), error.hint, error.joints);
  } catch (const InputError& error) {
    return input_fault(error);
  } catch (const AssemblyError& error) {
    const auto [message, hint] = message_and_hint(error.what());
    return fault(message, hint, joints_named_in(error.what()));
  } catch (const std::bad_alloc&) {
    return fault("There is not enough memory for this.", "A longer simulate.output_step gives fewer rows; simulate.record selects the columns to keep.");
  } catch (const Json::exception&) {
    return fault("The call is malformed.", "This is a fault of the page: reload it.");
  } catch (const std::invalid_argument& error) {
    return fault(error.what(), "");
  } catch (const std::exception& error) {
    return fault(fmt::format("The kernel failed: {}", error.what()), "Please report it with the model.");
  } catch (...) {
    return fault("The kernel failed.", "Please report it with the model.");
  }
}

std::pair<std::string, std::string> message_and_hint(const std::string& text) {
  std::string message, hint;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string line = text.substr(at, end - at);
    const std::size_t first = line.find_first_not_of(' ');
    const bool advice = first != std::string::npos && line.compare(first, 4, "Try ") == 0;
    std::string& part = advice ? hint : message;
    part += (part.empty() ? "" : "\n") + (advice ? line.substr(first) : line);
    at = end + 1;
  }
  return {message, hint};
}

std::vector<std::string> joints_named_in(const std::string& text, const std::vector<std::string>* known) {
  constexpr std::string_view kBefore = "joint ";
  std::vector<std::string> names;
  for (std::size_t at = text.find(kBefore); at != std::string::npos; at = text.find(kBefore, at + 1)) {
    const std::size_t begin = at + kBefore.size();
    std::size_t end = begin;
    while (end < text.size() && (std::isalnum(static_cast<unsigned char>(text[end])) || text[end] == '_' || text[end] == '-')) ++end;
    std::string name = text.substr(begin, end - begin);
    const bool is_known = known == nullptr || std::find(known->begin(), known->end(), name) != known->end();
    if (is_known && !name.empty() && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(std::move(name));
  }
  return names;
}

std::string dump(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace pintle::studio
