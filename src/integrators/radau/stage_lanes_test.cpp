// The maps between forces and accelerations of gaps and of bodies, in lanes, against the Jacobians of every kind of joint
// displacement.
#include "integrators/radau/stage_lanes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <type_traits>
#include <vector>

#include "joints/joint_checks_for_tests.h"

namespace pintle {
namespace {

using sample::Couple;
using sample::Random;
using Vec = Planar::Vec;

template <int N>
void put(PlanarBodyLanes<N>& body, int lane, const Vec& q, const Vec& v) {
  for (int k = 0; k < 3; ++k) {
    body.q[k].set(lane, q[k]);
    body.v[k].set(lane, v[k]);
  }
  body.c.set(lane, std::cos(q[2]));
  body.s.set(lane, std::sin(q[2]));
}

template <class T>
GapMap<T> map_of(const PoseGeometry<T>& pose) {
  GapMap<T> map;
  map.set(pose);
  return map;
}

// Gradients of a gap that is a function of the pose, into a lane of the map.
template <class Map>
void find_gradients(const JointDisplacement& displacement, const Vec& z, int lane, Map& map) {
  map.functions = count_functions(displacement);
  for_each_function(displacement, z, [&](int f, const GapFunction& g) {
    for (int k = 0; k < 3; ++k) map.gradient[f][k].set(lane, g.gradient[k]);
  });
}

const std::vector<JointDisplacement>& every_kind_of_displacement() {
  static const std::vector<JointDisplacement> all{Selection{}, Distance{0.8}, Mesh{0.3, 0.7, 1, 0}, Mesh{0.3, 0.7, -1, 0.1}, RackMesh{0.4, 1, 0}, RackMesh{0.4, -1, 0.2},
                                                  Mesh{0.3, 0.7, 1, 0, true}, Mesh{0.3, 0.7, -1, 0.1, true}, RackMesh{0.4, -1, 0.2, true}};
  return all;
}

// The map at each of N pairs of bodies with the same frames, and the joint kinematics there.
template <int N>
struct Poses {
  std::vector<Couple> couple;
  std::vector<JointKinematics> kinematics;
  PlanarBodyLanes<N> A, B;
  PoseGeometry<Lanes<N>> pose;
  GapMap<Lanes<N>> map;

  Poses(const JointDisplacement& displacement, Random& random) : couple(N, sample::random_couple(random)) {
    for (int i = 0; i < N; ++i) {
      Couple& c = couple[i];
      sample::place_at_random(random, 0.4, c);
      kinematics.push_back(sample::kinematics(displacement, c));
      put(A, i, c.qA, c.vA);
      put(B, i, c.qB, c.vB);
    }
    pose = PoseGeometry<Lanes<N>>::between(A.view(), couple[0].F, B.view(), couple[0].M);
    map = map_of(pose);
    for (int i = 0; i < N; ++i) find_gradients(displacement, couple[i].pose().z, i, map);
  }
  // The map at one of them.
  GapMap<double> frozen(int i) const {
    return map.lane(i);
  }
};

template <int N>
Vec lane(const Lanes<N>* x, int i) { return {x[0][i], x[1][i], x[2][i]}; }
template <int N>
Vec lane(const Spectrum<N>* x, int i) { return {x[0].x[i], x[1].x[i], x[2].x[i]}; }
template <int N>
void set_random(Random& random, Lanes<N>& x) {
  for (int i = 0; i < N; ++i) x.set(i, random.uniform(-5, 5));
}
template <int N>
void set_random(Random& random, Spectrum<N>& x) { set_random(random, x.x); }

// G' f and G a in every lane, against the Jacobians that `kinematics` gives for it.
template <int N, class T, class U, class JointKinematics>
void expect_map(const GapMap<T>& map, Random& random, JointKinematics&& kinematics) {
  U f[3], on_a[3], on_b[3], e[3];
  for (auto* x : {f, on_a, on_b})
    for (int k = 0; k < 3; ++k) set_random(random, x[k]);
  const auto spread = map.spread(f);
  map.gather(on_a, on_b, e);
  const U to_a[3] = {-spread.fx, -spread.fy, spread.ma}, to_b[3] = {spread.fx, spread.fy, spread.mb};
  for (int i = 0; i < N; ++i) {
    const auto& r = kinematics(i);
    sample::expect_close<Vec>(lane(to_a, i), r.GA().transpose() * lane(f, i), 1e-14, "force on A");
    sample::expect_close<Vec>(lane(to_b, i), r.GB().transpose() * lane(f, i), 1e-14, "force on B");
    sample::expect_close<Vec>(lane(e, i), r.GA() * lane(on_a, i) + r.GB() * lane(on_b, i), 1e-14, "acceleration of the gap");
  }
}

template <int N>
void expect_maps() {
  Random random(41);
  for (const JointDisplacement& displacement : every_kind_of_displacement())
    for (int again = 0; again < 50; ++again) {
      const Poses<N> at(displacement, random);
      expect_map<N, Lanes<N>, Lanes<N>>(at.map, random, [&](int i) { return at.kinematics[i]; });
      for (int i = 0; i < N; ++i) {
        expect_map<N, double, Lanes<N>>(at.frozen(i), random, [&](int) { return at.kinematics[i]; });
        expect_map<N, double, Spectrum<N>>(at.frozen(i), random, [&](int) { return at.kinematics[i]; });
        const Vec bias(at.pose.bias_x[i], at.pose.bias_y[i], 0);
        sample::expect_close<Vec>(bias, at.couple[i].pose().bias, 1e-14, "convective acceleration");
        const Planar::Motion a = at.A.motion(i), expected = at.couple[i].A();
        EXPECT_TRUE(a.p == expected.p && a.v == expected.v && a.angle == expected.angle && a.w == expected.w && a.c == expected.c && a.s == expected.s);
      }
      if (testing::Test::HasFailure()) return;
    }
}

TEST(GapMap, IsThatOfTheJointInEveryLane) {
  expect_maps<3>();
  expect_maps<5>();
}

}  // namespace
}  // namespace pintle
