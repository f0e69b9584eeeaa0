#include "check/check_gears.h"

#include <cmath>
#include <optional>

#include "joints/belt.h"
#include "mobility/rank.h"

namespace pintle {
namespace {

using S = Planar;

std::string body_name(const System& system, int body) {
  return body == kGround ? "ground" : system.bodies[body].name;
}

// A free coordinate of a joint and how fast it changes in a motion.
struct FreeRate {
  std::string joint, coordinate;
  double rate = 0;
  bool angular = false;
};

std::vector<FreeRate> free_rates(const System& system, const Vecs& q, const Vecs& v) {
  std::vector<S::Motion> m;
  system.motions(q, v, m);
  std::vector<FreeRate> out;
  for (const JointData& joint : system.joints) {
    if (joint.servo >= 0) continue;
    const S::Vec rate = read(joint.displacement, system.pose(joint.at, m)).rate;
    const char* length = std::holds_alternative<Selection>(joint.displacement) ? "slide" : "stroke";
    for (const int k : {0, 2})
      if (joint.free_mask[k] > 0) out.push_back({joint.name, k == 2 ? "angle" : length, rate[k], k == 2});
  }
  return out;
}

// The coordinate that a motor drives, or else the first one that moves.
std::optional<FreeRate> reference(const Model& model, const std::vector<FreeRate>& rates) {
  double largest = 0;
  for (const FreeRate& r : rates) largest = std::max(largest, std::abs(r.rate));
  const auto moves = [largest](const FreeRate& r) { return std::abs(r.rate) > 1e-6 * largest; };
  for (const Motor& motor : model.motors)
    for (const FreeRate& r : rates)
      if (r.joint == motor.joint && moves(r)) return r;
  for (const FreeRate& r : rates)
    if (moves(r)) return r;
  return {};
}

std::string ratio_unit(bool angular, bool reference_angular) {
  if (angular == reference_angular) return "-";
  return angular ? "rad/m" : "m/rad";
}

}  // namespace

std::vector<CheckGear> check_gears(const System& system) {
  std::vector<CheckGear> out;
  for (const JointData& joint : system.joints) {
    CheckGear gear{joint.name, joint.type, body_name(system, joint.at.a), body_name(system, joint.at.b), 0, "-"};
    if (const auto* mesh = std::get_if<Mesh>(&joint.displacement)) {
      gear.ratio = -mesh->sign * mesh->radius_first / mesh->radius_second;
    } else if (const auto* rack = std::get_if<RackMesh>(&joint.displacement)) {
      gear.ratio = rack->side * rack->radius;
      gear.unit = "m/rad";
    } else if (const auto belt = belt_of(joint.displacement); belt && belt->radius_first != 0 && belt->radius_second != 0) {
      gear.ratio = belt->radius_first / belt->radius_second;
    } else {
      continue;
    }
    out.push_back(std::move(gear));
  }
  return out;
}

TrainCheck check_train(const Model& model, const System& system, const Vecs& q, const CheckMobility& mobility) {
  constexpr int kLargest = 300;  // degrees of freedom
  TrainCheck out;
  if (mobility.mobility != 1 || mobility.rank != mobility.freedoms - 1 || mobility.freedoms > kLargest) return out;
  std::vector<ConstraintRow> rows;
  for (const ConstraintRow& row : constraint_rows(system, kinematics_at_rest(system, q), 1e-9 * mobility.length))
    if (!row.servo) rows.push_back(row);
  const DenseRank rank(rows, system, mobility.length, mobility.rank_tolerance);
  Eigen::VectorXd motion(mobility.freedoms);
  for (int i = 0; i < mobility.freedoms; ++i) motion[i] = 1 + 0.5 * std::sin(i);
  motion = rank.free_part(motion).normalized();
  Vecs v(q.size());
  for (std::size_t i = 0; i < q.size(); ++i)
    v[i] = motion.segment<3>(3 * static_cast<int>(i)).cwiseProduct(S::Vec(1, 1, 1 / mobility.length));
  const auto rates = free_rates(system, q, v);
  const auto base = reference(model, rates);
  if (!base) return out;
  out.reference = base->joint + "." + base->coordinate;
  for (const FreeRate& r : rates)
    if (r.joint != base->joint || r.coordinate != base->coordinate)
      out.ratios.push_back({r.joint, r.coordinate, r.rate / base->rate, ratio_unit(r.angular, base->angular)});
  return out;
}

}  // namespace pintle
