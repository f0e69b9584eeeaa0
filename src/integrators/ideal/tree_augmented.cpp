#include "integrators/ideal/tree_augmented.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/cubic_hermite.h"
#include "integrators/ideal/ideal_equations.h"
#include "integrators/thresholds.h"

namespace pintle {
namespace {

using S = Planar;
using Eigen::Index;

constexpr int kMaxIterations = 20;                                         // upper limit for Newton's method
constexpr double kEnough = 1e-9;                                           // last correction, as a fraction of the largest coordinate: the iteration is not quadratic
constexpr double kFactor = 1e7;                                            // ratio of the penalties in the iteration to what resists them in a step
constexpr double kProjection = 1e-7;                                       // added to the rows' scaled matrix, so that dependent rows need no special treatment
constexpr int kPasses = 2;                                                 // of a projection

double largest_of(const Eigen::VectorXd& x) { return std::max(1e-3, x.size() > 0 ? x.cwiseAbs().maxCoeff() : 0.0); }

}  // namespace

TreeAugmented::TreeAugmented(const System& system, const AlphaWeights& weights, double tolerance)
    : system_(system), weights_(weights), tolerance_(tolerance), tree_(std::make_unique<JointTree>(system)), at_(system, *tree_), forced_(tolerance) {
  for (int l = 0; l < static_cast<int>(tree_->laws().size()); ++l)
    for (int k = 0; k < S::kDof; ++k)
      if (is_constrained(system.joints[tree_->laws()[l]], k)) rows_.push_back({l, k});
  multipliers_ = stiffness_ = Vector::Zero(static_cast<Index>(rows_.size()));
}

void TreeAugmented::start(const State& state, double h) {
  end_state_ = state;
  if (!close_loops(system_, end_state_)) failure_ = "ideal joints cannot be closed at the start";
  read_coordinates(*tree_, end_state_, end_);
  end_.law_state = state.law_state;
  end_.law_rate = state.law_rate;
  complete(end_, end_state_);
  own_w_ = law_w_ = end_.w;
  h_ = h;
}

// The forces of joints with laws. Constrained components have no force yet, and their gaps count as closed.
void TreeAugmented::find_law_forces(TreeState& state) {
  at_.gaps(state.gap);
  at_.rates(state.rate);
  state.force.resize(at_.n_gaps());
  for (int l = 0; l < static_cast<int>(tree_->laws().size()); ++l) state.force.segment<3>(3 * l) = force_without_states(system_.joints[tree_->laws()[static_cast<std::size_t>(l)]], at_.t(), at_.kinematics(l));
  for (const Row& row : rows_) state.gap[index(row)] = state.rate[index(row)] = 0;
}

// theory/penalty Eq. (5.4), at the current instant.
bool TreeAugmented::factorize() {
  at_.find_matrices();
  const bool has_mass = mass_.compute(at_.H());
  const auto n = static_cast<Index>(rows_.size());
  A_.resize(n, tree_->n());
  for (Index i = 0; i < n; ++i) A_.row(i) = at_.A().row(index(rows_[static_cast<std::size_t>(i)]));
  pull_ = mass_.solve(A_.transpose());
  Eigen::MatrixXd N = A_ * pull_;
  scale_ = N.diagonal().cwiseMax(std::numeric_limits<double>::min()).cwiseSqrt().cwiseInverse();
  N = scale_.asDiagonal() * N * scale_.asDiagonal();
  N.diagonal().array() += kProjection;
  return (n == 0 || rows_matrix_.compute(N)) && has_mass;
}

Eigen::VectorXd TreeAugmented::reactions_for(const Vector& missing) const {
  return scale_.cwiseProduct(rows_matrix_.solve(scale_.cwiseProduct(missing)));
}

// What the rows lack to be closed, from a list for all gaps.
Eigen::VectorXd TreeAugmented::missing(const Vector& open) const {
  Vector out(static_cast<Index>(rows_.size()));
  for (std::size_t i = 0; i < rows_.size(); ++i) out[static_cast<Index>(i)] = -open[index(rows_[i])];
  return out;
}

// Accelerations and constraint forces for given coordinates and rates: the forces are the multipliers that go with projected accelerations.
void TreeAugmented::complete(TreeState& state, State& out) {
  at_.place(state.t, state.y, state.u);
  find_law_forces(state);
  if (!factorize()) failure_ = fmt::format("the mass matrix is singular at t = {:.9g} s", state.t);
  at_.accelerate(Vector::Zero(tree_->n()));
  at_.imbalance(state.force, state.w);
  state.w = mass_.solve(-state.w);
  for (int pass = 0; pass < kPasses && !rows_.empty(); ++pass) {
    at_.accelerate(state.w);
    at_.gap_accelerations(state.accel);
    const Vector f = reactions_for(missing(state.accel));
    state.w += pull_ * f;
    for (std::size_t i = 0; i < rows_.size(); ++i) state.force[index(rows_[i])] += f[static_cast<Index>(i)];
  }
  at_.accelerate(state.w);
  at_.gap_accelerations(state.accel);
  at_.write(state, state.w, out);
  find_powers(system_, at_.pose().m, out);
}

// theory/penalty Eqs. (5.5), (5.6).
bool TreeAugmented::project(double t, Vector& u, Vector& w) {
  Vector open;
  at_.place(t, trial_.y, u);
  if (!factorize()) return false;
  at_.gaps(open);
  for (const Row& row : rows_) violation_ = std::max(violation_, std::abs(open[index(row)]));
  for (int pass = 0; pass < kPasses && !rows_.empty(); ++pass) {
    at_.place(t, trial_.y, u);
    at_.rates(open);
    u += pull_ * reactions_for(missing(open));
  }
  at_.place(t, trial_.y, u);
  for (int pass = 0; pass < kPasses && !rows_.empty(); ++pass) {
    at_.accelerate(w);
    at_.gap_accelerations(open);
    w += pull_ * reactions_for(missing(open));
  }
  return u.allFinite() && w.allFinite();
}

// Penalties as in theory/penalty Eq. (2.5).
void TreeAugmented::begin_step(double h) {
  at_.place_only(begin_.t, begin_.y, begin_.u);
  factorize();
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const auto k = static_cast<Index>(i);
    multipliers_[k] = begin_.force[index(rows_[i])];
    stiffness_[k] = kFactor * scale_[k] * scale_[k] / (h * h * weights_.beta());
  }
}

// Adds the tangents of laws and loads to the matrix of Newton's method; those of inertia and of the rotation of forces are left out.
void TreeAugmented::add_tangents(double h) {
  const double by_y = (1 - weights_.forces) * h * h * weights_.beta(), by_u = (1 - weights_.forces) * h * weights_.gamma();
  LawTangents law;
  for (int l = 0; l < static_cast<int>(tree_->laws().size()); ++l) {
    if (system_.joints[tree_->laws()[static_cast<std::size_t>(l)]].ideal) continue;
    at_.linearize(l, trial_, law);
    const auto A = at_.A().middleRows<3>(3 * l);
    newton_ += A.transpose() * (by_y * law.stiffness + by_u * law.damping) * A;
  }
  system_.external_tangents(trial_.t, at_.pose().m, [&](int i, int j, const S::Mat& dq, const S::Mat& dv) {
    newton_ -= at_.J().middleRows<3>(3 * i).transpose() * (by_y * dq + by_u * dv) * at_.J().middleRows<3>(3 * j);
  });
}

// One correction, theory/penalty Eqs. (5.1)-(5.3). Returns the largest, in terms of coordinates.
double TreeAugmented::correct(double h) {
  ++counters_.evaluations;
  ++counters_.newton_iterations;
  ++counters_.factorizations;
  Vector open, rest;
  trial_.t = begin_.t + h;
  at_.place(trial_.t, trial_.y, trial_.u);
  at_.find_matrices();
  find_law_forces(trial_);
  at_.gaps(open);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const auto k = static_cast<Index>(i);
    A_.row(k) = at_.A().row(index(rows_[i]));
    trial_.force[index(rows_[i])] = multipliers_[k] - stiffness_[k] * open[index(rows_[i])];
  }
  at_.accelerate(trial_.w);
  at_.imbalance(trial_.force, rest);
  const double old = weights_.forces, reach = h * h * weights_.beta();
  rest = (1 - old) * rest + old * at_.H() * (trial_.w - begin_.w);
  newton_ = at_.H() + (1 - old) * reach * A_.transpose() * stiffness_.asDiagonal() * A_;
  add_tangents(h);
  lu_.compute(newton_);
  const Vector dw = lu_.solve(-rest);
  trial_.w += dw;
  for (Index i = 0; i < dw.size(); ++i) {
    trial_.y[i] = weights_.position(h, begin_.y[i], begin_.u[i], w_begin_[i], trial_.w[i]);
    trial_.u[i] = weights_.velocity(h, begin_.u[i], w_begin_[i], trial_.w[i]);
  }
  at_.place_only(trial_.t, trial_.y, trial_.u);
  at_.gaps(open);
  for (std::size_t i = 0; i < rows_.size(); ++i) multipliers_[static_cast<Index>(i)] -= stiffness_[static_cast<Index>(i)] * open[index(rows_[i])];
  return dw.allFinite() ? reach * dw.cwiseAbs().maxCoeff() : std::numeric_limits<double>::infinity();
}

bool TreeAugmented::solve(double h) {
  begin_step(h);
  trial_ = begin_;
  trial_.w = w_begin_;
  for (Index i = 0; i < trial_.w.size(); ++i) {
    trial_.y[i] = weights_.position(h, begin_.y[i], begin_.u[i], w_begin_[i], w_begin_[i]);
    trial_.u[i] = weights_.velocity(h, begin_.u[i], w_begin_[i], w_begin_[i]);
  }
  double last = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kMaxIterations; ++i) {
    const double size = correct(h);
    if (!std::isfinite(size) || (i > 2 && size > 2 * last)) return false;
    if (size < std::max(kEnough, kLastBits) * largest_y_) return project(trial_.t, trial_.u, trial_.w);
    last = size;
  }
  return false;
}

double TreeAugmented::error(double h) {
  double worst = 0;
  for (Index i = 0; i < trial_.w.size(); ++i) {
    const bool known = h_before_ > 0;
    const auto [e_y, e_u] = weights_.local_errors(h, h_before_, {known ? u_before_[i] : 0, known ? w_lagged_before_[i] : 0, begin_.u[i], w_begin_[i], trial_.u[i], trial_.w[i]});
    worst = std::max({worst, e_y / tolerance_.weight(begin_.y[i], trial_.y[i], largest_y_), e_u / tolerance_.weight(begin_.u[i], trial_.u[i], largest_u_)});
    if (!std::isfinite(e_y + e_u)) return std::numeric_limits<double>::infinity();
  }
  return worst;
}

bool TreeAugmented::step(double t_end) {
  if (!failure_.empty()) return false;
  begin_ = end_;
  begin_state_ = end_state_;
  largest_y_ = largest_of(begin_.y);
  largest_u_ = largest_of(begin_.u);
  double h = max_step_ > 0 ? std::min(h_, max_step_) : h_, most = 5;
  while (true) {
    h = std::min(h, t_end - begin_.t);
    if (h <= kLastBits * std::abs(t_end)) {
      failure_ = fmt::format("the step size became too small at t = {:.9g} s", begin_.t);
      return false;
    }
    w_begin_ = h_before_ > 0 && weights_.lag() != 0 ? weights_.lagged(h / h_before_, own_w_, law_w_) : own_w_;
    w_lagged_before_ = w_before_;
    const bool solved = solve(h);
    const double e = solved ? error(h) : 0;
    const double factor = std::isfinite(e) ? std::clamp(0.9 / std::cbrt(std::max(e, 1e-12)), 0.2, 5.0) : 0.1;
    const bool forced = solved && forced_.must_take(e, h, begin_.t + h >= t_end);
    if (solved && (e <= 1 || forced)) {
      finish(end_of_step(begin_.t, h, t_end), h);
      if (!forced) forced_.record_step(h);
      h_ = forced ? forced_.record_forced_step(begin_.t, h) : h * std::min(factor, most);
      return failure_.empty();
    }
    ++(solved ? counters_.rejected : counters_.newton_failures);
    most = 1;
    h *= solved ? std::min(factor, 0.8) : 0.25;
  }
}

void TreeAugmented::finish(double t, double h) {
  end_ = trial_;
  end_.t = t;
  w_before_ = w_begin_;
  u_before_ = begin_.u;
  own_w_ = trial_.w;
  complete(end_, end_state_);
  law_w_ = end_.w;
  h_before_ = h;
  end_state_.dissipated = begin_state_.dissipated + 0.5 * h * (begin_state_.loss_power + end_state_.loss_power);
  end_state_.supplied = begin_state_.supplied + 0.5 * h * (begin_state_.supply_power + end_state_.supply_power);
  ++counters_.steps;
}

// theory/solvers section 4, for coordinates.
const State& TreeAugmented::interpolate(double t) {
  if (t == end_.t) return end_state_;
  if (t == begin_.t) return begin_state_;
  const double h = end_.t - begin_.t, s = (t - begin_.t) / h;
  inside_.t = t;
  inside_.y = cubic_hermite(s, h, begin_.y, begin_.u, end_.y, end_.u);
  inside_.u = cubic_hermite(s, h, begin_.u, begin_.w, end_.u, end_.w);
  inside_.law_state = begin_.law_state;
  inside_.law_rate = begin_.law_rate;
  complete(inside_, inside_state_);
  inside_state_.dissipated = begin_state_.dissipated + 0.5 * h * s * (begin_state_.loss_power + inside_state_.loss_power);
  inside_state_.supplied = begin_state_.supplied + 0.5 * h * s * (begin_state_.supply_power + inside_state_.supply_power);
  return inside_state_;
}

std::vector<std::string> TreeAugmented::remarks() const {
  std::vector<std::string> out{fmt::format("augmented Lagrangian in {} relative coordinates: the {} constraints that close loops are violated by at most {:.1e} m or rad", tree_->n(), rows_.size(), violation_)};
  for (std::string& remark : forced_.remarks()) out.push_back(std::move(remark));
  return out;
}

}  // namespace pintle
