#pragma once

#include <cstddef>
#include <vector>

#include "core/random.h"
#include "diagnose/statistics/series/series.h"

namespace tera {

/// Circular shifts of a series against another one. They keep the autocorrelation of both and
/// destroy the dependence between them: the reference distribution of every dependence test here.
///
/// Model   with one block, shift k turns the whole series by least + (k + u) * stride samples, the
///         stride at least `least`, so that shifts are nearly independent of each other and of no
///         shift at all. With blocks, each block is turned within itself by its own random amount,
///         which keeps what varies slowly in place (a machine that works in one half of the
///         recording).
/// Omits   the seam at which end meets beginning. One of the two series should be stationary
///         (within blocks).
/// Source  Harris 2020, "A shift test for independence in generic time series".
class CircularShifts {
 public:
  /// Shifts of `size` samples, by at least `least`, at most `most`; `block` 0 for one block. Fewer,
  /// or none, where the series is short.
  CircularShifts(std::size_t size, std::size_t least, std::size_t most, std::size_t block,
                 const Stream& stream);

  std::size_t count() const { return offset_.size(); }
  const std::vector<Segment>& blocks() const { return blocks_; }
  /// The offset by which block `b` is turned in shift `k`: sample t comes from t - offset, within
  /// the block.
  std::size_t offset(std::size_t k, std::size_t b) const { return offset_[k][b]; }

  /// Calls use(to, from, length) for the contiguous pieces of shift `k`.
  template <typename Use>
  void ForEachPiece(std::size_t k, const Use& use) const {
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      const Segment& block = blocks_[b];
      const std::size_t by = offset_[k][b];
      use(block.begin + by, block.begin, block.size() - by);
      if (by > 0) use(block.begin, block.end - by, by);
    }
  }

 private:
  std::vector<Segment> blocks_;
  std::vector<std::vector<std::size_t>> offset_;
};

/// The place of an observed statistic among those under shifts.
///
/// Model   p = (1 + #{shifted >= observed}) / (1 + shifts). p_tail, for ranking what lies beyond
///         all shifts: p where ten shifts or more exceed, else an exponential tail through the
///         upper fifth of the shifts (statistics are energies), never above p. Equals p below 50
///         shifts.
/// Source  Phipson and Smyth 2010, "Permutation p-values should never be zero"; Knijnenburg et al.
///         2009, "Fewer permutations, more accurate P-values".
struct ShiftComparison {
  double statistic = 0;
  double p = 1, p_tail = 1;
  std::size_t shifts = 0;
};
ShiftComparison CompareWithShifts(double observed, std::vector<double> shifted);

}  // namespace tera
