// Rubber: a spring and a damper in parallel with relaxing branches, which are springs in series with dampers (a generalised Maxwell
// body; in finite elements a Prony series). J. D. Ferry, Viscoelastic Properties of Polymers, Wiley 1980, chapter 3.
//
//   f = -(k e + c e') - sum_i k_i (e - z_i),     z_i' = (e - z_i) / tau_i        theory/joints Eq. (3.11)
//   V = 1/2 k e^2 + 1/2 sum_i k_i (e - z_i)^2
//   P = c e'^2 + sum_i k_i (e - z_i)^2 / tau_i
//
// z_i is the displacement of the damper of a branch. Held at a gap, the force relaxes from (k + sum k_i) e to k e; under a constant
// force the joint creeps.
//
// In the held lengths e the relaxed spring may harden, and filled rubber has internal friction, independent of speed (P. R. Dahl, The Aerospace Corp.
// TOR-0158, 1968; M. Berg, Veh. Syst. Dyn. 30 (1998) 197):
//   V = 1/2 q (1 + 1/2 a r^2),  q = sum k_i e_i^2,  r^2 = sum e_i^2              Eq. (3.21)
//   f = -(F_h/x_h) z,   z' = e' - |e'| z/x_h                                     Eq. (3.22)
// so that |f| is at most F_h, which it approaches within a few x_h. Stored: F_h/x_h |z|^2/2; lost: F_h |e'| |z|^2/x_h^2.
#pragma once

#include <string_view>
#include <vector>

#include "laws/law_math.h"
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
  Planar::Vec k = Planar::Vec::Zero();  // stiffness when all branches have relaxed [N/m, N/m, N*m/rad]
  Planar::Vec c = Planar::Vec::Zero();  // [N*s/m, N*s/m, N*m*s/rad]
  std::vector<Branch> branches;         // one state each
  double hardening = 0;                 // a [1/m^2]
  double hysteresis_force = 0, hysteresis_displacement = 1;  // F_h, x_h; one state for each held length [N], [m]
  std::vector<int> lengths;             // held lengths in which it hardens or has internal friction

  static MaxwellLaw typical() { return {{1e6, 2e6, 300}, {200, 100, 0.5}, {{0, 5e5, 0.01}, {0, 2e5, 0.3}, {1, 1e6, 0.01}, {2, 200, 0.02}}, 1e6, 300, 2e-4, {0, 1}}; }

  int n_states() const { return static_cast<int>(branches.size() + (has_hysteresis() ? lengths.size() : 0)); }
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
    if (hardening > 0) harden(in, out);
    if (has_hysteresis()) rub_inside(in, out);
  }
  void rest(const LawInput<double>& in, double* state) const {
    for (std::size_t b = 0; b < branches.size(); ++b) state[b] = in.gap[branches[b].component];
    for (std::size_t i = branches.size(); i < static_cast<std::size_t>(n_states()); ++i) state[i] = 0;
  }
  Planar::Vec engaged_stiffness() const { return k; }

 private:
  bool has_hysteresis() const { return hysteresis_force > 0; }
  template <class T>
  void harden(const LawInput<T>& in, LawOutput<T>& out) const {
    T q(0.0), r2(0.0);
    for (const int i : lengths) {
      q += k[i] * (in.gap[i] * in.gap[i]);
      r2 += in.gap[i] * in.gap[i];
    }
    for (const int i : lengths) out.force[i] -= (0.5 * hardening) * ((k[i] * r2 + q) * in.gap[i]);  // (3.21)
    out.energy += (0.25 * hardening) * (q * r2);
  }
  template <class T>
  void rub_inside(const LawInput<T>& in, LawOutput<T>& out) const {
    using namespace law_math;
    const std::size_t first = branches.size();
    const double stiffness = hysteresis_force / hysteresis_displacement;
    T speed_squared(0.0), stretch_squared(0.0);
    for (std::size_t i = 0; i < lengths.size(); ++i) {
      speed_squared += in.rate[lengths[i]] * in.rate[lengths[i]];
      stretch_squared += in.state[first + i] * in.state[first + i];
    }
    const T share = (1 / hysteresis_displacement) * sqrt(speed_squared);
    for (std::size_t i = 0; i < lengths.size(); ++i) {
      const T z = in.state[first + i];
      out.force[lengths[i]] -= stiffness * z;                               // (3.22)
      out.state_rate[first + i] = in.rate[lengths[i]] - share * z;          // (3.22)
    }
    out.energy += (0.5 * stiffness) * stretch_squared;
    out.loss += stiffness * (share * stretch_squared);
  }
};

}  // namespace pintle
