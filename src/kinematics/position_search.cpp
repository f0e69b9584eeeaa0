#include "kinematics/position_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pintle {
namespace {

using S = Planar;

// The stiffness of each gap component, 0 where a joint is open or free.
Vecs joint_weights(const System& system, const std::vector<bool>& open) {
  Vecs w(system.joints.size(), S::Vec::Zero());
  for (std::size_t j = 0; j < w.size(); ++j) {
    if (open[j]) continue;
    w[j] = system.joints[j].law.engaged_stiffness();
  }
  return w;
}

double energy(const System& system, const Vecs& w, const std::vector<JointKinematics>& r) {
  double sum = 0;
  for (std::size_t j = 0; j < w.size(); ++j) {
    const S::Vec gap = gap_to_close(system.joints[j], r[j]);
    sum += 0.5 * gap.dot(w[j].cwiseProduct(gap));
  }
  return sum;
}

}  // namespace

LeastSquares::LeastSquares(const System& system)
    : system_(system), free_(system.bodies.size(), S::Vec::Ones()), slots_(system.joints.size()), lu_(system.pattern(), Symmetry::kSymmetric),
      x_(system.bodies.size()), pull_(system.bodies.size()), solution_(system.bodies.size()) {
  for (std::size_t j = 0; j < slots_.size(); ++j) {
    const Placement& at = system.joints[j].at;
    if (at.a != kGround && at.b != kGround) slots_[j] = system.pattern().slot(at.a, at.b);
  }
}

bool LeastSquares::prepare(const std::vector<JointKinematics>& r, const Vecs& joint_weight, const Vecs& body_weight) {
  lu_.set_diagonal([&](int b, int k) { return body_weight[b][k]; });
  const auto add = [](Block<double, S::kDof>& target, const S::Mat& block) {
    for (int a = 0; a < S::kDof; ++a)
      for (int b = 0; b < S::kDof; ++b) target(a, b) += block(a, b);
  };
  for (int j = 0; j < system_.n_joints(); ++j) {
    const Placement& at = system_.joints[j].at;
    S::Mat GA = r[j].GA(), GB = r[j].GB();
    if (at.a != kGround) GA = GA * free_[at.a].asDiagonal();
    if (at.b != kGround) GB = GB * free_[at.b].asDiagonal();
    const S::Mat WA = joint_weight[j].asDiagonal() * GA, WB = joint_weight[j].asDiagonal() * GB;
    if (at.a != kGround) add(lu_.diagonal(at.a), GA.transpose() * WA);
    if (at.b != kGround) add(lu_.diagonal(at.b), GB.transpose() * WB);
    if (at.a == kGround || at.b == kGround) continue;
    if (slots_[j].upper) add(lu_.off_diagonal(slots_[j]), GA.transpose() * WB);
    else add(lu_.off_diagonal({slots_[j].index, true}), GB.transpose() * WA);
  }
  return lu_.factorize();
}

const Vecs& LeastSquares::pull(const std::vector<JointKinematics>& r, const Vecs& joint_weight, const Vecs& gap) {
  for (S::Vec& f : pull_) f.setZero();
  for (int j = 0; j < system_.n_joints(); ++j) {
    const S::Vec w = joint_weight[j].cwiseProduct(gap[j]);
    add_force(system_.joints[j].at, r[j], w, pull_);
  }
  for (std::size_t i = 0; i < pull_.size(); ++i) pull_[i] = pull_[i].cwiseProduct(free_[i]);
  return pull_;
}

const Vecs& LeastSquares::solve(const Vecs& rhs) {
  for (std::size_t i = 0; i < rhs.size(); ++i) x_[i] = {{rhs[i][0], rhs[i][1], rhs[i][2]}};
  lu_.solve(x_);
  for (std::size_t i = 0; i < rhs.size(); ++i) solution_[i] = S::Vec(x_[i][0], x_[i][1], x_[i][2]);
  return solution_;
}

void kinematics_at(const System& system, double t, const Vecs& q, const Vecs& v, std::vector<S::Motion>& m, std::vector<JointKinematics>& r) {
  system.motions(q, v, m);
  system.joint_kinematics(t, m, r);
}

S::Vec gap_to_close(const JointData& joint, const JointKinematics& r) { return joint.law.misfit(r.gap); }

double mechanism_size(const System& system, const Vecs& q) {
  double size = 1e-6;
  for (const auto& x : q) size = std::max({size, std::abs(x[0]), std::abs(x[1])});
  for (const JointData& joint : system.joints) size = std::max({size, joint.at.F.p.norm(), joint.at.M.p.norm()});
  return size;
}

PositionSearch::PositionSearch(const Model& model, const System& system, const std::vector<bool>& open)
    : model_(model), system_(system), equations_(system), weight_(joint_weights(system, open)) {
  for (int i = 0; i < system.n_bodies(); ++i)
    for (int k = 0; k < S::kDof; ++k)
      if (model.bodies[i].hold[k]) equations_.hold(i, k);
}

void PositionSearch::run(Vecs& q, int max_iterations) {
  const Vecs still(q.size(), S::Vec::Zero());
  kinematics_at(system_, 0, q, still, m_, r_);
  double now = energy(system_, weight_, r_), damping = 1e-3;
  const Vecs body = body_weights(q);
  Vecs gaps(r_.size()), damped, trial;
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    for (std::size_t j = 0; j < gaps.size(); ++j) gaps[j] = -gap_to_close(system_.joints[j], r_[j]);
    damped = body;
    for (auto& d : damped) d *= damping;
    if (!equations_.prepare(r_, weight_, damped)) { damping *= 10; continue; }
    const Vecs& move = equations_.solve(equations_.pull(r_, weight_, gaps));
    trial = q;
    double step = 0;
    for (std::size_t i = 0; i < q.size(); ++i) {
      trial[i] += move[i];
      step = std::max(step, move[i].cwiseAbs().maxCoeff());
    }
    kinematics_at(system_, 0, trial, still, m_, r_);
    const double next = energy(system_, weight_, r_);
    if (next <= now && std::isfinite(next)) {
      q = trial;
      const bool settled = step < 1e-15 * mechanism_size(system_, q) || (now - next <= 1e-14 * now && step < 1e-10);
      now = next;
      damping = std::max(damping * 0.1, 1e-12);
      if (settled) return;
    } else {
      kinematics_at(system_, 0, q, still, m_, r_);
      damping *= 10;
      if (damping > 1e12 || step < 1e-15) return;
    }
  }
}

// How much each coordinate resists being moved: stated ones more than unstated ones.
Vecs PositionSearch::body_weights(const Vecs& q) const {
  double stiffest = 0;
  for (const auto& w : weight_) stiffest = std::max(stiffest, w.maxCoeff());
  if (!(stiffest > 0)) stiffest = 1;
  const double size = mechanism_size(system_, q);
  Vecs weights(q.size());
  for (std::size_t i = 0; i < q.size(); ++i) {
    const Body& body = model_.bodies[i];
    const double place = body.position ? 1 : 1e-3, turn = body.angle ? 1 : 1e-3;
    weights[i] = stiffest * S::Vec(place, place, turn * size * size);
  }
  return weights;
}

}  // namespace pintle
