// The result of a run: columns with name, unit and meaning; the energy account; the accuracy of every joint force; counters.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace pintle {

/// One column of the table. Joint forces are named `joint.<name>.on_<body>.fx[world]` and the like, so that body, axes and
/// sign cannot be mistaken; `about` says the same in a sentence.
struct Column {
  std::string name;
  std::string unit;
  std::string about;
};

/// The load on one joint (or motor, or spring) over the whole run, including the times between the rows of the table. Magnitudes of the force [N] on the second
/// body, and of the couple [N*m] about the second marker where the joint transmits one (`has_moment`).
struct LoadSummary {
  std::string name;
  std::string type;
  std::string first_body, second_body;
  double peak = 0, rms = 0, mean = 0;  ///< of the magnitude
  double peak_time = 0;                ///< [s]
  bool has_moment = false;
  double peak_moment = 0, rms_moment = 0, mean_moment = 0;
  double heat = 0;                     ///< heat that the joint has generated [J]; 0 for springs
  double error_estimate = 0;           ///< largest error of the force over the run [N]; NaN if the run stopped before its second integration, as are the other two
  double moment_error_estimate = 0;    ///< largest error of the couple [N*m]
  double relative_error_estimate = 0;  ///< the larger of the two, each relative to the joint's peak, or to 1e-4 of the mechanism's largest if that is more [-]; without the couple of a pin with friction
  double horizon = 0;                  ///< last time up to which the force is promised [s]; the error estimates cover the rows up to it
  double peak_after = 0, rms_after = 0, mean_after = 0;  ///< where the motion continues beyond the horizon: statistics of the remainder [N]
  double peak_scatter = 0, rms_scatter = 0, mean_scatter = 0;  ///< how far they differ between two motions that agree up to the horizon; of RMS and mean at least their standard error [N]
  bool unique = true;                  ///< false: redundant ideal constraints leave its force undetermined; one of many solutions is given
};

/// A motor: peak, RMS and mean effort [N*m or N] and power [W].
struct MotorSummary {
  std::string name, joint, unit;
  double peak_effort = 0, rms_effort = 0, mean_effort = 0;
  double peak_power = 0, mean_power = 0, work = 0;
  double effort_error = std::numeric_limits<double>::quiet_NaN();  ///< largest error of the effort over the run [N*m or N]; NaN for an effort that the model gives, and where the run states none
};

/// The duty of a pin during a run, and what it means for its bearing; the run counts as a load cycle that repeats. A value that cannot be computed, because a size is not stated or the pin does not turn, is
/// NaN, and `wants` or `remarks` say why. theory/bearing_life
struct BearingSummary {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::string joint;
  double path = 0;                            ///< angle turned between pin and bush, both directions added up [rad]
  double swing = 0;                           ///< from the least to the largest angle [rad]
  double mean_speed = 0, peak_speed = 0;      ///< of the angle, absolute value [rad/s]
  double mean_force = 0, peak_force = 0;      ///< of the magnitude [N]
  double force_error = 0;                     ///< as stated for the joint's force [N]
  double equivalent_load = kNone, equivalent_load_error = kNone;  ///< constant load of equal life, P [N]
  double life = kNone, life_hours = kNone;    ///< L10 in million turns, and in hours of repeated runs
  double life_error = kNone;                  ///< of the life, relative [-]
  double static_safety = kNone;               ///< C_0 over the peak force [-]
  double fatigue_ratio = kNone;               ///< fatigue load limit over P [-]
  double mean_pressure = kNone, peak_pressure = kNone;  ///< force over projected area [Pa]
  double mean_sliding = kNone, peak_sliding = kNone;    ///< speed of the pin's surface in the bush [m/s]
  double mean_pv = kNone, peak_pv = kNone;    ///< pressure times sliding speed [W/m^2]
  double bush_depth = kNone, bush_depth_angle = kNone;  ///< greatest depth that a pin with clearance has worn off its bush, and the middle of that sector [m], [rad]
  std::vector<std::string> wants;             ///< "state C (dynamic_load_rating) for a life"
  std::vector<std::string> remarks;           ///< where the formulas do not apply
};

/// kinetic + potential + dissipated - supplied stays constant: `drift` is the largest departure from that [J].
struct EnergyAccount {
  double kinetic_start = 0, kinetic_end = 0, kinetic_peak = 0;
  double potential_start = 0, potential_end = 0;  ///< gravity, springs and joints
  double dissipated = 0;                          ///< in joints, dampers
  double supplied = 0;                            ///< by motors and applied forces
  double drift = 0;
};

struct Counters {
  std::uint64_t steps = 0, rejected = 0, newton_iterations = 0, newton_failures = 0;
  std::uint64_t evaluations = 0, factorizations = 0, passes = 0;
  std::uint64_t events = 0;  ///< kinks, jumps and borders of laws at which steps ended; 0 also if the method does not locate them
};

enum class Outcome {
  kCompleted,
  kToleranceNotMet,
  kInterrupted,
  kFailed,
  kHorizon,     ///< the motion is chaotic: forces are promised up to a time, and statistics after it
  kRunaway,     ///< something feeds the motion more and more energy
  kEnergyOpen,  ///< the energy account does not close: the results are wrong
};

/// How errors grow along a chaotic motion.
struct Growth {
  double rate = 0, rate_error = 0;  ///< and how far it may differ on another stretch of the motion [1/s]; 0: not found to be chaotic
  double horizon = 0;               ///< the earliest of the joints [s]
};

/// An event of a joint's law: touch and let-go of a contact, stick and slip.
struct JointEvent {
  double t = 0;               ///< [s]
  std::string what;           ///< "touch"
  std::vector<double> values; ///< of JointEvents::columns, just after the event
};
struct JointEvents {
  std::string joint;
  std::vector<Column> columns;     ///< what the law reports: contact_force, penetration ..
  std::vector<JointEvent> events;  ///< in order of time
};

/// Events of one kind in one joint.
struct EventKind {
  std::string joint, what;
  int count = 0;
  double first = 0, last = 0;   ///< [s]
  double fastest_approach = 0;  ///< for touches, else 0
  std::string approach_unit;    ///< "m/s", "rad/s"
  double most_heat = 0;         ///< since the joint's previous event [J]
};

/// Where a pin with clearance and its bush rub against each other: the integral of the normal force over the sliding distance, which Archard's law
/// multiplies, by sectors of equal width that begin at the x axis of the first marker (bush) and of the second one (pin), counter-clockwise.
/// theory/bearing_life section 5
struct JointWear {
  std::string joint;
  std::vector<double> bush, pin;  ///< [N*m]
};

/// How far a pin has turned in its bush and under which force, from curves within the steps. theory/bearing_life section 1
struct PinDuty {
  std::string joint;
  double path = 0, swing = 0;       ///< angle, both directions added up; from the smallest angle to the largest [rad]
  double peak_rate = 0;             ///< of the angle, absolute value [rad/s]
  double load = 0, load_3 = 0, load_10_3 = 0;  ///< integrals of |F|^p over the path, p = 1, 3, 10/3 [N^p*rad]
  double peak_power = 0;            ///< of |F| times the rate [N*rad/s]
};

struct Trajectory {
  std::vector<Column> columns;    ///< the first is the time
  std::vector<double> values;     ///< row-major, n_rows x columns.size()
  std::size_t n_rows() const { return columns.empty() ? 0 : values.size() / columns.size(); }
  double at(std::size_t row, std::size_t column) const { return values[row * columns.size() + column]; }
  int column(const std::string& name) const;  ///< index, or -1

  std::vector<LoadSummary> joints;
  std::vector<LoadSummary> springs;
  std::vector<MotorSummary> motors;
  std::vector<BearingSummary> bearings;  ///< of the joints whose bearing is stated in the model
  EnergyAccount energy;
  std::vector<JointEvents> events;  ///< of joints that have any; empty for a run that was read back
  std::vector<EventKind> event_kinds;  ///< of a run that was read back
  std::vector<JointWear> wear;      ///< of pins with clearance
  std::vector<PinDuty> duty;        ///< of joints that turn freely; empty for runs of version 0.3.0 and earlier
  Counters counters;
  std::string method;        ///< the method used
  double tolerance = 0;      ///< asked for
  bool of_motion = false;    ///< the tolerance applied to the motion, not to the joint forces
  double motion_error = 0;   ///< in that case: largest estimated error of a body's position, relative to the longest distance that a body has travelled [-]
  double wall_seconds = 0;   ///< assembly and integration
  Outcome outcome = Outcome::kCompleted;
  Growth growth;
  double t_end = 0;          ///< time reached [s]
  std::string message;       ///< why it stopped early: time, step, the worst joints
  std::vector<std::string> notes;  ///< what was assumed: assembled positions, opened distances, free lengths
};

}  // namespace pintle
