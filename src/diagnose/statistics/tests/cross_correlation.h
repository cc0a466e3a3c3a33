#pragma once

#include <array>
#include <cstddef>

#include "core/random.h"
#include "diagnose/statistics/series/series.h"
#include "diagnose/statistics/tests/circular_shifts.h"

namespace tera {

struct CrossCorrelationOptions {
  std::size_t highest_lag = 50;  ///< samples, either way
  std::size_t shifts = 200;
  std::size_t block = 0;  ///< samples; shifts within blocks of this length, 0 for one block
  double clip = 4;        ///< of the residual, in robust scales
};

/// The strongest correlation over the lags. At a positive lag the residual follows the input.
struct LaggedCorrelation {
  std::ptrdiff_t lag = 0;
  double correlation = 0;
  ShiftComparison comparison;  ///< statistic: largest squared correlation times pairs
};

/// Tests whether a residual depends on an input at any lag, directly or by squares.
///
/// Model   forms residual–input, residual–input^2, residual^2–input, residual^2–input^2
///         (each centred). Statistic of a form: max over lags of n_l r_l^2, so that its
///         p is of the whole family of lags. `p` of the whole: the largest statistic
///         over forms, each divided by its median under shifts, against the same under
///         shifts.
/// Omits   lags beyond `highest_lag`.
/// Source  Billings and Voon 1986, "Correlation based model validity tests for non-linear models";
///         shifts in circular_shifts.h.
///
/// `residual` best is whitened and `input` filtered likewise (Box and Jenkins); both of equal
/// length. Gaps of the input are bridged. The shifts are drawn from `stream`.
struct CrossCorrelationTest {
  enum Form { kLinear, kSquaredInput, kSquaredResidual, kSquaredBoth };
  std::array<LaggedCorrelation, 4> form;
  double p = 1;
};
CrossCorrelationTest TestCrossCorrelation(const Series& residual, const Series& input,
                                          const CrossCorrelationOptions& options,
                                          const Stream& stream);

}  // namespace tera
