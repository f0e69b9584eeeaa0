// What the fuzzers try, and what the tests replay: each takes any bytes and answers with nothing, or with the promise
// that was broken. A crash, a hang or a foreign exception is a broken promise too.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/expression/expression_parser.h"
#include "base/units.h"
#include "io/document.h"
#include "io/writers.h"
#include "pintle/read_model.h"
#include "results/disk.h"
#include "results/series_csv.h"
#include "results/summary_json.h"
#include "studio/server/request_router.h"

namespace pintle::fuzz {

/// Every complaint stands somewhere, has a reason, and can be printed.
inline std::string faults_of(const InputError& error, std::string_view text) {
  if (error.complaints().empty()) return "an InputError without complaints";
  for (const Complaint& complaint : error.complaints()) {
    const std::string printed = to_text(complaint);
    if (complaint.because.empty()) return "no reason: " + printed;
    if (complaint.place.line < 1 || complaint.place.column < 1) return "no place: " + printed;
    if (static_cast<std::size_t>(complaint.place.line) > text.size() + 1) return "a place after the end: " + printed;
  }
  return {};
}

inline std::string read_as_model(std::string_view text, std::string_view name) {
  try {
    parse_model(text, name);
  } catch (const InputError& error) {
    return faults_of(error, text);
  }
  return {};
}

/// TOML: read as a model; as a tree it goes to JSON and back; its formatted text has the same tree and formats to
/// itself.
inline std::string model_toml(std::string_view text) {
  if (std::string fault = read_as_model(text, "x.toml"); !fault.empty()) return fault;
  try {
    const Document document = parse_toml(text, "x.toml");
    check_text(text, "x.toml");
    const Document twin = parse_json(to_json(document), "x.json");
    if (!same_tree(document.root, twin.root)) return "another tree in JSON:\n" + to_json(document);
    const std::string once = format_toml(text, "x.toml");
    if (!same_tree(document.root, parse_toml(once, "x.toml").root)) return "another tree when formatted:\n" + once;
    if (format_toml(once, "x.toml") != once) return "formatting again changes it:\n" + once;
  } catch (const InputError& error) {
    return faults_of(error, text);
  }
  return {};
}

inline std::string model_json(std::string_view text) {
  if (std::string fault = read_as_model(text, "x.json"); !fault.empty()) return fault;
  try {
    check_text(text, "x.json");
    const Document document = parse_json(text, "x.json");
    if (!same_tree(document.root, parse_toml(to_toml(document), "x.toml").root))
      return "another tree in TOML:\n" + to_toml(document);
  } catch (const InputError& error) {
    return faults_of(error, text);
  }
  return {};
}

inline ParseScope expression_scope() {
  const auto constant = [](std::string_view name) -> std::optional<Quantity> {
    if (name == "crank") return Quantity{0.1, kLength};
    if (name == "broken") return Quantity{std::nan(""), kMass};
    return std::nullopt;
  };
  return {constant, {"crank"}, {{"t", kTime}, {"x", kBareNumber}, {"a-b.angle", kAngle}}};
}

inline bool same(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

/// What is accepted has the same value and first derivatives by every way of asking.
inline std::string expression(std::string_view text) {
  const auto parsed = parse_expression(text, expression_scope());
  if (const auto* problem = std::get_if<ParseProblem>(&parsed)) {
    if (problem->offset > text.size()) return "a problem after the end";
    return problem->because.empty() ? "a problem without a reason" : "";
  }
  const Expression& f = std::get<ParsedExpression>(parsed).expression;
  const std::vector<double> values(f.variables().size(), 0.7);
  std::vector<double> gradient(values.size());
  if (!same(f.value(values), f.gradient(values, gradient))) return "two values";
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!same(f.second_order(values, i)[1], gradient[i])) return "two derivatives";
  return {};
}

/// The name of a unit that is read is read as the same unit (but for names without numerator, "1/m/s", and
/// products of larger exponents than may be written).
inline constexpr int kLargestUnitExponent = 20;
inline std::string unit(std::string_view text) {
  const std::optional<Unit> found = parse_unit(text);
  if (!found) return {};
  if (std::isnan(found->factor)) return "a factor that is no number";
  const std::string name = to_unit_text(found->dimension);
  const std::optional<Unit> again = parse_unit(name);
  const auto large = [](std::int8_t exponent) { return std::abs(exponent) > kLargestUnitExponent; };
  const bool readable = std::none_of(found->dimension.exponents.begin(), found->dimension.exponents.end(), large);
  if (readable && !name.starts_with('1') && (!again || !fits(again->dimension, found->dimension)))
    return fmt::format("its name {} is not read back", name);
  return {};
}

inline std::string series(std::string_view text) {
  try {
    Trajectory trajectory;
    read_series(text, "series.csv", trajectory);
  } catch (const FileError& error) {
    if (std::string_view(error.what()).empty()) return "an empty message";
  }
  return {};
}

inline std::string summary(std::string_view text) {
  try {
    is_summary(text);
    const Summary found = parse_summary(text, "summary.json");
    const std::string once = summary_json(found.run.trajectory, found.run.stamp);
    summary_text(found.run.trajectory, found.run.stamp);
    if (once.empty()) return "an empty summary";
  } catch (const FileError& error) {
    if (std::string_view(error.what()).empty()) return "an empty message";
  }
  return {};
}

/// A call of the studio's kernel: its name on the first line, then its arguments. The answer is a value or a fault with a message.
inline std::string studio_call(std::string_view text) {
  static constexpr std::array<std::string_view, 6> kQuick{"read", "write", "edit", "format", "open_drag", "drag"};
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view name = text.substr(0, end);
  if (std::find(kQuick.begin(), kQuick.end(), name) == kQuick.end()) return {};
  const auto answer = nlohmann::json::parse(studio::Kernel().call(name, text.substr(std::min(end + 1, text.size()))).text);
  if (answer.contains("value") == answer.contains("fault")) return "neither a value nor a fault";
  if (answer.contains("fault") && answer["fault"].at("message").get<std::string>().empty()) return "a fault without a message";
  return {};
}

/// A folder with a model and a page, and one beside it that nobody may read.
class FuzzedRouter {
 public:
  FuzzedRouter() {
    namespace fs = std::filesystem;
    std::string name = (fs::temp_directory_path() / "pintle-fuzz-XXXXXX").string();
    root_ = mkdtemp(name.data());
    for (const char* folder : {"pages", "models/sub", "outside"}) fs::create_directories(root_ / folder);
    write_file(root_ / "pages/index.html", "page");
    write_file(root_ / "models/a.toml", "format = 1\n");
    write_file(root_ / "outside/s.toml", kSecret);
    fs::create_symlink(root_ / "outside", root_ / "models/way");
    router_ = std::make_unique<studio::RequestRouter>(studio::RouterSettings{root_ / "pages", root_ / "models", "", 1, "t"});
  }
  ~FuzzedRouter() { std::filesystem::remove_all(root_); }
  studio::Reply answer(const studio::Request& request) { return router_->answer(request); }
  bool is_touched() const { return read_file(root_ / "outside/s.toml") != kSecret || std::distance(std::filesystem::directory_iterator(root_ / "outside"), {}) != 1; }
  static constexpr const char* kSecret = "dont-read-me";

 private:
  std::filesystem::path root_;
  std::unique_ptr<studio::RequestRouter> router_;
};

/// A request to the studio's server: method and target on the first line, then headers if they are not the page's own, an empty
/// line, the body. Nothing outside its folder is read or written; what is refused says why.
inline std::string studio_request(std::string_view text) {
  static FuzzedRouter router;
  const bool knows = text.find(FuzzedRouter::kSecret) != std::string_view::npos;  // then a refusal may quote it
  const auto line = [&text] {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view out = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    return out;
  };
  const std::string_view first = line();
  const std::size_t space = std::min(first.find(' '), first.size());
  studio::Request request{std::string(first.substr(0, space)), std::string(first.substr(std::min(space + 1, first.size()))), {}, ""};
  for (std::string_view header = line(); !header.empty(); header = line()) {
    const std::size_t colon = std::min(header.find(':'), header.size());
    request.headers.emplace(header.substr(0, colon), header.substr(std::min(colon + 1, header.size())));
  }
  if (request.headers.empty()) request.headers = {{"host", "127.0.0.1:1"}, {"x-pintle-token", "t"}};
  request.body = text;
  if (request.target.starts_with("/api/runs") && request.method == "POST") return {};  // takes as long as the model says
  const studio::Reply reply = router.answer(request);
  if ((!knows && reply.body.find(FuzzedRouter::kSecret) != std::string::npos) || router.is_touched()) return "a file outside the folder";
  if (reply.status < 200 || reply.status > 599) return "a status that is none";
  if (reply.status >= 400 && nlohmann::json::parse(reply.body).at("fault").at("message").get<std::string>().empty()) return "refused without a reason";
  return {};
}

struct Target {
  const char* name;
  std::string (*run)(std::string_view);
};

inline constexpr std::array<Target, 8> kTargets{{{"model_toml", model_toml},
                                                 {"model_json", model_json},
                                                 {"expression", expression},
                                                 {"unit", unit},
                                                 {"series", series},
                                                 {"summary", summary},
                                                 {"studio_call", studio_call},
                                                 {"studio_request", studio_request}}};

}  // namespace pintle::fuzz
