#include "integrators/radau/step_control.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "joints/edge_profile.h"

namespace pintle {
namespace {

// The motor, applied force or driven coordinate whose value is not finite in this state or, if it depends on time alone, just after; empty: all are finite.
template <class S>
std::string broken_function(const BasicSystem<S>& system, const BasicState<S>& state) {
  constexpr double kJustAfter = 1e-9;  // fraction of the time: a function must be finite this long after an instant, too
  const double t = state.t;
  std::vector<typename S::Motion> m;
  system.motions(state.q, state.v, m);
  for (const BasicLoadData<S>& load : system.loads)
    if (load.kind == LoadKind::kEffort && !std::isfinite(system.load_effort(load, t, m))) return (load.applied ? "force " : "motor ") + load.name;
  for (const double at : {t, t + kJustAfter * std::max(std::abs(t), 1e-3)}) {
    const std::array<double, 1> time{at};
    for (const BasicAppliedData<S>& force : system.applied)
      for (const Expression* e : force.functions())
        if (!std::isfinite(e->value(std::span(time).first(e->variables().size())))) return "force " + force.name;
    for (const BasicJointData<S>& joint : system.joints)
      if (joint.driven >= 0)
        for (const double x : target_of(joint, at))
          if (!std::isfinite(x)) return (joint.servo >= 0 ? "motor " : "the length of joint ") + joint.name;
  }
  return {};
}

// Message that the joint's edge is undefined beyond its stretch, where what runs on it may be; empty: it is not.
template <class S>
std::string undefined_edge(const BasicJointData<S>& joint) {
  const std::optional<double> x = joint.edge ? joint.edge->undefined_at() : std::nullopt;
  if (!x) return {};
  return fmt::format(", whose edge has no finite height at x = {:.4g} m: if the contact has come there, try if(..., ..., ...) to continue the height beyond its range", *x);
}

}  // namespace

template <class S>
std::string StepControl::last_event(const BasicSystem<S>& system, double since) const {
  if (event_.function < 0 || event_.t < since) return {};
  return fmt::format("{} turns {} at t = {:.9g} s", system.name(system.switching_functions()[static_cast<std::size_t>(event_.function)]), event_.rising ? "positive" : "negative",
                     event_.t);
}

template <class S>
std::string no_step_message(const BasicSystem<S>& system, const BasicState<S>& start, double h, std::vector<std::pair<double, int>> residuals, const std::string& event) {
  const double t = start.t;
  if (const std::string broken = broken_function(system, start); !broken.empty()) return fmt::format("at t = {:.9g} s: {} is not finite there; try if(..., ..., 0) where its expression is not defined", t, broken);
  constexpr std::size_t kNamed = 3;  // joints with the largest residuals
  constexpr double kSensible = 1e12;  // [m/s^2]: Newton's iteration has diverged where a residual is larger, or not a number
  const auto rank = [](double x) { return std::isfinite(x) ? x : std::numeric_limits<double>::infinity(); };
  std::stable_sort(residuals.begin(), residuals.end(), [&](const auto& a, const auto& b) { return rank(a.first) > rank(b.first); });
  std::string text = fmt::format("the step size became too small at t = {:.9g} s, step {:.3g} s", t, h);
  if (!event.empty()) text += "; " + event;
  if (event.starts_with("kink or jump")) text += "; if a force jumps there and drives its bodies back and forth across the jump, try one that is 0 there (a damper on the relative speed, or a ramp by smoothstep)";
  for (std::size_t i = 0; i < std::min(kNamed, residuals.size()); ++i) {
    const BasicJointData<S>& joint = system.joints[residuals[i].second];
    const double residual = residuals[i].first;
    text += fmt::format("; joint {} ({}){}", joint.name, residual < kSensible ? fmt::format("residual {:.3g} m/s^2", residual) : "no solution found", undefined_edge(joint));
  }
  return text;
}

template std::string no_step_message(const BasicSystem<Planar>& system, const State& start, double h, std::vector<std::pair<double, int>> residuals, const std::string& event);
PINTLE_IN_SPACE(template std::string no_step_message(const BasicSystem<Spatial>& system, const BasicState<Spatial>& start, double h, std::vector<std::pair<double, int>> residuals, const std::string& event);)
template std::string StepControl::last_event(const BasicSystem<Planar>& system, double since) const;
PINTLE_IN_SPACE(template std::string StepControl::last_event(const BasicSystem<Spatial>& system, double since) const;)

}  // namespace pintle
