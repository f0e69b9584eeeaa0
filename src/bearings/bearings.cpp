#include "pintle/bearings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "base/constants.h"
#include "bearings/worn_sector.h"
#include "laws/least_stated.h"

namespace pintle {
namespace {

constexpr double kNone = BearingSummary::kNone;
constexpr double kMillion = 1e6, kHour = 3600;  // [s]
constexpr double kTurnedBack = 1.001;           // ratio of path to swing: a pin that never reverses has 1
constexpr double kMostShareOfRating = 0.5;      // upper limit on P, as a fraction of C, for the formula of ISO 281 to hold

/// Results of a run's joints, by name: a large mechanism has very many.
class NamedParts {
 public:
  explicit NamedParts(const Trajectory& run) {
    for (const LoadSummary& load : run.joints) loads_.emplace(load.name, &load);
    for (const PinDuty& duty : run.duty) duties_.emplace(duty.joint, &duty);
  }

  /// Null if there is none.
  const LoadSummary* load(const std::string& joint) const { return find(loads_, joint); }
  const PinDuty* duty(const std::string& joint) const { return find(duties_, joint); }

 private:
  template <class T>
  static const T* find(const std::unordered_map<std::string, const T*>& map, const std::string& name) {
    const auto found = map.find(name);
    return found == map.end() ? nullptr : found->second;
  }

  std::unordered_map<std::string, const LoadSummary*> loads_;
  std::unordered_map<std::string, const PinDuty*> duties_;
};

void add_duty(const PinDuty& duty, double time, BearingSummary& out) {
  out.path = duty.path;
  out.swing = duty.swing;
  out.mean_speed = time > 0 ? out.path / time : 0;  // Eq. (1.4)
  out.peak_speed = duty.peak_rate;
  if (out.path > kTurnedBack * out.swing && out.swing < kTurn)
    out.remarks.push_back(fmt::format("it swings back and forth by {:.4g} deg: its path counts as turns", out.swing * 360 / kTurn));
}

// ISO 281. Equations (2.1) to (2.4).
void add_life(const Bearing& bearing, const PinDuty& duty, double relative_scatter, BearingSummary& out) {
  const double exponent = life_exponent(bearing);
  if (std::isnan(exponent)) return;
  if (!(out.path > 0)) {
    out.remarks.push_back("it does not turn: rolling life does not apply, the static safety does");
    return;
  }
  out.equivalent_load = std::pow((exponent == 3 ? duty.load_3 : duty.load_10_3) / out.path, 1 / exponent);
  out.equivalent_load_error = std::max(out.force_error, relative_scatter * out.equivalent_load);
  if (bearing.fatigue_load_limit) out.fatigue_ratio = *bearing.fatigue_load_limit / out.equivalent_load;
  if (!bearing.dynamic_load_rating || !(out.equivalent_load > 0)) return;
  const double rating = *bearing.dynamic_load_rating;
  out.life = std::pow(rating / out.equivalent_load, exponent);
  out.life_hours = out.life * kMillion * kTurn / (out.mean_speed * kHour);
  out.life_error = exponent * out.equivalent_load_error / out.equivalent_load;
  if (out.equivalent_load > kMostShareOfRating * rating)
    out.remarks.push_back(fmt::format("P is {:.3g} of C: ISO 281's life does not hold above {:g}", out.equivalent_load / rating, kMostShareOfRating));
}

// ISO 76. Equation (2.5).
void add_static_safety(const Bearing& bearing, BearingSummary& out) {
  if (!bearing.static_load_rating || !(out.peak_force > 0)) return;
  out.static_safety = *bearing.static_load_rating / out.peak_force;
  if (out.static_safety < 1) out.remarks.push_back("the peak force exceeds C0: the raceways keep dents");
}

// Equations (3.1) to (3.3).
void add_pressure(const Bearing& bearing, const PinDuty* duty, double time, BearingSummary& out) {
  if (!bearing.pin_diameter || !bearing.pin_length) return;
  const double radius = 0.5 * *bearing.pin_diameter, area = *bearing.pin_diameter * *bearing.pin_length;
  out.mean_pressure = out.mean_force / area;
  out.peak_pressure = out.peak_force / area;
  if (duty == nullptr) return;
  out.mean_sliding = radius * out.mean_speed;
  out.peak_sliding = radius * out.peak_speed;
  out.mean_pv = time > 0 ? radius / area * duty->load / time : 0;
  out.peak_pv = radius / area * duty->peak_power;
}

// The values of its table; sizes that this omits are taken from an oil film's law.
Bearing bearing_of(const Joint& joint) {
  Bearing out = joint.bearing.value_or(Bearing{});
  const auto size = [&joint](const char* key) {  // a linear film needs none
    const auto stated = least_stated(joint.law, key);
    return stated && *stated > 0 ? stated : std::nullopt;
  };
  const auto radius = size("journal_radius");
  if (radius && !out.pin_diameter) out.pin_diameter = 2 * *radius;
  if (!out.pin_length) out.pin_length = size("bearing_length");
  return out;
}

// The row in which an oil film is thinnest, and for how many rows it is thinner than its surfaces'
// roughness.
void add_film(const Joint& joint, const Trajectory& run, BearingSummary& out) {
  const auto roughness = least_stated(joint.law, "roughness");
  if (!roughness || run.n_rows() == 0) return;
  const std::string path = "joint." + joint.name + ".";
  const int thickness = run.column(path + "film_thickness"), eccentricity = run.column(path + "eccentricity");
  if (thickness < 0 || eccentricity < 0) return;
  std::size_t thinnest = 0, touching = 0;
  const auto film = [&](std::size_t row) { return run.at(row, static_cast<std::size_t>(thickness)); };
  for (std::size_t i = 0; i < run.n_rows(); ++i) {
    if (film(i) < film(thinnest)) thinnest = i;
    touching += film(i) < *roughness ? 1 : 0;
  }
  const double t = run.at(thinnest, 0), least = film(thinnest);
  if (touching == 0)
    out.remarks.push_back(fmt::format("its oil film is thinnest at t = {:.5g} s: {:.3g} um, at an eccentricity of {:.3g}", t, 1e6 * least, run.at(thinnest, static_cast<std::size_t>(eccentricity))));
  else
    out.remarks.push_back(fmt::format("its oil film is too thin: rough surfaces touch in {:.3g} % of the rows, most at t = {:.5g} s, where smooth ones would {} {:.3g} um (roughness {:.3g} um)",
                                      100 * static_cast<double>(touching) / static_cast<double>(run.n_rows()), t, least < 0 ? "press into each other by" : "leave", 1e6 * std::abs(least), 1e6 * *roughness));
}

// Equation (5.2).
void add_wear(const Bearing& bearing, const Trajectory& run, BearingSummary& out) {
  if (!bearing.wear_coefficient || !bearing.pin_diameter || !bearing.pin_length) return;
  const auto wear = std::find_if(run.wear.begin(), run.wear.end(), [&out](const JointWear& one) { return one.joint == out.joint; });
  if (wear == run.wear.end()) {
    const bool loose = run.column("joint." + out.joint + ".wear_power") >= 0;
    out.remarks.push_back(loose ? "this run has no record of where it wears: run it again" : "wear is recorded only for a pin with clearance: law = \"clearance\"");
    return;
  }
  const WornSector most = most_worn(wear->bush);
  if (!(most.work > 0)) return;
  out.bush_depth = *bearing.wear_coefficient * most.work / (0.5 * *bearing.pin_diameter * most.width() * *bearing.pin_length);
  out.bush_depth_angle = most.angle();
}

std::vector<std::string> missing_sizes(const Bearing& bearing) {
  const bool rolling = !bearing.type.empty() || bearing.dynamic_load_rating || bearing.static_load_rating || bearing.fatigue_load_limit;
  const bool plain = bearing.pin_diameter || bearing.pin_length || bearing.wear_coefficient;
  std::vector<std::string> wants;
  if (!rolling && !plain) return {"state type and dynamic_load_rating (C) for a life, or pin_diameter and pin_length for a pressure"};
  if (rolling && bearing.type.empty()) wants.push_back("state type (ball or roller) for an equivalent load and a life");
  if (rolling && !bearing.dynamic_load_rating) wants.push_back("state dynamic_load_rating (C) for a life");
  if (rolling && !bearing.static_load_rating) wants.push_back("state static_load_rating (C0) for a static safety");
  if (plain && !bearing.pin_diameter) wants.push_back("state pin_diameter for a pressure");
  if (plain && !bearing.pin_length) wants.push_back("state pin_length for a pressure");
  return wants;
}

// How far the forces of a chaotic motion may differ after its horizon, relative to their values.
double relative_scatter(const LoadSummary& load) {
  const auto relative = [](double scatter, double of) { return of > 0 ? scatter / of : 0; };
  return std::max(relative(load.rms_scatter, load.rms_after), relative(load.mean_scatter, load.mean_after));
}

BearingSummary summary_of(const Joint& joint, const LoadSummary& load, const Trajectory& run, const NamedParts& parts) {
  const Bearing bearing = bearing_of(joint);
  BearingSummary out;
  out.joint = load.name;
  out.mean_force = load.mean;
  out.peak_force = load.peak;
  out.force_error = load.error_estimate;
  const bool chaotic = run.outcome == Outcome::kHorizon && load.horizon < run.t_end;
  if (chaotic)
    out.remarks.push_back(fmt::format("the motion is chaotic: forces are promised up to t = {:.5g} s, and the errors of P and of the life are the difference between two motions that agree up to then", load.horizon));
  const PinDuty* duty = parts.duty(load.name);
  if (duty != nullptr) {
    add_duty(*duty, run.t_end, out);
    add_life(bearing, *duty, chaotic ? relative_scatter(load) : 0, out);
  } else {
    out.path = out.swing = out.mean_speed = out.peak_speed = kNone;
    out.remarks.push_back("this run has no record of its rotation under load: run it again");
  }
  add_static_safety(bearing, out);
  add_pressure(bearing, duty, run.t_end, out);
  add_film(joint, run, out);
  add_wear(bearing, run, out);
  out.wants = missing_sizes(bearing);
  return out;
}

}  // namespace

double life_exponent(const Bearing& bearing) { return bearing.type == "ball" ? 3 : bearing.type == "roller" ? 10.0 / 3 : kNone; }

std::vector<BearingSummary> bearing_summaries(const Model& model, const Trajectory& run, BearingsOf which) {
  const auto wanted = [which](const Joint& joint) { return joint.bearing || least_stated(joint.law, "journal_radius") || (which == BearingsOf::kEveryPin && joint.type == "revolute"); };
  std::vector<BearingSummary> out;
  if (std::none_of(model.joints.begin(), model.joints.end(), wanted)) return out;
  const NamedParts parts(run);
  for (const Joint& joint : model.joints) {
    const LoadSummary* load = wanted(joint) ? parts.load(joint.name) : nullptr;
    if (load != nullptr) out.push_back(summary_of(joint, *load, run, parts));
  }
  return out;
}

}  // namespace pintle
