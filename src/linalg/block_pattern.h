// The block structure of a body-by-body matrix: the joint graph, a fill-reducing order of elimination determined once,
// and the resulting fill. The pattern is symmetric; the values need not be.
#pragma once

#include <utility>
#include <vector>

namespace pintle {

class BlockPattern {
 public:
  BlockPattern() = default;
  /// `pairs` are the coupled rows (i, j), i != j; repeats and either order are allowed.
  BlockPattern(int n, const std::vector<std::pair<int, int>>& pairs);

  int n() const { return n_; }
  int n_off_diagonal() const { return static_cast<int>(columns_.size()); }  ///< upper blocks, fill included
  /// Position of row i in the order of elimination.
  int position(int i) const { return position_[i]; }
  int row_at(int position) const { return order_[position]; }
  /// The same pattern with rows numbered by their positions.
  BlockPattern in_order() const;

  /// The off-diagonal block of (i, j) as rows of the user's numbering: its index, and whether it is in the upper part.
  struct Slot {
    int index;
    bool upper;
  };
  Slot slot(int i, int j) const;

  // For the elimination: the upper blocks of pivot k are first(k)..first(k+1); columns in elimination order; and for each
  // pair (a, b) of them the block that their product changes, as index + 1 of the upper block or -(index + 1) of the
  // lower one, or 0 for the diagonal.
  int first(int k) const { return first_[k]; }
  int longest_row() const;  ///< largest number of upper blocks of a pivot
  int column(int index) const { return columns_[index]; }
  const int* updates(int k) const { return updates_.data() + first_update_[k]; }

 private:
  int find_upper(int row, int column) const;
  void order_rows(const std::vector<std::pair<int, int>>& pairs);
  void peel(const std::vector<std::pair<int, int>>& pairs);
  void order_core(const std::vector<std::pair<int, int>>& pairs);
  void find_fill(const std::vector<std::pair<int, int>>& pairs);
  void list_updates();

  int n_ = 0;
  std::vector<int> order_, position_, first_, columns_, updates_;
  std::vector<std::size_t> first_update_;
};

}  // namespace pintle
