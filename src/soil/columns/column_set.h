#pragma once

#include <cstdint>
#include <vector>

#include "soil/columns/columns.h"

namespace tera {

/// A set of columns, one bit each. Its walk goes tile by tile and row by row, whatever the order of
/// insertion: neighbours in the ground are neighbours in memory.
class ColumnSet {
 public:
  bool Contains(ColumnId k) const {
    const std::size_t row = k >> Columns::kRowBits;
    return row < rows_.size() && (rows_[row] >> (k & Columns::kRowMask) & 1) != 0;
  }
  void Add(ColumnId k);
  /// Adds a column that has neighbours of its own tile on all sides, and those.
  void AddWithNeighbours(ColumnId k);
  std::size_t size() const;
  /// All of it, in the order of the ids; `ids` is overwritten.
  void ListTo(std::vector<ColumnId>* ids) const;
  void clear();

 private:
  static constexpr int kRowsOfTile = 1 << (Columns::kTileBits - Columns::kRowBits);
  std::uint64_t& Row(std::size_t row);

  std::vector<std::uint64_t> rows_;     ///< a bit for each column of a row
  std::vector<std::uint8_t> has_some_;  ///< of each tile: whether any of its columns is in
};

}  // namespace tera
