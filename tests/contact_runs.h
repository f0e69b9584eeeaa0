// Runs that record where the laws of contacts change their state.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "integrators/methods.h"
#include "tests/reference_tables.h"

namespace pintle::contacts {

constexpr int kTouch = 0, kLetGo = 1;

// A touch or a release: when, which of the two, and in which joint.
struct Contact {
  double t;
  int border;
  int joint;
};

struct Followed {
  std::vector<Contact> contacts;
  std::vector<State> touched;  // the states just after them
  State end;
  Counters counters;
};

// The borders that the laws cross; steps end there.
inline Followed follow(const Model& model, double tolerance, double t_end, MethodChoice choice) {
  const Assembly assembly = start_of_run(model);
  const System& system = assembly.system;
  const State& start = assembly.state;
  choice.equations = model.simulate.equations;
  const auto stepper = make_stepper(system, choice, tolerance);
  stepper->start(start, 1e-4 * t_end);
  Followed out;
  std::vector<double> states = start.law_state;
  while (stepper->state().t < t_end) {
    if (!stepper->step(t_end)) {
      ADD_FAILURE() << stepper->failure();
      break;
    }
    const State& begin = stepper->previous();  // after whatever has been crossed before this step
    for (std::size_t z = 0; z < states.size(); ++z)
      if ((states[z] > 0) != (begin.law_state[z] > 0)) {
        int joint = 0;
        for (int j = 0; j < system.n_joints(); ++j)
          if (system.joints[j].law.n_states() > 0 && system.joints[j].first_state == static_cast<int>(z)) joint = j;
        out.contacts.push_back({begin.t, states[z] > 0 ? kLetGo : kTouch, joint});
        out.touched.push_back(begin);
      }
    states = begin.law_state;
  }
  out.end = stepper->state();
  out.counters = stepper->counters();
  return out;
}

}  // namespace pintle::contacts
