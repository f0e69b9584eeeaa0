#include "bench/flat_equations.h"

#include <algorithm>
#include <array>

namespace pintle::bench {
namespace {

using S = Planar;

const S::Motion kStill{};

}  // namespace

FlatEquations::FlatEquations(const System& system)
    : system_(system), q_(system.bodies.size()), v_(system.bodies.size()), a_(system.bodies.size()) {
  const std::size_t blocks = system.bodies.size() * system.bodies.size();
  coupled_.assign(blocks, 0);
  by_q_.assign(blocks, S::Mat::Zero());
  by_v_.assign(blocks, S::Mat::Zero());
  for (int i = 0; i < system.n_bodies(); ++i) coupled_[place(i, i)] = 1;
  const auto couple = [this](const Placement& at) {
    if (at.a == kGround || at.b == kGround) return;
    coupled_[place(at.a, at.b)] = coupled_[place(at.b, at.a)] = 1;
  };
  for (const JointData& joint : system.joints) couple(joint.at);
  for (const LoadData& load : system.loads) couple(load.at);
}

void FlatEquations::flatten(const Vecs& q, const Vecs& v, double* y) const {
  const int half = 3 * system_.n_bodies();
  for (int i = 0; i < system_.n_bodies(); ++i)
    for (int k = 0; k < 3; ++k) {
      y[3 * i + k] = q[i][k];
      y[half + 3 * i + k] = v[i][k];
    }
}

void FlatEquations::unflatten(const double* y, Vecs& q, Vecs& v) const {
  const int half = 3 * system_.n_bodies();
  q.resize(system_.bodies.size());
  v.resize(system_.bodies.size());
  for (int i = 0; i < system_.n_bodies(); ++i) {
    q[i] = S::Vec(y[3 * i], y[3 * i + 1], y[3 * i + 2]);
    v[i] = S::Vec(y[half + 3 * i], y[half + 3 * i + 1], y[half + 3 * i + 2]);
  }
}

void FlatEquations::rate(double t, const double* y, double* dy) {
  unflatten(y, q_, v_);
  system_.accelerations(t, q_, v_, a_);
  flatten(v_, a_, dy);
}

// d/dq and d/dv of G' law(gap, rate).
void FlatEquations::add_joint(int j, double t) {
  const JointData& joint = system_.joints[j];
  const std::array<int, 2> body{joint.at.a, joint.at.b};
  const S::Motion &A = body[0] == kGround ? kStill : motions_[body[0]],
                  &B = body[1] == kGround ? kStill : motions_[body[1]];
  const Reading r = system_.reading(j, t, motions_);
  const Response law = respond(joint.law, r.gap, r.rate);
  const auto geometric = geometric_stiffness(joint.probe, system_.pose(joint.at, motions_), law.force);
  const auto rate_by_q = rate_gradient(joint.probe, system_.pose(joint.at, motions_), A, B);
  const std::array<const S::Mat*, 2> G{&r.GA, &r.GB};
  for (int row = 0; row < 2; ++row)
    for (int column = 0; column < 2; ++column) {
      if (body[row] == kGround || body[column] == kGround) continue;
      const S::Mat force_by_q = -law.stiffness * *G[column] - law.damping * rate_by_q.block<3, 3>(0, 3 * column);
      by_q_[place(body[row], body[column])] +=
          geometric.block<3, 3>(3 * row, 3 * column) + G[row]->transpose() * force_by_q;
      by_v_[place(body[row], body[column])] -= G[row]->transpose() * law.damping * *G[column];
    }
}

void FlatEquations::linearize(double t, const double* y) {
  unflatten(y, q_, v_);
  system_.motions(q_, v_, motions_);
  std::fill(by_q_.begin(), by_q_.end(), S::Mat::Zero());
  std::fill(by_v_.begin(), by_v_.end(), S::Mat::Zero());
  for (int j = 0; j < system_.n_joints(); ++j) add_joint(j, t);
  system_.external_tangents(t, motions_, [this](int i, int j, const S::Mat& dq, const S::Mat& dv) {
    by_q_[place(i, j)] += dq;
    by_v_[place(i, j)] += dv;
  });
  for (int i = 0; i < system_.n_bodies(); ++i)
    for (int j = 0; j < system_.n_bodies(); ++j) {
      by_q_[place(i, j)] = system_.bodies[i].mass.cwiseInverse().asDiagonal() * by_q_[place(i, j)];
      by_v_[place(i, j)] = system_.bodies[i].mass.cwiseInverse().asDiagonal() * by_v_[place(i, j)];
    }
}

}  // namespace pintle::bench
