#include "io/model_variants.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "io/variations.h"

namespace pintle {
namespace {

std::vector<std::string> keys_of(const std::string& path) {
  std::vector<std::string> keys(1);
  for (const char c : path) {
    if (c == '.') keys.emplace_back();
    else keys.back() += c;
  }
  return keys;
}

// The node at a path; tables and the key itself are added if the file leaves them at their defaults.
Node& node_at(Node& root, const std::vector<std::string>& keys) {
  Node* at = &root;
  for (const std::string& key : keys) {
    Node* next = at->table()->find(key);
    at = next != nullptr ? next : &at->table()->append(key, at->spot, Node{{}, at->spot});
  }
  return *at;
}

template <class Thing>
void put_in(std::vector<Thing>& all, const std::vector<std::size_t>& places, std::vector<Thing>& changed) {
  for (std::size_t k = 0; k < places.size(); ++k) all[places[k]] = std::move(changed[k]);
}

// What turns a number into a quantity of this unit, in an expression: " N/m", or "/(1 s)" for 1/s.
std::string as_factor(const std::string& unit) {
  if (unit.empty() || !unit.starts_with("1/")) return unit.empty() ? unit : " " + unit;
  std::string factor;
  for (std::size_t slash = 1; slash < unit.size();) {
    const std::size_t next = std::min(unit.find('/', slash + 1), unit.size());
    factor += "/(1 " + unit.substr(slash + 1, next - slash - 1) + ")";
    slash = next;
  }
  return factor;
}

// Placeholder for a varied number until it has a value: it occurs in no file, and `depends` finds it.
constexpr const char* kVaried = "\x01";

}  // namespace

ModelVariants::ModelVariants(const Document& document, const std::vector<std::string>& paths, const FileText& files) : changing_(document), files_(files) {
  ModelReading whole(document, files);
  read_all(whole);
  whole.complaints.throw_if_any();
  base_ = std::move(whole.model);
  markers_of_ = std::move(whole.markers_of);
  type_of_joint_ = std::move(whole.type_of_joint);
  named_tables_ = std::move(whole.tables);
  for (const std::string& path : paths) {
    paths_.push_back(keys_of(path));
    const auto parameter = paths_.back()[0] == "parameters" ? varied_key(whole, path, {}) : std::nullopt;
    units_.push_back(parameter ? as_factor(parameter->unit) : "");
    node_at(changing_.root, paths_.back()).value = std::string(kVaried);
    if (paths_.back()[0] == "parameters") parameters_.insert(paths_.back()[1]);
  }
  leave_out_what_stays();
  begin_reading();
}

ModelVariants::ModelVariants(const ModelVariants& other)
    : paths_(other.paths_), units_(other.units_), parameters_(other.parameters_), changing_(other.changing_), base_(other.base_), markers_of_(other.markers_of_),
      type_of_joint_(other.type_of_joint_),
      named_tables_(other.named_tables_), files_(other.files_), bodies_(other.bodies_), joints_(other.joints_), springs_(other.springs_), forces_(other.forces_),
      motors_(other.motors_), all_joints_(other.all_joints_), settings_(other.settings_), ground_(other.ground_), tables_(other.tables_) {
  begin_reading();
}

ModelVariants::~ModelVariants() = default;

void ModelVariants::begin_reading() {
  reading_ = std::make_unique<ModelReading>(changing_, files_);
  reading_->markers_of = markers_of_;
  reading_->type_of_joint = type_of_joint_;
  reading_->tables = named_tables_;
  let_expressions_call_tables(*reading_);
}

// Whether it contains a varied number or the name of a parameter that changes. A name inside a longer one counts too:
// then more is read again than necessary, but never less.
bool ModelVariants::depends(const Node& node) const {
  if (const Table* table = node.table()) return std::any_of(table->entries().begin(), table->entries().end(), [this](const Entry& entry) { return depends(entry.value); });
  if (const Array* array = node.array()) return std::any_of(array->begin(), array->end(), [this](const Node& item) { return depends(item); });
  const std::string* text = node.string();
  if (text == nullptr) return false;
  return *text == kVaried || std::any_of(parameters_.begin(), parameters_.end(), [text](const std::string& name) { return text->find(name) != std::string::npos; });
}

ModelVariants::Places ModelVariants::keep_dependent(std::string_view section, std::size_t before) {
  Places places;
  Node* node = changing_.root.table()->find(section);
  if (node == nullptr) return places;
  Table kept;
  const std::vector<Entry>& entries = node->table()->entries();
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (!depends(entries[i].value) && !(section == "joint" && all_joints_) && !(section == "body" && ground_ && i == 0)) continue;
    places.push_back(before + i);
    kept.append(entries[i].key, entries[i].key_spot, entries[i].value);
  }
  node->value = std::move(kept);
  return places;
}

void ModelVariants::leave_out_what_stays() {
  const Table& root = *changing_.root.table();
  const auto section_depends = [&](std::string_view name) {
    const Node* node = root.find(name);
    return node != nullptr && depends(*node);
  };
  const auto add_dependent = [this](const Node& section) {
    std::size_t known = 0;
    do {  // those defined by others that change
      known = parameters_.size();
      for (const Entry& entry : section.table()->entries())
        if (depends(entry.value)) parameters_.insert(entry.key);
    } while (known < parameters_.size());
  };
  if (const Node* parameters = root.find("parameters")) add_dependent(*parameters);
  tables_ = section_depends("table");
  if (tables_) add_dependent(*root.find("table"));
  all_joints_ = section_depends("defaults");
  ground_ = section_depends("ground");
  settings_ = section_depends("simulate") || section_depends("gravity");
  bodies_ = keep_dependent("body");
  joints_ = keep_dependent("joint");
  const Node* springs = root.find("spring");
  const std::size_t n_springs = springs == nullptr ? 0 : springs->table()->entries().size();
  springs_ = keep_dependent("spring");
  for (const std::size_t place : keep_dependent("torsion_spring", n_springs)) springs_.push_back(place);
  forces_ = keep_dependent("force");
  motors_ = keep_dependent("motor");
}

Model ModelVariants::at(std::span<const double> values) {
  for (std::size_t i = 0; i < paths_.size(); ++i) {
    Node& node = node_at(changing_.root, paths_[i]);
    if (units_[i].empty()) node.value = values[i];
    else node.value = fmt::format("{:.17g}{}", values[i], units_[i]);
  }
  ModelReading& reading = *reading_;
  reading.model = Model();
  reading.records.scope.constant_names.clear();
  read_parameters(reading);
  if (tables_) read_tables(reading);
  if (settings_) read_settings(reading);
  if (!bodies_.empty()) read_bodies(reading);
  if (!joints_.empty()) read_joints(reading);
  if (!springs_.empty() || !forces_.empty()) read_loads(reading);
  if (!motors_.empty()) read_motors(reading);
  if (!reading.complaints.empty()) {
    const std::unique_ptr<ModelReading> complaining = std::move(reading_);
    begin_reading();
    complaining->complaints.throw_if_any();
  }
  Model out = base_;
  if (settings_) {
    out.gravity = reading.model.gravity;
    out.simulate = reading.model.simulate;
  }
  if (ground_) out.ground = std::move(reading.model.ground);
  put_in(out.bodies, bodies_, reading.model.bodies);
  put_in(out.joints, joints_, reading.model.joints);
  put_in(out.springs, springs_, reading.model.springs);
  put_in(out.forces, forces_, reading.model.forces);
  put_in(out.motors, motors_, reading.model.motors);
  return out;
}

}  // namespace pintle
