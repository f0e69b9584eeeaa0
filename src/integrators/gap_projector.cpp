#include "integrators/gap_projector.h"

#include <algorithm>

namespace pintle {
namespace {

using S = Planar;

void add_block(Block<double, S::kDof>& block, const S::Mat& m) {
  for (int i = 0; i < S::kDof; ++i)
    for (int j = 0; j < S::kDof; ++j) block(i, j) += m(i, j);
}

}  // namespace

GapProjector::GapProjector(const System& system)
    : system_(system), lu_(system.pattern()), readings_(system.joints.size()), weight_(system.joints.size()),
      slots_(system.joints.size()), work_(system.bodies.size()), body_(system.bodies.size()),
      accel_(system.bodies.size()), missing_(system.joints.size()) {
  for (std::size_t j = 0; j < slots_.size(); ++j) {
    const Placement& at = system.joints[j].at;
    if (at.a != kGround && at.b != kGround) slots_[j] = system.pattern().slot(at.a, at.b);
  }
}

bool GapProjector::prepare(double t, const std::vector<S::Motion>& m, double mu, const Vecs& gap_at, const Vecs& rate_at,
                           const Vecs* moved) {
  mu_ = mu;
  system_.readings(t, m, readings_);
  lu_.set_zero();
  for (int i = 0; i < system_.n_bodies(); ++i)
    add_block(lu_.diagonal(i), S::Mat((mu * mu * system_.bodies[i].mass).asDiagonal()));
  for (int j = 0; j < system_.n_joints(); ++j) {
    const Placement& at = system_.joints[j].at;
    const Reading& r = readings_[j];
    const Response response = respond(system_.joints[j].law, gap_at[j], rate_at[j]);
    weight_[j] = response.stiffness + mu * response.damping;
    if (moved) weight_[j] = (*moved)[j].asDiagonal() * weight_[j] * (*moved)[j].asDiagonal();
    const S::Mat WA = weight_[j] * r.GA, WB = weight_[j] * r.GB;
    if (at.a != kGround) add_block(lu_.diagonal(at.a), r.GA.transpose() * WA);
    if (at.b != kGround) add_block(lu_.diagonal(at.b), r.GB.transpose() * WB);
    if (at.a == kGround || at.b == kGround) continue;
    BlockPattern::Slot ab = slots_[j];
    add_block(lu_.off_diagonal(ab), r.GA.transpose() * WB);
    ab.upper = !ab.upper;
    add_block(lu_.off_diagonal(ab), r.GB.transpose() * WA);
  }
  return lu_.factorize();
}

void GapProjector::solve(Vecs& x) {
  for (std::size_t i = 0; i < x.size(); ++i) work_[i] = {{x[i][0], x[i][1], x[i][2]}};
  lu_.solve(work_);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = S::Vec(work_[i][0], work_[i][1], work_[i][2]);
}

void GapProjector::close(const Vecs& wanted, Vecs& x) {
  for (auto& b : body_) b.setZero();
  for (int j = 0; j < system_.n_joints(); ++j) {
    const S::Vec f = weight_[j] * wanted[j];
    add_force(system_.joints[j].at, readings_[j], f, body_);
  }
  solve(body_);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += body_[i];
}

void GapProjector::close(const std::vector<Three>& wanted, std::vector<Three>& x) const {
  std::fill(x.begin(), x.end(), Three{});
  const auto push = [](const S::Mat& G, const Three& f, Three& on) {
    for (int r = 0; r < S::kDof; ++r)
      for (int k = 0; k < S::kDof; ++k) on[k] += G(r, k) * f[r];
  };
  for (int j = 0; j < system_.n_joints(); ++j) {
    const Placement& at = system_.joints[j].at;
    Three f{};
    for (int r = 0; r < S::kDof; ++r)
      for (int k = 0; k < S::kDof; ++k) f[r] += weight_[j](r, k) * wanted[j][k];
    if (at.a != kGround) push(readings_[j].GA, f, x[at.a]);
    if (at.b != kGround) push(readings_[j].GB, f, x[at.b]);
  }
  lu_.solve(x);
}

// theory/time Eq. (4.4).
void GapProjector::improve_forces(const Vecs& Q, const Vecs& a, Vecs& force) {
  for (int i = 0; i < system_.n_bodies(); ++i) body_[i] = Q[i] - system_.bodies[i].mass.cwiseProduct(a[i]);
  for (int j = 0; j < system_.n_joints(); ++j) add_force(system_.joints[j].at, readings_[j], force[j], body_);
  solve(body_);
  for (int j = 0; j < system_.n_joints(); ++j) {
    S::Vec gap = S::Vec::Zero();
    add_gap(system_.joints[j].at, readings_[j], body_, gap);
    force[j] -= weight_[j] * gap;
  }
}

// theory/time Eq. (4.5).
void GapProjector::balance(const Vecs& Q, const Vecs& gap_accel, Vecs& force) {
  accel_ = Q;
  for (int j = 0; j < system_.n_joints(); ++j) add_force(system_.joints[j].at, readings_[j], force[j], accel_);
  for (int i = 0; i < system_.n_bodies(); ++i) accel_[i] = accel_[i].cwiseQuotient(system_.bodies[i].mass);
  const auto take_off = [&](const Vecs& a) {
    for (int j = 0; j < system_.n_joints(); ++j) subtract_gap(system_.joints[j].at, readings_[j], a, missing_[j]);
  };
  for (int j = 0; j < system_.n_joints(); ++j) missing_[j] = gap_accel[j] - readings_[j].bias;
  take_off(accel_);
  for (auto& x : accel_) x.setZero();
  close(missing_, accel_);
  take_off(accel_);
  for (int j = 0; j < system_.n_joints(); ++j) force[j] += weight_[j] * missing_[j] / (mu_ * mu_);
}

}  // namespace pintle
