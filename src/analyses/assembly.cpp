#include "analyses/assembly.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "analyses/guess.h"
#include "analyses/slow_start.h"
#include "pintle/simulate.h"
#include "solve/block_lu.h"
#include "system/build.h"

namespace pintle {
namespace {

using S = Planar;
using Row = BlockVec<double, S::kDof>;

// Normal equations G' W G + D on the joint graph, D and W diagonal. One object serves positions and velocities.
class LeastSquares {
 public:
  explicit LeastSquares(const System& system) : system_(system), free_(system.bodies.size(), S::Vec::Ones()), lu_(system.pattern()), x_(system.bodies.size()) {}

  void hold(int body, int coordinate) { free_[body][coordinate] = 0; }

  bool prepare(const std::vector<Reading>& r, const Vecs& joint_weight, const Vecs& body_weight) {
    lu_.set_zero();
    for (int i = 0; i < system_.n_bodies(); ++i)
      for (int k = 0; k < S::kDof; ++k) lu_.diagonal(i)(k, k) = body_weight[i][k];
    for (int j = 0; j < system_.n_joints(); ++j) {
      const Placement& at = system_.joints[j].at;
      const std::array<int, 2> body{at.a, at.b};
      std::array<S::Mat, 2> G{r[j].GA(), r[j].GB()};
      for (int x = 0; x < 2; ++x)
        if (body[x] != kGround) G[x] = G[x] * free_[body[x]].asDiagonal();
      for (int x = 0; x < 2; ++x)
        for (int y = 0; y < 2; ++y) {
          if (body[x] == kGround || body[y] == kGround) continue;
          const S::Mat block = G[x].transpose() * joint_weight[j].asDiagonal() * G[y];
          auto& target = x == y ? lu_.diagonal(body[x]) : lu_.off_diagonal(system_.pattern().slot(body[x], body[y]));
          for (int a = 0; a < S::kDof; ++a)
            for (int b = 0; b < S::kDof; ++b) target(a, b) += block(a, b);
        }
    }
    return lu_.factorize();
  }

  // G' W gap
  Vecs pull(const std::vector<Reading>& r, const Vecs& joint_weight, const Vecs& gap) const {
    Vecs f(system_.bodies.size(), S::Vec::Zero());
    for (int j = 0; j < system_.n_joints(); ++j) {
      const S::Vec w = joint_weight[j].cwiseProduct(gap[j]);
      add_force(system_.joints[j].at, r[j], w, f);
    }
    for (std::size_t i = 0; i < f.size(); ++i) f[i] = f[i].cwiseProduct(free_[i]);
    return f;
  }

  Vecs solve(const Vecs& rhs) {
    for (std::size_t i = 0; i < rhs.size(); ++i) x_[i] = {{rhs[i][0], rhs[i][1], rhs[i][2]}};
    lu_.solve(x_);
    Vecs out(rhs.size());
    for (std::size_t i = 0; i < rhs.size(); ++i) out[i] = S::Vec(x_[i][0], x_[i][1], x_[i][2]);
    return out;
  }

 private:
  const System& system_;
  Vecs free_;  // 0 where a coordinate is held: no gap reacts to it, so that nothing moves it
  BlockLu<double, S::kDof> lu_;
  std::vector<Row> x_;
};

// The stiffness of each gap component, 0 where a joint is open or free.
Vecs joint_weights(const System& system, const std::vector<bool>& open) {
  Vecs w(system.joints.size(), S::Vec::Zero());
  for (std::size_t j = 0; j < w.size(); ++j) {
    if (open[j]) continue;
    S::Vec probe_gap = S::Vec::Zero();
    if (system.joints[j].type == "rope") probe_gap[0] = 1;  // a rope is taut while it is assembled
    w[j] = respond(system.joints[j].law, probe_gap, S::Vec::Zero()).stiffness.diagonal();
  }
  return w;
}

void readings_at(const System& system, double t, const Vecs& q, const Vecs& v, std::vector<S::Motion>& m, std::vector<Reading>& r) {
  system.motions(q, v, m);
  system.readings(t, m, r);
}

// A rope that hangs loose needs no closing.
S::Vec gap_to_close(const JointData& joint, const Reading& r) {
  S::Vec gap = r.gap;
  if (joint.type == "rope") gap[0] = std::max(gap[0], 0.0);
  return gap;
}

double energy(const System& system, const Vecs& w, const std::vector<Reading>& r) {
  double sum = 0;
  for (std::size_t j = 0; j < w.size(); ++j) {
    const S::Vec gap = gap_to_close(system.joints[j], r[j]);
    sum += 0.5 * gap.dot(w[j].cwiseProduct(gap));
  }
  return sum;
}

double mechanism_size(const System& system, const Vecs& q) {
  double size = 1e-6;
  for (const auto& x : q) size = std::max({size, std::abs(x[0]), std::abs(x[1])});
  for (const JointData& joint : system.joints) size = std::max({size, joint.at.F.p.norm(), joint.at.M.p.norm()});
  return size;
}

// The minimum of the joints' potential energy nearest to the guess, by Levenberg-Marquardt. theory/assembly Eqs. (1.1)-(1.4).
class PositionSearch {
 public:
  PositionSearch(const Model& model, const System& system, const std::vector<bool>& open)
      : model_(model), system_(system), equations_(system), weight_(joint_weights(system, open)) {
    for (int i = 0; i < system.n_bodies(); ++i)
      for (int k = 0; k < S::kDof; ++k)
        if (model.bodies[i].hold[k]) equations_.hold(i, k);
  }

  void run(Vecs& q) {
    const Vecs still(q.size(), S::Vec::Zero());
    readings_at(system_, 0, q, still, m_, r_);
    double now = energy(system_, weight_, r_), damping = 1e-3;
    const Vecs body = body_weights(q);
    for (int iteration = 0; iteration < 500; ++iteration) {
      Vecs gaps(r_.size());
      for (std::size_t j = 0; j < gaps.size(); ++j) gaps[j] = -gap_to_close(system_.joints[j], r_[j]);
      Vecs damped = body;
      for (auto& d : damped) d *= damping;
      if (!equations_.prepare(r_, weight_, damped)) { damping *= 10; continue; }
      const Vecs move = equations_.solve(equations_.pull(r_, weight_, gaps));
      Vecs trial = q;
      double step = 0;
      for (std::size_t i = 0; i < q.size(); ++i) {
        trial[i] += move[i];
        step = std::max(step, move[i].cwiseAbs().maxCoeff());
      }
      readings_at(system_, 0, trial, still, m_, r_);
      const double next = energy(system_, weight_, r_);
      if (next <= now && std::isfinite(next)) {
        q = trial;
        const bool settled = step < 1e-15 * mechanism_size(system_, q) || (now - next <= 1e-14 * now && step < 1e-10);
        now = next;
        damping = std::max(damping * 0.1, 1e-12);
        if (settled) return;
      } else {
        readings_at(system_, 0, q, still, m_, r_);
        damping *= 10;
        if (damping > 1e12 || step < 1e-15) return;
      }
    }
  }

 private:
  // How much a coordinate resists being moved: what the user stated more than what he left open.
  Vecs body_weights(const Vecs& q) const {
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

  const Model& model_;
  const System& system_;
  LeastSquares equations_;
  Vecs weight_;
  std::vector<S::Motion> m_;
  std::vector<Reading> r_;
};

// Velocities that leave every gap as it is (servos: that follow their targets), nearest to the stated ones in the mass
// norm; what is not stated follows. Multiplier iteration, theory/assembly Eqs. (2.1)-(2.3).
void assemble_velocities(const Model& model, const System& system, const Vecs& q, Vecs& v) {
  std::vector<S::Motion> m;
  std::vector<Reading> r;
  const Vecs still(q.size(), S::Vec::Zero());
  readings_at(system, 0, q, still, m, r);
  Vecs joint_weight(r.size(), S::Vec::Zero()), body_weight(q.size());
  for (std::size_t i = 0; i < q.size(); ++i) {
    const Body& body = model.bodies[i];
    const double move = body.velocity ? 1 : 1e-3, turn = body.spin ? 1 : 1e-3;
    body_weight[i] = system.bodies[i].mass.cwiseProduct(S::Vec(move, move, turn));
  }
  for (std::size_t j = 0; j < r.size(); ++j) {
    const JointData& joint = system.joints[j];
    const S::Vec stiff = respond(joint.law, S::Vec(joint.type == "rope" ? 1 : 0, 0, 0), S::Vec::Zero()).stiffness.diagonal();
    for (int k = 0; k < 3; ++k) {
      if (!(stiff[k] > 0)) continue;
      double mobility = 0;
      if (joint.at.a != kGround) mobility += r[j].GA().row(k).cwiseAbs2().dot(system.bodies[joint.at.a].mass.cwiseInverse());
      if (joint.at.b != kGround) mobility += r[j].GB().row(k).cwiseAbs2().dot(system.bodies[joint.at.b].mass.cwiseInverse());
      joint_weight[j][k] = mobility > 0 ? 1e5 / mobility : 0;
    }
  }
  LeastSquares equations(system);
  if (!equations.prepare(r, joint_weight, body_weight)) return;
  Vecs target = v, multiplier(r.size(), S::Vec::Zero()), x = v;
  for (int iteration = 0; iteration < 60; ++iteration) {
    Vecs wanted(r.size());
    for (std::size_t j = 0; j < r.size(); ++j) wanted[j] = -r[j].rate + multiplier[j];  // at rest a servo's rate is minus its target's
    Vecs rhs = equations.pull(r, joint_weight, wanted);
    for (std::size_t i = 0; i < q.size(); ++i) rhs[i] += body_weight[i].cwiseProduct(target[i]);
    const Vecs next = equations.solve(rhs);
    double change = 0, size = 1e-12;
    for (std::size_t i = 0; i < q.size(); ++i) {
      change = std::max(change, (next[i] - x[i]).cwiseAbs().maxCoeff());
      size = std::max(size, next[i].cwiseAbs().maxCoeff());
      for (int k = 0; k < 3; ++k)
        if (!(k < 2 ? model.bodies[i].velocity.has_value() : model.bodies[i].spin.has_value())) target[i][k] = next[i][k];
    }
    x = next;
    for (std::size_t j = 0; j < r.size(); ++j) {
      S::Vec rate = r[j].rate;
      add_gap(system.joints[j].at, r[j], x, rate);
      multiplier[j] -= rate;
    }
    if (change < 1e-15 * size) break;
  }
  v = x;
}

void demand_closed(const System& system, const Vecs& q, const std::vector<bool>& open, std::vector<std::string>& notes) {
  std::vector<S::Motion> m;
  std::vector<Reading> r;
  readings_at(system, 0, q, Vecs(q.size(), S::Vec::Zero()), m, r);
  const double size = mechanism_size(system, q);
  constexpr int kMostListed = 20;
  int n_broken = 0;
  std::string broken;
  for (std::size_t j = 0; j < r.size(); ++j) {
    if (open[j]) continue;
    const JointData& joint = system.joints[j];
    const S::Vec stiff = respond(joint.law, S::Vec(1, 0, 0), S::Vec::Zero()).stiffness.diagonal();
    S::Vec gap = gap_to_close(joint, r[j]);
    for (int k = 0; k < 3; ++k)
      if (stiff[k] == 0) gap[k] = 0;
    const double length = gap.head<2>().norm(), angle = std::abs(gap[2]);
    if (length > 2e-3 * size || angle > 0.02) {
      if (++n_broken > kMostListed) continue;
      broken += fmt::format("\n  joint {} ({}) stays {} apart", joint.name, joint.type,
                            length > 2e-3 * size ? fmt::format("{:.4g} m", length) : fmt::format("{:.4g} rad", angle));
    } else if (length > 1e-9 * size || angle > 1e-9) {
      notes.push_back(fmt::format("joint {}: misfit of {:.3g} m, {:.3g} rad as assembled; it is preloaded by it", joint.name, length, angle));
    }
  }
  if (n_broken > kMostListed) broken += fmt::format("\n  and {} more", n_broken - kMostListed);
  if (!broken.empty())
    throw AssemblyError("the mechanism cannot be assembled from the stated positions:" + broken + "\n  loop: " + loop_through(system, broken) +
                        "\n  Try lengths that close, or angles nearer to the position that is meant.");
}

void assemble_positions(const Model& model, System& system, Vecs& q, std::vector<std::string>& notes) {
  std::vector<bool> open(system.joints.size());
  for (int j = 0; j < system.n_joints(); ++j) open[j] = is_open(model, system, j);
  unwind(q, system);
  if (model.simulate.start != Start::kRaw || !all_positions_stated(model)) PositionSearch(model, system, open).run(q);
  if (model.simulate.start != Start::kRaw) demand_closed(system, q, open, notes);
  settle(model, q, system, notes);
}

}  // namespace

Assembly assemble(const Model& model, System& system) {
  Assembly out;
  State& state = out.state;
  state.q = guess_positions(model, system);
  const Vecs guess = state.q;
  assemble_positions(model, system, state.q, out.notes);
  for (std::size_t i = 0; i < guess.size(); ++i)
    if (model.bodies[i].position) out.largest_move = std::max(out.largest_move, (state.q[i] - guess[i]).head<2>().norm());
  state.v = stated_velocities(model);
  if (model.simulate.start != Start::kRaw) assemble_velocities(model, system, state.q, state.v);
  start_forces(system, model.simulate.start == Start::kAssembled, state);
  return out;
}

}  // namespace pintle
