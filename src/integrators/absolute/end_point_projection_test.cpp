// The end of a step against GapProjector, which performs one operation at a time.
#include "integrators/absolute/end_point_projection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "integrators/absolute/gap_projector.h"
#include "integrators/load_scale.h"
#include "integrators/radau/step_error.h"
#include "integrators/start_states_for_tests.h"
#include "integrators/thresholds.h"

namespace pintle {
namespace {

using sample::Random;
using S = Planar;

// A last stage at a random state, whose gaps and rates differ from those of its poses by up to `off`.
struct LastStage {
  const System system;
  double t = 0.3;
  Stage stage;

  LastStage(const Model& model, double off, std::uint64_t seed) : system(build_system(model)) {
    Random random(seed);
    sample::random_state(random, system.bodies.size(), stage.q, stage.v);
    system.motions(stage.q, stage.v, stage.m);
    for (std::size_t b = 0; b < system.bodies.size(); ++b) stage.a.push_back(random.vector<S::Vec>(-5, 5));
    stage.Q.assign(system.bodies.size(), S::Vec::Zero());
    system.external(t, stage.m, stage.Q);
    for (int j = 0; j < system.n_joints(); ++j) {
      const JointKinematics r = system.kinematics(j, t, stage.m);
      stage.gap.push_back(r.gap + random.vector<S::Vec>(-off, off));
      stage.gap_rate.push_back(r.rate + random.vector<S::Vec>(-off, off));
      stage.gap_accel.push_back(random.vector<S::Vec>(-5, 5));
      stage.force.push_back(S::Vec::Zero());
    }
  }
  StageTails random_tails(Random& random) const {
    StageTails tails = sample::room_for_tails(system);
    for (RowOf4<Planar>& gap : tails.gaps)
      for (int k = 0; k < 3; ++k)
        for (int lane = 0; lane < 3; ++lane) gap[k].set(lane, random.uniform(-1, 1));
    return tails;
  }
};

std::vector<Model> models() { return {sample::four_bar(1e8, 3000), sample::everything()}; }

TEST(EndPointProjection, AnswersAreTheProjectorsOneByOne) {
  Random random(5);
  for (const Model& model : models()) {
    const LastStage at(model, 0.1, 6);
    const auto end = make_end_point_projection(at.system);
    GapProjector projector(at.system);
    StageTails tails = at.random_tails(random);
    ASSERT_TRUE(end->prepare(at.t, 10, at.stage, tails));
    ASSERT_TRUE(projector.prepare(at.t, at.stage.m, 10, at.stage.gap, at.stage.gap_rate));
    for (int lane = 0; lane < 4; ++lane) {
      Vecs wanted(at.system.joints.size()), x(at.system.bodies.size(), S::Vec::Zero());
      for (std::size_t j = 0; j < wanted.size(); ++j)
        for (int k = 0; k < 3; ++k) wanted[j][k] = lane < 3 ? tails.gaps[j][k][lane] : at.stage.gap[j][k] - projector.joint_kinematics()[j].gap[k];
      projector.close(wanted, x);
      double size = 0;
      for (const S::Vec& move : x) size = std::max(size, move.cwiseAbs().maxCoeff());
      EXPECT_GT(size, 0.01) << model.name;
      for (std::size_t b = 0; b < x.size(); ++b)
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(end->corrections()[b][k][lane], x[b][k], 1e-9 * size) << model.name << ", body " << b << ", lane " << lane;
    }
  }
}

constexpr double kStep = 2e-3;

// The last coefficient of either kind, over the loads, times the expected ratio of the next one.
TEST(EndPointProjection, ErrorIsTheLargerTail) {
  Random random(11);
  const LastStage at(sample::four_bar(1e8, 3000), 1e-3, 12);
  const auto end = make_end_point_projection(at.system);
  for (const double of_bodies : {1e-9, 1e9}) {
    StageTails tails = at.random_tails(random);
    for (std::size_t b = 0; b < tails.bodies.size(); ++b)
      for (int k = 0; k < 3; ++k)
        for (int lane = 0; lane < 3; ++lane) tails.bodies[b][k].set(lane, of_bodies * random.uniform(-1, 1));
    ASSERT_TRUE(end->prepare(at.t, 10, at.stage, tails));
    LoadScale scale;
    for (std::size_t b = 0; b < tails.bodies.size(); ++b) scale.body.push_back(random.vector<S::Vec>(1, 2));
    const auto tail = [&](const std::vector<RowOf4<Planar>>& of) {
      double size[3] = {};
      for (std::size_t b = 0; b < at.system.bodies.size(); ++b)
        for (int k = 0; k < 3; ++k)
          for (int lane = 0; lane < 3; ++lane) size[lane] = std::max(size[lane], at.system.bodies[b].mass[k] / scale.body[b][k] * std::abs(of[b][k][lane]));
      return size[0] * fall_off(size[0], size[1], size[2]);
    };
    const double bodies = tail(tails.bodies), gaps = kGapError * tail(end->corrections());
    EXPECT_EQ(bodies > gaps, of_bodies > 1);
    EXPECT_NEAR(end->error(tails, scale), std::max(bodies, gaps), 1e-14 * std::max(bodies, gaps));
  }
  StageTails tails = at.random_tails(random);
  tails.bodies[0][1].set(1, std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(std::isfinite(end->error(tails, LoadScale{Vecs(tails.bodies.size(), S::Vec::Ones())})));
}

// The same end, one operation after the other. theory/time Eqs. (4.1)-(4.4). A second pass where the first has left more
// than rounding.
class Plainly {
 public:
  Vecs q, v, gap, rate, force;
  int passes = 0;  // over the velocities

  Plainly(const LastStage& from, double mu) : q(from.stage.q), v(from.stage.v), at_(from), projector_(from.system), wanted_(from.system.joints.size()) {
    EXPECT_TRUE(projector_.prepare(at_.t, at_.stage.m, mu, at_.stage.gap, at_.stage.gap_rate));
    read();
    const S::Vec rounding = rounding_of_gaps<S>(q), fastest(largest_coordinate(v), largest_coordinate(v), std::max(largest_coordinate(v), largest_spin()));
    const S::Vec rounding_of_rate = (kLastBits * fastest).cwiseMax((rounding / kStep).cwiseMin(1e-9 * fastest));
    for (int pass = 0; pass < 2 && (pass == 0 || left(at_.stage.gap, &JointKinematics::gap, rounding) >= 1); ++pass) move(at_.stage.gap, &JointKinematics::gap, q);
    for (int pass = 0; pass < 2 && (pass == 0 || left(at_.stage.gap_rate, &JointKinematics::rate, rounding_of_rate) >= 1); ++pass, ++passes) move(at_.stage.gap_rate, &JointKinematics::rate, v);
    find_forces(rounding, rounding_of_rate);
  }

 private:
  double largest_spin() const {
    double largest = 0;
    for (const S::Vec& each : v) largest = std::max(largest, std::abs(each[2]));
    return largest;
  }
  // Over its rounding.
  double left(const Vecs& carried, S::Vec JointKinematics::*of, const S::Vec& rounding) const {
    double size = 0;
    for (std::size_t j = 0; j < carried.size(); ++j)
      for (int k = 0; k < 3; ++k)
        if (at_.system.joints[j].free_mask[k] == 0) size = std::max(size, std::abs(carried[j][k] - (r_[j].*of)[k]) / rounding[k]);
    return size;
  }
  void move(const Vecs& carried, S::Vec JointKinematics::*of, Vecs& x) {
    for (std::size_t j = 0; j < wanted_.size(); ++j) wanted_[j] = carried[j] - r_[j].*of;
    projector_.close(wanted_, x);
    read();
  }
  void read() {
    std::vector<S::Motion> m;
    at_.system.motions(q, v, m);
    at_.system.joint_kinematics(at_.t, m, r_);
  }
  static S::Vec carried_or(S::Vec x, const S::Vec& geometry, const S::Vec& rounding) {
    for (int k = 0; k < 3; ++k)
      if (std::abs(geometry[k] - x[k]) > rounding[k]) x[k] = geometry[k];
    return x;
  }
  void find_forces(const S::Vec& rounding, const S::Vec& rounding_of_rate) {
    Vecs a = at_.stage.a;
    for (std::size_t j = 0; j < wanted_.size(); ++j) {
      const JointData& joint = at_.system.joints[j];
      wanted_[j] = at_.stage.gap_accel[j] - r_[j].bias;
      subtract_gap(joint.at, r_[j], at_.stage.a, wanted_[j]);
      gap.push_back(carried_or(at_.stage.gap[j], r_[j].gap, rounding));
      rate.push_back(carried_or(at_.stage.gap_rate[j], r_[j].rate, rounding_of_rate));
      force.push_back(joint.law.force({0, gap[j], rate[j]}));
    }
    projector_.close(wanted_, a);
    projector_.improve_forces(at_.stage.Q, a, force);
  }

  const LastStage& at_;
  GapProjector projector_;     // its joint kinematics and its matrix are those of the last stage
  std::vector<JointKinematics> r_;  // at q and v
  Vecs wanted_;
};

// With smaller mu the free motion is left to rounding: at 1 the forces of the two ways differ by 4e-7 N, of 110 N.
TEST(EndPointProjection, IsWhatTheProjectorDoesOneByOne) {
  int again = 0, at_once = 0;
  for (const double off : {1e-4, 1e-9})
    for (const double mu : {1.0, 30.0, 3e3}) {
      const LastStage at(sample::four_bar(1e8, 3000), off, 7);
      const Plainly plain(at, mu);
      ++(plain.passes > 1 ? again : at_once);
      const auto end = make_end_point_projection(at.system);
      Random random(8);
      StageTails tails = at.random_tails(random);
      ASSERT_TRUE(end->prepare(at.t, mu, at.stage, tails));
      State state = sample::plain_start(sample::four_bar(1e8, 3000), at.system);
      state.t = at.t;
      std::vector<S::Motion> m(at.system.bodies.size());
      LoadScale scale{Vecs(at.system.bodies.size(), S::Vec(7, 7, 1e-3))}, raised = scale;
      end->finish(at.stage, kStep, state, m, scale);
      EXPECT_LT(sample::largest_difference(state.q, plain.q), 1e-14) << off << " " << mu;
      EXPECT_LT(sample::largest_difference(state.v, plain.v), 1e-12) << off << " " << mu;
      double size = 0;
      for (const S::Vec& f : plain.force) size = std::max(size, f.norm());
      EXPECT_LT(sample::largest_difference(state.force, plain.force), 1e-8 * size) << off << " " << mu;
      EXPECT_LT(sample::largest_difference(state.gap, plain.gap), 1e-15) << off << " " << mu;
      EXPECT_LT(sample::largest_difference(state.gap_rate, plain.rate), 1e-12) << off << " " << mu;
      EXPECT_EQ(state.a, at.stage.a);
      EXPECT_EQ(state.gap_accel, at.stage.gap_accel);
      std::vector<S::Motion> there;
      at.system.motions(state.q, state.v, there);
      for (std::size_t b = 0; b < m.size(); ++b) {
        EXPECT_EQ(m[b].p, there[b].p);
        EXPECT_EQ(m[b].c, there[b].c);
        EXPECT_EQ(m[b].v, there[b].v);
      }
      grow_load_scale(at.system, m, at.stage.Q, state, raised);
      for (std::size_t b = 0; b < m.size(); ++b) {
        EXPECT_GT(raised.body[b][0], 7);
        EXPECT_LT((scale.body[b] - raised.body[b]).cwiseQuotient(raised.body[b]).norm(), 1e-3) << off << " " << mu;  // the maps differ by up to `off`
      }
    }
  EXPECT_GT(again, 0);
  EXPECT_GT(at_once, 0);
}

}  // namespace
}  // namespace pintle
