// Steps look at what they pass: a notch, a bump of an edge or the lift of a cam may be shorter than the way between two stages. theory/time section 3.4.
#pragma once

#include <vector>

#include "base/bends.h"
#include "system/system.h"

namespace pintle {

template <class S>
class BasicBendWatch {
 public:
  explicit BasicBendWatch(const BasicSystem<S>& system);

  /// The share of a step that leads to the second bend on the way of a joint, with the motions at its start and its end; 1: no joint passes two.
  double share_of_step(const std::vector<typename S::Motion>& start, const std::vector<typename S::Motion>& end) const;

 private:
  struct Way {
    int joint, component;  // component: of the gap; -1: along the profile of the joint's edge or cam
    Bends bends;
  };
  double place(const Way& way, const std::vector<typename S::Motion>& m) const;
  double end_of(const Way& way, double from, const std::vector<typename S::Motion>& start, const std::vector<typename S::Motion>& end) const;

  const BasicSystem<S>& system_;
  std::vector<Way> ways_;
};
using BendWatch = BasicBendWatch<Planar>;

}  // namespace pintle
