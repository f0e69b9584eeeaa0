#include "integrators/ideal/ideal_equations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "integrators/thresholds.h"

namespace pintle {
namespace {

using S = Planar;

constexpr int kOpening = 1;      // component of a mesh
constexpr int kRefinements = 1;  // of the multipliers, from the accelerations that they give
constexpr int kMaxClosing = 12;  // upper limit on Newton iterations to close the loops

constexpr int kMostModes = 300;       // up to this many rows eigenvectors are computed; with more, redundant rows are dropped
constexpr double kDamped = 1e-9;      // pivots below this are raised, so that forces stay finite at singular positions ...
constexpr double kMisfit = 30;        // ... and those below the square of this multiple of the misfit that redundant rows leave

// Angles count turns and may be far larger than the mechanism: their roundoff is that of their size.
double largest_number(const Vecs& q) {
  double largest = 0;
  for (const S::Vec& each : q) largest = std::max(largest, each.cwiseAbs().maxCoeff());
  return largest;
}

// Forces from outside, such as the pressures in a cylinder whose friction or stops have states, which these equations do not carry.
S::Vec pushing(const JointData& joint, double t, const JointKinematics& r) {
  LawInput<double> in{};
  in.t = t;
  std::copy_n(r.gap.data(), S::kDof, in.gap);
  std::copy_n(r.rate.data(), S::kDof, in.rate);
  LawOutput<double> out;
  out.clear();
  for (const auto& part : joint.law.parts())
    if (part->feeds()) part->evaluate(in, out);
  return Eigen::Map<const S::Vec>(out.force);
}

}  // namespace

S::Vec force_without_states(const JointData& joint, double t, const JointKinematics& r) {
  if (joint.ideal) return S::Vec::Zero();
  if (joint.law.n_states() == 0) return joint.law.force({t, r.gap, r.rate, nullptr});
  return respond(joint.law, r.gap, r.rate).force + pushing(joint, t, r);
}

void find_powers(const System& system, const std::vector<S::Motion>& m, State& state) {
  const ExternalWork work = system.external_work(state.t, state.q, m);
  state.supply_power = work.supplied;
  state.loss_power = work.lost;
  for (int j = 0; j < system.n_joints(); ++j) {
    const JointData& joint = system.joints[j];
    state.supply_power += system.drive_power(joint, state.t, m, state.force[j]);
    if (joint.servo >= 0 || joint.ideal) continue;
    state.loss_power += joint.law.n_states() == 0 ? joint.law.loss({state.t, state.gap[j], state.gap_rate[j], nullptr}) : respond(joint.law, state.gap[j], state.gap_rate[j]).loss;
  }
}

bool is_constrained(const JointData& joint, int component) { return joint.ideal && joint.law.engaged_stiffness()[component] > 0; }

IdealEquations::IdealEquations(const System& system, Equations equations, const PenaltySettings& penalty)
    : system_(system), equations_(equations), penalty_(penalty), still_(system.bodies.size(), S::Vec::Zero()) {
  for (int j = 0; j < system.n_joints(); ++j)
    for (int k = 0; k < S::kDof; ++k)
      if (is_constrained(system.joints[j], k)) {
        rows_.push_back({j, k});
        n_redundant_ += !has_penalties() && system.joints[j].redundant[k];
      }
  if (rows_.size() > kMostModes && n_redundant_ > 0) {
    std::erase_if(rows_, [&](const Row& row) { return system.joints[row.joint].redundant[row.component]; });
    n_redundant_ = 0;
  }
  for (int i = 0; i < static_cast<int>(rows_.size()); ++i)
    if (system.joints[rows_[i].joint].law.depends_on_reaction_alone()) teeth_.push_back({rows_[i].joint, i});
  std::vector<std::vector<std::pair<int, int>>> on_body(system.bodies.size());  // row, side
  for (int i = 0; i < static_cast<int>(rows_.size()); ++i) {
    const Placement& at = system.joints[rows_[i].joint].at;
    if (at.a != kGround) on_body[at.a].emplace_back(i, 0);
    if (at.b != kGround) on_body[at.b].emplace_back(i, 1);
  }
  std::map<std::pair<int, int>, int> entries;  // (column, row) of the lower half
  for (const auto& list : on_body)
    for (const auto& [row, side] : list)
      for (const auto& [other, other_side] : list)
        if (row >= other) entries.emplace(std::pair(other, row), 0);
  const int n = static_cast<int>(rows_.size());
  std::vector<Eigen::Triplet<double>> pattern;
  for (auto& [place, index] : entries) {
    index = static_cast<int>(pattern.size());  // in the order in which columns are stored
    pattern.emplace_back(place.second, place.first, 1.0);
    row_of_entry_.push_back(place.second);
    column_of_entry_.push_back(place.first);
  }
  for (int body = 0; body < system.n_bodies(); ++body)
    for (const auto& [row, side] : on_body[body])
      for (const auto& [other, other_side] : on_body[body])
        if (row >= other) products_.push_back({entries[{other, row}], row, other, side, other_side, body});
  matrix_.resize(n, n);
  matrix_.setFromTriplets(pattern.begin(), pattern.end());
  if (n > 0) factors_.analyzePattern(matrix_);
  jacobian_.resize(2 * rows_.size());
  orthonormal_.resize(2 * rows_.size());
  for (int i = 0; i < n; ++i) {
    if (i == 0 || rows_[i].joint != rows_[i - 1].joint) joint_rows_.push_back({i, 0, Eigen::Matrix3d::Identity()});
    ++joint_rows_.back().n;
  }
}

void IdealEquations::read(double t, const Vecs& q, const Vecs& v) {
  system_.motions(q, v, m_);
  system_.joint_kinematics(t, m_, r_);
  size_ = largest_coordinate(q);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const JointKinematics& r = r_[rows_[i].joint];
    jacobian_[2 * i] = r.GA().row(rows_[i].component);
    jacobian_[2 * i + 1] = r.GB().row(rows_[i].component);
  }
}

// Rows are made orthonormal within each joint, in the norm of the masses: what is left between them comes from loops. Scaled one by one, the two rows of
// a pin that holds a small heavy body on a long arm would be nearly dependent wherever the arm lies between their axes. theory/ideal Eq. (1.6).
void IdealEquations::orthonormalize_rows() {
  for (JointRows& joint : joint_rows_) {
    const Placement& at = system_.joints[rows_[joint.first].joint].at;
    const auto product = [&](const Eigen::RowVector3d* x, const Eigen::RowVector3d* y) {
      double sum = 0;
      if (at.a != kGround) sum += x[0].cwiseQuotient(system_.bodies[at.a].mass.transpose()).dot(y[0]);
      if (at.b != kGround) sum += x[1].cwiseQuotient(system_.bodies[at.b].mass.transpose()).dot(y[1]);
      return sum;
    };
    joint.lower.setZero();
    for (int i = 0; i < joint.n; ++i) {
      Eigen::RowVector3d* row = &orthonormal_[2 * (joint.first + i)];
      std::copy_n(&jacobian_[2 * (joint.first + i)], 2, row);
      const double whole = product(row, row);
      for (int k = 0; k < i && !has_penalties(); ++k) {
        const Eigen::RowVector3d* before = &orthonormal_[2 * (joint.first + k)];
        joint.lower(i, k) = product(row, before);
        for (int side = 0; side < 2; ++side) row[side] -= joint.lower(i, k) * before[side];
      }
      joint.lower(i, i) = std::sqrt(std::max({product(row, row), kLastBits * whole, std::numeric_limits<double>::min()}));
      for (int side = 0; side < 2; ++side) row[side] /= joint.lower(i, i);
    }
  }
}

bool IdealEquations::factorize() {
  if (rows_.empty()) return true;
  orthonormalize_rows();
  double* values = matrix_.valuePtr();
  std::fill(values, values + matrix_.nonZeros(), 0.0);
  for (const Product& p : products_)
    values[p.entry] += orthonormal_[2 * p.row + p.side].cwiseQuotient(system_.bodies[p.body].mass.transpose()).dot(orthonormal_[2 * p.other + p.other_side]);
  return has_penalties() ? factorize_with_penalties() : n_redundant_ == 0 ? factorize_sparse() : find_modes();
}

// theory/penalty Eq. (1.4).
bool IdealEquations::factorize_with_penalties() {
  Eigen::VectorXd scale(matrix_.rows());
  for (const JointRows& joint : joint_rows_) scale.segment(joint.first, joint.n) = joint.lower.diagonal().head(joint.n).cwiseInverse();
  if (first_scale_.size() == 0) first_scale_ = scale;
  for (int e = 0; e < matrix_.nonZeros(); ++e)
    if (const int row = row_of_entry_[e]; row == column_of_entry_[e]) matrix_.valuePtr()[e] += scale[row] * scale[row] / penalty(row);
  factors_.factorize(matrix_);
  return factors_.info() == Eigen::Success;
}

bool IdealEquations::factorize_sparse() {
  factors_.setShift(kLastBits);
  factors_.factorize(matrix_);
  if (factors_.info() != Eigen::Success) return false;
  smallest_pivot_ = factors_.vectorD().minCoeff();
  if (smallest_pivot_ >= damped_) return true;
  const double missing = 1 - std::max(0.0, smallest_pivot_) / damped_;
  factors_.setShift(kLastBits + damped_ * missing * missing);
  factors_.factorize(matrix_);
  return factors_.info() == Eigen::Success && factors_.vectorD().minCoeff() > 0;
}

bool IdealEquations::find_modes() {
  if (!modes_.compute(Eigen::MatrixXd(matrix_))) return false;
  smallest_pivot_ = modes_.eigenvalues()[n_redundant_];
  return true;
}

// With L of each joint: L^-1 x, for what rows should have.
Eigen::VectorXd IdealEquations::to_orthonormal_rows(Eigen::VectorXd x) const {
  for (const auto& [first, n, lower] : joint_rows_)
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k < i; ++k) x[first + i] -= lower(i, k) * x[first + k];
      x[first + i] /= lower(i, i);
    }
  return x;
}
// L'^-1 y, for multipliers.
Eigen::VectorXd IdealEquations::to_multipliers(Eigen::VectorXd y) const {
  for (const auto& [first, n, lower] : joint_rows_)
    for (int i = n - 1; i >= 0; --i) {
      for (int k = i + 1; k < n; ++k) y[first + i] -= lower(k, i) * y[first + k];
      y[first + i] /= lower(i, i);
    }
  return y;
}
// L y, the inverse of `to_orthonormal_rows`.
Eigen::VectorXd IdealEquations::from_orthonormal_rows(const Eigen::VectorXd& y) const {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(y.size());
  for (const auto& [first, n, lower] : joint_rows_)
    for (int i = 0; i < n; ++i)
      for (int k = 0; k <= i; ++k) x[first + i] += lower(i, k) * y[first + k];
  return x;
}

void IdealEquations::solve(const Eigen::VectorXd& wanted, Eigen::VectorXd& multipliers) const {
  if (n_redundant_ == 0) {
    multipliers = to_multipliers(factors_.solve(to_orthonormal_rows(wanted)));
    return;
  }
  const Eigen::Index kept = wanted.size() - n_redundant_;
  const auto V = modes_.eigenvectors().rightCols(kept);
  const Eigen::VectorXd values = modes_.eigenvalues().tail(kept).cwiseMax(damped_);
  multipliers = to_multipliers(V * (V.transpose() * to_orthonormal_rows(wanted)).cwiseQuotient(values));
}

Eigen::VectorXd IdealEquations::rates(const Vecs& x) const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(rows_.size()));
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Placement& at = system_.joints[rows_[i].joint].at;
    if (at.a != kGround) out[i] += jacobian(i, 0).dot(x[at.a]);
    if (at.b != kGround) out[i] += jacobian(i, 1).dot(x[at.b]);
  }
  return out;
}

void IdealEquations::push(const Eigen::VectorXd& multipliers, Vecs& x) const {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Placement& at = system_.joints[rows_[i].joint].at;
    for (const auto& [body, side] : {std::pair{at.a, 0}, std::pair{at.b, 1}})
      if (body != kGround) x[body] += jacobian(i, side).transpose().cwiseQuotient(system_.bodies[body].mass) * multipliers[i];
  }
}

// With a penalty, theory/penalty Eq. (1.3).
Eigen::VectorXd IdealEquations::add_reactions(Vecs& a) const {
  const bool penalized = equations_ == Equations::kPenalty;
  const double w = penalty_.frequency;
  Eigen::VectorXd multipliers = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(rows_.size())), change;
  for (int pass = 0; pass <= kRefinements && !rows_.empty(); ++pass) {
    Eigen::VectorXd missing = -rates(a);                                                    // (1.3)
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const auto [joint, k] = rows_[i];
      missing[i] -= r_[joint].bias[k];
      if (penalized) missing[i] -= 2 * penalty_.damping * w * r_[joint].rate[k] + w * w * r_[joint].gap[k] + multipliers[i] / penalty(i);
    }
    solve(missing, change);
    multipliers += change;
    push(change, a);
  }
  return multipliers;
}

void IdealEquations::find_applied_forces(State& state) {
  read(state.t, state.q, state.v);
  fill_joints(state);
  system_.external(state.t, m_, state.a);
  for (int j = 0; j < system_.n_joints(); ++j) add_force(system_.joints[j].at, r_[j], state.force[j], state.a);
}

void IdealEquations::add_constraint_forces(Vecs& force, Vecs& on_bodies) const {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Placement& at = system_.joints[rows_[i].joint].at;
    for (const auto& [body, side] : {std::pair{at.a, 0}, std::pair{at.b, 1}})
      if (body != kGround) on_bodies[body] += jacobian(i, side).transpose() * force[rows_[i].joint][rows_[i].component];
  }
  for (const auto [j, row] : teeth_) {
    const S::Vec beside = system_.joints[j].law.force_on_reaction(force[j]);
    add_force(system_.joints[j].at, r_[j], beside, on_bodies);
    force[j] += beside;
  }
}

void IdealEquations::find_reactions(State& state) const {
  const Eigen::VectorXd multipliers = add_reactions(state.a);
  for (std::size_t i = 0; i < rows_.size(); ++i) state.force[rows_[i].joint][rows_[i].component] = multipliers[i];
}

// Adds the accelerations due to a force of a joint on its bodies.
void IdealEquations::accelerate(int joint, const S::Vec& force, Vecs& a) const {
  const Placement& at = system_.joints[joint].at;
  for (const auto& [body, G] : {std::pair{at.a, r_[joint].GA()}, std::pair{at.b, r_[joint].GB()}})
    if (body != kGround) a[body] += (G.transpose() * force).cwiseQuotient(system_.bodies[body].mass);
}

// All reactions to a unit force along the opening of a mesh.
Eigen::VectorXd IdealEquations::reactions_to_unit_opening_force(int joint) const {
  Vecs a(system_.bodies.size(), S::Vec::Zero());
  accelerate(joint, S::Vec::Unit(kOpening), a);
  Eigen::VectorXd reactions;
  solve(-rates(a), reactions);
  return reactions;
}

// Solves f = f0 + C |f| for the teeth's reactions f, with signs that agree with the result; f0 are the reactions without their effect on the bearings.
bool IdealEquations::find_reaction_dependent_forces(const Vecs& applied, State& state) const {
  const auto n = static_cast<Eigen::Index>(teeth_.size());
  Eigen::MatrixXd C(n, n);
  Eigen::VectorXd f0(n), f, sign(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const Teeth& teeth = teeth_[static_cast<std::size_t>(k)];
    const Eigen::VectorXd reactions = system_.joints[teeth.joint].law.force_on_reaction(S::Vec::Unit(0))[kOpening] * reactions_to_unit_opening_force(teeth.joint);
    for (Eigen::Index i = 0; i < n; ++i) C(i, k) = reactions[teeth_[static_cast<std::size_t>(i)].row];
    f0[k] = state.force[teeth.joint][0];
    sign[k] = f0[k] < 0 ? -1 : 1;
  }
  for (Eigen::Index pass = 0;; ++pass) {
    f = (Eigen::MatrixXd::Identity(n, n) - C * sign.asDiagonal()).partialPivLu().solve(f0);
    const Eigen::VectorXd found = (f.array() < 0).select(-Eigen::VectorXd::Ones(n), Eigen::VectorXd::Ones(n));
    if (found == sign) break;
    if (pass > n) return false;
    sign = found;
  }
  state.a = applied;
  for (Eigen::Index k = 0; k < n; ++k) {
    const int j = teeth_[static_cast<std::size_t>(k)].joint;
    const S::Vec beside = system_.joints[j].law.force_on_reaction(f[k] * S::Vec::Unit(0));
    accelerate(j, beside, state.a);
    state.force[j] = beside;
  }
  find_reactions(state);
  return true;
}

bool IdealEquations::complete(State& state) {
  find_applied_forces(state);
  for (int i = 0; i < system_.n_bodies(); ++i) state.a[i] = state.a[i].cwiseQuotient(system_.bodies[i].mass);
  if (!factorize()) return false;
  const Vecs applied = teeth_.empty() ? Vecs{} : state.a;
  find_reactions(state);
  if (!teeth_.empty() && !find_reaction_dependent_forces(applied, state)) return false;
  find_gap_accelerations(system_, r_, state);
  find_powers(system_, m_, state);
  return state.a.empty() || std::isfinite(state.a[0].sum());
}

// Gaps, rates, and the forces of joints that have a law. Components constrained by ideal joints are exactly closed.
void IdealEquations::fill_joints(State& state) {
  for (int j = 0; j < system_.n_joints(); ++j) {
    state.gap[j] = r_[j].gap;
    state.gap_rate[j] = r_[j].rate;
    state.force[j] = force_without_states(system_.joints[j], state.t, r_[j]);
  }
  for (const auto [joint, k] : rows_) state.gap[joint][k] = state.gap_rate[joint][k] = 0;
}

void IdealEquations::measure_violation() {
  for (const auto [joint, k] : rows_) violation_[k == 2] = std::max(violation_[k == 2], std::abs(r_[joint].gap[k]));
}

std::string IdealEquations::violation_text(const std::string& method) const {
  std::string text = fmt::format("{}: the constraints of ideal joints are violated by at most {:.1e} m and {:.1e} rad", method, violation_[0], violation_[1]);
  if (equations_ != Equations::kPenalty) return text;
  text += fmt::format("; the stated force errors are those of the integration only; the penalties add an error of the order of 1/penalty, {:.0e} of a force", 1 / penalty_.factor);
  // A spring between the bodies of a loop is stretched by what the ideal joints of the loop open.
  double stiffest = 0;
  for (const JointData& joint : system_.joints)
    if (!joint.ideal && joint.servo < 0) stiffest = std::max(stiffest, joint.law.engaged_stiffness().head<2>().maxCoeff());
  if (stiffest > 0) text += fmt::format(", and up to {:.1e} N where these violations stretch the stiffest of the other joints", stiffest * violation_[0]);
  return text;
}

bool IdealEquations::close_positions(double t, Vecs& q) {
  double before = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kMaxClosing; ++i) {
    read(t, q, still_);
    double largest = 0;
    Eigen::VectorXd missing(matrix_.rows()), multipliers;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      missing[k] = -r_[rows_[k].joint].gap[rows_[k].component];
      largest = std::max(largest, std::abs(missing[k]));
    }
    if (!factorize()) return false;
    if (n_redundant_ > 0) {  // only what can be closed
      const auto V = modes_.eigenvectors().rightCols(missing.size() - n_redundant_);
      largest = from_orthonormal_rows(V * (V.transpose() * to_orthonormal_rows(missing))).cwiseAbs().maxCoeff();
    }
    if (largest <= kLastBits * size_) return true;
    if (!(largest < before)) return largest <= std::max(1e3 * kLastBits * size_, kLastBits * largest_number(q));  // roundoff, or the loops cannot be closed
    before = largest;
    solve(missing, multipliers);
    push(multipliers, q);                                                                   // (1.4)
  }
  return before <= 1e-9 * size_;
}

bool close_loops(const System& system, State& state) {
  IdealEquations equations(system);
  return equations.close_positions(state.t, state.q) && equations.close_velocities(state.t, state.q, state.v);
}

bool IdealEquations::close_velocities(double t, const Vecs& q, Vecs& v) {
  Eigen::VectorXd multipliers;
  for (int pass = 0; pass <= kRefinements && !rows_.empty(); ++pass) {
    read(t, q, v);
    if (pass == 0 && !factorize()) return false;
    Eigen::VectorXd missing(matrix_.rows());
    for (std::size_t k = 0; k < rows_.size(); ++k) missing[k] = -r_[rows_[k].joint].rate[rows_[k].component];
    solve(missing, multipliers);
    push(multipliers, v);                                                                   // (1.5)
  }
  return true;
}

bool IdealEquations::find_tangent(double t, const Vecs& q) {
  read(t, q, still_);
  return factorize();
}

void IdealEquations::project_onto_tangent(Vecs& displacement) const {
  Eigen::VectorXd multipliers;
  for (int pass = 0; pass <= kRefinements && !rows_.empty(); ++pass) {
    solve(-rates(displacement), multipliers);
    push(multipliers, displacement);
  }
}

bool IdealEquations::close_accelerations(double t, const Vecs& q, const Vecs& v, Vecs& a) {
  read(t, q, v);
  if (!factorize()) return false;
  add_reactions(a);
  return true;
}

void IdealEquations::measure_misfit(double t, const Vecs& q) {
  read(t, q, still_);
  double worst = 0;
  for (const Row& row : rows_) worst = std::max(worst, std::abs(r_[row.joint].gap[row.component]) / (row.component == 2 ? 1 : size_));
  damped_ = std::max(kDamped, kMisfit * kMisfit * worst * worst);
}

double IdealEquations::independence() const { return rows_.empty() ? 1 : std::sqrt(std::max(0.0, smallest_pivot_)); }

double IdealEquations::independence(double t, const Vecs& q) {
  if (rows_.empty()) return 1;
  return find_tangent(t, q) ? independence() : 0;
}

Eigen::VectorXd IdealEquations::nearest_dependency() const {
  Eigen::VectorXd x(matrix_.rows());
  if (n_redundant_ > 0) x = modes_.eigenvectors().col(n_redundant_);
  else {
    for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = 1 + 0.1 * std::sin(static_cast<double>(7 * i + 1));
    for (int i = 0; i < 4; ++i) x = factors_.solve(x).normalized().eval();
  }
  x = to_multipliers(x);
  for (const auto& [first, n, lower] : joint_rows_)
    for (int i = 0; i < n; ++i) x[first + i] *= lower.row(i).norm();  // of rows of unit length
  return x.normalized();
}

}  // namespace pintle
