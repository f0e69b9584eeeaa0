#include "solve/block_pattern.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cassert>

namespace pintle {

BlockPattern::BlockPattern(int n, const std::vector<std::pair<int, int>>& pairs) : n_(n) {
  order_rows(pairs);
  find_fill(pairs);
  list_updates();
}

void BlockPattern::order_rows(const std::vector<std::pair<int, int>>& pairs) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n_; ++i) entries.emplace_back(i, i, 1.0);
  for (const auto& [i, j] : pairs) {
    entries.emplace_back(i, j, 1.0);
    entries.emplace_back(j, i, 1.0);
  }
  Eigen::SparseMatrix<double> graph(n_, n_);
  graph.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
  if (n_ > 0) Eigen::AMDOrdering<int>()(graph.selfadjointView<Eigen::Upper>(), permutation);
  order_.resize(n_);
  position_.resize(n_);
  for (int k = 0; k < n_; ++k) {
    order_[k] = permutation.indices()[k];
    position_[order_[k]] = k;
  }
}

// Row k's fill pattern is its own couplings plus what it inherits from the rows whose first later neighbour it is.
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

int BlockPattern::find_upper(int row, int column) const {
  const auto begin = columns_.begin() + first_[row], end = columns_.begin() + first_[row + 1];
  const auto it = std::lower_bound(begin, end, column);
  assert(it != end && *it == column);
  return static_cast<int>(it - columns_.begin());
}

BlockPattern::Slot BlockPattern::slot(int i, int j) const {
  const int a = position_[i], b = position_[j];
  return a < b ? Slot{find_upper(a, b), true} : Slot{find_upper(b, a), false};
}

}  // namespace pintle
