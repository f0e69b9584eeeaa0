// The Jacobians that the general methods use, against finite differences of the forces.
#include "integrators/general/force_tangents.h"

#include <gtest/gtest.h>

#include "integrators/general/first_order_ode.h"
#include "integrators/start_states_for_tests.h"

namespace pintle {
namespace {

// A random state of the model that contains everything, and the first-order equations there.
struct Everything {
  const System system;
  State state;
  std::vector<double> y;
  FirstOrderOde equations;

  explicit Everything(FirstOrderOde::Energies energies) : system(settled()), state(zero_state(system)), equations(system, energies) {
    sample::Random random(17);
    sample::random_state(random, system.bodies.size(), state.q, state.v);
    state.t = 0.3;
    y.resize(equations.size());
    equations.flatten(state, y.data());
  }
  static System settled() {
    const Model model = sample::everything();
    System system = build_system(model);
    sample::Random random(3);
    Vecs q, v;
    sample::random_state(random, system.bodies.size(), q, v);
    std::vector<std::string> notes;
    return fix_assembled_values(model, std::move(system), q, notes);
  }
  // d f / d y by central differences, column k.
  std::vector<double> column(int k) {
    const double h = 1e-6;
    std::vector<double> up = y, down = y, fu(y.size()), fd(y.size());
    up[k] += h;
    down[k] -= h;
    EXPECT_TRUE(equations.rate(state.t, up.data(), fu.data()) && equations.rate(state.t, down.data(), fd.data()));
    for (std::size_t i = 0; i < fu.size(); ++i) fu[i] = (fu[i] - fd[i]) / (2 * h);
    return fu;
  }
};

TEST(ForceTangents, AreTheDifferencesOfTheAccelerations) {
  Everything at(FirstOrderOde::Energies::kLeftOut);
  at.equations.linearize(at.state.t, at.y.data());
  const int n = at.system.n_bodies(), half = 3 * n;
  for (int j = 0; j < n; ++j)
    for (int c = 0; c < 6; ++c) {
      const int k = c < 3 ? 3 * j + c : half + 3 * j + c - 3;
      std::vector<double> rest = at.column(k);
      for (const FirstOrderOde::Coupling& to : at.equations.couplings(j)) {
        const Planar::Mat block = c < 3 ? at.equations.by_position(to) : at.equations.by_velocity(to);
        for (int r = 0; r < 3; ++r) rest[half + 3 * to.row + r] -= block(r, c % 3);
      }
      for (int i = half; i < 2 * half; ++i) EXPECT_NEAR(rest[i], 0, 2e-5) << "column " << k << ", row " << i;
    }
}

TEST(ForceTangents, CombineIntoTheMatrixOfAnImplicitStep) {
  Everything at(FirstOrderOde::Energies::kLeftOut);
  ForceTangents tangents(at.system);
  tangents.find(at.state.t, at.state.q, at.state.v, at.state.law_state);
  const int n = at.system.n_bodies();
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  for (int j = 0; j < n; ++j)
    for (const FirstOrderOde::Coupling& to : at.equations.couplings(j))
      dense.block<3, 3>(3 * to.row, 3 * j) = -0.3 * tangents.by_position(to.place) - 0.7 * tangents.by_velocity(to.place);
  for (int i = 0; i < n; ++i) dense.diagonal().segment<3>(3 * i) += 2 * at.system.bodies[i].mass;
  BlockLu<double, 3> lu(at.system.pattern());
  tangents.combine(2, 0.3, 0.7, lu);
  ASSERT_TRUE(lu.factorize());
  Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(3 * n, -1, 2);
  std::vector<BlockVec<double, 3>> x(n);
  for (int i = 0; i < n; ++i) x[i] = {{b[3 * i], b[3 * i + 1], b[3 * i + 2]}};
  lu.solve(x);
  Eigen::VectorXd solution(3 * n);
  for (int i = 0; i < 3 * n; ++i) solution[i] = x[i / 3][i % 3];
  EXPECT_LT((dense * solution - b).norm(), 1e-9 * b.norm());
}

// The rates of the energies are the powers, and nothing depends on the energies.
TEST(ForceTangents, EnergiesRideAlong) {
  Everything with(FirstOrderOde::Energies::kAppended), without(FirstOrderOde::Energies::kLeftOut);
  ASSERT_EQ(with.equations.size(), without.equations.size() + 2);
  std::vector<double> f(with.y.size()), g(without.y.size());
  ASSERT_TRUE(with.equations.rate(0.3, with.y.data(), f.data()));
  ASSERT_TRUE(without.equations.rate(0.3, without.y.data(), g.data()));
  for (std::size_t i = 0; i < g.size(); ++i) EXPECT_NEAR(f[i], g[i], 1e-12 * (1 + std::abs(g[i])));
  ForceEvaluator(with.system).complete(with.state);
  EXPECT_EQ(f[g.size()], with.state.loss_power);
  EXPECT_EQ(f[g.size() + 1], with.state.supply_power);
  for (const int k : {with.equations.motion_size(), with.equations.motion_size() + 1})
    for (const double x : with.column(k)) EXPECT_EQ(x, 0);
}

}  // namespace
}  // namespace pintle
