#include "soil/columns/column_set.h"

#include <algorithm>
#include <bit>

namespace tera {

std::uint64_t& ColumnSet::Row(std::size_t row) {
  const std::size_t tile = row / kRowsOfTile;
  if (tile >= has_some_.size()) {
    has_some_.resize(tile + 1);
    rows_.resize((tile + 1) * kRowsOfTile);
  }
  has_some_[tile] = 1;
  return rows_[row];
}

void ColumnSet::Add(ColumnId k) {
  Row(k >> Columns::kRowBits) |= std::uint64_t{1} << (k & Columns::kRowMask);
}

void ColumnSet::AddWithNeighbours(ColumnId k) {
  const std::size_t row = k >> Columns::kRowBits;
  const std::uint64_t three = std::uint64_t{7} << ((k & Columns::kRowMask) - 1);
  Row(row) |= three;
  rows_[row - 1] |= three;
  rows_[row + 1] |= three;
}

std::size_t ColumnSet::size() const {
  std::size_t sum = 0;
  for (const std::uint64_t row : rows_) sum += static_cast<std::size_t>(std::popcount(row));
  return sum;
}

void ColumnSet::ListTo(std::vector<ColumnId>* ids) const {
  ids->clear();
  for (std::size_t tile = 0; tile < has_some_.size(); ++tile) {
    if (!has_some_[tile]) continue;
    for (std::size_t row = tile * kRowsOfTile; row < (tile + 1) * kRowsOfTile; ++row) {
      for (std::uint64_t bits = rows_[row]; bits != 0; bits &= bits - 1) {
        ids->push_back(static_cast<ColumnId>(row << Columns::kRowBits) |
                       static_cast<ColumnId>(std::countr_zero(bits)));
      }
    }
  }
}

void ColumnSet::clear() {
  for (std::size_t tile = 0; tile < has_some_.size(); ++tile) {
    if (!has_some_[tile]) continue;
    std::fill_n(rows_.begin() + static_cast<std::ptrdiff_t>(tile * kRowsOfTile), kRowsOfTile, 0);
    has_some_[tile] = 0;
  }
}

}  // namespace tera
