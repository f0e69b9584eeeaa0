#include "integrators/bend_watch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <variant>

#include "base/constants.h"
#include "base/cubic_hermite.h"
#include "base/expression/switching_points.h"
#include "integrators/thresholds.h"
#include "joints/cam_profile.h"
#include "joints/edge_profile.h"
#include "laws/law.h"
#include "linalg/chebyshev_nodes.h"

namespace pintle {
namespace {

constexpr int kParts = 2000;  // parts of the run, at whose ends loads and motors are evaluated: costs as much as a few steps
constexpr int kFewParts = 8;  // parts of a step, at least: more than it has stages

// The points half-way, in angle, between the samples of a step's forces (ForceSamples), and the samples' weights there.
struct BetweenSamples {
  static constexpr int kN = ChebyshevNodes::kN - 1;  // one between every two
  ChebyshevNodes nodes;
  std::array<double, kN> x;
  std::array<Eigen::Matrix<double, ChebyshevNodes::kN, 1>, kN> weight;

  BetweenSamples() {
    for (int i = 0; i < kN; ++i) {
      x[i] = 0.5 * (1 - std::cos(0.5 * kTurn * (i + 0.5) / kN));
      weight[i] = nodes.weights(x[i]);
    }
  }
};

// The largest `size` of the error between the samples of the polynomial through the values of f at the samples.
template <class F, class Size>
double missed_between(const F& f, const Size& size) {
  static const BetweenSamples between;
  std::array<decltype(f(0.0)), ChebyshevNodes::kN> value;
  for (int k = 0; k < ChebyshevNodes::kN; ++k) value[k] = f(between.nodes.x[k]);
  double largest = 0;
  for (int i = 0; i < BetweenSamples::kN; ++i) {
    auto error = f(between.x[i]);
    for (int k = 0; k < ChebyshevNodes::kN; ++k) error -= between.weight[i][k] * value[k];
    const double missed = size(error);
    if (!(missed <= largest)) largest = std::isfinite(missed) ? missed : std::numeric_limits<double>::infinity();
  }
  return largest;
}

// Interpolated from the coordinates and speeds at both ends of a step of h.
Planar::Motion between(const Planar::Motion& start, const Planar::Motion& end, double h, double x) {
  const auto coordinates = [](const Planar::Motion& m) { return Planar::Vec(m.p.x(), m.p.y(), m.angle); };
  const auto speeds = [](const Planar::Motion& m) { return Planar::Vec(m.v.x(), m.v.y(), m.w); };
  const Planar::Vec q0 = coordinates(start), v0 = speeds(start), q1 = coordinates(end), v1 = speeds(end);
  return Planar::Motion::of(cubic_hermite(x, h, q0, v0, q1, v1), cubic_hermite_slope(x, h, q0, v0, q1, v1));
}

// The functions of loads, motors and driven lengths that vary with time alone.
template <class S>
std::vector<const Expression*> functions_of_time(const BasicSystem<S>& system) {
  std::vector<const Expression*> all;
  for (const auto& force : system.applied)
    for (const Expression* f : force.functions()) all.push_back(f);
  for (const BasicLoadData<S>& load : system.loads)
    if (load.signals.size() == 1 && load.signals.front().is_time) all.push_back(&load.law);
  for (const BasicJointData<S>& joint : system.joints)
    if (joint.driven >= 0) all.push_back(&joint.target);
  std::erase_if(all, [](const Expression* f) { return f->is_constant(); });
  return all;
}

// The share of a step up to a point between its first two kinks, so that it passes only the first; 1: there is none.
double share_to_one_kink(const std::vector<double>& kinks, double t, double h) {
  const double rounding = kLastBits * std::abs(t + h);
  const auto first = std::upper_bound(kinks.begin(), kinks.end(), t + rounding);
  if (kinks.end() - first < 2 || !(first[1] < t + h - rounding)) return 1;
  return (0.5 * (first[0] + first[1]) - t) / h;
}

}  // namespace

template <class S>
std::vector<Bends> bends_in_time(const BasicSystem<S>& system, double from, double to) {
  std::vector<Bends> all;
  SampledGraph samples(kParts);
  for (const Expression* f : functions_of_time(system)) {
    Bends bends;
    samples.take([f](double t) { return f->value(std::array{t}); }, from, to, kParts);
    samples.for_each_bend([&](double part) { bends.places.push_back(from + part * (to - from) / kParts); });
    if (!bends.empty()) all.push_back(std::move(bends));
  }
  return all;
}

template <class S>
std::vector<double> kinks_in_time(const BasicSystem<S>& system, double from, double to) {
  constexpr std::size_t kMost = 1000000;  // of one table, at most: more, as of a motor's turns in a long run, would fill the memory
  std::vector<double> all;
  for (const Expression* f : functions_of_time(system)) {
    const std::vector<double> places = switching_points(*f, from, to, kParts, kMost);
    all.insert(all.end(), places.begin(), places.end());
  }
  std::sort(all.begin(), all.end());
  const double rounding = kLastBits * std::max(std::abs(from), std::abs(to));
  all.erase(std::unique(all.begin(), all.end(), [rounding](double a, double b) { return b - a <= rounding; }), all.end());
  return all;
}

template <class S>
BasicBendWatch<S>::BasicBendWatch(const BasicSystem<S>& system) : system_(system), on_way_(system.bodies.size()), samples_(kParts) {
  const auto add = [this](int joint, int component, const Bends& bends) {
    if (!bends.empty()) ways_.push_back({joint, component, bends});
  };
  for (const auto& force : system.applied)
    for (int c = 0; const Expression* f : force.functions()) {
      if (!f->is_constant()) applied_.push_back({f, force.body, c});
      ++c;
    }
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

// The position on a cam is known up to whole turns, and turns with the follower.
template <class S>
double BasicBendWatch<S>::place_at_end(const Way& way, double from, const std::vector<typename S::Motion>& start, const std::vector<typename S::Motion>& end) const {
  const double to = place(way, end);
  if (way.component >= 0 || way.bends.period == 0) return to;
  const BasicPlacement<S>& at = system_.joints[way.joint].at;
  const double turned = system_.pose(at, end).z[2] - system_.pose(at, start).z[2];
  return from + turned + std::remainder(to - from - turned, way.bends.period);
}

template <class S>
typename BasicBendWatch<S>::ReadInStep BasicBendWatch<S>::read_in_step(const BasicLoadData<S>& load, double t, double h, const std::vector<typename S::Motion>& start,
                                                                       const std::vector<typename S::Motion>& end) const {
  ReadInStep read{load, t, h, start, end, system_.signal_values(load, t, start), system_.signal_values(load, t + h, end), 0};
  if constexpr (!S::kCurved)
    for (const BasicSignal<S>& signal : load.signals) {
      if (signal.is_time || signal.component >= S::kDim) continue;  // angles follow straight ways
      for (const int b : {signal.at.a, signal.at.b})
        if (b != kGround) read.turn = std::max(read.turn, std::abs(end[b].angle - start[b].angle));
    }
  return read;
}

template <class S>
bool BasicBendWatch<S>::ReadInStep::is_straight() const {
  constexpr double kFarTurn = 0.3;  // [rad]: rotation up to which ways are straight. With 3 a rotor that turns in a field ends with exit code 7; 0.15 and 0.6 are as good
  return turn <= kFarTurn;
}

// A step ends where its motors jump, or slides along the jump.
template <class S>
bool BasicBendWatch<S>::ReadInStep::jumps() const {
  return load.law.jump_between({from.data(), load.signals.size()}, {to.data(), load.signals.size()}).has_value();
}

// Whether its readings change so little that the curvature of its effort is largely rounding.
template <class S>
bool BasicBendWatch<S>::ReadInStep::stays() const {
  constexpr double kLittle = 1e-9;  // fraction of its readings. With 0 a block that sticks takes 9 times the steps
  if (!is_straight()) return false;
  for (std::size_t s = 0; s < load.signals.size(); ++s)
    if (!load.signals[s].is_time && std::abs(to[s] - from[s]) > kLittle * std::max(std::abs(from[s]), std::abs(to[s]))) return false;
  return true;
}

template <class S>
double BasicBendWatch<S>::effort_at(const ReadInStep& read, double x) {
  const std::vector<BasicSignal<S>>& signals = read.load.signals;
  std::array<double, kMaxSignals> at = read.from;
  if constexpr (!S::kCurved)
    if (!read.is_straight()) {
      for (const BasicSignal<S>& signal : signals)
        for (const int b : {signal.at.a, signal.at.b})
          if (!signal.is_time && b != kGround) on_way_[b] = between(read.start[b], read.end[b], read.h, x);
      at = system_.signal_values(read.load, read.t + x * read.h, on_way_);
      return read.load.law.value({at.data(), signals.size()});
    }
  for (std::size_t s = 0; s < signals.size(); ++s) at[s] += x * (read.to[s] - read.from[s]);
  return read.load.law.value({at.data(), signals.size()});
}

template <class S>
double BasicBendWatch<S>::share_of_effort(const BasicLoadData<S>& load, double t, double h, const std::vector<typename S::Motion>& start, const std::vector<typename S::Motion>& end) {
  constexpr double kPerTurn = 720;  // parts of a turn, at which loads that read positions are evaluated. With 8 three of 18 rotors in narrow fields end with exit code 7; 360 and 1440 are as good
  if (!(h > apart_)) return 1;
  const ReadInStep read = read_in_step(load, t, h, start, end);
  if (read.stays() || read.jumps()) return 1;
  const double of_turn = read.is_straight() ? 0 : kPerTurn * read.turn / kTurn;
  if (of_turn > kParts) return kParts / of_turn;  // no farther than can be sampled
  const int n = static_cast<int>(std::min<double>(std::max({h / apart_, static_cast<double>(kFewParts), of_turn}), kParts));
  samples_.take([&](double x) { return effort_at(read, x); }, 0, 1, n);
  int passed = 0;
  double second = 1, third = 1;
  samples_.for_each_bend([&](double part) {
    if (++passed == 2) second = part / n;
    if (passed == 3) third = part / n;
  });
  return Bends::share_of_way(second, third);
}

template <class S>
double BasicBendWatch<S>::share_of_step(double t, double h, double t_end, const std::vector<typename S::Motion>& start, const std::vector<typename S::Motion>& end) {
  if (apart_ == 0 && t_end > t) {
    apart_ = (t_end - t) / kParts;
    in_time_ = bends_in_time(system_, t, t_end);
    kinks_ = kinks_in_time(system_, t, t_end);
  }
  double share = share_to_one_kink(kinks_, t, h);
  for (const Bends& bends : in_time_) share = std::min(share, bends.share_to_second_bend(t, t + h));
  for (const int l : placed_) share = std::min(share, share_of_effort(system_.loads[l], t, h, start, end));
  for (const Way& way : ways_) {
    const double from = place(way, start);
    share = std::min(share, way.bends.share_to_second_bend(from, place_at_end(way, from, start, end)));
  }
  return share;
}

// Where surfaces reverse their slip, in a small part of the way between their speeds at the start and at the end.
template <class S>
double BasicBendWatch<S>::missed_friction(int j, double t, const std::vector<typename S::Motion>& start, const std::vector<typename S::Motion>& end, const BasicLoadScale<S>& scale) const {
  const BasicJointData<S>& joint = system_.joints[j];
  const BasicJointKinematics<S> from = system_.kinematics(j, t, start), to = system_.kinematics(j, t, end);
  bool turns = false;
  for (int c = 0; c < S::kDof; ++c) turns = turns || (!joint.held[c] && from.rate[c] * to.rate[c] < 0);
  if (!turns) return 0;
  const typename S::Vec load = load_in_gap_axes(joint.at, scale);
  const auto force = [&](double x) {
    const typename S::Vec rate = from.rate + x * (to.rate - from.rate);
    return typename S::Vec(joint.law.force({t, to.gap, rate, nullptr}));
  };
  return missed_between(force, [&load](const typename S::Vec& x) { return x.cwiseAbs().cwiseQuotient(load).maxCoeff(); });
}

template <class S>
double BasicBendWatch<S>::missed_between_samples(double t, double h, const std::vector<typename S::Motion>& start, const std::vector<typename S::Motion>& end,
                                                 const BasicLoadScale<S>& scale) {
  double largest = 0;
  const auto over = [](double load) { return [load](double x) { return std::abs(x) / load; }; };
  for (const Applied& force : applied_)
    largest = std::max(largest, missed_between([&](double x) { return force.f->value(std::array{t + x * h}); }, over(scale.body[force.body][force.component])));
  for (const int l : timed_) {
    const BasicLoadData<S>& load = system_.loads[l];
    const ReadInStep read = read_in_step(load, t, h, start, end);
    if (!read.jumps()) largest = std::max(largest, missed_between([&](double x) { return effort_at(read, x); }, over(load_in_gap_axes(load.at, scale)[load.component])));
  }
  for (const int j : rubbing_) largest = std::max(largest, missed_friction(j, t + h, start, end, scale));
  return largest;
}

template std::vector<Bends> bends_in_time(const System& system, double from, double to);
template std::vector<double> kinks_in_time(const System& system, double from, double to);
template class BasicBendWatch<Planar>;
PINTLE_IN_SPACE(template std::vector<Bends> bends_in_time(const BasicSystem<Spatial>& system, double from, double to);)
PINTLE_IN_SPACE(template std::vector<double> kinks_in_time(const BasicSystem<Spatial>& system, double from, double to);)
PINTLE_IN_SPACE(template class BasicBendWatch<Spatial>;)

}  // namespace pintle
