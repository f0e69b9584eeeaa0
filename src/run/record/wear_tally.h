// What pins with clearance and their bushes wear off each other, by sectors around them. theory/bearing_life section 5.
#pragma once

#include <vector>

#include "pintle/trajectory.h"
#include "system/state.h"

namespace pintle {

template <class S>
class BasicWearTally {
 public:
  static constexpr int kSectors = 72;

  /// Of the joints whose law tells `wear_power` and `contact_angle`.
  explicit BasicWearTally(const BasicSystem<S>& system);

  bool empty() const { return worn_.empty(); }
  /// Into how many equal parts a step must be divided so that in each pins and contacts turn by a small part of a sector; 0: they hardly turn.
  int parts(const BasicState<S>& begin, const BasicState<S>& end) const;
  /// A state that stands for so many seconds.
  void add(const BasicState<S>& state, double seconds);
  std::vector<JointWear> result() const;

 private:
  struct Worn {
    int joint;
    std::size_t power, angle;  // columns of its law
    JointWear wear;
  };

  const std::vector<double>& observe(const Worn& worn, const BasicState<S>& state) const;

  const BasicSystem<S>& system_;
  std::vector<Worn> worn_;
  mutable std::vector<double> observed_;  // reused so that steps do not allocate
};
using WearTally = BasicWearTally<Planar>;

}  // namespace pintle
