// Checks the energy of a motion step by step: whether its account closes, and whether it runs away. theory/time section 8.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "run/limits/torn_joints.h"
#include "system/state.h"

namespace pintle {

template <class S>
class BasicEnergyWatch {
 public:
  enum class Alarm { kNone, kRunaway, kOpen };

  /// For a motion of `duration` [s] whose forces are to be accurate to `tolerance` [-]. `exact_work`: the method integrates work as accurately as the
  /// motion; otherwise the account is judged loosely. `counts_turns`: the method follows belts however far they are wound; otherwise they are watched.
  BasicEnergyWatch(const BasicSystem<S>& system, double duration, double tolerance, bool exact_work, bool counts_turns);

  /// Sets the energy turned over by the earlier integration whose loads serve as the error scale of this one [J].
  void expect(double turnover) { expected_ = turnover; }
  /// The energy turned over so far. Eq. (8.2)
  double turnover() const;

  void start(const BasicState<S>& state);
  /// Call at the end of each step; h [s] is its length.
  Alarm see_step(const BasicState<S>& state, double h);
  /// Call at the end of the motion: the account is judged once more.
  Alarm see_end(const BasicState<S>& state);
  /// Names the element that has fed the motion far more than the mechanism stores by itself; empty if there is none.
  std::string note_on_feeder() const;
  /// Describes the last alarm.
  const std::string& message() const { return message_; }

 private:
  struct Feeder {
    const char* kind;
    const std::string* name;
    bool listens;     // depends on the motion, not on time alone, so that a sign may be wrong
    double work = 0;  // [J]
  };
  Alarm check_energy_account(const BasicState<S>& state);
  Alarm check_energy_growth(const BasicState<S>& state);
  Alarm check_torn_joints(const BasicState<S>& state);
  void add_works(const BasicState<S>& state, double h);
  double potential(const BasicState<S>& state);
  double load_work_over_distance(const BasicState<S>& state, double distance);
  double flow(const BasicState<S>& state);
  void describe_energy_imbalance(const BasicState<S>& state, double missing, double within);
  void describe_runaway(const BasicState<S>& state, double energy, const std::string& how);
  const Feeder* largest_feeder() const;

  static constexpr int kDecades = 64;  // number of powers of ten of the storable energy whose times are kept
  const BasicSystem<S>& system_;
  double duration_, tolerance_;
  bool exact_work_;
  BasicDeflectionScale<S> deflection_;
  double storable_ = 0;                  // Eq. (8.3): stored at the start, and by its weights and loads over its size [J]
  double total_ = 0, potential_ = 0;     // at the start [J]
  double kinetic_peak_ = 0, swing_ = 0;  // largest kinetic energy, largest change of potential energy [J]
  double kinetic_ = 0, exchanged_ = 0;   // at the last step; sum of the absolute changes [J]
  double expected_ = 0;                  // turnover of an earlier integration [J]
  double throughput_ = 0;                // absolute work of all supplies and losses [J]
  double flow_ = 0;                      // its rate at the last step [W]
  double missing_ = 0;                   // error of the account when last judged [J]
  int since_judged_ = 0;
  int reached_ = 0;                      // powers of ten of `storable_` reached
  double decade_[kDecades] = {};         // when they were reached [s]
  std::vector<typename S::Motion> m_;
  std::vector<Feeder> feeders_;          // joints, loads, applied forces
  std::vector<int> belts_;                     // joints that wind, but whose turns are not counted
  std::vector<int> drives_;                    // joints that are driven
  std::vector<int> lengths_;                   // those driven by their length
  std::string message_;
};
using EnergyWatch = BasicEnergyWatch<Planar>;

}  // namespace pintle
