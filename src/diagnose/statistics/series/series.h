#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tera {

/// 1 where a sample can be used, else 0.
using Mask = std::vector<std::uint8_t>;

/// A uniformly sampled quantity with gaps.
///
/// Model   sample k is at k * period_s. Where `valid` is 0 there is no measurement, and `value` is
///         0.
struct Series {
  double period_s = 0.01;
  std::vector<double> value;
  Mask valid;

  std::size_t size() const { return value.size(); }
};

/// Samples [begin, end).
struct Segment {
  std::size_t begin = 0, end = 0;
  std::size_t size() const { return end - begin; }
  bool operator==(const Segment&) const = default;
};

/// Runs of at least `shortest` valid samples, in order.
std::vector<Segment> SegmentsOf(const Mask& valid, std::size_t shortest = 1);

std::size_t CountValid(const Mask& valid);

/// Valid where both are.
Mask Both(const Mask& a, const Mask& b);

/// The series with gaps outside `kept`.
Series Restricted(const Series& series, const Mask& kept);

/// The values of the valid samples, in order.
std::vector<double> ValidValues(const Series& series);

/// Root mean square of the valid samples; 0 without any.
double Rms(const Series& series);

/// Mean square of the valid samples in a mask; 0 without any.
double MeanSquare(const Series& series, const Mask& mask);
/// Mean square of the valid samples of a segment; 0 without any.
double MeanSquare(const Series& series, const Segment& samples);

/// Values with gaps interpolated linearly and the ends held, for inputs with short gaps. All 0
/// without a valid sample.
std::vector<double> BridgedValues(const Series& series);

}  // namespace tera
