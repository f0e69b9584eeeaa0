// The model with every expression evaluated, for drawing it.
#include "studio/kernel/exchange.h"

namespace pintle::studio {
namespace {

template <class List, class Make>
Json array(const List& list, Make&& make) {
  Json out = Json::array();
  for (const auto& entry : list) out.push_back(make(entry));
  return out;
}

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json marker(const Marker& m) { return {{"name", m.name}, {"position", m.position}, {"axis", m.axis}}; }

Json ref(const MarkerRef& m) { return {{"body", m.body}, {"marker", m.marker}}; }

Json body(const Body& b) {
  return {{"name", b.name},
          {"mass", b.mass},
          {"inertia", b.inertia},
          {"position", or_null(b.position)},
          {"angle", or_null(b.angle)},
          {"markers", array(b.markers, marker)}};
}

Json joint(const Joint& j) {
  return {{"name", j.name},
          {"type", j.type},
          {"first", ref(j.first)},
          {"second", ref(j.second)},
          {"geometry", Json(j.geometry)},
          {"law", {{"word", j.law.word}, {"values", Json(j.law.values)}}},
          {"friction", {{"word", j.friction.word}, {"values", Json(j.friction.values)}}},
          {"stops", {{"word", j.stops.word}, {"values", Json(j.stops.values)}}},
          {"detent", {{"word", j.detent.word}, {"values", Json(j.detent.values)}}},
          {"ideal", j.ideal}};
}

Json spring(const Spring& s) {
  return {{"name", s.name},
          {"torsion", s.torsion},
          {"first", ref(s.first)},
          {"second", ref(s.second)},
          {"stiffness", s.stiffness},
          {"damping", s.damping},
          {"free_length", or_null(s.free_length)},
          {"preload", or_null(s.preload)}};
}

Json force(const AppliedForce& f) {
  return {{"name", f.name},
          {"on", ref(f.on)},
          {"force", Json::array({f.force[0].text(), f.force[1].text()})},
          {"torque", f.torque.text()},
          {"body_axes", f.body_axes}};
}

const char* word(MotorKind kind) {
  return kind == MotorKind::kEffort ? "effort" : kind == MotorKind::kSpeed ? "speed" : "position";
}

Json motor(const Motor& m) {
  return {{"name", m.name},           {"joint", m.joint},     {"kind", word(m.kind)},
          {"law", m.law.text()},      {"stiffness", m.stiffness}, {"damping", m.damping}};
}

const char* word(Start start) { return start == Start::kRaw ? "raw" : start == Start::kUnloaded ? "unloaded" : start == Start::kSettled ? "settled" : "assembled"; }

}  // namespace

Json resolved(const Model& model) {
  const SimulateSettings& run = model.simulate;
  return {{"name", model.name},
          {"description", model.description},
          {"gravity", model.gravity},
          {"duration", run.duration},
          {"output_step", run.output_step},
          {"tolerance", run.tolerance},
          {"method", run.method},
          {"equations", to_word(run.equations)},
          {"start", word(run.start)},
          {"ground", array(model.ground, marker)},
          {"bodies", array(model.bodies, body)},
          {"joints", array(model.joints, joint)},
          {"springs", array(model.springs, spring)},
          {"forces", array(model.forces, force)},
          {"motors", array(model.motors, motor)}};
}

}  // namespace pintle::studio
