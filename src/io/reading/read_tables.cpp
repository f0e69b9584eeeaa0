// [table]: functions that expressions may call.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/units.h"
#include "io/reading/file_columns.h"
#include "io/reading/model_reading.h"
#include "io/text.h"
#include "results/run_folder.h"

namespace pintle {
namespace {

// Units such as 1/min of a column: why they are refused, and what to write.
constexpr const char* kFrequencyUnit = "this unit would count radians, not turns";
constexpr const char* kSpeedUnits = "\"rpm\", \"rev/s\", \"rad/s\", or \"1/s\" for what is no speed of rotation";

// Why a file name cannot be used, and what to try; "" for both if it can.
std::pair<std::string, std::string> name_fault(const std::string& name) {
  const std::filesystem::path path(name);
  const bool leaves = path.is_absolute() || (name.size() > 1 && name[1] == ':') || std::find(path.begin(), path.end(), "..") != path.end();
  if (name.empty() || leaves) return {"a model reads files in its own folder and in folders below it only, so that it can be moved with them", "a copy of the file beside the model"};
  if (name.find('\\') != std::string::npos) return {"folders are separated by /", "\"data/gas.csv\""};
  const std::string plain = path.lexically_normal().string();
  if (plain == kSeriesFile || plain == kEventsFile || plain == kSummaryFile || plain.starts_with("model-as-run.")) return {"a run folder, where the file is copied to, has a file of this name", "another name"};
  return {};
}

// Either x or y: its numbers [SI], and what they measure.
struct Coordinate {
  std::vector<double> numbers;
  Dimension dimension = kBareNumber;
};

class TableReader {
 public:
  TableReader(ModelReading& reading, const Entry& entry) : reading_(reading), entry_(entry), path_("table." + entry.key) {}

  /// The table, unless something was wrong with it.
  std::optional<NamedTable> read() {
    const std::size_t before = reading_.complaints.size();
    check_name();
    record_ = reading_.records.read(reading_.spec("table.*"), entry_.value, entry_.key_spot, path_);
    if (reading_.complaints.size() > before) return {};
    check_sources();
    if (reading_.complaints.size() == before) record_.states("file") ? read_file() : read_lists();
    if (reading_.complaints.size() == before) check_points();
    if (reading_.complaints.size() == before) check_period();
    if (reading_.complaints.size() > before) return {};
    return finished();
  }

 private:
  void complain(std::string_view key, Spot spot, std::string found, std::string because, std::string suggestion) {
    reading_.complaints.add(spot, key.empty() ? path_ : path_ + "." + std::string(key), std::move(found), std::move(because), std::move(suggestion));
  }

  void check_name() {
    const std::string& name = entry_.key;
    constexpr std::array<std::string_view, 9> kVariables{"t", "x", "angle", "slide", "rate", "angle_rate", "slide_rate", "stroke", "stroke_rate"};
    const bool variable = std::find(kVariables.begin(), kVariables.end(), name) != kVariables.end();
    const auto& parameters = reading_.records.scope.constant_names;
    if (!is_identifier(name)) complain("", entry_.key_spot, in_quotes(name), "a table is called by its name, which is a letter, then letters, digits and _", "no other character in it");
    else if (is_reserved_name(name) || variable) complain("", entry_.key_spot, in_quotes(name), "this is the name of a function, a constant or a variable", name + "_table");
    else if (std::find(parameters.begin(), parameters.end(), name) != parameters.end()) complain("", entry_.key_spot, in_quotes(name), "a parameter has this name", name + "_table");
  }

  // Either lists or a file, and no keys without effect.
  void check_sources() {
    const bool file = record_.states("file");
    for (const char* key : {"x", "y"}) {
      if (file && record_.states(key)) complain(key, record_.spot(key), key, "the numbers are in the file", "either file, or x and y");
      if (!file && !record_.states(key)) complain(key, entry_.key_spot, std::string("no ") + key, "a table has lists x and y, or a file", std::string(key) + " = [0, 1]");
    }
    for (const char* key : {"x_column", "y_column"})
      if (!file && record_.states(key)) complain(key, record_.spot(key), key, "columns are of a file", "delete it, or file = \"data.csv\"");
    if (record_.states("period") && record_.states("outside")) complain("outside", record_.spot("outside"), in_quotes(record_.word("outside")), "a periodic table has no outside", "delete it");
  }

  std::optional<Unit> stated_unit(const char* key) {
    if (!record_.states(key)) return {};
    const std::string text = record_.word(key);
    const auto unit = parse_unit(text);
    if (unit && is_frequency_unit(text, *unit)) complain(key, record_.spot(key), in_quotes(text), kFrequencyUnit, kSpeedUnits);
    if (!unit) complain(key, record_.spot(key), in_quotes(text), "this is not a unit", reading_.complaints.did_you_mean(text, {unit_symbols().begin(), unit_symbols().end()}));
    return unit;
  }

  void read_lists() {
    const std::optional<Unit> y = stated_unit("y_unit");
    x_unit_ = stated_unit("x_unit");
    read_list("x", x_unit_, x_);
    read_list("y", y, y_);
  }

  void read_list(const char* key, const std::optional<Unit>& unit, Coordinate& out) {
    if (unit) out.dimension = unit->dimension;
    for (const Node& item : *record_.find(key)->node->array())
      if (const auto quantity = reading_.records.read_quantity(item, path_ + "." + key)) out.numbers.push_back(in_si(*quantity, unit, item, key, out.dimension));
  }

  // A bare number is in the stated unit. The first quantity with a unit sets the dimension of all of them.
  double in_si(const Quantity& quantity, const std::optional<Unit>& unit, const Node& node, const char* key, Dimension& common) {
    if (quantity.dimension.any) return unit ? quantity.si * unit->factor : quantity.si;
    if (common.any) common = quantity.dimension;
    if (auto problem = check_dimension(quantity.dimension, common)) complain(key, node.spot, describe(node), *problem, "quantities of one kind");
    return quantity.si;
  }

  void read_file() {
    const std::string name = record_.word("file");
    const Spot spot = record_.spot("file");
    if (const auto [because, suggestion] = name_fault(name); !because.empty()) return complain("file", spot, in_quotes(name), because, suggestion);
    if (!reading_.file_text) return complain("file", spot, in_quotes(name), "only the text of the model is known here, and no other file can be read", "lists x and y instead of the file");
    try {
      const FileColumns found = read_file_columns(name, reading_.file_text(name), {chosen("x_column"), chosen("y_column")});
      lines_ = found.lines;
      x_unit_ = take_column("x", found.columns[0], x_);
      take_column("y", found.columns[1], y_);
    } catch (const FileFault& fault) {
      const char* key = fault.column < 0 ? "file" : fault.column == 0 ? "x_column" : "y_column";
      complain(key, record_.states(key) ? record_.spot(key) : spot, fault.found, fault.because, fault.suggestion);
    } catch (const FileError& error) {
      const std::string why = error.what();
      complain("file", spot, in_quotes(name), why.substr(0, why.find('\n')), "the name of a file in the folder of the model or below it");
    }
  }

  ColumnChoice chosen(const char* key) const {
    const Value& value = *record_.find(key);
    if (!value.words.empty()) return {value.words.front(), 0};
    return {"", value.numbers.front() >= 1 ? static_cast<std::size_t>(value.numbers.front()) : 0};
  }

  std::optional<Unit> take_column(const std::string& name, const FileColumn& column, Coordinate& out) {
    const std::string key = name + "_unit";
    std::optional<Unit> unit = stated_unit(key.c_str());
    if (!unit && column.unit) {
      unit = parse_unit(*column.unit);
      if (unit && is_frequency_unit(*column.unit, *unit)) complain("file", record_.spot("file"), fmt::format("a column in {}", *column.unit), kFrequencyUnit, key + " = one of " + kSpeedUnits);
    }
    if (!unit) {
      complain(key, record_.spot("file"), "no " + key, "the file does not say in which unit the column is", key + " = \"mm\", or \"\" for a pure number");
      return {};
    }
    out.dimension = unit->dimension;
    for (const double number : column.numbers) out.numbers.push_back(number * unit->factor);
    return unit;
  }

  // The place of a number: in its list, or in the file.
  Spot spot_of(const char* key, std::size_t i) const { return lines_.empty() ? (*record_.find(key)->node->array())[i].spot : record_.spot("file"); }
  std::string found_at(std::size_t i, const std::string& what) const { return lines_.empty() ? what : fmt::format("{}:{}: {}", record_.word("file"), lines_[i], what); }
  const char* key_of(const char* key) const { return lines_.empty() ? key : "file"; }

  void check_points() {
    const std::size_t n = x_.numbers.size();
    if (n < 2) return complain(key_of("x"), record_.spot(key_of("x")), fmt::format("{} {}", n, n == 1 ? "point" : "points"), "a table has two points at least", "more points");
    if (y_.numbers.size() != n) return complain("y", record_.spot("y"), fmt::format("{} numbers", y_.numbers.size()), fmt::format("x has {}", n), "one y for each x");
    for (std::size_t i = 1; i < n; ++i) {
      const double before = x_.numbers[i - 1], now = x_.numbers[i];
      if (now > before) continue;
      return complain(key_of("x"), spot_of("x", i), found_at(i, fmt::format("{:g} {}", now, unit_of(x_))), fmt::format("x must rise, and the one before it is {:g} {}", before, unit_of(x_)), "points in rising order, each once");
    }
  }

  static bool is_frequency_unit(const std::string& text, const Unit& unit) { return unit.dimension == Dimension{{0, 0, -1, 0}, false} && mentions_frequency(text); }
  static std::string unit_of(const Coordinate& one) { return one.dimension.any ? "" : to_unit_text(one.dimension); }

  void check_period() {
    if (!record_.states("period")) return;
    const Node& node = *record_.find("period")->node;
    const auto quantity = reading_.records.read_quantity(node, path_ + ".period");
    Dimension dimension = x_.dimension;
    period_ = in_si(*quantity, x_unit_, node, "period", dimension);
    const double span = x_.numbers.back() - x_.numbers.front(), first = y_.numbers.front(), last = y_.numbers.back();
    const double rounding = 1e-9 * *period_;
    if (span > *period_ + rounding)
      return complain("period", node.spot, fmt::format("{:g} {}", *period_, unit_of(x_)), fmt::format("the table spans more, {:g} {}", span, unit_of(x_)), "a table of one period");
    const std::size_t end = y_.numbers.size() - 1;
    const auto [least, most] = std::minmax_element(y_.numbers.begin(), y_.numbers.end());
    if (span > *period_ - rounding && std::abs(last - first) > 1e-9 * std::max(std::abs(*least), std::abs(*most)))
      complain(key_of("y"), spot_of("y", end), found_at(end, fmt::format("{:g} {}", last, unit_of(y_))), fmt::format("one period before it is {:g} {}: the function would jump", first, unit_of(y_)), "the same value at both ends, or no point at the end of the period");
  }

  NamedTable finished() {
    NamedTable out{{entry_.key, x_.dimension, y_.dimension, nullptr}, x_.numbers, y_.numbers};
    const std::string word = record_.word("interpolation");
    const TableInterpolation interpolation = word == "spline" ? TableInterpolation::kSpline : word == "monotone" ? TableInterpolation::kMonotone : TableInterpolation::kLinear;
    out.in_scope.function = std::make_shared<const TableFunction>(std::move(x_.numbers), std::move(y_.numbers), interpolation, record_.word("outside") == "extend" ? TableOutside::kExtend : TableOutside::kHold, period_);
    return out;
  }

  ModelReading& reading_;
  const Entry& entry_;
  std::string path_;
  Record record_;
  Coordinate x_, y_;
  std::optional<Unit> x_unit_;      // of bare numbers
  std::vector<std::size_t> lines_;  // line in the file; empty for lists
  std::optional<double> period_;
};

// Stands in for a faulty table, so that expressions that call it are not blamed.
NamedTable faulty_table(const std::string& name) {
  return {{name, kBareNumber, kBareNumber, std::make_shared<const TableFunction>(std::vector<double>{0, 1}, std::vector<double>{1, 1}, TableInterpolation::kLinear)}, {}, {}};
}

}  // namespace

void read_tables(ModelReading& reading) {
  reading.tables.clear();
  for (const Entry& entry : section(reading, "table").entries()) {
    auto table = TableReader(reading, entry).read();
    reading.tables.insert_or_assign(entry.key, table ? std::move(*table) : faulty_table(entry.key));
  }
  let_expressions_call_tables(reading);
}

void let_expressions_call_tables(ModelReading& reading) {
  reading.records.scope.tables.clear();
  for (const auto& [name, table] : reading.tables) reading.records.scope.tables.push_back(table.in_scope);
}

}  // namespace pintle
