#include "start/settle_joints.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "dynamics/inverse_dynamics.h"
#include "dynamics/time_scales.h"
#include "integrators/absolute/radau_stepper.h"
#include "linalg/chebyshev_nodes.h"
#include "start/preload.h"
#include "start/slow_manifold.h"

namespace pintle {
namespace {

constexpr double kMostHaste = 1e-3, kMostLever = 30;  // upper limits on the change of a body's speed due to the joints' deflection: as a fraction of the largest speed; or as a multiple of the largest gap rate
constexpr double kExact = 1e-6;                       // relative change of the gaps below which no more settling is needed
constexpr double kUnsettledGrowth = 1.1;              // upper limit on the growth of the largest force when the sweeps of soft joints have not converged: a start beyond it is rejected. With the 2 of kMostGrowth a lift at rest starts with 1.3 times its load (test Starts)
constexpr double kMostKick = 0.5;                     // upper limit, as a fraction of a joint's force, on what may ring because gap rates are known no better than the gaps, which the last sweep has changed
constexpr double kMostOfStored = 0.2;                 // upper limit, as a fraction of the energy that joints store, on the kinetic energy that fast ones give bodies. The collection's largest value is 0.1 (a toggle under load); starts dominated by roundoff have 0.3 and more
constexpr double kMostChange = 0.1;                   // upper limit, as a fraction of a force, on its change when joints are put on their slow motion. Fast ones of the collection change it by 0.007 at most, a hoist that was turned back by 0.9; soft ones by 0.09, a latch whose toe was to stick by 7 (tests/models/hoist_against_friction.toml)
constexpr double kLeastMeasure = 0.03;                  // as a fraction of the largest force: lower limit on the force that a change is compared with. With 1, an idle motor was given 50 N next to a weight of 510 N; with 0.01 the collection starts the same
constexpr double kBalanced = 1e-6;                    // as a fraction of the largest joint force: a body counts as at rest if the force that accelerates it is below this
constexpr double kSmallCouple = 0.05;                 // as a fraction of the largest force at the largest radius of gyration: growth of couples below this is not checked
constexpr double kEntirely = 0.99;                    // share of its slow motion from which a soft joint counts as following the motion

constexpr const char* kNotSettled = "no transient-free start was found (a force jumps at the start, or a long chain has modes slower than its motion): joint forces may ring from the start. All passes start from the same state, so the stated errors do not include this";

// Half a step of a rough integration, but at least the time in which the slowest joint vibrates, or `longest` if that is shorter: over
// less, rates and accelerations of gaps are roundoff. Rounded to a binary fraction of the duration, so that it does not change with every
// slight change of the model: where a joint is as slow as the motion, its slow motion depends on the span.
template <class S>
double smooth_span(const BasicSystem<S>& system, const BasicState<S>& start, double duration, double slowest, double longest) {
  const double half = 0.5 * natural_step<BasicRadauStepper<S>>(system, start, duration);
  const double smooth = std::max(half, std::min({1 / slowest, longest, duration}));
  return half > 0 ? duration * std::exp2(std::floor(std::log2(smooth / duration))) : 0;
}

template <class S>
double largest_gap_rate(const BasicSystem<S>& system, const BasicState<S>& state) {
  double largest = 0;
  for (std::size_t j = 0; j < state.gap_rate.size(); ++j)
    for (int k = 0; k < S::kDim; ++k)
      if (system.joints[j].free_mask[k] == 0) largest = std::max(largest, std::abs(state.gap_rate[j][k]));
  return largest;
}

// In a chain of hundreds of joints, each of them fast, the compliances add up to modes slower than the motion. The sweeps then
// do not approach the start: all joints deflect a little, one after the other, and the ends get speeds of their own.
template <class S>
bool is_runaway(const BasicSystem<S>& system, const BasicState<S>& attempt, const BasicState<S>& given) {
  VecsOf<S> change = attempt.v;
  for (std::size_t i = 0; i < change.size(); ++i) change[i] -= given.v[i];
  return system.largest_speed(change) > std::max(kMostHaste * system.largest_speed(given.v), kMostLever * largest_gap_rate(system, attempt));
}

// Whether sweeps that have not converged came near. An attempt that diverged, or has forces or couples far above those of the given state, is
// useless.
template <class S>
bool is_near(const BasicSystem<S>& system, const BasicState<S>& attempt, const BasicState<S>& given, double most_growth = kMostGrowth) {
  const double force = largest_force(given.force), couple = std::max(largest_couple<S>(given.force), kSmallCouple * force * system.largest_radius_of_gyration());
  return is_finite(attempt) && largest_force(attempt.force) <= most_growth * force && largest_couple<S>(attempt.force) <= most_growth * couple;
}

// Twice the energy of springs with these gaps and forces.
template <class S>
double twice_stored(const BasicState<S>& state) {
  double twice = 0;
  for (std::size_t j = 0; j < state.gap.size(); ++j) twice += std::abs(state.force[j].dot(state.gap[j]));
  return twice;
}

// Gaps that follow the motion, more slowly than their own vibration, give bodies less kinetic energy than the joints store.
template <class S>
bool is_moderate(const BasicSystem<S>& system, const BasicState<S>& attempt, const BasicState<S>& given, double share) {
  VecsOf<S> change = attempt.v;
  for (std::size_t i = 0; i < change.size(); ++i) change[i] -= given.v[i];
  return 2 * system.kinetic(change) <= share * twice_stored(attempt) + kFits * 2 * system.kinetic(given.v);
}

// The slowest rate of those gaps that count as fast [1/s].
template <class S>
double slowest_fast_rate(const BasicTimeScales<S>& time_scales) {
  double slowest = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < time_scales.slow_rate.size(); ++j)
    for (int k = 0; k < S::kDim; ++k)
      if (time_scales.slow_rate[j][k] > 0 && time_scales.overdamped[j][k] == 0 && time_scales.resolved[j][k] == 0) slowest = std::min(slowest, time_scales.slow_rate[j][k]);
  return slowest;
}

// Sweeps may converge to a motion other than the one that the given forces start, for instance if they turn back a joint with friction.
template <class S>
bool keeps_forces(const BasicState<S>& attempt, const BasicState<S>& given) {
  const double least = kLeastMeasure * largest_force(given.force);
  for (std::size_t j = 0; j < given.force.size(); ++j) {
    const double change = (attempt.force[j] - given.force[j]).template head<S::kDim>().norm();
    if (!(change <= kMostChange * std::max(given.force[j].template head<S::kDim>().norm(), least))) return false;
  }
  return true;
}

// Puts fast joints on their slow motion. If that is not found, the state stays, or with `keep_best` becomes the best attempt.
// Returns the time over which it was found; 0: it was not.
template <class S>
double settle_fast_joints(const BasicSystem<S>& system, const BasicTimeScales<S>& time_scales, double slowest, double span, bool keep_best, BasicState<S>& state) {
  const BasicState<S> given = state;
  for (int i = 0; i < kSpans && span > 0; ++i, span *= 0.25) {
    BasicState<S> attempt = state;
    const double moved = move_onto_slow_manifold(system, time_scales, span, attempt);
    // Differentiated over too short a span, the gap changes of the last sweep would give rates above those of the gaps' own vibration.
    const double change = std::max(moved, moved * ChebyshevNodes().D.cwiseAbs().maxCoeff() / (span * slowest) * (kSettledSweep / kMostKick));
    if (is_runaway(system, attempt, given) || !is_moderate(system, attempt, given, kMostOfStored)) continue;
    if (change < kSettledSweep && !keeps_forces(attempt, given)) continue;
    if (change < kSettledSweep || (keep_best && is_near(system, attempt, given))) state = std::move(attempt);
    if (change < kSettledSweep) return span;
  }
  return 0;
}

// Joints that cannot follow their load, and the longest time in which they would.
struct SlowJoints {
  std::vector<std::size_t> joints;
  double longest = 0;  // [s]
};

// All in one note, as there may be many. `damped`: it is their damping, rather than the inertia of what they carry, that lets them follow slowly.
template <class S>
void note_slow_joints(const BasicSystem<S>& system, const SlowJoints& slow, bool damped, std::vector<std::string>& notes) {
  if (slow.joints.empty()) return;
  const bool one = slow.joints.size() == 1;
  constexpr std::size_t kNamed = 6;  // upper limit on the joints named
  std::string names;
  for (std::size_t i = 0; i < std::min(slow.joints.size(), kNamed); ++i) {
    const BasicJointData<S>& joint = system.joints[slow.joints[i]];
    names += fmt::format("{}{} {}", i == 0 ? "" : ", ", joint.servo < 0 ? "joint" : "motor", joint.name);
  }
  if (slow.joints.size() > kNamed) names += fmt::format(" and {} more", slow.joints.size() - kNamed);
  notes.push_back(fmt::format("{}: {} {} follow {} load only within {:.3g} s, and at the start the load changes faster; {} at the deflection that carries the load, and the {} that follows is physical, not an error of the start",
                              names, damped ? "damping lets" : "the inertia of what moves lets", one ? "it" : "them", one ? "its" : "their", slow.longest, one ? "it begins" : "they begin", damped ? "movement" : "vibration"));
}

// Notes which joints start on a motion of their own. True if there are none.
template <class S>
bool note_resolved_joints(const BasicSystem<S>& system, const BasicTimeScales<S>& time_scales, const BasicSoftStart<S>& soft, std::vector<std::string>& notes) {
  SlowJoints damped, vibrating;
  for (std::size_t j = 0; j < soft.share.size(); ++j) {
    Eigen::Index slowest = 0;
    const double share = soft.share[j].minCoeff(&slowest);
    if (share > kEntirely) continue;
    SlowJoints& slow = time_scales.overdamped[j][slowest] > 0 ? damped : vibrating;
    slow.joints.push_back(j);
    slow.longest = std::max(slow.longest, 1 / time_scales.slow_rate[j][slowest]);
  }
  note_slow_joints(system, damped, true, notes);
  note_slow_joints(system, vibrating, false, notes);
  return damped.joints.empty() && vibrating.joints.empty();
}

// theory/assembly section 5: soft joints first, then the others around them.
template <class S>
void settle_soft_joints(const BasicSystem<S>& system, const BasicTimeScales<S>& time_scales, double span, BasicSettledStart<S>& start) {
  BasicState<S> attempt = start.state;
  const BasicSoftStart<S> soft = place_soft_joints(system, time_scales, 2 * span, attempt);
  const bool converged = soft.change < kSettledSweep;
  const bool fits = is_moderate(system, attempt, start.state, 1.0) && (largest_force(start.state.force) == 0 || keeps_forces(attempt, start.state));
  if (fits && (converged || is_near(system, attempt, start.state, kUnsettledGrowth))) start.state = std::move(attempt);
  const bool along = note_resolved_joints(system, time_scales, soft, start.notes);
  if (soft.placed && fits && along && soft.change < kExact) return;
  const double slowest = slowest_fast_rate(time_scales);
  const bool all_soft = !std::isfinite(slowest);  // then there is no fast joint that would ring
  if (all_soft && soft.placed && fits && converged) return;
  if (settle_fast_joints(system, time_scales, slowest, span, false, start.state) > 0) return;
  if (!soft.placed || !fits || !converged) start.notes.push_back(kNotSettled);
}

// The largest force that accelerates a body [N]; a couple counts as a force at the body's radius of gyration.
template <class S>
double largest_unbalanced(const BasicSystem<S>& system, const BasicState<S>& state) {
  double largest = 0;
  for (std::size_t i = 0; i < state.a.size(); ++i) {
    const typename S::Vec unbalanced = system.bodies[i].mass.cwiseProduct(state.a[i]);
    const double force = unbalanced.template head<S::kDim>().norm() + unbalanced.template tail<S::kDof - S::kDim>().norm() / system.bodies[i].radius_of_gyration();
    if (!std::isfinite(force)) return std::numeric_limits<double>::infinity();
    largest = std::max(largest, force);
  }
  return largest;
}

// What the rounding of the positions makes of the force of the stiffest joint [N]: all that acts on bodies without loads.
template <class S>
double rounding_of_forces(const BasicSystem<S>& system, const BasicState<S>& state) {
  return kLastBits * largest_coordinate(state.q) * largest_stiffness(system);
}

// Whether loads and targets do not change for the time `span`, as far as they depend on time alone.
template <class S>
bool is_steady(const BasicSystem<S>& system, const BasicState<S>& state, double span) {
  std::vector<typename S::Motion> m;
  system.motions(state.q, state.v, m);
  const auto loads_at = [&](double t) {
    VecsOf<S> loads(state.q.size(), S::Vec::Zero());
    system.external(t, m, loads, state.sliding);
    return loads;
  };
  const auto targets_at = [&](double t) {
    std::vector<double> targets;
    for (const BasicJointData<S>& joint : system.joints)
      if (joint.driven >= 0)
        for (const double x : target_of(joint, t)) targets.push_back(x);
    return targets;
  };
  for (const double t : {state.t + 0.5 * span, state.t + span})
    if (loads_at(t) != loads_at(state.t) || targets_at(t) != targets_at(state.t)) return false;
  return true;
}

// theory/assembly sections 4 and 5.
template <class S>
void settle(const BasicSystem<S>& system, double duration, double known_span, BasicSettledStart<S>& start) {
  BasicState<S>& state = start.state;
  const double span = known_span > 0 ? known_span : span_of_motion(system, state, 4 * duration);
  start.span = span;
  const BasicTimeScales<S> time_scales = measure_time_scales(system, state, span);
  start.effective_mass = time_scales.effective_mass;
  if (span > 0 && time_scales.any_soft()) return settle_soft_joints(system, time_scales, span, start);
  const BasicTimeScales<S> fast = all_fast(system);
  const BasicState<S> given = state;
  const double slowest = slowest_fast_rate(time_scales);
  start.settled_over = settle_fast_joints(system, fast, slowest, smooth_span(system, state, duration, slowest, span), true, state);
  if (start.settled_over == 0 && span > 0) {  // where almost nothing acts yet, roundoff determines the steps of a rough integration
    BasicState<S> slower = given;
    start.settled_over = settle_fast_joints(system, fast, slowest, std::min(span, duration), false, slower);
    if (start.settled_over > 0) state = std::move(slower);
  }
  if (start.settled_over == 0) note_not_settled(system, state, start.notes);
}

}  // namespace

template <class S>
bool is_at_rest(const BasicSystem<S>& system, const BasicState<S>& state) {
  return 2 * system.kinetic(state.v) <= kFits * twice_stored(state) &&
         largest_unbalanced(system, state) <= std::max(kBalanced * largest_force(state.force), rounding_of_forces(system, state));
}

template <class S>
void settle_joints(const BasicSystem<S>& system, double duration, double known_span, BasicSettledStart<S>& start) {
  if (!(duration > 0)) return;
  const BasicState<S> given = start.state;
  settle(system, duration, known_span, start);
  if (moves_too_far(system, given, start.state)) start.state = given;
  if (!is_at_rest(system, given) || !is_steady(system, given, start.span > 0 ? std::min(start.span, duration) : duration)) return;
  // Sweeps that do not quite converge, as beside springs stiffer than a motor, disturb what rests; and where they find nothing, nothing rings.
  if (!is_at_rest(system, start.state)) start.state = given;
  std::erase(start.notes, kNotSettled);
}

template <class S>
void note_not_settled(const BasicSystem<S>& system, const BasicState<S>& state, std::vector<std::string>& notes) {
  const bool may_change = !system.applied.empty() || std::any_of(system.joints.begin(), system.joints.end(), [](const BasicJointData<S>& joint) { return joint.driven >= 0; });
  if (may_change || (largest_force(state.force) > 0 && !is_at_rest(system, state))) notes.push_back(kNotSettled);
}

template void note_not_settled(const BasicSystem<Planar>& system, const BasicState<Planar>& state, std::vector<std::string>& notes);

template void settle_joints(const BasicSystem<Planar>& system, double duration, double known_span, BasicSettledStart<Planar>& start);
PINTLE_IN_SPACE(template void settle_joints(const BasicSystem<Spatial>& system, double duration, double known_span, BasicSettledStart<Spatial>& start);)

template bool is_at_rest(const BasicSystem<Planar>& system, const BasicState<Planar>& state);
PINTLE_IN_SPACE(template bool is_at_rest(const BasicSystem<Spatial>& system, const BasicState<Spatial>& state);)

}  // namespace pintle
