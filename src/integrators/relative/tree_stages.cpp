#include "integrators/relative/tree_stages.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pintle {
namespace {

using Eigen::Index;
using Eigen::VectorXcd;
using Eigen::VectorXd;
using S = Planar;

}  // namespace

TreeStages::TreeStages(const System& system, const JointTree& tree, const RadauTable& table, double tolerance)
    : system_(system), tree_(tree), table_(table), n_(table.n), tolerance_(tolerance), predictor_(Steps::kAccurate),
      relinearizes_(std::any_of(tree.laws().begin(), tree.laws().end(), [&system](int j) { return is_relinearized(system.joints[j].law); })), state_(table.n),
      at_(table.n, TreeInstant(system, tree)), missing_(table.n), missing_gap_(table.n),
      missing_state_(table.n, VectorXd::Zero(system.n_law_states())), law_(tree.laws().size()) {
  const auto make_room = [&](auto& mode) {
    mode.law.resize(tree.laws().size());
    for (std::size_t l = 0; l < mode.law.size(); ++l) mode.law[l].reserve(system.joints[tree.laws()[l]].law.n_states());
  };
  make_room(real_);
  for (auto& mode : pair_) make_room(mode);
  for (TreeState& s : state_) s.force = VectorXd::Zero(at_[0].n_gaps());
}

bool TreeStages::solve(const TreeState& begin, double h, const TreeNodes* before, double last_h, const LoadScale& scale, Counters& counters) {
  predict(begin, h, before, last_h);
  place(begin, h);
  find_forces(scale);
  contraction_.start();
  double first = 0;  // first correction, in tolerances
  for (int iteration = 0; iteration < NewtonContraction::kMaxIterations; ++iteration) {
    find_residuals();
    counters.evaluations += n_;
    if (iteration == 0 || (relinearizes_ && contraction_.wants_new_jacobians())) {
      linearize();
      counters.factorizations += 1 + n_ / 2;
      if (!factorize(h)) return false;
    }
    const double of_bodies = correct(scale);
    place(begin, h);
    ++counters.newton_iterations;
    const double correction = std::max(of_bodies, find_forces(scale));
    if (iteration == 0) first = correction / tolerance_;
    const auto verdict = contraction_.judge(iteration, correction, tolerance_);
    if (verdict == NewtonContraction::Verdict::kHopeless) return false;
    if (verdict == NewtonContraction::Verdict::kGoOn) continue;
    if (before && relinearizes_)
      predictor_.choose_degree(table_, h / last_h, first, [&](const RadauTable::Vec& weights) { return over_loads(system_, at_[n_ / 2].J() * (before->w * weights - state_.back().w), scale); });
    return true;
  }
  return false;
}

void TreeStages::set_sliding(const std::vector<SlidingMode>& sliding) {
  for (TreeInstant& at : at_) at.set_sliding(sliding);
}

void TreeStages::predict(const TreeState& begin, double h, const TreeNodes* before, double last_h) {
  for (int s = 0; s < n_; ++s) {
    TreeState& state = state_[s];
    state.w = begin.w;
    state.accel = begin.accel;
    state.law_rate = begin.law_rate;
    if (!before) continue;
    const RadauTable::Vec weight = predictor_.weights(table_, table_.c[s], h / last_h);
    state.w.noalias() = before->w * weight;
    state.accel.noalias() = before->accel * weight;
    if (!state.law_rate.empty()) VectorXd::Map(state.law_rate.data(), system_.n_law_states()) = before->law_rate * weight;
  }
}

// Positions and rates of the stages from their accelerations. Eq. (5.2).
void TreeStages::place(const TreeState& begin, double h) {
  for (int s = 0; s < n_; ++s) {
    TreeState& state = state_[s];
    state.t = begin.t + table_.c[s] * h;
    state.u = begin.u;
    state.y = begin.y + table_.c[s] * h * begin.u;
    state.rate = begin.rate;
    state.gap = begin.gap + table_.c[s] * h * begin.rate;
    for (int i = 0; i < n_; ++i) {
      const double first = h * table_.A(s, i), second = h * h * table_.A2(s, i);
      state.u += first * state_[i].w;
      state.y += second * state_[i].w;
      state.rate += first * state_[i].accel;
      state.gap += second * state_[i].accel;
    }
    state.law_state = begin.law_state;
    for (std::size_t z = 0; z < state.law_state.size(); ++z)
      for (int i = 0; i < n_; ++i) state.law_state[z] += h * table_.A(s, i) * state_[i].law_rate[z];
    at_[s].place(state.t, state.y, state.u);
    at_[s].accelerate(state.w);
  }
}

// Joint forces from gaps and rates. Returns how much they have changed, relative to the scale of the bodies that they act on.
double TreeStages::find_forces(const LoadScale& scale) {
  double worst = 0, sum = 0;
  for (int s = 0; s < n_; ++s) {
    TreeState& state = state_[s];
    at_[s].forces(state, force_, law_rate_);
    for (std::size_t z = 0; z < law_rate_.size(); ++z) missing_state_[s][z] = state.law_rate[z] - law_rate_[z];
    for (std::size_t l = 0; l < tree_.laws().size(); ++l) {
      const Placement& at = system_.joints[tree_.laws()[l]].at;
      const S::Vec largest = load_on(at, scale);
      for (int k = 0; k < 3; ++k) {
        const Index i = 3 * static_cast<Index>(l) + k;
        const double change = (force_[i] - state.force[i]) / largest[k];
        worst = std::max(worst, std::abs(change));
        sum += change;
      }
    }
    state.force = force_;
  }
  return std::isfinite(sum) ? worst : std::numeric_limits<double>::infinity();
}

// Residuals of the equations. Eq. (5.3).
void TreeStages::find_residuals() {
  for (int s = 0; s < n_; ++s) {
    at_[s].imbalance(state_[s].force, missing_[s]);
    at_[s].gap_accelerations(missing_gap_[s]);
    missing_gap_[s] = state_[s].accel - missing_gap_[s];
  }
}

// At the predicted middle stage. Eq. (5.4).
void TreeStages::linearize() {
  const TreeState& state = state_[n_ / 2];
  TreeInstant& at = at_[n_ / 2];
  at.find_matrices();
  for (std::size_t l = 0; l < law_.size(); ++l) at.linearize(static_cast<int>(l), state, law_[l]);
  at.slopes(state.force, slopes_);
}

// Eq. (5.5).
template <class Scalar>
bool TreeStages::factorize(Mode<Scalar>& mode) {
  const TreeInstant& at = at_[n_ / 2];
  const Scalar once = Scalar(1) / mode.mu, twice = once * once;
  mode.gaps = at.A().template cast<Scalar>() + once * slopes_.gap_by_rate.template cast<Scalar>() + twice * slopes_.gap.template cast<Scalar>();
  mode.pull.resize(tree_.n(), at.n_gaps());
  for (std::size_t l = 0; l < law_.size(); ++l) {
    const Index i = 3 * static_cast<Index>(l);
    mode.law[l].find(law_[l], mode.mu);
    Eigen::Matrix<Scalar, 3, 3> weight;
    for (int k = 0; k < 9; ++k) weight(k / 3, k % 3) = twice * mode.law[l].weight[k];
    mode.pull.template middleCols<3>(i) = at.A().middleRows<3>(i).transpose().template cast<Scalar>() * weight;
  }
  Matrix<Scalar> matrix = at.H().template cast<Scalar>() + once * slopes_.balance_by_rate.template cast<Scalar>() + twice * slopes_.balance.template cast<Scalar>();
  matrix.noalias() += mode.pull * mode.gaps;
  if (!std::isfinite(std::abs(matrix.sum()))) return false;
  mode.lu.compute(matrix);
  return true;
}

bool TreeStages::factorize(double h) {
  if (tree_.n() == 0) return true;
  real_.mu = table_.real_eigenvalue / h;
  bool good = factorize(real_);
  for (int p = 0; p < table_.pairs && good; ++p) {
    pair_[p].mu = table_.eigenvalue[p] / h;
    good = factorize(pair_[p]);
  }
  return good;
}

// The forces due to the residuals of the laws' states. theory/time Eq. (3.16).
template <class Scalar>
TreeStages::Vector<Scalar> TreeStages::pushes(const Mode<Scalar>& mode, const Vector<Scalar>& missing) const {
  Vector<Scalar> force = Vector<Scalar>::Zero(at_[0].n_gaps());
  for (std::size_t l = 0; l < mode.law.size(); ++l)
    for (int k = 0; k < 3; ++k)
      for (int z = 0; z < mode.law[l].n; ++z)
        force[3 * static_cast<Index>(l) + k] += mode.law[l].pushes[k * mode.law[l].n + z] * missing[system_.joints[tree_.laws()[l]].first_state + z];
  return at_[n_ / 2].A().transpose().template cast<Scalar>() * force;
}

// The correction of the states' rates, once that of the gaps' accelerations is known. theory/time Eq. (3.17).
template <class Scalar>
TreeStages::Vector<Scalar> TreeStages::states_moved(const Mode<Scalar>& mode, const Vector<Scalar>& gaps, const Vector<Scalar>& missing) const {
  Vector<Scalar> move = Vector<Scalar>::Zero(missing.size());
  for (std::size_t l = 0; l < mode.law.size(); ++l) {
    const LawImpedance<Scalar>& law = mode.law[l];
    const int first = system_.joints[tree_.laws()[l]].first_state;
    for (int z = 0; z < law.n; ++z) {
      for (int k = 0; k < 3; ++k) move[first + z] += law.follows[3 * z + k] * gaps[3 * static_cast<Index>(l) + k] / mode.mu;
      for (int y = 0; y < law.n; ++y) move[first + z] -= mode.mu * law.inverse[z * law.n + y] * missing[first + y];
    }
  }
  return move;
}

// One Newton correction: into the diagonal frame, solution, and back. Eq. (5.6). Returns its size as body forces over the scale.
double TreeStages::correct(const LoadScale& scale) {
  if (tree_.n() == 0) return 0;
  const Index n = tree_.n(), m = at_[0].n_gaps();
  const Index states = system_.n_law_states();
  VectorXd balance = VectorXd::Zero(n), gaps = VectorXd::Zero(m), of_states = VectorXd::Zero(states);
  for (int s = 0; s < n_; ++s) {
    balance += table_.inverse_real[s] * missing_[s];
    gaps += table_.inverse_real[s] * missing_gap_[s];
    of_states += table_.inverse_real[s] * missing_state_[s];
  }
  const VectorXd real = real_.lu.solve(real_.pull * gaps - balance - pushes(real_, of_states)), real_gaps = real_.gaps * real - gaps;
  const VectorXd real_states = states_moved(real_, real_gaps, of_states);
  std::array<VectorXcd, RadauTable::kMaxPairs> pair, pair_gaps, pair_states;
  for (int p = 0; p < table_.pairs; ++p) {
    VectorXcd b = VectorXcd::Zero(n), g = VectorXcd::Zero(m), z = VectorXcd::Zero(states);
    for (int s = 0; s < n_; ++s) {
      b += table_.inverse_complex[p][s] * missing_[s];
      g += table_.inverse_complex[p][s] * missing_gap_[s];
      z += table_.inverse_complex[p][s] * missing_state_[s];
    }
    pair[p] = pair_[p].lu.solve(pair_[p].pull * g - b - pushes(pair_[p], z));
    pair_gaps[p] = pair_[p].gaps * pair[p] - g;
    pair_states[p] = states_moved(pair_[p], pair_gaps[p], z);
  }
  double worst = 0;
  for (int s = 0; s < n_; ++s) {
    VectorXd w = table_.T_real[s] * real, e = table_.T_real[s] * real_gaps;
    for (int p = 0; p < table_.pairs; ++p) {
      w += 2 * (table_.T_complex[p][s] * pair[p]).real();
      e += 2 * (table_.T_complex[p][s] * pair_gaps[p]).real();
    }
    state_[s].w += w;
    state_[s].accel += e;
    for (Index z = 0; z < states; ++z) {
      state_[s].law_rate[z] += table_.T_real[s] * real_states[z];
      for (int p = 0; p < table_.pairs; ++p) state_[s].law_rate[z] += 2 * (table_.T_complex[p][s] * pair_states[p][z]).real();
    }
    worst = std::max(worst, over_loads(system_, at_[n_ / 2].J() * w, scale));
  }
  return worst;
}

double TreeStages::residual(int j) const {
  const auto found = std::find(tree_.laws().begin(), tree_.laws().end(), j);
  if (found == tree_.laws().end() || missing_gap_[n_ - 1].size() == 0) return 0;
  return missing_gap_[n_ - 1].segment<3>(3 * (found - tree_.laws().begin())).norm();
}

}  // namespace pintle
