// A part of a law that does nothing. It has as many states as the part, or the law, whose place it takes while a start is computed, so that the states of all laws keep their places.
#pragma once

#include <string_view>

#include "laws/law.h"

namespace pintle {

struct InertStates {
  static constexpr std::string_view kWord = "inert states";
  static constexpr bool kHolds = false, kRubs = false;
  int states = 0;

  int n_states() const { return states; }
  template <class T>
  void evaluate(const LawInput<T>&, LawOutput<T>&) const {}
};

inline std::unique_ptr<BasicLawPart<Planar>> inert_states(int states) { return BasicLaw<Planar>(InertStates{states}).parts().front()->clone(); }

}  // namespace pintle
