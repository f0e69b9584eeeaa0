// The error of a step over a joint tree, the projection of its end onto its gaps, and its dense output.
#include <algorithm>
#include <cmath>
#include <limits>

#include "integrators/dense/curve_weights.h"
#include "integrators/load_scale.h"
#include "integrators/radau/joint_pull.h"
#include "integrators/radau/step_error.h"
#include "integrators/relative/tree_radau.h"
#include "integrators/thresholds.h"
#include "integrators/unresolved_ringing.h"

namespace pintle {
namespace {

using S = Planar;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

double largest(const VectorXd& x) { return x.size() == 0 ? 0 : x.cwiseAbs().maxCoeff(); }

}  // namespace

// theory/time Eqs. (3.12), (3.13): in forces on the bodies, regardless of the coordinates.
bool TreeRadau::error_estimate(double h, double& error) {
  const TreeState& last = stages_.states()[n_ - 1];
  const double mu = kProjectionShare * table_.real_eigenvalue / std::abs(h);
  if (!projector_.prepare(stages_.instant(n_ - 1), mu, last, TreeProjector::Laws::kWhole, find_taut(mu / kProjectionShare))) return false;
  const auto force_at = [this](int node, int j) -> S::Vec { return (node == 0 ? begin_ : stages_.states()[node - 1]).force.segment<3>(3 * law_index(j)); };
  error = std::max({body_tail(), gap_tail(), state_tail(std::abs(h)), force_tail_.size(table_, scale_, force_at), open_contact_error(h), ringing_behind_event(h), bends_.missed_between_samples(begin_.t, h, end_at_.pose().m, stages_.instant(n_ - 1).pose().m, scale_)});
  return std::isfinite(error);
}

// How the joints' forces hold the bodies, where a step with the frequency `own` does not resolve this. Uses the forces at the start of the
// step, including the tree's reactions. Empty if everything is resolved. theory/time section 4.1.
VectorXd TreeRadau::find_taut(double own) const {
  std::vector<BodyPull<Planar>> pulled(system_.bodies.size());
  for (int j = 0; j < system_.n_joints(); ++j) add_pull_of(j, system_, stages_.instant(n_ - 1).pose().m, begin_state_.force[j], pulled);
  VectorXd taut(3 * system_.n_bodies());
  for (int b = 0; b < system_.n_bodies(); ++b) taut.segment<3>(3 * b) = unresolved(pulled[b], own, system_.bodies[b].mass);
  return taut.maxCoeff() > 0 ? taut : VectorXd();
}

S::Vec TreeRadau::body_coefficient(int k, int body) const {
  S::Vec a = table_.to_legendre(k, 0) * begin_state_.a[body];
  for (int s = 0; s < n_; ++s) a += table_.to_legendre(k, s + 1) * stages_.instant(s).a()[body];
  return a;
}

double TreeRadau::body_tail() const {
  std::array<double, RadauTable::kMaxNodes> size{};
  VectorXd coefficient(3 * system_.n_bodies());
  for (int k = n_ - 2; k <= n_; ++k) {
    for (int i = 0; i < system_.n_bodies(); ++i) coefficient.segment<3>(3 * i) = body_coefficient(k, i);
    size[k] = over_loads(system_, coefficient, scale_);
  }
  return tail_size(size[n_], size[n_ - 1], size[n_ - 2]);
}

double TreeRadau::gap_tail() {
  const Index m = end_at_.n_gaps();
  if (m == 0) return 0;
  MatrixXd tail = MatrixXd::Zero(m, 3);
  for (int back = 0; back < 3; ++back)  // without the start of the step, whose error belongs to the previous step
    for (int s = 0; s < n_; ++s) tail.col(back) += table_.stages_to_legendre(n_ - 1 - back, s) * stages_.states()[s].accel;
  const MatrixXd move = stages_.instant(n_ - 1).J() * projector_.close(tail);
  return kGapError * tail_size(over_loads(system_, move.col(0), scale_), over_loads(system_, move.col(1), scale_), over_loads(system_, move.col(2), scale_));
}

// theory/time Eq. (3.18).
double TreeRadau::state_tail(double h) const {
  const Index states = system_.n_law_states();
  if (states == 0) return 0;
  MatrixXd tail(states, 3);
  for (int back = 0; back < 3; ++back)
    for (Index z = 0; z < states; ++z) {
      tail(z, back) = table_.to_legendre(n_ - back, 0) * begin_.law_rate[z];
      for (int s = 0; s < n_; ++s) tail(z, back) += table_.to_legendre(n_ - back, s + 1) * stages_.states()[s].law_rate[z];
    }
  MatrixXd force = MatrixXd::Zero(end_at_.n_gaps(), 3);
  LawTangents tangents;
  LawImpedance<double> law;
  for (std::size_t l = 0; l < tree_->laws().size(); ++l) {
    stages_.instant(n_ - 1).linearize(static_cast<int>(l), stages_.states()[n_ - 1], tangents);
    law.reserve(tangents.n);
    law.find(tangents, table_.real_eigenvalue / h);
    for (int k = 0; k < 3; ++k)
      for (int z = 0; z < law.n; ++z) force.row(3 * static_cast<Index>(l) + k) += law.pushes[k * law.n + z] * tail.row(system_.joints[tree_->laws()[l]].first_state + z);
  }
  if (!force.allFinite()) return std::numeric_limits<double>::infinity();
  std::array<double, 3> size{};
  for (std::size_t l = 0; l < tree_->laws().size(); ++l) {
    const S::Vec load = load_on(system_.joints[tree_->laws()[l]], scale_);
    for (int back = 0; back < 3; ++back)
      size[back] = std::max(size[back], force.col(back).segment<3>(3 * static_cast<Index>(l)).cwiseQuotient(load).cwiseAbs().maxCoeff());
  }
  return tail_size(size[0], size[1], size[2]);
}

// theory/time Eq. (3.23).
double TreeRadau::open_contact_error(double h) const {
  if (open_contacts_.empty()) return 0;
  const TreeState& last = stages_.states()[n_ - 1];
  const TreeInstant& instant = stages_.instant(n_ - 1);
  const auto first_gap = [this](int j) { return 3 * law_index(j); };
  S::Vec gap, rate;  // a law's point refers to them
  const auto carried = [&](int j) {
    gap = last.gap.segment<3>(first_gap(j));
    rate = last.rate.segment<3>(first_gap(j));
    return LawPoint{instant.t(), gap, rate, last.law_state.data() + system_.joints[j].first_state};
  };
  return open_contacts_.error(h, carried, [&](int j) { return instant.kinematics(static_cast<int>(law_index(j))); }, [this](int b) { return body_coefficient(n_, b); },
                              largest_coordinate(instant.pose().q), scale_);
}

// theory/time Eq. (3.24), for the joints that are not coordinates.
double TreeRadau::ringing_behind_event(double h) const {
  if (!control_.behind_event) return 0;
  const TreeState& last = stages_.states()[n_ - 1];
  const TreeInstant& instant = stages_.instant(n_ - 1);
  double largest = 0;
  for (Index l = 0; l < std::ssize(tree_->laws()); ++l) {
    const int j = tree_->laws()[l];
    S::Vec last_coefficient = S::Vec::Zero();
    for (int s = 0; s < n_; ++s) last_coefficient += table_.stages_to_legendre(n_ - 1, s) * stages_.states()[s].accel.segment<3>(3 * l);
    const S::Vec gap = last.gap.segment<3>(3 * l), rate = last.rate.segment<3>(3 * l);
    const LawPoint at{instant.t(), gap, rate, last.law_state.data() + system_.joints[j].first_state};
    largest = std::max(largest, unresolved_ringing(system_, j, at, instant.kinematics(static_cast<int>(l)), last_coefficient, h, n_, scale_));
  }
  return largest;
}

// theory/tree section 6.
void TreeRadau::finish_step(double h) {
  const TreeState& last = stages_.states()[n_ - 1];
  nodes_.w.col(0) = begin_.w;
  nodes_.accel.col(0) = begin_.accel;
  nodes_.force.col(0) = begin_.force;
  const auto put_states = [this](int node, const TreeState& at) {
    for (std::size_t z = 0; z < at.law_state.size(); ++z) {
      nodes_.law_state(static_cast<Index>(z), node) = at.law_state[z];
      nodes_.law_rate(static_cast<Index>(z), node) = at.law_rate[z];
    }
  };
  put_states(0, begin_);
  for (int s = 0; s < n_; ++s) {
    nodes_.w.col(s + 1) = stages_.states()[s].w;
    nodes_.accel.col(s + 1) = stages_.states()[s].accel;
    nodes_.force.col(s + 1) = stages_.states()[s].force;
    put_states(s + 1, stages_.states()[s]);
  }
  add_work(h);
  end_ = last;
  end_.t = begin_.t + h;
  move_onto_gaps();
  take_gaps();
  VectorXd w;
  projector_.balance(end_at_, last.accel, true, end_.force, w);
  nodes_.force.col(n_) = end_.force;
  control_.step_made(h);
  finish_end(w);
  update_switching();
}

void TreeRadau::taylor_step(double h) {
  for (int node = 0; node <= n_; ++node) {
    nodes_.w.col(node) = begin_.w;
    nodes_.accel.col(node) = begin_.accel;
    nodes_.force.col(node) = begin_.force;
    nodes_.power.col(node) << begin_state_.supply_power, begin_state_.loss_power;
    for (std::size_t z = 0; z < begin_.law_state.size(); ++z) {
      nodes_.law_state(static_cast<Index>(z), node) = begin_.law_state[z] + h * table_.nodes[node] * begin_.law_rate[z];
      nodes_.law_rate(static_cast<Index>(z), node) = begin_.law_rate[z];
    }
  }
  extrapolate_end_state(h);
  balance_end();
  control_.step_made(h);
  update_switching();
}

// Projects coordinates and rates, each in one pass, and in a second one if the first leaves more than roundoff. Eq. (6.2).
void TreeRadau::move_onto_gaps() {
  const double rounding = rounding_of_gaps<S>(stages_.instant(n_ - 1).pose().q)[0];
  const double rounding_of_rate = kLastBits * largest_coordinate(stages_.instant(n_ - 1).pose().v);
  end_at_.place_only(end_.t, end_.y, end_.u);
  VectorXd now;
  for (int pass = 0; pass < 2; ++pass) {
    end_at_.gaps(now, &end_);
    const VectorXd wanted = end_.gap - now;
    if (pass > 0 && largest(wanted) < rounding) break;
    end_.y += projector_.close(wanted);
    end_at_.place_only(end_.t, end_.y, end_.u);
  }
  for (int pass = 0; pass < 2; ++pass) {
    end_at_.rates(now);
    const VectorXd wanted = end_.rate - now;
    if (pass > 0 && largest(wanted) < rounding_of_rate) break;
    end_.u += projector_.close(wanted);
    end_at_.place_only(end_.t, end_.y, end_.u);
  }
  end_at_.place(end_.t, end_.y, end_.u);
}

// Keeps the carried gap, but takes that of the geometry if no motion can reach it (redundant joints). theory/time Eq. (4.3).
void TreeRadau::take_gaps() {
  const S::Vec rounding = rounding_of_gaps<S>(end_at_.pose().q);
  const double near = kLastBits * largest_coordinate(end_at_.pose().q);
  const auto is_linear = [this](Index law) { return system_.joints[tree_->laws()[static_cast<std::size_t>(law)]].law.as_linear() != nullptr; };
  VectorXd now;
  end_at_.gaps(now, &end_);
  for (Index i = 0; i < now.size(); ++i)
    if (std::abs(now[i] - end_.gap[i]) > (is_linear(i / S::kDof) ? rounding[i % S::kDof] : near)) end_.gap[i] = now[i];
  end_at_.rates(end_.rate);
  end_at_.forces(end_, end_.force, end_.law_rate);
}

void TreeRadau::add_work(double h) {
  nodes_.power.col(0) << begin_state_.supply_power, begin_state_.loss_power;
  end_state_.supplied = begin_state_.supplied;
  end_state_.dissipated = begin_state_.dissipated;
  for (int s = 0; s < n_; ++s) {
    const TreeState& stage = stages_.states()[s];
    const auto [supplied, lost] = stages_.instant(s).power(stage);
    nodes_.power.col(s + 1) << supplied, lost;
    end_state_.supplied += h * table_.b[s] * supplied;
    end_state_.dissipated += h * table_.b[s] * lost;
  }
  for (std::size_t l = 0; l < tree_->laws().size(); ++l) {
    const JointData& joint = system_.joints[tree_->laws()[l]];
    if (joint.servo < 0) continue;
    const Index i = 3 * static_cast<Index>(l) + joint.servo;
    end_state_.supplied += work_missed_by_quadrature(
        table_, h, [&](int node) { return stages_.states()[node - 1].force[i]; },
        [&](int node) { return (node == 0 ? begin_ : stages_.states()[node - 1]).rate[i] + target_of(joint, begin_.t + h * table_.nodes[node])[1]; });
  }
  end_state_.supply_power = nodes_.power(0, n_);
  end_state_.loss_power = nodes_.power(1, n_);
}

// Power series in the fraction of the step, from the values at the nodes; the mismatch at the end goes into the bends. theory/time Eq. (5.1).
void TreeRadau::find_curves() {
  const double h = end_.t - begin_.t;
  const MatrixXd to_powers = MatrixXd(table_.to_powers).transpose();
  curves_.from = begin_.t;
  curves_.to = end_.t;
  curves_.w = nodes_.w * to_powers;
  curves_.accel = nodes_.accel * to_powers;
  curves_.force = nodes_.force * to_powers;
  curves_.power = nodes_.power * to_powers;
  VectorXd once(n_ + 1), twice(n_ + 1);
  for (int k = 0; k <= n_; ++k) {
    once[k] = CurveWeights::first_integral_at_end(k, h);
    twice[k] = CurveWeights::second_integral_at_end(k, h);
  }
  curves_.bend_u = end_.u - begin_.u - curves_.w * once;
  curves_.bend_y = end_.y - begin_.y - h * begin_.u - curves_.w * twice;
  curves_.bend_rate = end_.rate - begin_.rate - curves_.accel * once;
  curves_.bend_gap = end_.gap - begin_.gap - h * begin_.rate - curves_.accel * twice;
  curves_.bend_work = -(curves_.power * once);
  curves_.bend_work[0] += end_state_.supplied - begin_state_.supplied;
  curves_.bend_work[1] += end_state_.dissipated - begin_state_.dissipated;
}

void TreeRadau::follow(double x, TreeState& out) const {
  const double h = end_.t - begin_.t;
  const CurveWeights weights(x, h);
  const auto value = VectorXd::Map(weights.value.data(), n_ + 1), once = VectorXd::Map(weights.first.data(), n_ + 1), twice = VectorXd::Map(weights.second.data(), n_ + 1);
  out.t = begin_.t + x * h;
  out.w = curves_.w * value;
  out.u = begin_.u + x * curves_.bend_u + curves_.w * once;
  out.y = begin_.y + x * h * begin_.u + weights.end_mismatch_weight * curves_.bend_y + curves_.w * twice;
  out.accel = curves_.accel * value;
  out.rate = begin_.rate + x * curves_.bend_rate + curves_.accel * once;
  out.gap = begin_.gap + x * h * begin_.rate + weights.end_mismatch_weight * curves_.bend_gap + curves_.accel * twice;
  out.force = curves_.force * value;
  const RadauTable::Vec weight = table_.weights(x);
  out.law_state.assign(begin_.law_state.size(), 0.0);
  out.law_rate = out.law_state;
  for (std::size_t z = 0; z < out.law_state.size(); ++z)
    for (int node = 0; node <= n_; ++node) {
      out.law_state[z] += weight[node] * nodes_.law_state(static_cast<Index>(z), node);
      out.law_rate[z] += weight[node] * nodes_.law_rate(static_cast<Index>(z), node);
    }
}

// Evaluates the curves, projects rates onto those of the gaps, and balances forces with the gaps' accelerations. Eq. (6.3).
const State& TreeRadau::interpolate(double t) {
  if (t == end_.t) return end_state_;
  if (t == begin_.t) return begin_state_;
  if (const State* before = in_crossing(t)) return *before;
  if (curves_.from != begin_.t || curves_.to != end_.t) find_curves();
  const double h = end_.t - begin_.t, x = (t - begin_.t) / h;
  TreeState now;
  follow(x, now);
  now.t = t;
  VectorXd w = now.w, rate;
  inside_at_.place(t, now.y, now.u);
  if (projector_.prepare(inside_at_, table_.real_eigenvalue / h, now)) {
    inside_at_.rates(rate);
    now.u += projector_.close(now.rate - rate);
    inside_at_.place(t, now.y, now.u);
    projector_.balance(inside_at_, now.accel, false, now.force, w);
  }
  inside_at_.write(now, w, inside_state_);
  const CurveWeights weights(x, h);
  Eigen::Vector2d work = x * curves_.bend_work;
  for (int k = 0; k <= n_; ++k) work += curves_.power.col(k) * weights.first[k];
  inside_state_.supplied = begin_state_.supplied + work[0];
  inside_state_.dissipated = begin_state_.dissipated + work[1];
  return inside_state_;
}

}  // namespace pintle
