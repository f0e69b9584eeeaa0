#include "integrators/bend_watch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <variant>

#include "base/constants.h"
#include "joints/cam_profile.h"
#include "joints/edge_profile.h"
#include "laws/law.h"

namespace pintle {
namespace {

constexpr int kParts = 2000;    // of the run, at whose ends loads and motors are looked at: as dear as a few steps
constexpr int kFewParts = 8;  // of a step, at least: more than it has stages
constexpr int kIntervals = 6;  // between the samples of a step's forces, five and its ends

// What the polynomial through the values of f at the samples in [0, 1], the extrema of a Chebyshev polynomial, misses between them: the largest `size` of it.
template <class F, class Size>
double missed_between(const F& f, const Size& size) {
  using Value = decltype(f(0.0));
  const auto at = [](double k) { return 0.5 * (1 - std::cos(k * kTurn / (2 * kIntervals))); };
  std::array<Value, kIntervals + 1> value;
  for (int k = 0; k <= kIntervals; ++k) value[k] = f(at(k));
  double largest = 0;
  for (int interval = 0; interval < kIntervals; ++interval) {
    const double between = at(interval + 0.5);
    std::array<double, kIntervals + 1> weight;  // barycentric
    double weights = 0;
    for (int k = 0; k <= kIntervals; ++k) weights += weight[k] = (k % 2 == 0 ? 1 : -1) * (k % kIntervals == 0 ? 0.5 : 1) / (between - at(k));
    Value error = f(between);
    for (int k = 0; k <= kIntervals; ++k) error -= (weight[k] / weights) * value[k];
    const double missed = size(error);
    if (!(missed <= largest)) largest = std::isfinite(missed) ? missed : std::numeric_limits<double>::infinity();
  }
  return largest;
}

}  // namespace

template <class S>
BasicBendWatch<S>::BasicBendWatch(const BasicSystem<S>& system) : system_(system), samples_(kParts) {
  const auto add = [this](int joint, int component, const Bends& bends) {
    if (!bends.empty()) ways_.push_back({joint, component, bends});
  };
  for (std::size_t l = 0; l < system.loads.size(); ++l) {
    const std::vector<BasicSignal<S>>& signals = system.loads[l].signals;
    if (!signals.empty() && !system.loads[l].law.is_constant()) timed_.push_back(static_cast<int>(l));
    if (std::any_of(signals.begin(), signals.end(), [](const auto& signal) { return !signal.is_time; })) placed_.push_back(static_cast<int>(l));
  }
  for (int j = 0; j < system.n_joints(); ++j) {
    const BasicJointData<S>& joint = system.joints[j];
    if (joint.ideal) continue;
    if (joint.law.has_friction() && joint.law.n_states() == 0) rubbing_.push_back(j);
    for (const auto& part : joint.law.parts()) {
      const auto [component, bends] = part->bends();
      add(j, component, bends);
    }
    std::visit([&](const auto& displacement) {
      if constexpr (requires { displacement.profile->bends(); }) add(j, -1, displacement.profile->bends());
    }, joint.displacement);
  }
}

template <class S>
double BasicBendWatch<S>::place(const Way& way, const std::vector<typename S::Motion>& m) const {
  const BasicJointData<S>& joint = system_.joints[way.joint];
  const typename S::RelativePose pose = system_.pose(joint.at, m);
  if (way.component >= 0) return read(joint.displacement, pose).gap[way.component];
  if constexpr (!S::kCurved)  // seen from the cam's axis: the nearest point of a cam may jump while its follower hardly moves
    if (const auto* cam = std::get_if<CamGap>(&joint.displacement)) return cam->profile->flat() ? pose.z[2] + kTurn / 4 : std::atan2(pose.z[1], pose.z[0]);
  return pose.z[0];
}

// The place on a cam is known up to whole turns, and turns with the follower.
template <class S>
double BasicBendWatch<S>::end_of(const Way& way, double from, const std::vector<typename S::Motion>& start, const std::vector<typename S::Motion>& end) const {
  const double to = place(way, end);
  if (way.component >= 0 || way.bends.period == 0) return to;
  const BasicPlacement<S>& at = system_.joints[way.joint].at;
  const double turned = system_.pose(at, end).z[2] - system_.pose(at, start).z[2];
  return from + turned + std::remainder(to - from - turned, way.bends.period);
}

template <class S>
void BasicBendWatch<S>::find_bends_in_time(double from, double to) {
  if (!(to > from)) return;
  apart_ = (to - from) / kParts;
  const auto add = [&](const Expression& f) {
    if (f.is_constant() || f.variables().size() != 1) return;
    Bends bends;
    samples_.take([&f](double t) { return f.value(std::array{t}); }, from, to, kParts);
    samples_.visit_bends_in_parts([&](double part) { bends.places.push_back(from + part * apart_); });
    if (!bends.empty()) in_time_.push_back(std::move(bends));
  };
  for (const auto& force : system_.applied)
    for (const Expression* f : force.functions()) add(*f);
  for (const BasicLoadData<S>& load : system_.loads)
    if (load.signals.size() == 1 && load.signals.front().is_time) add(load.law);
  for (const BasicJointData<S>& joint : system_.joints)
    if (joint.driven >= 0) add(joint.target);
}

// A step ends where its motors jump, or slides along it.
template <class S>
bool jumps(const BasicLoadData<S>& load, const std::array<double, kMaxSignals>& from, const std::array<double, kMaxSignals>& to) {
  return load.law.jump_between({from.data(), load.signals.size()}, {to.data(), load.signals.size()}).has_value();
}

// What it reads changes so little that rounding is a good part of how its effort bends.
template <class S>
bool stays(const BasicLoadData<S>& load, const std::array<double, kMaxSignals>& from, const std::array<double, kMaxSignals>& to) {
  constexpr double kLittle = 1e-9;  // of what it reads
  for (std::size_t s = 0; s < load.signals.size(); ++s)
    if (!load.signals[s].is_time && std::abs(to[s] - from[s]) > kLittle * std::max(std::abs(from[s]), std::abs(to[s]))) return false;
  return true;
}

// Over the straight way from what it reads at the start to that at the end.
template <class S>
double BasicBendWatch<S>::share_of_effort(const BasicLoadData<S>& load, double t, double h, const std::vector<typename S::Motion>& start, const std::vector<typename S::Motion>& end) {
  if (!(h > apart_)) return 1;
  const double parts = std::max<double>(h / apart_, kFewParts);
  const std::array<double, kMaxSignals> from = system_.signal_values(load, t, start), to = system_.signal_values(load, t + h, end);
  if (stays(load, from, to) || jumps(load, from, to)) return 1;
  const int n = static_cast<int>(std::min<double>(parts, kParts));
  samples_.take([&](double x) { return effort_on_way(load, from, to, x); }, 0, 1, n);
  int passed = 0;
  double second = 1, third = 1;
  samples_.visit_bends_in_parts([&](double part) {
    if (++passed == 2) second = part / n;
    if (passed == 3) third = part / n;
  });
  return Bends::share_of_way(second, third);
}

template <class S>
double BasicBendWatch<S>::share_of_step(double t, double h, double t_end, const std::vector<typename S::Motion>& start, const std::vector<typename S::Motion>& end) {
  if (apart_ == 0) find_bends_in_time(t, t_end);
  double share = 1;
  for (const Bends& bends : in_time_) share = std::min(share, bends.share_to_second(t, t + h));
  for (const int l : placed_) share = std::min(share, share_of_effort(system_.loads[l], t, h, start, end));
  for (const Way& way : ways_) {
    const double from = place(way, start);
    share = std::min(share, way.bends.share_to_second(from, end_of(way, from, start, end)));
  }
  return share;
}

template <class S>
double BasicBendWatch<S>::effort_on_way(const BasicLoadData<S>& load, const std::array<double, kMaxSignals>& from, const std::array<double, kMaxSignals>& to, double x) const {
  std::array<double, kMaxSignals> at{};
  for (std::size_t s = 0; s < load.signals.size(); ++s) at[s] = from[s] + x * (to[s] - from[s]);
  return load.law.value({at.data(), load.signals.size()});
}

// Where surfaces turn round, within a small part of the way between their speeds at the start and at the end.
template <class S>
double BasicBendWatch<S>::missed_friction(int j, double t, const std::vector<typename S::Motion>& start, const std::vector<typename S::Motion>& end, const BasicLoadScale<S>& scale) const {
  const BasicJointData<S>& joint = system_.joints[j];
  const BasicJointKinematics<S> from = system_.kinematics(j, t, start), to = system_.kinematics(j, t, end);
  bool turns = false;
  for (int c = 0; c < S::kDof; ++c) turns = turns || (!joint.held[c] && from.rate[c] * to.rate[c] < 0);
  if (!turns) return 0;
  const typename S::Vec load = load_across(joint.at, scale);
  const auto force = [&](double x) {
    const typename S::Vec rate = from.rate + x * (to.rate - from.rate);
    return typename S::Vec(joint.law.force({t, to.gap, rate, nullptr}));
  };
  return missed_between(force, [&load](const typename S::Vec& x) { return x.cwiseAbs().cwiseQuotient(load).maxCoeff(); });
}

template <class S>
double BasicBendWatch<S>::missed_between_samples(double t, double h, const std::vector<typename S::Motion>& start, const std::vector<typename S::Motion>& end,
                                                 const BasicLoadScale<S>& scale) const {
  double largest = 0;
  for (const auto& force : system_.applied)
    for (int c = 0; const Expression* f : force.functions()) {
      const double load = scale.body[force.body][c++];
      if (!f->is_constant() && f->variables().size() == 1) largest = std::max(largest, missed_between([&](double x) { return f->value(std::array{t + x * h}); }, [load](double x) { return std::abs(x) / load; }));
    }
  for (const int l : timed_) {
    const BasicLoadData<S>& load = system_.loads[l];
    const std::array<double, kMaxSignals> from = system_.signal_values(load, t, start), to = system_.signal_values(load, t + h, end);
    const double at_most = load_across(load.at, scale)[load.component];
    if (!jumps(load, from, to)) largest = std::max(largest, missed_between([&](double x) { return effort_on_way(load, from, to, x); }, [at_most](double x) { return std::abs(x) / at_most; }));
  }
  for (const int j : rubbing_) largest = std::max(largest, missed_friction(j, t + h, start, end, scale));
  return largest;
}

template class BasicBendWatch<Planar>;
PINTLE_IN_SPACE(template class BasicBendWatch<Spatial>;)

}  // namespace pintle
