// The block factorisation against dense matrices, on chains, loops, grids, stars and random graphs.
#include "linalg/block_lu.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <complex>
#include <limits>
#include <set>

#include "base/random_for_tests.h"
#include "linalg/graphs_for_tests.h"
#include "linalg/spectrum.h"

namespace pintle {
namespace {

using namespace sample;

struct Graph {
  const char* name;
  int n;
  Pairs pairs;
};

Graph random_graph(Random& random, int n, int edges) {
  Graph g{"random", n, {}};
  while (static_cast<int>(g.pairs.size()) < edges) {
    const int i = random.below(n), j = random.below(n);
    if (i != j) g.pairs.emplace_back(i, j);
  }
  return g;
}

std::vector<Graph> graphs() {
  Random random(11);
  std::vector<Graph> all{{"one", 1, {}}, {"apart", 4, {}}, {"chain", 2, chain(2)}, {"chain", 17, chain(17)},
                         {"loop", 3, loop(3)}, {"loop", 20, loop(20)}, {"star", 12, star(12)}, {"grid", 20, grid(4, 5)}, {"grid", 49, grid(7, 7)}};
  for (int i = 0; i < 12; ++i) all.push_back(random_graph(random, 3 + random.below(20), 2 + random.below(40)));
  return all;
}

// The number of systems that one matrix of T represents: one real, or those of a spectrum.
template <class T>
constexpr int kSystems = 1;
template <int N>
constexpr int kSystems<Spectrum<N>> = N / 2 + 1;

std::complex<double> to_std(double x, int) { return x; }
template <int N>
std::complex<double> to_std(const Spectrum<N>& x, int system) {
  if (system == N / 2) return x.x[N - 1];
  return {x.x[2 * system], x.x[2 * system + 1]};
}
void put_random(Random& random, double& x) { x = random.uniform(-1, 1); }
template <int N>
void put_random(Random& random, Spectrum<N>& x) {
  for (int i = 0; i < N; ++i) x.x.set(i, random.uniform(-1, 1));
}

template <class T>
void compare_with_dense(const Graph& g, Random& random, Symmetry symmetry) {
  constexpr int N = 3;
  const BlockPattern pattern(g.n, g.pairs);
  BlockLu<T, N> lu(pattern, symmetry);
  lu.set_diagonal([](int, int) { return T(0.0); });
  std::vector<Eigen::MatrixXcd> dense(kSystems<T>, Eigen::MatrixXcd::Zero(N * g.n, N * g.n));
  const auto fill = [&](Block<T, N>& block, int i, int j) {
    for (int r = 0; r < N; ++r)
      for (int c = 0; c < N; ++c) {
        T x{};
        put_random(random, x);
        if (i == j && r == c) x += T(20.0);
        block(r, c) += x;
        for (int s = 0; s < kSystems<T>; ++s) dense[s](N * i + r, N * j + c) += to_std(x, s);
      }
  };
  for (int i = 0; i < g.n; ++i) fill(lu.diagonal(i), i, i);
  for (const auto& [i, j] : g.pairs)
    for (const auto& [row, column] : {std::pair{i, j}, std::pair{j, i}})
      if (const BlockPattern::Slot slot = pattern.slot(row, column); lu.has(slot)) fill(lu.off_diagonal(slot), row, column);
  if (lu.symmetric()) {
    for (int i = 0; i < g.n; ++i) {
      Block<T, N>& block = lu.diagonal(i);
      for (int r = 0; r < N; ++r)
        for (int c = 0; c < r; ++c) {
          block(r, c) = block(c, r);
          for (auto& m : dense) m(N * i + r, N * i + c) = m(N * i + c, N * i + r);
        }
    }
    for (auto& m : dense)
      for (const auto& [i, j] : g.pairs) {
        const BlockPattern::Slot slot = pattern.slot(i, j);
        const int row = slot.upper ? i : j, column = slot.upper ? j : i;
        m.block<N, N>(N * column, N * row) = m.block<N, N>(N * row, N * column).transpose();
      }
  }
  std::vector<BlockVec<T, N>> x(g.n);
  std::vector<Eigen::VectorXcd> expected(kSystems<T>, Eigen::VectorXcd(N * g.n));
  for (int i = 0; i < g.n; ++i)
    for (int k = 0; k < N; ++k) {
      put_random(random, x[i][k]);
      for (int s = 0; s < kSystems<T>; ++s) expected[s][N * i + k] = to_std(x[i][k], s);
    }
  for (int s = 0; s < kSystems<T>; ++s) expected[s] = dense[s].partialPivLu().solve(Eigen::VectorXcd(expected[s]));
  const auto expect_solved = [&](const std::vector<BlockVec<T, N>>& y) {
    for (int s = 0; s < kSystems<T>; ++s) {
      double worst = 0;
      for (int i = 0; i < g.n; ++i)
        for (int k = 0; k < N; ++k) worst = std::max(worst, std::abs(to_std(y[i][k], s) - expected[s][N * i + k]));
      EXPECT_LT(worst, 1e-12 * (1 + expected[s].cwiseAbs().maxCoeff())) << g.name << " of " << g.n << ", system " << s;
    }
  };
  // In one forward and one backward pass, with right-hand sides supplied and solutions taken row by row.
  BlockLu<T, N> on_the_way = lu;
  std::vector<BlockVec<T, N>> rows(g.n), taken(g.n);
  const auto bring = [&](int i, BlockVec<T, N>& row) {
    for (int k = 0; k < N; ++k) row[k] += x[i][k];
  };
  const auto take = [&](int i, const BlockVec<T, N>& row) { taken[i] = row; };
  for (int from = 0, filled = 1; filled <= g.n; ++filled) {
    const int to = on_the_way.ready(filled, from);
    ASSERT_TRUE(on_the_way.eliminate(from, to, rows, bring)) << g.name;
    from = to;
  }
  for (int to = g.n; to > 0; to = (to - 1) / 2) on_the_way.substitute((to - 1) / 2, to, rows, take);
  expect_solved(taken);
  ASSERT_TRUE(lu.factorize()) << g.name;
  for (int again = 0; again < 2; ++again) {  // one factorisation serves any number of right-hand sides
    auto y = x;
    lu.solve(y);
    expect_solved(y);
    std::fill(rows.begin(), rows.end(), BlockVec<T, N>{});
    lu.reduce(0, g.n, rows, bring);
    lu.substitute(0, g.n, rows, take);
    expect_solved(taken);
  }
}

TEST(BlockLu, RealSolutionsAreTheDenseOnes) {
  Random random(1);
  for (const Graph& g : graphs())
    for (const Symmetry symmetry : {Symmetry::kNone, Symmetry::kSymmetric}) compare_with_dense<double>(g, random, symmetry);
}

TEST(BlockLu, EverySolutionOfASpectrumIsTheDenseOne) {
  Random random(2);
  for (const Graph& g : graphs())
    for (const Symmetry symmetry : {Symmetry::kNone, Symmetry::kSymmetric}) {
      compare_with_dense<Spectrum<3>>(g, random, symmetry);
      compare_with_dense<Spectrum<5>>(g, random, symmetry);
    }
}

// Right-hand sides in lanes are solved as if each were separate.
TEST(BlockLu, SolvesRightHandSidesSideBySide) {
  constexpr int N = 3;
  Random random(3);
  for (const Graph& g : graphs()) {
    const BlockPattern pattern(g.n, g.pairs);
    BlockLu<double, N> lu(pattern);
    lu.set_diagonal([](int, int) { return 0.0; });
    const auto fill = [&](Block<double, N>& block, double diagonal) {
      for (int r = 0; r < N; ++r)
        for (int c = 0; c < N; ++c) block(r, c) += random.uniform(-1, 1) + (r == c ? diagonal : 0);
    };
    for (int i = 0; i < g.n; ++i) fill(lu.diagonal(i), 20);
    for (const auto& [i, j] : g.pairs) {
      fill(lu.off_diagonal(pattern.slot(i, j)), 0);
      fill(lu.off_diagonal(pattern.slot(j, i)), 0);
    }
    ASSERT_TRUE(lu.factorize()) << g.name;
    std::vector<std::vector<BlockVec<double, N>>> single(3, std::vector<BlockVec<double, N>>(g.n));
    std::vector<BlockVec<Lanes<3>, N>> together(g.n);
    for (int i = 0; i < g.n; ++i)
      for (int k = 0; k < N; ++k)
        for (int lane = 0; lane < 3; ++lane) {
          put_random(random, single[lane][i][k]);
          together[i][k].set(lane, single[lane][i][k]);
        }
    lu.solve(together);
    for (int lane = 0; lane < 3; ++lane) {
      lu.solve(single[lane]);
      for (int i = 0; i < g.n; ++i)
        for (int k = 0; k < N; ++k) EXPECT_NEAR(together[i][k][lane], single[lane][i][k], 1e-15) << g.name;
    }
  }
}

// It is enough that one of its systems is singular or contains a NaN.
template <int M>
void expect_one_bad_system_is_reported() {
  using X = Spectrum<M>;
  for (const Graph& g : graphs()) {
    const BlockPattern pattern(g.n, g.pairs);
    BlockLu<X, 3> lu(pattern);
    const auto set_to_one = [&] {
      lu.set_diagonal([](int, int) { return X(1.0); });
    };
    set_to_one();
    EXPECT_TRUE(lu.factorize()) << g.name;
    for (int s = 0; s < kSystems<X>; ++s)
      for (const double bad : {0.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        set_to_one();
        lu.diagonal(g.n - 1)(2, 2).x.set(2 * s, bad);
        EXPECT_FALSE(lu.factorize()) << g.name << ", system " << s << " with " << bad;
      }
  }
}

TEST(BlockLu, OneBadSystemOfASpectrumIsReported) {
  expect_one_bad_system_is_reported<3>();
  expect_one_bad_system_is_reported<5>();
}

TEST(BlockLu, SingularMatrixIsReported) {
  for (const Graph& g : graphs()) {
    const BlockPattern pattern(g.n, g.pairs);
    BlockLu<double, 3> lu(pattern);
    lu.set_diagonal([](int, int) { return 0.0; });
    EXPECT_FALSE(lu.factorize()) << g.name;
    lu.set_diagonal([](int, int) { return 1.0; });
    lu.diagonal(g.n - 1)(2, 2) = 0;
    EXPECT_FALSE(lu.factorize()) << g.name;
  }
}

// Two identical rows lead to a zero pivot block during the elimination.
TEST(BlockLu, DependentRowsAreReported) {
  const BlockPattern pattern(2, {{0, 1}});
  BlockLu<double, 3> lu(pattern);
  lu.set_diagonal([](int, int) { return 1.0; });
  for (int k = 0; k < 3; ++k) {
    lu.off_diagonal(pattern.slot(0, 1))(k, k) = lu.off_diagonal(pattern.slot(1, 0))(k, k) = -1;
  }
  EXPECT_FALSE(lu.factorize());
}

TEST(BlockLu, ValuesThatAreNotNumbersAreReported) {
  const BlockPattern pattern(1, {});
  BlockLu<double, 3> lu(pattern);
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    lu.set_diagonal([bad](int, int) { return bad; });
    EXPECT_FALSE(lu.factorize());
  }
}

TEST(Block, FactorisationPivotsWithinTheBlock) {
  Block<double, 3> m;
  m(0, 1) = 2;
  m(1, 2) = 4;
  m(2, 0) = 8;
  RowSwaps<3> swaps;
  ASSERT_TRUE(factorize_pivoted(m, swaps));
  BlockVec<double, 3> x;
  x[0] = 2;
  x[1] = 8;
  x[2] = 24;
  solve_lower(m, swaps, x);
  solve_upper(m, x);
  EXPECT_EQ(x[0], 3);
  EXPECT_EQ(x[1], 1);
  EXPECT_EQ(x[2], 2);
}

// A bar on a stiff pin is nearly free to turn: what little its inertia resists must not be lost in the pin's stiffness when it is eliminated first.
TEST(BlockLu, NearlySingularPivotBlocksLeaveTheRestExact) {
  const BlockPattern pattern(2, {{0, 1}});
  const double k = 1e8, m = 1e-2, lever = 0.3;
  for (const Symmetry symmetry : {Symmetry::kSymmetric, Symmetry::kNone}) {
    BlockLu<double, 3> lu(pattern, symmetry);
    // k G' G + m, with G the displacement of the pin: that of the first body's end less that of the second body's centre.
    const double first[2][3] = {{1, 0, 0.6 * lever}, {0, 1, 0.8 * lever}};
    const BlockPattern::Slot up = pattern.slot(0, 1), down = pattern.slot(1, 0);
    lu.set_diagonal([&](int, int) { return m; });
    for (int g = 0; g < 2; ++g) {
      lu.diagonal(1)(g, g) += k;
      for (int c = 0; c < 3; ++c) {
        for (int d = 0; d < 3; ++d) lu.diagonal(0)(c, d) += k * first[g][c] * first[g][d];
        if (lu.has(up)) lu.off_diagonal(up)(c, g) -= k * first[g][c];
        if (lu.has(down)) lu.off_diagonal(down)(g, c) -= k * first[g][c];
      }
    }
    ASSERT_TRUE(lu.factorize());
    std::vector<Eigen::Vector3d> x(2, Eigen::Vector3d::Zero());
    x[1] << 1, 0, 0;  // a force on the second body: it moves as if the first body's inertia at the pin were added
    lu.solve(x);
    const Eigen::Matrix2d resists = m * (2 * Eigen::Matrix2d::Identity() - Eigen::Vector2d(0.6, 0.8) * Eigen::RowVector2d(0.6, 0.8) * (lever * lever / (1 + lever * lever)));
    const Eigen::Vector2d exact = resists.inverse() * Eigen::Vector2d(1, 0);
    EXPECT_NEAR(x[1][0], exact[0], 1e-6 * exact.norm()) << (symmetry == Symmetry::kNone);
    EXPECT_NEAR(x[1][1], exact[1], 1e-6 * exact.norm());
  }
}

// Elimination on sets of neighbours: those of an eliminated row become neighbours of each other.
TEST(BlockPattern, HoldsExactlyTheFillOfItsOrder) {
  for (const Graph& g : graphs()) {
    const BlockPattern p(g.n, g.pairs);
    std::vector<std::set<int>> later(g.n);
    for (const auto& [i, j] : g.pairs) later[std::min(p.position(i), p.position(j))].insert(std::max(p.position(i), p.position(j)));
    int count = 0;
    for (int k = 0; k < g.n; ++k) {
      for (const int a : later[k])
        for (const int b : later[k])
          if (a < b) later[a].insert(b);
      const std::set<int> found = [&] {
        std::set<int> s;
        for (int a = p.first(k); a < p.first(k + 1); ++a) s.insert(p.column(a));
        return s;
      }();
      EXPECT_EQ(found, later[k]) << g.name << " pivot " << k;
      count += static_cast<int>(found.size());
    }
    EXPECT_EQ(count, p.n_off_diagonal());
  }
}

TEST(BlockPattern, OrderIsAPermutation) {
  for (const Graph& g : graphs()) {
    const BlockPattern p(g.n, g.pairs);
    std::set<int> rows;
    for (int k = 0; k < g.n; ++k) {
      rows.insert(p.row_at(k));
      EXPECT_EQ(p.position(p.row_at(k)), k);
    }
    EXPECT_EQ(static_cast<int>(rows.size()), g.n);
  }
}

TEST(BlockPattern, ChainsAndStarsMakeNoFill) {
  for (const Graph& g : {Graph{"chain", 2, chain(2)}, Graph{"chain", 30, chain(30)}, Graph{"star", 30, star(30)}})
    EXPECT_EQ(BlockPattern(g.n, g.pairs).n_off_diagonal(), static_cast<int>(g.pairs.size())) << g.name;
  EXPECT_EQ(BlockPattern(30, loop(30)).n_off_diagonal(), 30 + 27);  // a loop: one block per row but the last three
}

TEST(BlockPattern, DoesNotDependOnHowThePairsAreWritten) {
  for (const Graph& g : graphs()) {
    Pairs written = g.pairs;
    std::reverse(written.begin(), written.end());
    for (auto& [i, j] : written) std::swap(i, j);
    written.insert(written.end(), g.pairs.begin(), g.pairs.end());  // every pair twice
    const BlockPattern p(g.n, g.pairs), q(g.n, written);
    for (int i = 0; i < g.n; ++i) EXPECT_EQ(p.position(i), q.position(i)) << g.name;
    EXPECT_EQ(p.n_off_diagonal(), q.n_off_diagonal());
  }
}

TEST(BlockPattern, SlotsOfBothTrianglesShareAnIndex) {
  const Graph g{"grid", 16, grid(4, 4)};
  const BlockPattern p(g.n, g.pairs);
  std::set<int> indices;
  for (const auto& [i, j] : g.pairs) {
    const auto ij = p.slot(i, j), ji = p.slot(j, i);
    EXPECT_EQ(ij.index, ji.index);
    EXPECT_NE(ij.upper, ji.upper);
    EXPECT_TRUE(indices.insert(ij.index).second);
  }
}

}  // namespace
}  // namespace pintle
