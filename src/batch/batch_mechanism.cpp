#include "batch/batch_mechanism.h"

#include <algorithm>

namespace pintle {
namespace {

void put_frame(int lane, const Planar::Frame& from, BatchFrame& to) {
  to.p.along.set(lane, from.p.x());
  to.p.across.set(lane, from.p.y());
  to.angle.set(lane, from.angle);
  to.c.set(lane, from.c);
  to.s.set(lane, from.s);
}

void put_vec(int lane, const Planar::Vec& from, VariantVec& to) {
  for (int k = 0; k < 3; ++k) to[k].set(lane, from[k]);
}

}  // namespace

bool BatchMechanism::accepts(const System& system) {
  return !system.has_branches() && std::all_of(system.joints.begin(), system.joints.end(), [](const JointData& joint) {
    return joint.law.as_linear() && std::holds_alternative<Selection>(joint.displacement);
  });
}

BatchMechanism::BatchMechanism(const System& base)
    : bodies(base.bodies.size()), joints(base.joints.size()), pattern_(&base.pattern()), loads_(base.has_loads()),
      motions_(base.bodies.size()), Q_(base.bodies.size()) {
  const auto place = [&](int body) { return body == kGround ? base.n_bodies() : body; };
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const JointData& joint = base.joints[j];
    BatchJoint& to = joints[j];
    to.at.a = joint.at.a;
    to.at.b = joint.at.b;
    to.a = place(joint.at.a);
    to.b = place(joint.at.b);
    to.servo = joint.servo;
    if (joint.at.a != kGround && joint.at.b != kGround) to.slot = base.pattern().slot(joint.at.a, joint.at.b);
    for (int k = 0; k < 3; ++k) to.stiff[k] = joint.law.engaged_stiffness()[k] > 0;
  }
}

void BatchMechanism::put(int lane, const System& variant) {
  variant_[lane] = &variant;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const BodyData& body = variant.bodies[i];
    put_vec(lane, body.mass, bodies[i].mass);
    put_vec(lane, body.mass.cwiseInverse(), bodies[i].over_mass);
    put_vec(lane, body.gravity, bodies[i].weight);
  }
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const JointData& joint = variant.joints[j];
    const LinearLaw& law = *joint.law.as_linear();
    put_frame(lane, joint.at.F, joints[j].F);
    put_frame(lane, joint.at.M, joints[j].M);
    put_vec(lane, std::get<Selection>(joint.displacement).offset, joints[j].offset);
    put_vec(lane, law.k, joints[j].k);
    put_vec(lane, law.c, joints[j].c);
    for (int k = 0; k < 3; ++k) joints[j].over_k[k].set(lane, joints[j].stiff[k] ? 1 / law.k[k] : 0);
  }
}

void BatchMechanism::take_off_target(std::size_t j, const VariantLanes& t, BatchJointKinematics& r) const {
  const int s = joints[j].servo;
  for (int lane = 0; lane < kVariantLanes; ++lane) {
    const auto target = target_of(variant_[lane]->joints[j], t[lane]);
    subtract(r.gap[s], lane, target[0]);
    subtract(r.rate[s], lane, target[1]);
    subtract(r.bias[s], lane, target[2]);
  }
}

void BatchMechanism::take_off_accel(std::size_t j, const VariantLanes& t, VariantVec& bias) const {
  for (int lane = 0; lane < kVariantLanes; ++lane) subtract(bias[joints[j].servo], lane, target_of(variant_[lane]->joints[j], t[lane])[2]);
}

void BatchMechanism::take_motions(const std::vector<BatchMotion>& m, int lane) {
  for (std::size_t i = 0; i < motions_.size(); ++i)
    motions_[i] = {{m[i].x[lane], m[i].y[lane]}, m[i].angle[lane], m[i].c[lane], m[i].s[lane], {m[i].vx[lane], m[i].vy[lane]}, m[i].w[lane]};
}

void BatchMechanism::add_loads(const VariantLanes& t, const std::vector<BatchMotion>& m, VariantVecs& Q) {
  for (int lane = 0; lane < kVariantLanes; ++lane) {
    take_motions(m, lane);
    variant_[lane]->external(t[lane], motions_, Q_);
    for (std::size_t i = 0; i < Q_.size(); ++i) put_vec(lane, Q_[i], Q[i]);
  }
}

}  // namespace pintle
