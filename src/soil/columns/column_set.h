#pragma once

#include <cstdint>
#include <vector>

#include "soil/columns/columns.h"

namespace tera {

/// A set of columns, one bit for each. Iteration goes by tile and row, so that neighbours in the
/// ground are close in memory.
class ColumnSet {
 public:
  bool Contains(ColumnId k) const {
    const std::size_t row = k >> Columns::kRowBits;
    return row < rows_.size() && (rows_[row] >> (k & Columns::kRowMask) & 1) != 0;
  }
  void Add(ColumnId k);
  /// Adds a column and its eight neighbours. All must belong to one tile.
  void AddWithNeighbours(ColumnId k);
  std::size_t size() const;
  /// Overwrites `ids` with all members in ascending order.
  void ListTo(std::vector<ColumnId>* ids) const;
  void clear();

 private:
  static constexpr int kRowsOfTile = 1 << (Columns::kTileBits - Columns::kRowBits);
  std::uint64_t& Row(std::size_t row);

  std::vector<std::uint64_t> rows_;     ///< one bit for each column of a row
  std::vector<std::uint8_t> has_some_;  ///< for each tile: 1 if the set holds any of its columns
};

}  // namespace tera
