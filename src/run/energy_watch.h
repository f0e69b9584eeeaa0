// Follows the energy of a motion from step to step: whether its account closes, and whether it runs away. theory/time section 8.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "system/state.h"

namespace pintle {

template <class S>
class BasicEnergyWatch {
 public:
  enum class Alarm { kNone, kRunaway, kOpen };

  /// A motion of `duration` [s] whose forces are to be right to `tolerance` [-]. `exact_work`: the method integrates works as it does the
  /// motion, so that the account is as accurate; otherwise it is not judged. `counts_turns`: it follows belts however far they are wound; otherwise they are watched.
  BasicEnergyWatch(const BasicSystem<S>& system, double duration, double tolerance, bool exact_work, bool counts_turns);

  /// The energy that an earlier integration of the same motion has turned over, by whose loads this one measures its errors [J].
  void expect(double turnover) { expected_ = turnover; }
  /// The energy turned over so far. Eq. (8.2)
  double turnover() const;

  void start(const BasicState<S>& state);
  /// The end of a step of h seconds.
  Alarm see_step(const BasicState<S>& state, double h);
  /// The end of the motion: the account is judged once more.
  Alarm see_end(const BasicState<S>& state);
  /// What has fed the motion far more than the mechanism stores by itself, in words; empty: nothing has.
  std::string note_on_feeder() const;
  /// What the last alarm was about.
  const std::string& message() const { return message_; }

 private:
  struct Feeder {
    const char* kind;
    const std::string* name;
    bool listens;     // to the motion, so that a sign may be wrong: not to the time alone
    double work = 0;  // [J]
  };
  Alarm judge_account(const BasicState<S>& state);
  Alarm judge_growth(const BasicState<S>& state);
  void add_works(const BasicState<S>& state, double h);
  double potential(const BasicState<S>& state);
  double flow(const BasicState<S>& state);
  void say_open(const BasicState<S>& state, double missing, double within);
  void say_runaway(const BasicState<S>& state, double energy);
  const Feeder* largest_feeder() const;

  static constexpr int kDecades = 64;  // powers of ten above the storable energy whose instants are kept
  const BasicSystem<S>& system_;
  double duration_, tolerance_;
  bool exact_work_;
  double storable_ = 0;                  // what the mechanism stores at the start, or its weights over its size [J]
  double total_ = 0, potential_ = 0;     // at the start [J]
  double kinetic_peak_ = 0, swing_ = 0;  // largest kinetic energy, largest change of the potential one [J]
  double kinetic_ = 0, exchanged_ = 0;   // at the last step; the sum of its changes by their size [J]
  double expected_ = 0;                  // turnover [J]
  double throughput_ = 0;                // of all that supplies and all losses, by their size [J]
  double flow_ = 0;                      // its rate at the last step [W]
  double missing_ = 0;                   // of the account when last judged [J]
  int since_judged_ = 0;
  int reached_ = 0;                      // powers of ten of `storable_`
  double decade_[kDecades] = {};         // when they were [s]
  std::vector<typename S::Motion> m_;
  std::vector<Feeder> feeders_;          // joints, loads, applied forces
  std::vector<int> belts_;                     // joints that wind, and whose turns are not counted
  std::vector<int> drives_;                    // joints that are driven
  std::vector<int> lengths_;                   // of those, the ones by their length
  std::string message_;
};
using EnergyWatch = BasicEnergyWatch<Planar>;

}  // namespace pintle
