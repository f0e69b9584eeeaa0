// Rubber: a spring and a damper, and beside them branches that relax: springs in series with dampers (a generalised Maxwell body; in
// finite elements a Prony series). J. D. Ferry, Viscoelastic Properties of Polymers, Wiley 1980, chapter 3.
//
//   f = -(k e + c e') - sum_i k_i (e - z_i),     z_i' = (e - z_i) / tau_i        theory/joints Eq. (3.11)
//   V = 1/2 k e^2 + 1/2 sum_i k_i (e - z_i)^2
//   P = c e'^2 + sum_i k_i (e - z_i)^2 / tau_i
//
// z_i is how far the damper of a branch has followed. Held at a gap, the force relaxes from (k + sum k_i) e to k e; under a constant
// force the joint creeps.
#pragma once

#include <string_view>
#include <vector>

#include "laws/law_numbers.h"
#include "space/planar.h"

namespace pintle {

struct MaxwellLaw {
  static constexpr std::string_view kWord = "maxwell";
  struct Branch {
    int component = 0;
    double k = 0;    // > 0 [N/m] or [N*m/rad]
    double tau = 1;  // > 0 [s]
  };
  Planar::Vec k = Planar::Vec::Zero();  // what is left when all branches have relaxed [N/m, N/m, N*m/rad]
  Planar::Vec c = Planar::Vec::Zero();  // [N*s/m, N*s/m, N*m*s/rad]
  std::vector<Branch> branches;         // one state each

  static MaxwellLaw typical() { return {{1e6, 2e6, 300}, {200, 100, 0.5}, {{0, 5e5, 0.01}, {0, 2e5, 0.3}, {1, 1e6, 0.01}, {2, 200, 0.02}}}; }

  int n_states() const { return static_cast<int>(branches.size()); }
  template <class T>
  void evaluate(const LawInput<T>& in, LawOutput<T>& out) const {
    for (int i = 0; i < 3; ++i) {
      out.force[i] = -(k[i] * in.gap[i] + c[i] * in.rate[i]);
      out.energy += 0.5 * k[i] * (in.gap[i] * in.gap[i]);
      out.loss += c[i] * (in.rate[i] * in.rate[i]);
    }
    for (std::size_t b = 0; b < branches.size(); ++b) {
      const Branch& branch = branches[b];
      const T stretch = in.gap[branch.component] - in.state[b], force = branch.k * stretch;
      out.force[branch.component] -= force;
      out.state_rate[b] = (1 / branch.tau) * stretch;
      out.energy += 0.5 * (force * stretch);
      out.loss += (1 / branch.tau) * (force * stretch);
    }
  }
  void rest(const LawInput<double>& in, double* state) const {
    for (std::size_t b = 0; b < branches.size(); ++b) state[b] = in.gap[branches[b].component];
  }
  Planar::Vec engaged_stiffness() const { return k; }
};

}  // namespace pintle
