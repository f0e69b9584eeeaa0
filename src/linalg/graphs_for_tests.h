// Graphs for elimination, given by their edges.
#pragma once

#include <utility>
#include <vector>

namespace pintle::sample {

using Pairs = std::vector<std::pair<int, int>>;

inline Pairs chain(int n) {
  Pairs pairs;
  for (int i = 1; i < n; ++i) pairs.emplace_back(i - 1, i);
  return pairs;
}

inline Pairs loop(int n) {
  Pairs pairs = chain(n);
  pairs.emplace_back(n - 1, 0);
  return pairs;
}

inline Pairs star(int n) {
  Pairs pairs;
  for (int i = 1; i < n; ++i) pairs.emplace_back(0, i);
  return pairs;
}

// Binary tree: every node has two children.
inline Pairs tree(int n) {
  Pairs pairs;
  for (int i = 1; i < n; ++i) pairs.emplace_back((i - 1) / 2, i);
  return pairs;
}

// Two rails of n rows with n rungs.
inline Pairs ladder(int n) {
  Pairs pairs;
  for (int i = 0; i < n; ++i) {
    pairs.emplace_back(2 * i, 2 * i + 1);
    if (i > 0) pairs.emplace_back(2 * i - 2, 2 * i);
    if (i > 0) pairs.emplace_back(2 * i - 1, 2 * i + 1);
  }
  return pairs;
}

inline Pairs grid(int rows, int columns) {
  Pairs pairs;
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      if (i > 0) pairs.emplace_back((i - 1) * columns + j, i * columns + j);
      if (j > 0) pairs.emplace_back(i * columns + j - 1, i * columns + j);
    }
  return pairs;
}

}  // namespace pintle::sample
