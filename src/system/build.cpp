#include "system/build.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "base/text/article.h"
#include "joints/belt.h"
#include "joints/cam_profile.h"
#include "joints/catalog.h"
#include "joints/edge_profile.h"
#include "laws/catalog.h"
#include "laws/fault_of_values.h"
#include "laws/pressure.h"
#include "laws/separating_force.h"
#include "system/joint_tree.h"
#include "system/speed_integral.h"

namespace pintle {
namespace {

using S = Planar;

class Builder {
 public:
  explicit Builder(const Model& model) : model_(model) {
    for (std::size_t i = 0; i < model.bodies.size(); ++i)
      if (!body_index_.emplace(model.bodies[i].name, static_cast<int>(i)).second) refuse(fmt::format("two bodies are called '{}'", model.bodies[i].name));
    for (std::size_t j = 0; j < model.joints.size(); ++j)
      if (!joint_index_.emplace(model.joints[j].name, static_cast<int>(j)).second) refuse(fmt::format("two joints are called '{}'", model.joints[j].name));
  }

  System build(const System* like) {
    for (const Body& body : model_.bodies) add_body(body);
    for (const Joint& joint : model_.joints) add_joint(joint);
    for (const Motor& motor : model_.motors) add_motor(motor);
    for (const Spring& spring : model_.springs) add_spring(spring);
    for (const AppliedForce& force : model_.forces) add_force(force);
    if (model_.simulate.equations == Equations::kRelative) open_loops();
    system_.finish(like);
    return std::move(system_);
  }

 private:
  [[noreturn]] static void refuse(const std::string& what) { throw std::invalid_argument(what); }

  void open_loops() {
    const JointTree tree(system_);
    for (int j = 0; j < system_.n_joints(); ++j) {
      JointData& joint = system_.joints[j];
      joint.opened = joint.ideal && !tree.in_tree(j);
      joint.ideal = tree.in_tree(j);
    }
  }

  void add_body(const Body& body) {
    if (!(body.mass > 0) || !(body.inertia > 0)) refuse(fmt::format("body {}: mass and inertia must be positive", body.name));
    system_.bodies.push_back({body.name, {body.mass, body.mass, body.inertia},
                              {body.mass * model_.gravity[0], body.mass * model_.gravity[1], 0}});
  }

  const std::vector<Marker>& markers(const std::string& body) const {
    if (body == "ground") return model_.ground;
    const auto it = body_index_.find(body);
    if (it == body_index_.end()) refuse(fmt::format("there is no body '{}'", body));
    return model_.bodies[it->second].markers;
  }
  int body(const MarkerRef& ref) const { return ref.body == "ground" ? kGround : body_index_.at(ref.body); }
  S::Frame frame(const MarkerRef& ref) const {
    const Marker* marker = find_marker(markers(ref.body), ref.marker);
    if (!marker) refuse(fmt::format("body {} has no marker '{}'", ref.body, ref.marker));
    return S::Frame::at({marker->position[0], marker->position[1]}, marker->axis);
  }
  // A long list of markers, such as the ground's in a model of many mechanisms, is indexed at the first lookup.
  const Marker* find_marker(const std::vector<Marker>& row, const std::string& name) const {
    constexpr std::size_t kFew = 16;  // up to this many markers of a body are searched one by one; longer lists are indexed
    if (row.size() <= kFew) {
      const auto it = std::find_if(row.begin(), row.end(), [&name](const Marker& marker) { return marker.name == name; });
      return it == row.end() ? nullptr : &*it;
    }
    auto& index = marker_index_[&row];
    if (index.empty())
      for (const Marker& marker : row) index.emplace(marker.name, &marker);
    const auto it = index.find(name);
    return it == index.end() ? nullptr : it->second;
  }
  Placement place(const MarkerRef& first, const MarkerRef& second) const {
    Placement at;
    at.F = frame(first);
    at.M = frame(second);
    at.a = body(first);
    at.b = body(second);
    if (at.a == at.b) refuse(fmt::format("{} and {} are on the same body", first.marker, second.marker));
    return at;
  }

  // A chamber whose pressure is not stated is open.
  static std::shared_ptr<const Chambers> chambers_of(const Joint& joint) {
    const auto number = [&joint](const char* key, double otherwise) {
      const auto at = joint.geometry.find(key);
      return at == joint.geometry.end() ? otherwise : at->second;
    };
    const double ambient = number("ambient_pressure", 0);
    const auto pressure = [&](const char* key) {
      const auto at = joint.functions.find(key);
      return ChamberPressure(at == joint.functions.end() ? Expression::constant(number(key, ambient)) : at->second);
    };
    return std::make_shared<const Chambers>(number("bore", 0), number("rod_diameter", 0), ambient, pressure("cap_pressure"), pressure("rod_pressure"));
  }

  // A law with a rest position of its own also determines where the gap counts from.
  static Law make_law(const Joint& joint, const JointTypeInfo& type, const std::array<bool, 3>& held, JointDisplacement& displacement) {
    LawSetting setting;
    setting.joint_type = joint.type;
    setting.held = held;
    setting.one_sided = type.one_sided;
    setting.take(joint.geometry);
    for (const ComponentInfo& free : type.free) setting.free[free.place] = true;
    Law law;
    if (joint.type == "cylinder") {
      setting.chambers = chambers_of(joint);
      law.add(std::make_unique<LawPartOf<PressureLaw>>(PressureLaw{setting.chambers}));
    }
    const LawInfo* law_info = find_law(joint.law.word);
    const auto add = [&](const LawChoice* choice, LawRole role) {
      if (choice->word.empty()) return;
      const LawInfo* info = find_law(choice->word);
      if (!info || info->role != role) refuse(fmt::format("joint {}: there is no {} '{}'", joint.name, key_of(role), choice->word));
      if (!suits(*info, joint.type)) refuse(fmt::format("joint {}: {} joint has no law '{}'", joint.name, with_article(joint.type), choice->word));
      if (const std::string fault = fault_of_values(*info, choice->values); !fault.empty()) refuse(fmt::format("joint {}: {} {}", joint.name, key_of(role), fault));
      setting.values = &choice->values;
      setting.keys = info->keys;
      if (info->fault)
        if (const LawFault fault = info->fault(setting); !fault.key.empty()) refuse(fmt::format("joint {}: {}: {}", joint.name, fault.key, fault.why));
      if (role == LawRole::kFriction && law_info && law_info->rubs) refuse(fmt::format("joint {}: law '{}' has friction of its own", joint.name, joint.law.word));
      info->make(setting, law);
      if (info->rest) std::get<Selection>(displacement).offset.head<2>() = info->rest(setting);
    };
    if (!type.gap.empty()) add(&joint.law, LawRole::kHolds);
    if (setting.pressure_angle > 0) law.add(std::make_unique<LawPartOf<SeparatingForce>>(SeparatingForce{setting.pressure_angle}));
    if (!joint.friction.word.empty()) let_teeth_rub(displacement);
    add(&joint.friction, LawRole::kFriction);
    add(&joint.stops, LawRole::kStops);
    add(&joint.detent, LawRole::kDetent);
    return law;
  }
  void add_joint(const Joint& joint) {
    const JointTypeInfo* info = find_joint_type(joint.type);
    if (!info) refuse(fmt::format("joint {}: there is no type '{}'", joint.name, joint.type));
    JointData data;
    data.name = joint.name;
    data.type = joint.type;
    data.at = place(joint.first, joint.second);
    data.displacement = info->make(joint.geometry);
    if (info->fault)
      if (const GeometryFault fault = info->fault(joint.geometry); !fault.key.empty()) refuse(fmt::format("joint {}: {}: {}", joint.name, fault.key, fault.why));
    if (info->has_ends && joint.stops.word.empty()) refuse(fmt::format("joint {}: a {} needs stops", joint.name, joint.type));
    if (auto* gap = std::get_if<CamGap>(&data.displacement)) {
      if (!joint.cam) refuse(fmt::format("joint {}: a cam needs a profile", joint.name));
      data.cam = std::make_shared<const CamProfile>(*joint.cam);
      gap->profile = data.cam.get();
    }
    if (auto* gap = std::get_if<EdgeGap>(&data.displacement)) {
      if (!joint.edge) refuse(fmt::format("joint {}: an edge needs a height", joint.name));
      data.edge = std::make_shared<const EdgeProfile>(*joint.edge);
      gap->profile = data.edge.get();
    }
    for (const ComponentInfo& gap : info->gap) data.held[gap.place] = true;
    data.law = make_law(joint, *info, data.held, data.displacement);
    data.ideal = joint.ideal && model_.simulate.equations == Equations::kRelative;
    for (const ComponentInfo& free : info->free) data.free_mask[free.place] = 1;
    for (int k = 1; k < count_functions(data.displacement); ++k) data.free_mask[k] = 1;  // the opening and turn of teeth, the slip of surfaces
    if (const auto length = joint.functions.find("length"); length != joint.functions.end()) {
      if (!std::holds_alternative<Distance>(data.displacement)) refuse(fmt::format("joint {}: {} joint has no length that is driven", joint.name, with_article(joint.type)));
      data.displacement = Distance{0};
      data.driven = 0;
      data.target = length->second;
    }
    system_.joints.push_back(std::move(data));
  }

  int joint(const std::string& name) const {
    const auto it = joint_index_.find(name);
    if (it == joint_index_.end()) refuse(fmt::format("there is no joint '{}'", name));
    return it->second;
  }
  void add_motor(const Motor& motor) {
    const JointData& driven = system_.joints[joint(motor.joint)];
    if (!std::holds_alternative<Selection>(driven.displacement)) refuse(fmt::format("motor {}: {} joint has no coordinate for a motor", motor.name, with_article(driven.type)));
    const int component = driven.free_mask[0] > 0 ? 0 : 2;
    if (driven.free_mask[component] == 0) refuse(fmt::format("motor {}: joint {} leaves nothing free", motor.name, motor.joint));
    if (motor.kind == MotorKind::kEffort) {
      system_.loads.push_back(effort(motor, driven, component));
      return;
    }
    JointData servo;
    servo.name = motor.name;
    servo.type = "motor";
    servo.at = driven.at;
    servo.servo = servo.driven = component;
    LinearLaw law;
    law.k[component] = motor.stiffness;
    law.c[component] = motor.damping;
    servo.law = law;
    servo.displacement = Selection{};
    servo.held[component] = true;
    servo.keeps_speed = motor.kind == MotorKind::kSpeed;
    if (servo.keeps_speed && motor.law.variables().empty()) {
      servo.speed = motor.law.value({});
    } else {
      servo.target = motor.law;
      if (servo.keeps_speed) servo.speed_integral = std::make_shared<const SpeedIntegral>(motor.law, model_.simulate.duration > 0 ? model_.simulate.duration : 1);
    }
    system_.joints.push_back(std::move(servo));
  }
  LoadData effort(const Motor& motor, const JointData& driven, int component) const {
    LoadData load;
    load.name = motor.name;
    load.kind = LoadKind::kEffort;
    load.at = driven.at;
    load.component = component;
    load.law = motor.law;
    read_signals("motor", motor.joint, component, load);
    return load;
  }
  // `own`: the joint whose coordinate may be given without a joint name, and the component of it; empty: none.
  void read_signals(const char* kind, const std::string& own, int component, LoadData& load) const {
    const std::vector<std::string>& variables = load.law.variables();
    if (variables.size() > static_cast<std::size_t>(kMaxSignals)) refuse(fmt::format("{} {}: an expression may read {} signals at most", kind, load.name, kMaxSignals));
    for (const std::string& variable : variables) {
      const std::optional<Signal> signal = find_signal(variable, own, component);
      if (!signal) refuse(fmt::format("{} {}: '{}' is not a coordinate of a joint, a body or a marker", kind, load.name, variable));
      load.signals.push_back(*signal);
    }
  }
  std::optional<Signal> find_signal(const std::string& variable, const std::string& own, int component) const {
    if (variable == "t") return Signal{};
    const auto dot = variable.rfind('.');
    const std::string word = dot == std::string::npos ? variable : variable.substr(dot + 1), of = dot == std::string::npos ? own : variable.substr(0, dot);
    if (const auto it = joint_index_.find(of); it != joint_index_.end()) {
      const JointData& joint = system_.joints[it->second];
      const int free = dot == std::string::npos ? component : joint.free_mask[0] > 0 ? 0 : 2;
      if (word == "angle" || word == "angle_rate") return Signal{false, joint.at, 2, word == "angle_rate"};
      if (word == "slide" || word == "slide_rate") return Signal{false, joint.at, 0, word == "slide_rate"};
      if (word == "rate") return Signal{false, joint.at, free, true};
    }
    return find_body_signal(of, word);
  }
  // As seen from the ground: a coordinate of a body's centre of mass, or of one of its markers.
  std::optional<Signal> find_body_signal(const std::string& of, std::string_view word) const {
    constexpr std::array<std::string_view, 6> kWords{"x", "y", "angle", "vx", "vy", "spin"};
    const auto found = std::find(kWords.begin(), kWords.end(), word);
    const auto dot = of.find('.');
    const std::string body = of.substr(0, dot);
    const auto at = body_index_.find(body);
    if (found == kWords.end() || at == body_index_.end()) return {};
    Signal signal{false, {}, static_cast<int>(found - kWords.begin()) % 3, found - kWords.begin() >= 3};
    signal.at.a = kGround;
    signal.at.b = at->second;
    signal.at.F = S::Frame::at({0, 0}, 0);
    signal.at.M = dot == std::string::npos ? S::Frame::at({0, 0}, 0) : frame({body, of.substr(dot + 1)});
    return signal;
  }

  void add_spring(const Spring& spring) {
    LoadData load;
    load.name = spring.name;
    load.kind = spring.torsion ? LoadKind::kTorsionSpring : LoadKind::kSpring;
    load.at = place(spring.first, spring.second);
    load.component = spring.torsion ? 2 : 0;
    load.k = spring.stiffness;
    load.c = spring.damping;
    load.free = spring.free_length.value_or(0);
    system_.loads.push_back(std::move(load));
  }
  void add_force(const AppliedForce& force) {
    const int on = body(force.on);
    if (on == kGround) refuse(fmt::format("force {} acts on the ground", force.name));
    const std::array<const Expression*, 3> along{&force.force[0], &force.force[1], &force.torque};
    const bool of_time = std::all_of(along.begin(), along.end(), [](const Expression* e) { return std::all_of(e->variables().begin(), e->variables().end(), [](const std::string& x) { return x == "t"; }); });
    if (of_time) {
      system_.applied.push_back({force.name, on, frame(force.on), force.force[0], force.force[1], force.torque, force.body_axes});
      return;
    }
    for (int component = 0; component < 3; ++component)
      if (!along[component]->variables().empty() || along[component]->value({}) != 0) add_effort(force, on, component, *along[component]);
  }
  // Along the position of the point as seen from the ground, or that of the ground as seen from the point in its body's axes; or along the angle.
  void add_effort(const AppliedForce& force, int on, int component, const Expression& law) {
    LoadData load;
    load.name = force.name;
    load.kind = LoadKind::kEffort;
    load.applied = true;
    const bool in_body_axes = force.body_axes && component < 2;
    const S::Frame ground = S::Frame::at({0, 0}, 0), point = frame(force.on);
    load.at.a = in_body_axes ? on : kGround;
    load.at.b = in_body_axes ? kGround : on;
    load.at.F = in_body_axes ? S::Frame::at(point.p, 0) : ground;
    load.at.M = in_body_axes ? ground : point;
    load.component = component;
    load.law = law;
    read_signals("force", "", component, load);
    system_.loads.push_back(std::move(load));
  }

  const Model& model_;
  std::unordered_map<std::string_view, int> body_index_, joint_index_;
  mutable std::unordered_map<const std::vector<Marker>*, std::unordered_map<std::string_view, const Marker*>> marker_index_;
  System system_;
};

const Joint* model_joint(const Model& model, std::size_t j) { return j < model.joints.size() ? &model.joints[j] : nullptr; }

// Whether the length of a rod or rope is taken from the assembled position; a cylinder's length is stated.
bool is_measured(const Joint& joint) { return !joint.functions.contains("length") && !joint.geometry.contains("length") && joint.type != "cylinder"; }

// Stretch in the assembled position [m].
double stretch_of(const Joint& joint) {
  const auto stretch = joint.geometry.find("stretch");
  return stretch == joint.geometry.end() ? 0 : stretch->second;
}

void settle_joint(const Joint& joint, const RelativePose& pose, JointDisplacement& displacement, std::vector<std::string>& notes) {
  if (auto* distance = std::get_if<Distance>(&displacement); distance && is_measured(joint)) {
    distance->length = std::hypot(pose.z[0], pose.z[1]) - stretch_of(joint);
    notes.push_back(fmt::format("joint {}: length {:.9g} m, as assembled{}", joint.name, distance->length, stretch_of(joint) == 0 ? "" : ", less its stretch"));
  }
  if (auto belt = belt_of(displacement)) {
    belt->length += (*belt)(pose.z).gap - stretch_of(joint);
    displacement = function_of(*belt);
  }
  if (auto* mesh = std::get_if<Mesh>(&displacement)) mesh->phase -= (*mesh)(pose.z).gap;
  if (auto* rack = std::get_if<RackMesh>(&displacement)) {
    // The pinion's centre in the rack's axes: minus the rack's position in the pinion's, rotated.
    const double across = pose.z[0] * std::sin(pose.z[2]) - pose.z[1] * std::cos(pose.z[2]);
    rack->side = across >= 0 ? 1 : -1;
    rack->phase -= (*rack)(pose.z).gap;
  }
}

}  // namespace

System build_system(const Model& model, const System* like) { return Builder(model).build(like); }

bool is_open(const Model& model, const System& system, int j) {
  const JointData& data = system.joints[j];
  if (data.servo >= 0) return data.keeps_speed;
  return std::holds_alternative<Mesh>(data.displacement) || std::holds_alternative<RackMesh>(data.displacement) ||
         belt_of(data.displacement) || (std::holds_alternative<Distance>(data.displacement) && is_measured(model.joints[j]));
}

System unwind(System system, const Vecs& q) {
  std::vector<S::Motion> m;
  system.motions(q, Vecs(q.size(), S::Vec::Zero()), m);
  const double turn = 2 * std::numbers::pi;
  for (JointData& joint : system.joints) {
    auto* selection = std::get_if<Selection>(&joint.displacement);
    if (!selection || joint.servo >= 0 || !joint.held[2]) continue;
    selection->offset[2] = turn * std::round(system.pose(joint.at, m).z[2] / turn);
  }
  return system;
}

System fix_assembled_values(const Model& model, System system, const Vecs& q, std::vector<std::string>& notes) {
  system = unwind(std::move(system), q);
  std::vector<S::Motion> m;
  system.motions(q, Vecs(q.size(), S::Vec::Zero()), m);
  for (std::size_t j = 0; j < system.joints.size(); ++j) {
    JointData& data = system.joints[j];
    const RelativePose pose = system.pose(data.at, m);
    if (const Joint* joint = model_joint(model, j)) {
      settle_joint(*joint, pose, data.displacement, notes);
    } else if (data.keeps_speed) {
      data.start = pose.z[data.servo];
    }
  }
  const auto first_spring = static_cast<std::size_t>(std::count_if(model.motors.begin(), model.motors.end(), [](const Motor& motor) { return motor.kind == MotorKind::kEffort; }));
  for (std::size_t s = 0; s < model.springs.size(); ++s) {
    const Spring& spring = model.springs[s];
    if (spring.free_length) continue;
    LoadData& load = system.loads[first_spring + s];
    const RelativePose pose = system.pose(load.at, m);
    const double now = spring.torsion ? pose.z[2] : std::hypot(pose.z[0], pose.z[1]);
    const bool elastic = spring.stiffness > 0;
    load.free = elastic ? now - spring.preload.value_or(0) / spring.stiffness : now;
    load.constant = elastic ? 0 : spring.preload.value_or(0);
    if (!elastic) continue;
    notes.push_back(fmt::format("{} {}: free {} {:.9g} {}, from the assembled position", spring.torsion ? "torsion_spring" : "spring",
                                spring.name, spring.torsion ? "angle" : "length", load.free, spring.torsion ? "rad" : "m"));
  }
  return system;
}

System with_joints(const System& system, const std::vector<JointData>& joints) {
  System out = system;
  out.joints.insert(out.joints.end(), joints.begin(), joints.end());
  out.finish(&system);
  return out;
}

}  // namespace pintle
