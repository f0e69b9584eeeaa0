// The derivatives that Newton's method uses over a joint tree, against finite differences.
#include "integrators/relative/tree_instant.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "system/sample_systems_for_tests.h"

namespace pintle {
namespace {

using Eigen::VectorXd;
using sample::random_vector;

// Loads of every kind, and joints of every kind as laws in addition to the tree, which is traversed from first bodies and from second ones.
TEST(TreeInstant, SlopesAreDifferencesOfTheBalanceAndOfTheGaps) {
  const double h = 1e-5;
  const std::vector<std::string> trees[] = {{"g", "r", "p", "f"}, {"h", "p", "f", "s"}, {"r", "p", "f", "s"}, {"g", "s", "f"}, {}};
  for (const std::vector<std::string>& ideal : trees) {
    System system = sample::with_ideal(build_system(sample::everything()), ideal);
    for (JointData& joint : system.joints)
      if (joint.type == "fixed") std::get<Selection>(joint.displacement).offset[2] = 2 * std::numbers::pi;
    const JointTree tree(system);
    sample::Random random(11);
    TreeInstant at(system, tree);
    const int n = tree.n();
    const VectorXd y = random_vector(random, n, 1.5), u = random_vector(random, n, 1.5), w = random_vector(random, n, 3), f = random_vector(random, at.n_gaps(), 5);
    const double t = 0.31;
    TreeSlopes slopes;
    at.place(t, y, u);
    at.accelerate(w);
    at.find_matrices();
    at.slopes(f, slopes);
    std::vector<bool> exact(tree.laws().size());  // gaps that are not functions of the pose; for functions a third derivative is left out
    int counted = 0;
    for (std::size_t l = 0; l < exact.size(); ++l) counted += exact[l] = count_functions(system.joints[tree.laws()[l]].displacement) == 0;
    ASSERT_GT(counted, 0);
    const auto equations_at = [&](const VectorXd& y_there, const VectorXd& u_there) {
      TreeInstant there(system, tree);
      VectorXd balance, gaps;
      there.place(t, y_there, u_there);
      there.accelerate(w);
      there.imbalance(f, balance);
      there.gap_accelerations(gaps);
      return std::pair(balance, gaps);
    };
    for (int k = 0; k < n; ++k) {
      const VectorXd step = h * VectorXd::Unit(n, k);
      for (const bool of_rate : {false, true}) {
        const auto [b1, g1] = of_rate ? equations_at(y, u + step) : equations_at(y + step, u);
        const auto [b0, g0] = of_rate ? equations_at(y, u - step) : equations_at(y - step, u);
        const VectorXd balance = (b1 - b0) / (2 * h), gaps = (g1 - g0) / (2 * h);
        const VectorXd found = (of_rate ? slopes.balance_by_rate : slopes.balance).col(k), of_gaps = (of_rate ? slopes.gap_by_rate : slopes.gap).col(k);
        EXPECT_LT((balance - found).cwiseAbs().maxCoeff(), 1e-6 * (1 + balance.cwiseAbs().maxCoeff())) << fmt::format("{} ", fmt::join(ideal, "")) << k << of_rate;
        for (std::size_t l = 0; l < exact.size(); ++l) {
          if (!exact[l] && !of_rate) continue;
          const auto row = 3 * static_cast<Eigen::Index>(l);
          EXPECT_LT((gaps - of_gaps).segment<3>(row).cwiseAbs().maxCoeff(), 1e-6 * (1 + gaps.cwiseAbs().maxCoeff())) << fmt::format("{} ", fmt::join(ideal, "")) << k << of_rate << system.joints[tree.laws()[l]].name;
        }
      }
    }
  }
}

}  // namespace
}  // namespace pintle
