#include "integrators/relative/tree_instant.h"

namespace pintle {
namespace {

using S = Planar;
using Eigen::VectorXd;

}  // namespace

TreeInstant::TreeInstant(const System& system, const JointTree& tree)
    : system_(system), tree_(tree), r_(tree.laws().size()), Q_(system.bodies.size()), a_(system.bodies.size(), S::Vec::Zero()),
      gap_(system.joints.size(), S::Vec::Zero()), rate_(gap_), on_bodies_(system.bodies.size()) {}

void TreeInstant::place_only(double t, const VectorXd& y, const VectorXd& u) {
  t_ = t;
  tree_.place(y, u, pose_);
  for (std::size_t l = 0; l < r_.size(); ++l) r_[l] = system_.kinematics(tree_.laws()[l], t, pose_.m);
}

void TreeInstant::place(double t, const VectorXd& y, const VectorXd& u) {
  place_only(t, y, u);
  system_.external(t, pose_.m, Q_, sliding());
}

void TreeInstant::gap_accelerations(VectorXd& out) const {
  out.resize(n_gaps());
  for (std::size_t l = 0; l < r_.size(); ++l) {
    S::Vec e = r_[l].bias;
    add_gap(system_.joints[tree_.laws()[l]].at, r_[l], a_, e);
    out.segment<3>(3 * static_cast<Eigen::Index>(l)) = e;
  }
}

// Q + G' f - M a of every body.
void TreeInstant::find_unbalanced_forces(const VectorXd& f) {
  for (std::size_t i = 0; i < Q_.size(); ++i) on_bodies_[i] = Q_[i] - system_.bodies[i].mass.cwiseProduct(a_[i]);
  for (std::size_t l = 0; l < r_.size(); ++l)
    add_force(system_.joints[tree_.laws()[l]].at, r_[l], f.segment<3>(3 * static_cast<Eigen::Index>(l)), on_bodies_);
}

// Eq. (3.4).
void TreeInstant::imbalance(const VectorXd& f, VectorXd& out) {
  find_unbalanced_forces(f);
  tree_.gather(pose_, on_bodies_, out);
  out = -out;
}

void TreeInstant::gaps(VectorXd& out, const TreeState* carried) const {
  out.resize(n_gaps());
  for (std::size_t l = 0; l < r_.size(); ++l) {
    const Eigen::Index i = 3 * static_cast<Eigen::Index>(l);
    out.segment<3>(i) = r_[l].gap;
    if (!carried) continue;
    const JointDisplacement& displacement = system_.joints[tree_.laws()[l]].displacement;
    if (has_slip(displacement)) out[i + kSlip] = carried->gap[i + kSlip];
    count_turns(displacement, carried->gap[i], out.segment<3>(i));
  }
}

void TreeInstant::rates(VectorXd& out) const {
  out.resize(n_gaps());
  for (std::size_t l = 0; l < r_.size(); ++l) out.segment<3>(3 * static_cast<Eigen::Index>(l)) = r_[l].rate;
}

void TreeInstant::find_matrices() {
  tree_.mass(pose_, H_);
  tree_.jacobian(pose_, J_);
  A_.setZero(n_gaps(), n());
  for (std::size_t l = 0; l < r_.size(); ++l) {
    const Placement& at = system_.joints[tree_.laws()[l]].at;
    auto rows = A_.middleRows<3>(3 * static_cast<Eigen::Index>(l));
    if (at.a != kGround) rows.noalias() += r_[l].GA() * J_.middleRows<3>(3 * at.a);
    if (at.b != kGround) rows.noalias() += r_[l].GB() * J_.middleRows<3>(3 * at.b);
  }
}

void TreeInstant::slopes(const VectorXd& f, TreeSlopes& out) {
  tree_.motion_slopes(pose_, a_, moved_);
  // How M a - Q - G' f changes.
  of_forces_ = moved_.acceleration;
  of_forces_by_rate_ = moved_.acceleration_by_rate;
  for (std::size_t i = 0; i < Q_.size(); ++i)
    for (Eigen::MatrixXd* x : {&of_forces_, &of_forces_by_rate_}) x->middleRows<3>(3 * static_cast<Eigen::Index>(i)).array().colwise() *= system_.bodies[i].mass.array();
  const auto rows = [](Eigen::MatrixXd& x, int body) { return x.middleRows<3>(3 * body); };
  system_.external_tangents(
      t_, pose_.m,
      [&](int i, int j, const S::Mat& dq, const S::Mat& dv) {
        rows(of_forces_, i) -= dq * rows(J_, j) + dv * rows(moved_.velocity, j);
        rows(of_forces_by_rate_, i) -= dv * rows(J_, j);
      },
      sliding());
  out.gap.setZero(n_gaps(), n());
  out.gap_by_rate.setZero(n_gaps(), n());
  for (std::size_t l = 0; l < r_.size(); ++l) {
    const JointData& joint = system_.joints[tree_.laws()[l]];
    const Eigen::Index row = 3 * static_cast<Eigen::Index>(l);
    const S::Vec force = f.segment<3>(row);
    const std::array<int, 2> body{joint.at.a, joint.at.b};
    const std::array<S::Mat, 2> G{r_[l].GA(), r_[l].GB()};
    std::array<S::Motion, 2> motion{motion_of(body[0], pose_.m), motion_of(body[1], pose_.m)}, accelerated = motion;
    for (int i = 0; i < 2; ++i) {
      const S::Vec a = body[i] == kGround ? S::Vec(S::Vec::Zero()) : a_[body[i]];
      accelerated[i].v = a.head<2>();
      accelerated[i].w = a[2];
    }
    // d(G' f)/dq; d(G v)/dq, which is also the rate of G; d(G a)/dq; d(bias)/dq.
    const RelativePose pose = system_.pose(joint.at, pose_.m);
    const auto geometric = geometric_stiffness(joint.displacement, pose, force);
    const auto turning = rate_gradient(joint.displacement, pose, motion[0], motion[1]);
    const auto by_acceleration =
        rate_gradient(joint.displacement, RelativePose::between(accelerated[0], joint.at.F, accelerated[1], joint.at.M), accelerated[0], accelerated[1]);
    const auto by_bias = bias_gradient(joint.displacement, pose, motion[0], motion[1]);
    for (int i = 0; i < 2; ++i) {
      if (body[i] == kGround) continue;
      const S::Mat rate = turning.template block<3, 3>(0, 3 * i), place = by_acceleration.template block<3, 3>(0, 3 * i) + by_bias.template block<3, 3>(0, 3 * i);
      out.gap.middleRows<3>(row) += G[i] * rows(moved_.acceleration, body[i]) + 2 * rate * rows(moved_.velocity, body[i]) + place * rows(J_, body[i]);
      out.gap_by_rate.middleRows<3>(row) += G[i] * rows(moved_.acceleration_by_rate, body[i]) + 2 * rate * rows(J_, body[i]);
      for (int j = 0; j < 2; ++j)
        if (body[j] != kGround) rows(of_forces_, body[i]) -= geometric.template block<3, 3>(3 * i, 3 * j) * rows(J_, body[j]);
    }
  }
  find_unbalanced_forces(f);
  tree_.geometric_stiffness(pose_, on_bodies_, geometric_);
  tree_.gather(pose_, of_forces_, out.balance);
  tree_.gather(pose_, of_forces_by_rate_, out.balance_by_rate);
  out.balance -= geometric_;
}

void TreeInstant::linearize(int law, const TreeState& at, LawTangents& out) const {
  const JointData& joint = system_.joints[tree_.laws()[law]];
  const S::Vec gap = at.gap.segment<3>(3 * law), rate = at.rate.segment<3>(3 * law);
  joint.law.linearize({t_, gap, rate, at.law_state.data() + joint.first_state}, out);
}

void TreeInstant::rest(TreeState& at) const {
  at.law_state.assign(system_.n_law_states(), 0.0);
  for (std::size_t l = 0; l < r_.size(); ++l) {
    const JointData& joint = system_.joints[tree_.laws()[l]];
    const Eigen::Index i = 3 * static_cast<Eigen::Index>(l);
    const S::Vec gap = at.gap.segment<3>(i), rate = at.rate.segment<3>(i);
    double* const states = at.law_state.data() + joint.first_state;
    joint.law.rest({t_, gap, rate, states}, states);
  }
}

void TreeInstant::forces(const TreeState& at, VectorXd& f, std::vector<double>& law_rate) const {
  f.resize(at.gap.size());
  law_rate.resize(at.law_state.size());
  for (std::size_t l = 0; l < r_.size(); ++l) {
    const Eigen::Index i = 3 * static_cast<Eigen::Index>(l);
    const JointData& joint = system_.joints[tree_.laws()[l]];
    const S::Vec gap = at.gap.segment<3>(i), rate = at.rate.segment<3>(i);
    const LawPoint point{t_, gap, rate, at.law_state.data() + joint.first_state};
    f.segment<3>(i) = joint.law.force(point);
    joint.law.state_rates(point, law_rate.data() + joint.first_state);
  }
}

std::array<double, 2> TreeInstant::power(const TreeState& at) const {
  const ExternalWork work = system_.external_work(t_, pose_.q, pose_.m, sliding());
  std::array<double, 2> out{work.supplied, work.lost};
  for (std::size_t l = 0; l < r_.size(); ++l) {
    const JointData& joint = system_.joints[tree_.laws()[l]];
    const Eigen::Index i = 3 * static_cast<Eigen::Index>(l);
    const S::Vec gap = at.gap.segment<3>(i), rate = at.rate.segment<3>(i);
    out[0] += system_.drive_power(joint, t_, pose_.m, at.force.segment<3>(i));
    if (joint.servo < 0) out[1] += joint.law.loss({t_, gap, rate, at.law_state.data() + joint.first_state});
  }
  return out;
}

// Joints of the tree usually have linear laws; a law with kinks among them is evaluated at a gap of zero.
void TreeInstant::evaluate_switching_functions(const TreeState& at, double* value) {
  spread_gaps(at);
  system_.evaluate_switching_functions(t_, pose_.m, gap_, rate_, at.law_state, sliding(), value);
}

bool TreeInstant::cross_borders(const double* before, const double* after, TreeState& at, double& lost) {
  spread_gaps(at);
  return system_.cross_borders(t_, gap_, rate_, before, after, at.law_state, lost);
}

void TreeInstant::spread_gaps(const TreeState& at) {
  for (std::size_t l = 0; l < r_.size(); ++l) {
    const Eigen::Index i = 3 * static_cast<Eigen::Index>(l);
    gap_[tree_.laws()[l]] = at.gap.segment<3>(i);
    rate_[tree_.laws()[l]] = at.rate.segment<3>(i);
  }
}

void TreeInstant::write(const TreeState& at, const VectorXd& w, State& state) {
  const std::size_t joints = system_.joints.size();
  for (Vecs* x : {&state.gap, &state.gap_rate, &state.gap_accel, &state.force}) x->resize(joints, S::Vec::Zero());
  state.t = at.t;
  state.sliding.assign(sliding().begin(), sliding().end());
  state.q = pose_.q;
  state.v = pose_.v;
  state.law_state = at.law_state;
  state.law_rate = at.law_rate;
  accelerate(w);
  state.a = a_;
  on_bodies_ = Q_;
  for (std::size_t l = 0; l < r_.size(); ++l) {
    const Eigen::Index i = 3 * static_cast<Eigen::Index>(l);
    const int j = tree_.laws()[l];
    state.gap[j] = at.gap.segment<3>(i);
    state.gap_rate[j] = at.rate.segment<3>(i);
    state.gap_accel[j] = at.accel.segment<3>(i);
    state.force[j] = at.force.segment<3>(i);
    add_force(system_.joints[j].at, r_[l], state.force[j], on_bodies_);
  }
  tree_.reactions(pose_, a_, on_bodies_, state.force);
  for (int j = 0; j < system_.n_joints(); ++j) {
    if (!tree_.in_tree(j)) continue;
    const JointData& joint = system_.joints[j];
    JointKinematics r = system_.kinematics(j, t_, pose_.m);
    add_gap(joint.at, r, a_, r.bias);
    state.gap[j] = r.gap.cwiseProduct(joint.free_mask);
    state.gap_rate[j] = r.rate.cwiseProduct(joint.free_mask);
    state.gap_accel[j] = r.bias.cwiseProduct(joint.free_mask);
  }
}

void read_coordinates(const JointTree& tree, const State& state, TreeState& out) {
  out.t = state.t;
  tree.read_positions(state.q, out.y);
  TreePose pose;
  tree.place(out.y, VectorXd::Zero(tree.n()), pose);
  tree.read_rates(pose, state.v, out.u);
}

void read_carried(const JointTree& tree, const State& state, TreeState& out) {
  const auto n = static_cast<Eigen::Index>(3 * tree.laws().size());
  for (VectorXd* x : {&out.gap, &out.rate, &out.accel, &out.force}) x->resize(n);
  out.law_state = state.law_state;
  out.law_rate = state.law_rate;
  for (std::size_t l = 0; l < tree.laws().size(); ++l) {
    const Eigen::Index i = 3 * static_cast<Eigen::Index>(l);
    const int j = tree.laws()[l];
    out.gap.segment<3>(i) = state.gap[j];
    out.rate.segment<3>(i) = state.gap_rate[j];
    out.accel.segment<3>(i) = state.gap_accel[j];
    out.force.segment<3>(i) = state.force[j];
  }
}

}  // namespace pintle
