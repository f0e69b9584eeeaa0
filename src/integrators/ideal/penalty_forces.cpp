#include "integrators/ideal/penalty_forces.h"

#include "integrators/force_evaluator.h"

namespace pintle {

PenaltyForces::PenaltyForces(const System& system, const PenaltySettings& penalty)
    : system_(system), equations_(system, Equations::kPenalty, penalty), none_(system.joints.size(), Planar::Vec::Zero()), iterate_(zero_state(system)) {}

// M a of theory/penalty Eq. (1.1).
void PenaltyForces::find_forces(double t, const Vecs& q, const Vecs& v, Vecs& F) {
  iterate_.t = t;
  iterate_.q = q;
  iterate_.v = v;
  equations_.complete(iterate_);
  for (int i = 0; i < system_.n_bodies(); ++i) F[i] = system_.bodies[i].mass.cwiseProduct(iterate_.a[i]);
}

bool PenaltyForces::project(double t, const Vecs& q, Vecs& v, Vecs&) {
  equations_.look_at(t, q, v);
  equations_.measure_violation();
  return true;
}

}  // namespace pintle
