#include "run/limits/limit_notes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include "base/constants.h"
#include "integrators/methods.h"
#include "run/limits/drive_limit.h"
#include "run/pass_constants.h"

namespace pintle {
namespace {

constexpr int kHalvings = 40;                                  // bisections of the step in which a limit is reached
constexpr double kFinestReplay = 1e-6, kLoosestReplay = 1e-4;  // lower and upper limit on the tolerance of the steps that find the time of arrival
constexpr double kLooks = 2000;                                // upper limit on the checks for a limit in a repeated run
constexpr double kFarBehind = 0.1;                              // lag of a motor that is worth a note, as a fraction of the travel asked of it
constexpr double kSameLimit = 1e-6;                            // two values of a coordinate that differ by less are the same limit [rad or m]
constexpr double kLittle = 0.01;                               // fraction of the duration after a stopped run at which its drive is checked for a limit

// What was found about a drive.
struct Finding {
  DrivePeak<Planar> peak;
  DriveLimit limit;
  double t;              // when the mechanism reached it; before refinement, when it was seen there [s]
  bool pushed;           // the run continued
  bool alone;            // no other drive is at a limit
  bool first = true;     // the limit is that at which the effort was largest
};

// By how much a coordinate is beyond the limit; angles may differ by whole turns.
double past(const DriveLimit& limit, double value, bool angle) {
  const double beyond = limit.ahead * (value - limit.value);
  return angle ? std::remainder(beyond, kTurn) : beyond;
}

// Integrates again up to the time at which the limit is first reached, which is located in the dense output of the step that reaches it.
class Arrival {
 public:
  Arrival(const System& system, const State& start, const SimulateSettings& settings, const Trajectory& run) : system_(system), start_(start), settings_(settings), run_(run) {}

  // The limit that the mechanism reaches first need not be the one at which its drive later pushed hardest. With several drives no coordinate has a
  // limit of its own: then the time is the first at which they ask for an impossible position.
  void refine(Finding& finding) const {
    const int drive = finding.peak.joint;
    const JointData& joint = system_.joints[static_cast<std::size_t>(drive)];
    std::optional<DriveLimit> limit;
    const auto look = [&](const State& state) {
      limit = find_drive_limit(system_, state.q, state.t, drive);
      return limit.has_value();
    };
    double looked = -1, looked_before = -1;
    const auto look_now_and_then = [&](const State& state) {
      if (looked >= 0 && state.t < looked + settings_.duration / kLooks) return false;
      looked_before = std::exchange(looked, state.t);
      return look(state);
    };
    const auto past_limit = [&](const State& state) {
      return state.t >= looked_before && limit->ahead * (drive_value(joint, state.gap[static_cast<std::size_t>(drive)][joint.driven], state.t) - limit->value) >= 0;
    };
    double t = finding.alone ? first(look_now_and_then, finding.t, 0) : first(look, finding.t, kHalvings);
    if (!limit) return;
    if (finding.alone) t = first(past_limit, finding.t, kHalvings);
    if (t < 0) return;
    finding.t = t;
    finding.first = std::abs(past(finding.limit, limit->value, joint.driven == 2)) < kSameLimit;
    finding.limit = *limit;
  }

 private:
  // The end of the first step in which `reached` holds, or that time after bisecting the step; negative if not before t_end.
  template <class Reached>
  double first(Reached reached, double t_end, int halvings) const {
    const auto stepper = make_stepper(system_, resolve_method(settings_), std::clamp(settings_.tolerance, kFinestReplay, kLoosestReplay));
    stepper->set_max_step(settings_.max_step);
    stepper->start(start_, kFirstStep * settings_.duration);
    if (reached(stepper->state())) return stepper->state().t;
    for (std::uint64_t i = 0; i < run_.counters.steps && stepper->state().t < t_end * kAlmostAll; ++i) {
      if (!stepper->step(t_end)) return -1;
      if (!reached(stepper->state())) continue;
      double low = stepper->previous().t, high = stepper->state().t;
      for (int k = 0; k < halvings; ++k) {
        const double middle = 0.5 * (low + high);
        (reached(stepper->interpolate(middle)) ? high : low) = middle;
      }
      return high;
    }
    return -1;
  }

  const System& system_;
  const State& start_;
  const SimulateSettings& settings_;
  const Trajectory& run_;
};

// The joint whose coordinate a servo drives.
const JointData& driven_joint(const System& system, const JointData& drive) {
  const auto same = [&drive](const JointData& joint) {
    return joint.servo < 0 && joint.at.a == drive.at.a && joint.at.b == drive.at.b && joint.at.F.p == drive.at.F.p && joint.at.M.p == drive.at.M.p;
  };
  const auto found = std::find_if(system.joints.begin(), system.joints.end(), same);
  return drive.servo < 0 || found == system.joints.end() ? drive : *found;
}

std::string in_line(const System& system, const DriveLimit& limit) {
  if (limit.in_line.size() != 3) return "";
  const auto name = [&](int i) { return system.joints[static_cast<std::size_t>(limit.in_line[static_cast<std::size_t>(i)])].name; };
  return fmt::format(", where joints {}, {} and {} are in line", name(0), name(1), name(2));
}

std::string note(const System& system, const Finding& finding) {
  const DriveLimit& limit = finding.limit;
  const DrivePeak<Planar>& peak = finding.peak;
  const JointData& drive = system.joints[static_cast<std::size_t>(peak.joint)];
  const bool angle = drive.driven == 2, servo = drive.servo >= 0;
  const std::string what = servo ? fmt::format("the {} of joint {}", angle ? "angle" : "slide", driven_joint(system, drive).name) : fmt::format("the length of joint {}", drive.name);
  const double beyond = past(limit, drive_value(drive, peak.lag, peak.t), angle);
  const double unit = angle ? 360 / kTurn : 1000;
  const char* unit_name = angle ? "deg" : "mm";
  std::string text = fmt::format("the mechanism came to its limit at t = {:.4g} s: {} can go no further than {:.6g} {}{}{}", finding.t, what, limit.value * unit, unit_name,
                                 finding.alone ? "" : " with the other motors where they were at that time", in_line(system, limit));
  if (!finding.pushed) return text + fmt::format("; {} {} commands more", servo ? "motor" : "the drive of joint", drive.name);
  text += fmt::format(". {} {} kept pushing: with {:.5g} {} at t = {:.4g} s, {:.3g} {} behind its target", servo ? "Motor" : "The drive of joint", drive.name, peak.effort,
                      angle ? "N*m" : "N", peak.t, std::abs(peak.lag) * unit, unit_name);
  if (finding.alone && finding.first && beyond > 0) text += fmt::format("; the deflection of the joints took it {:.3g} {} past the limit", beyond * unit, unit_name);
  return text;
}

Vecs places(const std::vector<Planar::Motion>& m) {
  Vecs q;
  for (const Planar::Motion& body : m) q.emplace_back(body.p[0], body.p[1], body.angle);
  return q;
}

bool has_redundant_rows(const System& system) {
  return std::any_of(system.joints.begin(), system.joints.end(), [](const JointData& joint) { return joint.ideal && std::ranges::any_of(joint.redundant, std::identity{}); });
}

// Looks where the drive's effort was largest, and where the run ended. If the run could not continue, also a little later, and from its start
// too: the last positions may no longer be those of a mechanism.
std::optional<Finding> look_at(const System& system, const State& start, const SimulateSettings& settings, const Trajectory& run, const Vecs& last, const DrivePeak<Planar>& peak) {
  const auto found = [&](const Vecs& q, double t) { return find_drive_limit(system, q, t, peak.joint); };
  if (!peak.q.empty())
    if (auto limit = found(peak.q, peak.t_seen)) return Finding{peak, *limit, peak.t_seen, true, true};
  if (auto limit = found(last, run.t_end)) return Finding{peak, *limit, run.t_end, true, true};
  const bool stopped = run.outcome == Outcome::kFailed || run.outcome == Outcome::kRunaway || run.outcome == Outcome::kEnergyOpen;
  if (stopped && !has_redundant_rows(system))  // a row left out counts as free, and the drive would be found at a limit that it does not have
    for (const Vecs* from : {&last, &start.q})
      if (auto limit = found(*from, run.t_end + kLittle * settings.duration)) return Finding{peak, *limit, run.t_end, false, true};
  return std::nullopt;
}

// The range of values that a drive is asked to take up to `t_end` [rad or m].
double asked_travel(const JointData& drive, double t_end) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (double i = 0; i <= kLooks; ++i) {
    const double value = target_of(drive, i / kLooks * t_end)[0];
    least = std::min(least, value);
    most = std::max(most, value);
  }
  return most - least;
}

// A motor whose spring yields by a good part of the travel asked of it: the motion is not the one that was meant. Empty otherwise.
std::string note_on_lag(const System& system, const Trajectory& run, const DrivePeak<Planar>& peak) {
  const JointData& drive = system.joints[static_cast<std::size_t>(peak.joint)];
  if (drive.servo < 0 || run.outcome == Outcome::kFailed || run.outcome == Outcome::kEnergyOpen) return "";
  const double lag = std::abs(peak.lag), travel = asked_travel(drive, run.t_end);
  if (!(travel > 0 && lag > kFarBehind * travel)) return "";
  const bool angle = drive.driven == 2;
  const double unit = angle ? 360 / kTurn : 1000;
  const char* unit_name = angle ? "deg" : "mm";
  return fmt::format("motor {} is {:.3g} {} from where it should be at t = {:.4g} s, when it pushes with {:.5g} {}; it travels {:.3g} {}. Raise its stiffness, unless it is meant to yield", drive.name, lag * unit,
                     unit_name, peak.t, peak.effort, angle ? "N*m" : "N", travel * unit, unit_name);
}

}  // namespace

std::vector<std::string> limit_notes(const System& system, const State& start, const SimulateSettings& settings, const Trajectory& run, const ForceRecorder& recorder) {
  std::vector<Finding> findings;
  std::vector<std::string> lags;
  if (recorder.drive_peaks().empty()) return {};
  const Vecs last = places(recorder.last_motions());
  for (const DrivePeak<Planar>& peak : recorder.drive_peaks()) {
    if (auto finding = look_at(system, start, settings, run, last, peak)) findings.push_back(std::move(*finding));
    else if (std::string lag = note_on_lag(system, run, peak); !lag.empty()) lags.push_back(std::move(lag));
  }
  std::vector<std::string> notes;
  const Arrival arrival(system, start, settings, run);
  for (Finding& finding : findings) {
    finding.alone = findings.size() == 1;
    if (finding.pushed) arrival.refine(finding);
    notes.push_back(note(system, finding));
  }
  notes.insert(notes.end(), lags.begin(), lags.end());
  return notes;
}

}  // namespace pintle
