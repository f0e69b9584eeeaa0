// Fill of the order of elimination, by counts.
#include "linalg/block_pattern.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "linalg/graphs_for_tests.h"

namespace pintle {
namespace {

using namespace sample;

double products(const BlockPattern& p) {
  double sum = 0;
  for (int k = 0; k < p.n(); ++k) sum += std::pow(p.first(k + 1) - p.first(k), 2);
  return sum;
}

TEST(BlockPattern, AForestIsEliminatedWithoutFill) {
  for (const int n : {2, 7, 1000, 30000}) {
    EXPECT_EQ(BlockPattern(n, chain(n)).n_off_diagonal(), n - 1);
    if (n != 7) continue;  // small graphs keep to minimum degree
    EXPECT_EQ(BlockPattern(n, tree(n)).n_off_diagonal(), n - 1);
  }
  for (const int n : {1000, 30000}) {
    EXPECT_EQ(BlockPattern(n, tree(n)).n_off_diagonal(), n - 1);
    EXPECT_EQ(BlockPattern(n, {}).n_off_diagonal(), 0);
  }
}

TEST(BlockPattern, ALadderFillsInProportion) {
  for (const int n : {500, 5000, 50000}) {
    const BlockPattern p(2 * n, ladder(n));
    EXPECT_LE(p.n_off_diagonal(), 4.5 * n);  // 3 n without any fill
    EXPECT_LE(products(p), 12.0 * n);
  }
}

// As nested dissection would, which needs about 31/8 n log2 n of them for large n (George 1973).
TEST(BlockPattern, AGridFillsAsNLogN) {
  for (const int edge : {20, 40, 80}) {
    const double n = edge * edge;
    const BlockPattern p(edge * edge, grid(edge, edge));
    EXPECT_LE(p.n_off_diagonal(), 2 * n * std::log2(n)) << edge;
    EXPECT_LE(products(p), 16 * std::pow(n, 1.5)) << edge;
  }
}

TEST(BlockPattern, ThePartsOfAGraphThatHangOnALoopComeFirst) {
  Pairs pairs = chain(300);
  pairs.emplace_back(100, 160);
  const BlockPattern p(300, pairs);
  EXPECT_LE(p.n_off_diagonal(), 300 + 58);  // the loop of 61 has one fill for each row except three
  int last_outside = 0, first_inside = 300;
  for (int i = 0; i < 300; ++i)
    (i < 100 || i > 160 ? last_outside = std::max(last_outside, p.position(i)) : first_inside = std::min(first_inside, p.position(i)));
  EXPECT_LT(last_outside, first_inside);
}

TEST(BlockPattern, EveryRowHasOnePlace) {
  Pairs pairs = grid(20, 20);
  for (int i = 400; i < 500; ++i) pairs.emplace_back(i - 300, i);
  const BlockPattern p(500, pairs);
  for (int k = 0; k < 500; ++k) EXPECT_EQ(p.position(p.row_at(k)), k);
}

}  // namespace
}  // namespace pintle
