#include "linalg/block_pattern.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cassert>
#include <numeric>

namespace pintle {

BlockPattern::BlockPattern(int n, const std::vector<std::pair<int, int>>& pairs) : n_(n) {
  order_rows(pairs);
  find_fill(pairs);
  list_updates();
}

void BlockPattern::order_rows(const std::vector<std::pair<int, int>>& pairs) {
  position_.assign(n_, -1);
  peel(pairs);
  order_core(pairs);
  for (int k = 0; k < n_; ++k) position_[order_[k]] = k;
}

// Rows with at most one remaining neighbour go first: they create no fill. This alone orders trees and chains; minimum degree,
// which may merge siblings, is used only for the rows in loops. Chains are eliminated from both ends alternately, which a
// processor executes in parallel.
void BlockPattern::peel(const std::vector<std::pair<int, int>>& pairs) {
  std::vector<std::vector<int>> neighbours(n_);
  for (const auto& [i, j] : pairs) {
    neighbours[i].push_back(j);
    neighbours[j].push_back(i);
  }
  std::vector<int> left(n_);
  for (int i = 0; i < n_; ++i) {
    auto& row = neighbours[i];
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    left[i] = static_cast<int>(row.size());
  }
  const auto take = [&](int i) {
    position_[i] = static_cast<int>(order_.size());
    order_.push_back(i);
  };
  for (int i = 0; i < n_; ++i)
    if (left[i] <= 1) take(i);
  for (std::size_t k = 0; k < order_.size(); ++k)
    for (const int j : neighbours[order_[k]])
      if (position_[j] < 0 && --left[j] <= 1) take(j);
}

// Orders the remaining rows by approximate minimum degree.
void BlockPattern::order_core(const std::vector<std::pair<int, int>>& pairs) {
  std::vector<int> core, index(n_, -1);
  for (int i = 0; i < n_; ++i)
    if (position_[i] < 0) {
      index[i] = static_cast<int>(core.size());
      core.push_back(i);
    }
  if (core.empty()) return;
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t i = 0; i < core.size(); ++i) entries.emplace_back(i, i, 1.0);
  for (const auto& [i, j] : pairs) {
    if (index[i] < 0 || index[j] < 0) continue;
    entries.emplace_back(index[i], index[j], 1.0);
    entries.emplace_back(index[j], index[i], 1.0);
  }
  const auto n = static_cast<Eigen::Index>(core.size());
  Eigen::SparseMatrix<double> graph(n, n);
  graph.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
  Eigen::AMDOrdering<int>()(graph.selfadjointView<Eigen::Upper>(), permutation);
  for (Eigen::Index k = 0; k < n; ++k) order_.push_back(core[permutation.indices()[k]]);
}

// Row k's fill pattern consists of its own couplings and those inherited from the rows whose first later neighbour it is.
void BlockPattern::find_fill(const std::vector<std::pair<int, int>>& pairs) {
  std::vector<std::vector<int>> later(n_);
  for (const auto& [i, j] : pairs) {
    const int a = position_[i], b = position_[j];
    later[std::min(a, b)].push_back(std::max(a, b));
  }
  first_.assign(n_ + 1, 0);
  for (int k = 0; k < n_; ++k) {
    auto& row = later[k];
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    if (row.size() > 1) {
      auto& heir = later[row.front()];
      heir.insert(heir.end(), row.begin() + 1, row.end());
    }
    columns_.insert(columns_.end(), row.begin(), row.end());
    first_[k + 1] = static_cast<int>(columns_.size());
    std::vector<int>().swap(row);
  }
}

void BlockPattern::list_updates() {
  first_update_.assign(n_ + 1, 0);
  for (int k = 0; k < n_; ++k) {
    for (int a = first_[k]; a < first_[k + 1]; ++a)
      for (int b = first_[k]; b < first_[k + 1]; ++b) {
        const int i = columns_[a], j = columns_[b];
        updates_.push_back(i == j ? 0 : i < j ? find_upper(i, j) + 1 : -(find_upper(j, i) + 1));
      }
    first_update_[k + 1] = updates_.size();
  }
}

BlockPattern BlockPattern::in_order() const {
  BlockPattern ordered = *this;
  std::iota(ordered.order_.begin(), ordered.order_.end(), 0);
  ordered.position_ = ordered.order_;
  return ordered;
}

int BlockPattern::find_upper(int row, int column) const {
  const auto begin = columns_.begin() + first_[row], end = columns_.begin() + first_[row + 1];
  const auto it = std::lower_bound(begin, end, column);
  assert(it != end && *it == column);
  return static_cast<int>(it - columns_.begin());
}

int BlockPattern::longest_row() const {
  int longest = 0;
  for (int k = 0; k < n_; ++k) longest = std::max(longest, first_[k + 1] - first_[k]);
  return longest;
}

BlockPattern::Slot BlockPattern::slot(int i, int j) const {
  const int a = position_[i], b = position_[j];
  return a < b ? Slot{find_upper(a, b), true} : Slot{find_upper(b, a), false};
}

}  // namespace pintle
