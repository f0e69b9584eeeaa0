// Top level, [simulate] and [parameters].

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <unordered_set>
#include <utility>

#include "base/text/name_patterns.h"
#include "base/text/text_scanner.h"
#include "base/units.h"
#include "io/reading/model_reading.h"
#include "io/text.h"
#include "run/check_settings.h"

namespace pintle {
namespace {

constexpr int kNewestFormat = 1;

void check_times(ModelReading& reading, const Record& record) {
  const SimulateSettings& simulate = reading.model.simulate;
  if (simulate.duration <= 0 || simulate.output_step <= 0) return;
  const Spot spot = record.spot("output_step");
  if (simulate.output_step > simulate.duration) {
    reading.complaints.add(spot, "simulate.output_step", fmt::format("{} s", simulate.output_step),
                           "this exceeds the duration, " + fmt::format("{} s", simulate.duration),
                           "a small part of the duration");
  } else if (simulate.duration / simulate.output_step > kMostRows) {
    reading.complaints.add(spot, "simulate.output_step", fmt::format("{} s", simulate.output_step),
                           "this would give more than 10 million rows of results", "a longer step");
  }
}

// Which methods solve which equations.
void check_method(ModelReading& reading, const Record& record, const std::string& equations) {
  const std::string& method = reading.model.simulate.method;
  const bool relative = equations == "relative_augmented_lagrangian", augmented = relative || equations == "augmented_lagrangian", penalty = equations == "penalty";
  const bool in_alpha_family = method == "ode23t" || method == "hht" || (method == "generalised_alpha" && !relative);
  const bool fits = method == "auto" || equations == "newtonian" || (penalty && in_alpha_family) || (augmented ? in_alpha_family : method == "dopri5" || (equations == "relative" && method == "radau"));
  if (fits) return;
  reading.complaints.add(record.spot("method"), "simulate.method", in_quotes(method), "this method does not solve the " + equations + " equations",
                         relative        ? "\"auto\", \"trapezoidal\" or \"hht\""
                         : augmented     ? "\"auto\", \"trapezoidal\", \"hht\" or \"generalised_alpha\""
                         : penalty       ? "\"auto\", \"dopri5\", \"trapezoidal\", \"hht\" or \"generalised_alpha\""
                         : equations == "ideal" ? "\"auto\" or \"dopri5\""
                                         : "\"auto\", \"radau\" or \"dopri5\"");
}

// A penalty that the chosen equations do not use is a mistake.
void check_penalty(ModelReading& reading, const Record& record) {
  if (reading.model.simulate.equations == Equations::kPenalty) return;
  for (const char* key : {"penalty", "penalty_frequency", "penalty_damping"})
    if (record.states(key))
      reading.complaints.add(record.spot(key), std::string("simulate.") + key, fmt::format("{:g}", record.number(key)), std::string("the ") + to_word(reading.model.simulate.equations) + " equations have no penalty to choose",
                             "equations = \"penalty\"");
}

// Only the implicit method can step over vibrations that the motion does not feel.
void check_tolerance_of(ModelReading& reading, const Record& record) {
  const SimulateSettings& simulate = reading.model.simulate;
  if (simulate.tolerance_of == ToleranceOf::kForces) return;
  if (simulate.equations != Equations::kNewtonian)
    reading.complaints.add(record.spot("tolerance_of"), "simulate.tolerance_of", in_quotes("motion"), "a tolerance of the motion needs newtonian equations", "equations = \"newtonian\"");
  if (simulate.method != "auto" && simulate.method != "radau")
    reading.complaints.add(record.spot("tolerance_of"), "simulate.tolerance_of", in_quotes("motion"), "method " + in_quotes(simulate.method) + " has no tolerance of the motion", "method = \"radau\"");
}

// Only compliant joints come to rest by themselves.
void check_start(ModelReading& reading, const Record& record) {
  const Start start = reading.model.simulate.start;
  const Equations equations = reading.model.simulate.equations;
  if (equations == Equations::kNewtonian || (start != Start::kSettled && start != Start::kSeated)) return;
  if (start == Start::kSeated && equations == Equations::kRelative) return;
  if (start == Start::kSeated) return reading.complaints.add(record.spot("start"), "simulate.start", "\"seated\"", "these equations cannot start with play taken up", "equations = \"newtonian\" or \"relative\", or start = \"assembled\"");
  reading.complaints.add(record.spot("start"), "simulate.start", "\"settled\"", "these equations cannot bring a mechanism to rest", "equations = \"newtonian\", or start = \"assembled\"");
}

void read_simulate(ModelReading& reading) {
  const Entry* entry = reading.root.find_entry("simulate");
  if (entry == nullptr) return;
  const Record record = reading.records.read(reading.spec("simulate"), entry->value, entry->key_spot, "simulate");
  SimulateSettings& simulate = reading.model.simulate;
  simulate.duration = record.number("duration");
  simulate.output_step = record.number("output_step");
  simulate.tolerance = record.number("tolerance", simulate.tolerance);
  simulate.max_step = record.number("max_step");
  if (const std::string method = record.word("method"); !method.empty()) simulate.method = method;
  const std::string equations = record.word("equations");
  simulate.equations = to_equations(equations);
  simulate.penalty = {record.number("penalty", simulate.penalty.factor), record.number("penalty_frequency", simulate.penalty.frequency),
                      record.number("penalty_damping", simulate.penalty.damping)};
  if (record.word("tolerance_of") == "motion") simulate.tolerance_of = ToleranceOf::kMotion;
  check_method(reading, record, equations);
  check_tolerance_of(reading, record);
  check_penalty(reading, record);
  const std::string start = record.word("start");
  simulate.start = start == "raw" ? Start::kRaw : start == "unloaded" ? Start::kUnloaded : start == "settled" ? Start::kSettled : start == "seated" ? Start::kSeated : Start::kAssembled;
  check_start(reading, record);
  if (const Value* names = record.find("record")) simulate.record = names->words;
  check_times(reading, record);
}

// Evaluates parameters in the order of their dependence, without recursion because chains may be long.
class ParameterReader {
 public:
  using Values = std::unordered_map<std::string, Quantity>;

  ParameterReader(ModelReading& reading, const Table& table, Values& values)
      : reading_(reading), table_(table), values_(values) {
    for (std::size_t i = 0; i < entries().size(); ++i) index_.emplace(entries()[i].key, i);
  }

  void read_all() {
    count_dependencies();
    std::vector<std::size_t> ready;
    for (std::size_t i = 0; i < entries().size(); ++i) {
      if (waits_for_[i] == 0) ready.push_back(i);
    }
    while (!ready.empty()) {
      const std::size_t i = ready.back();
      ready.pop_back();
      evaluate(i);
      for (const std::size_t user : users_[i]) {
        if (--waits_for_[user] == 0) ready.push_back(user);
      }
    }
    complain_of_cycles();
  }

 private:
  static constexpr double kFaulty = std::numeric_limits<double>::quiet_NaN();

  const std::vector<Entry>& entries() const { return table_.entries(); }

  void count_dependencies() {
    users_.resize(entries().size());
    waits_for_.resize(entries().size());
    uses_.resize(entries().size());
    std::size_t reader = 0;
    ParseScope scope = reading_.records.scope;
    scope.constant = [&](std::string_view word) -> std::optional<Quantity> {
      if (const auto it = index_.find(word); it != index_.end()) {
        users_[it->second].push_back(reader);
        uses_[reader].push_back(it->second);
        ++waits_for_[reader];
      }
      return Quantity{kFaulty, {}};
    };
    for (; reader < entries().size(); ++reader) {
      if (const std::string* text = entries()[reader].value.string()) static_cast<void>(parse_quantity(*text, scope));  // its faults are reported when it is evaluated
    }
  }

  void evaluate(std::size_t i) {
    const Entry& entry = entries()[i];
    const std::string path = "parameters." + entry.key;
    Quantity value{kFaulty, {}};
    if (is_reserved_name(entry.key)) {
      reading_.complaints.add(entry.key_spot, path, in_quotes(entry.key),
                              "this is the name of a function, of a constant or of time", entry.key + "_value");
    } else if (!is_identifier(entry.key)) {
      reading_.complaints.add(entry.key_spot, path, in_quotes(entry.key),
                              "a parameter's name is a letter, then letters, digits and _", "no other character in it");
    } else if (const auto read = reading_.records.read_quantity(entry.value, path)) {
      value = *read;
      if (const std::string* text = entry.value.string(); text != nullptr && fits(value.dimension, kAngularSpeed) && reading_.records.is_frequency(*text)) reading_.records.frequencies.push_back(entry.key);
    }
    values_[entry.key] = value;
  }

  // Parameters still waiting are in a cycle or use one. Each cycle is reported once.
  void complain_of_cycles() {
    std::vector<std::size_t> walk_of(entries().size(), 0);
    std::vector<std::size_t> position(entries().size(), 0);
    for (std::size_t i = 0; i < entries().size(); ++i) {
      if (waits_for_[i] == 0) continue;
      values_[entries()[i].key] = {kFaulty, {}};
      std::vector<std::size_t> trail;
      std::size_t at = i;
      for (; walk_of[at] == 0; at = waiting_use_of(at)) {
        walk_of[at] = i + 1;
        position[at] = trail.size();
        trail.push_back(at);
      }
      const bool closes = !trail.empty() && walk_of[at] == i + 1;
      if (closes) complain_of_cycle({trail.begin() + static_cast<std::ptrdiff_t>(position[at]), trail.end()});
    }
  }

  std::size_t waiting_use_of(std::size_t i) const {
    const auto waits = [&](std::size_t use) { return waits_for_[use] > 0; };
    return *std::find_if(uses_[i].begin(), uses_[i].end(), waits);
  }

  void complain_of_cycle(const std::vector<std::size_t>& cycle) {
    constexpr std::size_t kShown = 8;
    std::string chain;
    for (std::size_t i = 0; i < std::min(cycle.size(), kShown); ++i) chain += entries()[cycle[i]].key + " -> ";
    if (cycle.size() > kShown) chain += "... -> ";
    const Entry& entry = entries()[cycle.front()];
    reading_.complaints.add(entry.value.spot, "parameters." + entry.key, describe(entry.value),
                            "circular parameters have no value: " + chain + entry.key,
                            "define one of them as a number");
  }

  ModelReading& reading_;
  const Table& table_;
  std::map<std::string, std::size_t, std::less<>> index_;
  std::vector<std::vector<std::size_t>> users_;
  std::vector<std::vector<std::size_t>> uses_;
  std::vector<std::size_t> waits_for_;
  Values& values_;
};

}  // namespace

void read_parameters(ModelReading& reading) {
  const Table& table = section(reading, "parameters");
  auto parameters = std::make_shared<std::unordered_map<std::string, Quantity>>();
  reading.records.scope.constant = [parameters](std::string_view name) -> std::optional<Quantity> {
    const auto it = parameters->find(std::string(name));
    if (it == parameters->end()) return std::nullopt;
    return it->second;
  };
  for (const Entry& entry : table.entries()) reading.records.scope.constant_names.push_back(entry.key);
  ParameterReader(reading, table, *parameters).read_all();
}

void read_settings(ModelReading& reading) {
  const Node& root = reading.complaints.document().root;
  const Record record = reading.records.read(reading.spec(""), root, {0, 1, 1}, "");
  Model& model = reading.model;
  if (record.number("format", 1) > kNewestFormat) {
    reading.complaints.add(record.spot("format"), "format", fmt::format("{}", record.number("format")),
                           "this file is newer than the program, which reads format 1", "a newer pintle");
  }
  model.name = record.word("name");
  model.description = record.word("description");
  model.gravity = record.maybe_pair("gravity").value_or(model.gravity);
  if (record.word("space") == "spatial") {
    reading.complaints.add(record.spot("space"), "space", "\"spatial\"", "spatial mechanisms are not available yet",
                           "\"planar\"");
  }
  read_simulate(reading);
}

// A pattern that matches nothing is a mistake that would otherwise show only after the run.
void check_record(ModelReading& reading) {
  const Model& model = reading.model;
  std::vector<std::string> names{"all"};
  for (const Body& body : model.bodies) names.push_back("body." + body.name);
  for (const Joint& joint : model.joints) names.push_back("joint." + joint.name);
  const std::unordered_set<std::string_view> known(names.begin(), names.end());
  const Node* simulate = reading.root.find("simulate");
  for (std::size_t i = 0; i < model.simulate.record.size(); ++i) {
    const std::string& entry = model.simulate.record[i];
    const bool wild = entry.find('*') != std::string::npos;
    const bool found = wild ? std::any_of(names.begin(), names.end(), [&entry](const std::string& name) { return matches_pattern(entry, name); })
                            : known.contains(entry);
    if (found) continue;
    const Node* list = simulate->table()->find("record");
    reading.complaints.add((*list->array())[i].spot, "simulate.record", in_quotes(entry), "no body or joint has this name; body.NAME or joint.NAME is expected",
                           wild ? "\"joint.*\"" : reading.complaints.did_you_mean(entry, names));
  }
}

}  // namespace pintle
