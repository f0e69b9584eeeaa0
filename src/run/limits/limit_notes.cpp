#include "run/limits/limit_notes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "integrators/methods.h"
#include "run/limits/drive_limit.h"

namespace pintle {
namespace {

constexpr int kHalvings = 40;
constexpr double kFinestReplay = 1e-6;  // tolerance of the steps that find the instant

// In the units of results.
std::string quantity(double x, bool angle) {
  return angle ? fmt::format("{:.6g} deg", x * 180 / std::numbers::pi) : fmt::format("{:.6g} mm", 1000 * x);
}

// When the drive's coordinate reaches its limit first, by the dense output of the step that takes it there; negative: not before t_end.
class Arrival {
 public:
  Arrival(const System& system, const DriveLimit& limit, int drive) : joint_(system.joints[drive]), limit_(limit), drive_(drive) {}

  double find(BasicStepper<Planar>& stepper, double t_end, std::uint64_t most_steps) const {
    if (reached(stepper.state())) return stepper.state().t;
    for (std::uint64_t i = 0; i < most_steps && stepper.state().t < t_end * (1 - 1e-12); ++i) {
      if (!stepper.step(t_end)) return -1;
      if (!reached(stepper.state())) continue;
      double low = stepper.previous().t, high = stepper.state().t;
      for (int k = 0; k < kHalvings; ++k) {
        const double middle = 0.5 * (low + high);
        (reached(stepper.interpolate(middle)) ? high : low) = middle;
      }
      return high;
    }
    return -1;
  }

 private:
  bool reached(const State& state) const { return limit_.ahead * (drive_value(joint_, state.gap[drive_][joint_.driven], state.t) - limit_.value) >= 0; }

  const JointData& joint_;
  const DriveLimit& limit_;
  int drive_;
};

double arrival(const System& system, const State& start, const SimulateSettings& settings, const Trajectory& run, const DriveLimit& limit, int drive, double seen) {
  MethodChoice choice;
  choice.equations = settings.equations;
  choice.method = run.method;
  choice.tolerance_of = settings.tolerance_of;
  const auto stepper = make_stepper(system, choice, std::max(kFinestReplay, std::min(settings.tolerance, 1e-4)));
  stepper->set_max_step(settings.max_step);
  stepper->start(start, 1e-4 * settings.duration);
  return Arrival(system, limit, drive).find(*stepper, seen, run.counters.steps);
}

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

std::string note(const System& system, const DriveLimit& limit, const DrivePeak<Planar>& peak, double t) {
  const JointData& drive = system.joints[static_cast<std::size_t>(peak.joint)];
  const bool angle = drive.driven == 2, servo = drive.servo >= 0;
  const std::string what = servo ? fmt::format("the {} of joint {}", angle ? "angle" : "slide", driven_joint(system, drive).name) : fmt::format("the length of joint {}", drive.name);
  const double beyond = limit.ahead * (drive_value(drive, peak.lag, peak.t) - limit.value);
  const double unit = angle ? 180 / std::numbers::pi : 1000;
  std::string text = fmt::format("the mechanism came to its limit at t = {:.4g} s: {} can go no further than {}{}. {} {} went on pushing: with {:.5g} {} at t = {:.4g} s, {:.3g} {} behind",
                                 t, what, quantity(limit.value, angle), in_line(system, limit), servo ? "Motor" : "What drives joint", drive.name, peak.effort, angle ? "N*m" : "N",
                                 peak.t, std::abs(peak.lag) * unit, angle ? "deg" : "mm");
  if (beyond > 0) text += fmt::format(", the joints having given way by {:.3g} {}", beyond * unit, angle ? "deg" : "mm");
  return text;
}

Vecs places(const std::vector<Planar::Motion>& m) {
  Vecs q;
  for (const Planar::Motion& body : m) q.emplace_back(body.p[0], body.p[1], body.angle);
  return q;
}

}  // namespace

std::vector<std::string> limit_notes(const System& system, const State& start, const SimulateSettings& settings, const Trajectory& run, const ForceRecorder& recorder) {
  std::vector<std::string> notes;
  for (const DrivePeak<Planar>& peak : recorder.drive_peaks()) {
    if (peak.q.empty()) continue;
    double seen = peak.t_seen;
    auto limit = find_drive_limit(system, peak.q, seen, peak.joint);
    if (!limit) limit = find_drive_limit(system, places(recorder.last_motions()), seen = run.t_end, peak.joint);
    if (!limit) continue;
    const double t = arrival(system, start, settings, run, *limit, peak.joint, seen);
    notes.push_back(note(system, *limit, peak, t < 0 ? seen : t));
  }
  return notes;
}

}  // namespace pintle
