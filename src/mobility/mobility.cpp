#include "mobility/mobility.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "mobility/rank.h"
#include "mobility/redundancy.h"

namespace pintle {
namespace {

using S = Planar;

constexpr int kDenseFreedoms = 450;      // orthogonal factors are used up to here, sparse ones beyond
constexpr int kNearbyFreedoms = 300;     // nearby positions are tried up to here
constexpr int kSparseFreedoms = 200000;  // no rank is computed beyond
constexpr double kNearby = 0.05;         // distance of nearby positions, as a fraction of the arm's length [-]

class MobilityCount {
 public:
  MobilityCount(const System& system, const Vecs& q) : system_(system), q_(q) {
    const auto joint_kinematics = kinematics_at_rest(system, q);
    length_ = arm_length(system, joint_kinematics);
    const auto rows = constraint_rows(system, joint_kinematics, 1e-9 * length_);
    for (const ConstraintRow& row : rows) (row.servo ? driven_ : joints_).push_back(row);
    driven_.insert(driven_.begin(), joints_.begin(), joints_.end());
    misfit_ = misfit(joints_);
  }

  MobilityCheck run() {
    CheckMobility& counts = out_.counts;
    out_.regular = q_;
    counts.freedoms = S::kDof * system_.n_bodies();
    counts.constraints = static_cast<int>(joints_.size());
    counts.servos = static_cast<int>(driven_.size() - joints_.size());
    counts.gruebler = counts.freedoms - counts.constraints;
    counts.length = length_;
    // Positions are known no better than the misfit; a parallelogram with a manufacturing error is still a
    // parallelogram.
    counts.rank_tolerance = std::clamp(10 * misfit_, 1e-8, 1e-3);
    if (counts.freedoms > kSparseFreedoms || counts.constraints > kSparseFreedoms) {
      counts.remark = "too large to compute the rank; only Gruebler's count is known";
    } else if (counts.freedoms > kDenseFreedoms) {
      sparse();
    } else {
      dense();
    }
    if (counts.rank < 0) return out_;
    const int best = std::max(counts.rank, counts.rank_nearby);
    counts.mobility = counts.freedoms - best;
    counts.redundant = counts.constraints - best;
    return out_;
  }

 private:
  // The largest gap, as a fraction of the arm's length or as an angle.
  double misfit(const std::vector<ConstraintRow>& rows) const {
    double worst = 0;
    for (const ConstraintRow& row : rows)
      worst = std::max(worst, std::abs(row.gap) / (row.component == 2 ? 1 : length_));
    return worst;
  }

  void sparse() {
    CheckMobility& counts = out_.counts;
    counts.method = "sparse factors";
    counts.remark =
        fmt::format("more than {} degrees of freedom: no orthogonal factors, nearby positions not examined", kDenseFreedoms);
    const SparseRank rank = sparse_rank(joints_, system_, length_, counts.rank_tolerance);
    counts.rank = counts.mobility_driven = rank.rank;
    if (rank.rank < 0) {
      counts.remark = "the factorisation failed";
      return;
    }
    // The pivots' own limit is coarser, since they are squares.
    counts.rank_tolerance = std::max(counts.rank_tolerance, 1e-4);
    if (counts.servos > 0) counts.mobility_driven = sparse_rank(driven_, system_, length_, counts.rank_tolerance).rank;
    counts.mobility_driven = counts.freedoms - counts.mobility_driven;
    out_.redundancies = redundancies(system_, joints_, rank);
  }

  void dense() {
    CheckMobility& counts = out_.counts;
    counts.method = "pivoted QR";
    const DenseRank here(joints_, system_, length_, counts.rank_tolerance);
    counts.rank = here.rank();
    counts.smallest_kept = here.smallest_kept();
    counts.largest_dropped = here.largest_dropped();
    const int driven =
        counts.servos > 0 ? DenseRank(driven_, system_, length_, counts.rank_tolerance).rank() : here.rank();
    counts.mobility_driven = counts.freedoms - driven;
    out_.redundancies = redundancies(system_, joints_, here);
    if (counts.freedoms <= kNearbyFreedoms) look_around(here);
  }

  // Ranks at nearby assembled positions: a higher rank there means that this position is singular.
  void look_around(const DenseRank& here) {
    std::mt19937_64 random(20260);
    const int tries = out_.counts.freedoms <= 60 ? 3 : 1;
    for (int i = 0; i < tries; ++i) {
      Vecs q = q_;
      if (!move_away(here, random, q)) continue;
      const auto rows = joint_rows(q);
      const DenseRank there(rows, system_, length_, out_.counts.rank_tolerance);
      if (there.rank() > std::max(out_.counts.rank_nearby, here.rank())) {
        out_.redundancies = redundancies(system_, rows, there);
        out_.regular = q;
      }
      out_.counts.rank_nearby = std::max(out_.counts.rank_nearby, there.rank());
    }
  }

  // The rows of this position, evaluated at q.
  std::vector<ConstraintRow> joint_rows(const Vecs& q) const {
    const auto joint_kinematics = kinematics_at_rest(system_, q);
    std::vector<ConstraintRow> rows = joints_;
    for (ConstraintRow& row : rows) {
      const JointKinematics& r = joint_kinematics[row.joint];
      row.on_a = r.GA().row(row.component);
      row.on_b = r.GB().row(row.component);
      row.gap = r.gap[row.component];
    }
    return rows;
  }

  void move(const Eigen::VectorXd& scaled, Vecs& q) const {
    for (std::size_t i = 0; i < q.size(); ++i) {
      q[i] += scaled.segment<3>(3 * static_cast<int>(i)).cwiseProduct(S::Vec(1, 1, 1 / length_));
    }
  }

  // Moves q along a free direction and closes the joints again. False when that fails.
  bool move_away(const DenseRank& here, std::mt19937_64& random, Vecs& q) const {
    Eigen::VectorXd direction(S::kDof * system_.n_bodies());
    for (double& x : direction) x = static_cast<double>(random() >> 11) * 0x1p-52 - 1;
    direction = here.free_part(direction);
    const double size = direction.cwiseAbs().maxCoeff();
    if (size < 1e-6) return false;  // no free direction, so no nearby position
    move(direction * (kNearby * length_ / size), q);
    for (int iteration = 0; iteration < 20; ++iteration) {
      const auto rows = joint_rows(q);
      if (misfit(rows) <= std::max(1e-11, 2 * misfit_)) return true;
      move(DenseRank(rows, system_, length_, out_.counts.rank_tolerance).closing_motion(), q);
    }
    return misfit(joint_rows(q)) <= std::max(1e-8, 3 * misfit_);
  }

  const System& system_;
  Vecs q_;
  double length_ = 1, misfit_ = 0;
  std::vector<ConstraintRow> joints_, driven_;
  MobilityCheck out_;
};

}  // namespace

MobilityCheck check_mobility(const System& system, const Vecs& q) {
  return MobilityCount(system, q).run();
}

}  // namespace pintle
