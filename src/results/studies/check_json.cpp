// The report of a check as JSON.
#include <nlohmann/json.hpp>

#include "results/studies/check_report.h"

namespace pintle {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kCheckFormat = 1;

template <class List, class Make>
Json array(const List& list, Make&& make) {
  Json out = Json::array();
  for (const auto& entry : list) out.push_back(make(entry));
  return out;
}

Json unknown_if_negative(int n) {
  return n < 0 ? Json(nullptr) : Json(n);
}

Json mobility(const CheckMobility& m) {
  return {{"freedoms", m.freedoms},
          {"constraints", m.constraints},
          {"gruebler", m.gruebler},
          {"rank", unknown_if_negative(m.rank)},
          {"rank_nearby", unknown_if_negative(m.rank_nearby)},
          {"mobility", m.rank < 0 ? Json(nullptr) : Json(m.mobility)},
          {"redundant", m.rank < 0 ? Json(nullptr) : Json(m.redundant)},
          {"servos", m.servos},
          {"mobility_driven", m.rank < 0 ? Json(nullptr) : Json(m.mobility_driven)},
          {"singular_position", m.singular_position()},
          {"length", m.length},
          {"rank_tolerance", m.rank_tolerance},
          {"smallest_kept", m.smallest_kept},
          {"largest_dropped", m.largest_dropped},
          {"method", m.method},
          {"remark", m.remark}};
}

Json redundancy(const CheckRedundancy& group) {
  return {{"degree", group.degree}, {"members", array(group.members, [](const auto& m) {
                                       return Json{{"joint", m.joint}, {"component", m.component}, {"share", m.share}};
                                     })}};
}

Json gear(const CheckGear& g) {
  return {{"joint", g.joint}, {"type", g.type}, {"first_body", g.first_body}, {"second_body", g.second_body},
          {"ratio", g.ratio}, {"unit", g.unit}};
}

Json transmission(const CheckTransmission& t) {
  return {{"joint", t.joint}, {"coordinate", t.coordinate}, {"ratio", t.ratio}, {"unit", t.unit}};
}

Json component(const CheckComponent& c) {
  return {{"joint", c.joint},         {"type", c.type},
          {"component", c.component}, {"stiffness", c.stiffness},
          {"damping", c.damping},     {"effective_mass", c.effective_mass},
          {"frequency", c.frequency}, {"damping_ratio", c.damping_ratio}};
}

Json mode(const CheckMode& m) {
  return {{"frequency", m.frequency},
          {"damping_ratio", m.damping_ratio},
          {"joint", m.joint},
          {"component", m.component},
          {"share", m.share}};
}

Json battery(const CheckBattery& b) {
  return {{"passed", b.passed()}, {"items", array(b.items, [](const CheckItem& item) {
                                     return Json{{"what", item.what},        {"passed", item.passed()},
                                                 {"worst", item.worst},      {"tolerance", item.tolerance},
                                                 {"place", item.place},      {"comparisons", item.comparisons},
                                                 {"at_kinks", item.at_kinks}};
                                   })}};
}

Json topology(const CheckTopology& t) {
  return {{"n_loops", t.n_loops},
          {"loops", array(t.loops, [](const CheckLoop& loop) { return Json(loop.joints); })},
          {"floating", t.floating}};
}

Json frequencies(const CheckFrequencies& f) {
  return {{"components", array(f.components, component)},
          {"modes", array(f.modes, mode)},
          {"complete", f.complete},
          {"explicit_step", f.explicit_step},
          {"remark", f.remark}};
}

Json small_motion(const CheckSmallMotion& m) {
  return {{"real", m.real}, {"imaginary", m.imaginary}, {"frequency", m.frequency}, {"damping_ratio", m.damping_ratio},
          {"body", m.body}, {"direction", m.direction}, {"share", m.share}};
}

Json small_motions(const CheckSmallMotions& s) {
  return {{"known", s.known}, {"modes", array(s.modes, small_motion)}, {"resolved", s.resolved}, {"free", s.n_free}, {"remark", s.remark}};
}

}  // namespace

std::string check_json(const CheckReport& report, const std::string& model_name, const std::string& model_path) {
  Json json = {
      {"pintle_check", kCheckFormat}, {"model", model_name}, {"model_path", model_path}, {"passed", report.passed()}};
  json["bodies"] = report.n_bodies;
  json["joints"] = report.n_joints;
  json["springs"] = report.n_springs;
  json["forces"] = report.n_forces;
  json["motors"] = report.n_motors;
  json["total_mass"] = report.total_mass;
  json["mass_centre"] = report.mass_centre;
  json["topology"] = topology(report.topology);
  json["mobility"] = mobility(report.mobility);
  json["redundancies"] = array(report.redundancies, redundancy);
  json["gears"] = array(report.gears, gear);
  json["transmission"] = {{"of", report.transmission_of}, {"ratios", array(report.transmission, transmission)}};
  json["frequencies"] = frequencies(report.frequencies);
  json["small_motions"] = small_motions(report.small_motions);
  json["jacobian_battery"] = battery(report.jacobians);
  json["energy_battery"] = battery(report.energy);
  json["notes"] = report.notes;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace pintle
