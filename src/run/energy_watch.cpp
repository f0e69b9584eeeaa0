#include "run/energy_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "joints/belt.h"

namespace pintle {
namespace {

constexpr int kJudgedEvery = 8;           // steps between two checks of the account
constexpr double kExplained = 30;         // multiple of tolerance times turnover that errors of the forces explain. Eq. (8.2)
constexpr double kCoarseWork = 0.05;       // fraction of the turnover that a method whose works are sums over its steps may leave open. With double of it a penalty run that leaves its branch at 1.23 s (n_four_bar_2, 10 rad/s) is stopped at 4.6 s; with half, at 1.23 s too
constexpr double kPerExchange = 0.01;     // fraction of the energy exchanged that counts as turnover: errors add up in long runs
constexpr double kLeastJudged = 1e-7;  // lower limit on the tolerance by which the account is judged: below it roundoff dominates
constexpr double kRounding = 1e-11;       // fraction of the largest entry that roundoff may leave open
constexpr double kGiven = 0.01;           // fraction of the turnover: more negative dissipation than this is unexplained
constexpr int kRunaway = 10;              // powers of ten above the storable energy from which growth is judged. Eq. (8.4)
constexpr double kFarFed = 1000;          // multiple of the storable energy: a larger work is named if the run ends badly
constexpr double kTornOpen = 0.1;         // fraction of the mechanism's size: a joint deflected by more while a load that depends on the motion has fed that much ends the run. pendulum_wrong_signs ends at 0.457 s, with half at 0.413 s, with double at 0.942 s after twelve times the computation
constexpr int kCompared = 4;              // powers of ten: the time that the last ones took is compared with that of the ones before
constexpr double kSteady = 1.5;           // limit on the ratio of these times: 1 for an exponential, 100 for constant torque, 3.2 for t^8

template <class S>
double reach(const BasicPlacement<S>& at) { return std::max(at.F.p.norm(), at.M.p.norm()); }

// The distance over which weights can do work, from the markers and the bodies' own size.
template <class S>
double size_of(const BasicSystem<S>& system) {
  double size = system.largest_radius_of_gyration();
  for (const BasicJointData<S>& joint : system.joints) size = std::max(size, reach(joint.at));
  return size;
}

}  // namespace

template <class S>
BasicEnergyWatch<S>::BasicEnergyWatch(const BasicSystem<S>& system, double duration, double tolerance, bool exact_work, bool counts_turns)
    : system_(system), duration_(duration), tolerance_(std::max(tolerance, kLeastJudged)), exact_work_(exact_work) {
  for (const BasicJointData<S>& joint : system.joints) feeders_.push_back({joint.servo >= 0 ? "motor" : joint.driven >= 0 ? "the length of joint" : joint.law.feeds() ? "the pressure in joint" : joint.law.depends_on_reaction_alone() ? "the teeth of joint" : "negative damping of joint", &joint.name, joint.servo < 0});
  for (int j = 0; j < system.n_joints(); ++j)
    if (!counts_turns && is_at_end_of_range(system.joints[j].displacement, std::numeric_limits<double>::infinity())) belts_.push_back(j);
  for (int j = 0; j < system.n_joints(); ++j) {
    if (system.joints[j].driven < 0) continue;
    drives_.push_back(j);
    if (system.joints[j].servo < 0) lengths_.push_back(j);
  }
  for (const BasicLoadData<S>& load : system.loads) {
    const bool listens = load.kind != LoadKind::kEffort || std::any_of(load.signals.begin(), load.signals.end(), [](const BasicSignal<S>& signal) { return !signal.is_time; });
    feeders_.push_back({load.applied ? "force" : load.kind == LoadKind::kEffort ? "motor" : "negative damping of spring", &load.name, listens});
  }
  for (const BasicAppliedData<S>& force : system.applied) feeders_.push_back({"force", &force.name, false});
}

template <class S>
double BasicEnergyWatch<S>::potential(const BasicState<S>& state) {
  system_.motions(state.q, state.v, m_);
  return system_.external_work(state.t, state.q, m_, state.sliding).potential + energy_of_joints(system_, state);
}

// Eq. (8.3).
template <class S>
void BasicEnergyWatch<S>::start(const BasicState<S>& state) {
  const double kinetic = system_.kinetic(state.v), size = size_of(system_);
  kinetic_ = kinetic;
  potential_ = potential(state);
  total_ = kinetic + potential_ + state.dissipated - state.supplied;
  double elastic = potential_;
  storable_ = kinetic;
  for (std::size_t i = 0; i < system_.bodies.size(); ++i) {
    const BasicBodyData<S>& body = system_.bodies[i];
    elastic += body.gravity.template head<S::kDim>().dot(S::position(state.q[i]));
    storable_ += body.gravity.template head<S::kDim>().norm() * size + body.mass[0] * size * size / (duration_ * duration_);
  }
  storable_ += std::abs(elastic) + load_work_over_distance(state, size);
  deflection_ = {system_, state};
  flow_ = flow(state);
}

// The work of the loads at the start over a distance, and of their moments over a radian.
template <class S>
double BasicEnergyWatch<S>::load_work_over_distance(const BasicState<S>& state, double distance) {
  VecsOf<S> loads(system_.bodies.size());
  system_.motions(state.q, state.v, m_);
  system_.external(state.t, m_, loads, state.sliding);
  double work = 0;
  for (std::size_t i = 0; i < loads.size(); ++i) {
    const typename S::Vec load = loads[i] - system_.bodies[i].gravity;
    work += load.template head<S::kDim>().norm() * distance + load.template tail<S::kDof - S::kDim>().norm();
  }
  return work;
}

// The sum of powers does not show what one motor gives and another takes.
template <class S>
double BasicEnergyWatch<S>::flow(const BasicState<S>& state) {
  if (drives_.size() + system_.loads.size() + system_.applied.size() < 2) return std::abs(state.supply_power) + std::abs(state.loss_power);
  system_.motions(state.q, state.v, m_);
  double sum = std::abs(state.loss_power);
  for (const int j : drives_) sum += std::abs(system_.drive_power(system_.joints[j], state.t, m_, state.force[j]));
  for (const BasicLoadData<S>& load : system_.loads) sum += std::abs(system_.work_of(load, state.t, m_, state.sliding).supplied);
  for (const BasicAppliedData<S>& force : system_.applied) sum += std::abs(system_.power_of(force, state.t, m_));
  return sum;
}

template <class S>
typename BasicEnergyWatch<S>::Alarm BasicEnergyWatch<S>::see_step(const BasicState<S>& state, double h) {
  const double flow_now = flow(state);
  throughput_ += 0.5 * h * (flow_ + flow_now);
  flow_ = flow_now;
  const double kinetic = system_.kinetic(state.v);
  exchanged_ += std::abs(kinetic - kinetic_);
  kinetic_ = kinetic;
  kinetic_peak_ = std::max(kinetic_peak_, kinetic);
  if (reached_ > 0) add_works(state, h);
  for (const int j : belts_) {
    const double gap = state.gap[j][0];
    if (!is_at_end_of_range(system_.joints[j].displacement, gap)) continue;
    message_ = fmt::format("joint {} is {} by {:.4g} m at t = {:.6g} s, the most at which this method tells slack from stretch: it does not count the turns of discs. Use method radau, which does", system_.joints[j].name,
                           gap > 0 ? "stretched" : "slack", std::abs(gap), state.t);
    return Alarm::kOpen;
  }
  for (const int j : lengths_)
    if (const BasicJointData<S>& joint = system_.joints[j]; !(target_of(joint, state.t)[0] > 0)) {
      message_ = fmt::format("the length of joint {} has shrunk to 0 by t = {:.6g} s: its two ends have met. End the run earlier, or keep the length above 0", joint.name, state.t);
      return Alarm::kOpen;
    }
  if (++since_judged_ >= kJudgedEvery)
    if (const Alarm alarm = check_energy_account(state); alarm != Alarm::kNone) return alarm;
  if (const Alarm alarm = check_energy_growth(state); alarm != Alarm::kNone) return alarm;
  return check_torn_joints(state);
}

template <class S>
typename BasicEnergyWatch<S>::Alarm BasicEnergyWatch<S>::see_end(const BasicState<S>& state) {
  if (const Alarm alarm = check_energy_account(state); alarm != Alarm::kNone) return alarm;
  if (!exact_work_ || state.dissipated > -kGiven * turnover()) return Alarm::kNone;
  message_ = fmt::format("joints and dampers have delivered {:.3g} J, but can only dissipate: likely a negative damping, or friction whose slip jumped within a step, as at a corner of an edge", -state.dissipated);
  return Alarm::kOpen;
}

template <class S>
double BasicEnergyWatch<S>::turnover() const {
  return std::max({kinetic_peak_, swing_, throughput_, storable_}) + kPerExchange * exchanged_;
}

// Eq. (8.2).
template <class S>
typename BasicEnergyWatch<S>::Alarm BasicEnergyWatch<S>::check_energy_account(const BasicState<S>& state) {
  since_judged_ = 0;
  const double stored = potential(state), kinetic = system_.kinetic(state.v);
  swing_ = std::max(swing_, std::abs(stored - potential_));
  const double missing = kinetic + stored + state.dissipated - state.supplied - total_;
  const double largest = std::max({kinetic, std::abs(stored), std::abs(potential_), std::abs(state.supplied), std::abs(state.dissipated)});
  const double share = exact_work_ ? kExplained * tolerance_ : std::max(kExplained * tolerance_, kCoarseWork);
  const double within = share * std::max(expected_, turnover()) + kRounding * largest;
  if (std::abs(missing) <= within) {
    missing_ = missing;
    return Alarm::kNone;
  }
  describe_energy_imbalance(state, missing, within);
  return Alarm::kOpen;
}

template <class S>
void BasicEnergyWatch<S>::describe_energy_imbalance(const BasicState<S>& state, double missing, double within) {
  const bool ideal = std::any_of(system_.joints.begin(), system_.joints.end(), [](const BasicJointData<S>& joint) { return joint.ideal; });
  const bool loaded = !system_.loads.empty() || !system_.applied.empty();
  const bool sudden = std::abs(missing - missing_) > 0.5 * within;
  const char* cause = sudden && !loaded && ideal ? "likely a singular position of ideal joints: start elsewhere, or give its joints stiffness"
                      : sudden && loaded ? "likely a load or motor that changes within a step there, or has a pole: set a max_step that resolves it"
                      : ideal ? "likely ideal joints near a singular position: give them stiffness"
                              : "likely values of very different magnitude, or steps too long to resolve the motion: check masses, stiffness and loads, or set a max_step";
  const auto motors = std::count_if(system_.joints.begin(), system_.joints.end(), [](const BasicJointData<S>& joint) { return joint.servo >= 0; });
  message_ = fmt::format("the energy account does not close: there are {:.3g} J too {} at t = {:.6g} s, where errors within the tolerance explain {:.2g} J; {}{}", std::abs(missing),
                         missing > 0 ? "many" : "few", state.t, within, cause, motors > 1 ? ". Another possible cause: motors that contradict each other (pintle check counts the degrees of freedom that they leave)" : "");
}

// Eq. (8.4). Only supplied energy counts: the mechanism already had what falling weights or springs give. What dampers give counts too, what they take does not: a
// joint that is torn open takes most of it.
template <class S>
typename BasicEnergyWatch<S>::Alarm BasicEnergyWatch<S>::check_energy_growth(const BasicState<S>& state) {
  const double energy = state.supplied + std::max(0.0, -state.dissipated);
  bool more = false;
  while (reached_ < kDecades && energy > storable_ * std::pow(10.0, reached_)) {
    decade_[reached_++] = state.t;
    more = true;
  }
  if (!more || reached_ <= kRunaway) return Alarm::kNone;
  const double last = decade_[reached_ - 1] - decade_[reached_ - 1 - kCompared];
  const double before = decade_[reached_ - 1 - kCompared] - decade_[reached_ - 1 - 2 * kCompared];
  if (!(before > 0) || last > kSteady * before) return Alarm::kNone;  // powers of ten reached within one step show no growth rate
  const double span = decade_[reached_ - 1] - decade_[reached_ - 1 - 2 * kCompared];
  describe_runaway(state, energy, fmt::format(", growing tenfold every {:.2g} s", span / (2 * kCompared)));
  return Alarm::kRunaway;
}

// Work since the energy exceeded what can be stored, from the powers at the ends of steps.
template <class S>
void BasicEnergyWatch<S>::add_works(const BasicState<S>& state, double h) {
  system_.motions(state.q, state.v, m_);
  std::size_t at = 0;
  for (int j = 0; j < system_.n_joints(); ++j, ++at) {
    const BasicJointData<S>& joint = system_.joints[j];
    feeders_[at].work += h * system_.drive_power(joint, state.t, m_, state.force[j]);
    if (joint.servo < 0 && !joint.ideal) feeders_[at].work += h * std::max(0.0, -joint.law.loss(law_point(system_, j, state)));
  }
  for (const BasicLoadData<S>& load : system_.loads) {
    const ExternalWork work = system_.work_of(load, state.t, m_, state.sliding);
    feeders_[at++].work += h * (work.supplied + std::max(0.0, -work.lost));
  }
  for (const BasicAppliedData<S>& force : system_.applied) feeders_[at++].work += h * system_.power_of(force, state.t, m_);
}

template <class S>
const typename BasicEnergyWatch<S>::Feeder* BasicEnergyWatch<S>::largest_feeder() const {
  const auto most = std::max_element(feeders_.begin(), feeders_.end(), [](const Feeder& a, const Feeder& b) { return a.work < b.work; });
  if (most != feeders_.end() && most->work > 0) return &*most;
  // Powers that change their sign within steps add up to anything; a single load needs no comparison.
  return system_.loads.size() == 1 && reached_ > kRunaway ? &feeders_[system_.joints.size()] : nullptr;
}

template <class S>
std::string BasicEnergyWatch<S>::note_on_feeder() const {
  const Feeder* most = largest_feeder();
  const double fed = std::accumulate(feeders_.begin(), feeders_.end(), 0.0, [](double sum, const Feeder& f) { return sum + f.work; });  // less what others take up
  if (most == nullptr || !most->listens || !(std::min(most->work, fed) > kFarFed * storable_)) return {};
  return fmt::format("{} {} has fed {:.3g} J, {:.2g} times what the mechanism stores by itself: check the signs of what it depends on", most->kind, *most->name, most->work,
                     most->work / storable_);
}

// A motion that is fed by what depends on it, until a joint gives way, need not go on growing.
template <class S>
typename BasicEnergyWatch<S>::Alarm BasicEnergyWatch<S>::check_torn_joints(const BasicState<S>& state) {
  if (!(std::max(state.supplied, -state.dissipated) > kFarFed * storable_)) return Alarm::kNone;
  const Feeder* most = largest_feeder();
  if (most == nullptr || !most->listens || !(most->work > kFarFed * storable_)) return Alarm::kNone;
  for (std::size_t j = 0; j < system_.joints.size(); ++j)
    if (const double torn = deflection_.of(j, state.force[j].template head<S::kDim>().norm()); torn > kTornOpen) {
      describe_runaway(state, state.supplied, fmt::format(", when joint {} was torn open by {:.2g} m", system_.joints[j].name, torn * deflection_.size()));
      return Alarm::kRunaway;
    }
  return Alarm::kNone;
}

template <class S>
void BasicEnergyWatch<S>::describe_runaway(const BasicState<S>& state, double energy, const std::string& how) {
  message_ = fmt::format("the motion runs away: at t = {:.4g} s it had been fed {:.3g} J, more than the mechanism stores by itself, and {:.3g} J at t = {:.4g} s{}", decade_[0], storable_, energy, state.t, how);
  if (const Feeder* most = largest_feeder()) message_ += fmt::format("; {} {} feeds it: check the signs of what it depends on", most->kind, *most->name);
}

template class BasicEnergyWatch<Planar>;
PINTLE_IN_SPACE(template class BasicEnergyWatch<Spatial>;)

}  // namespace pintle
