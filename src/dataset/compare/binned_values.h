#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace tera {

/// Statistics of a stream of values in bounded memory. Mean and root mean square are exact.
/// Quantiles come from bins of equal width. A value outside the bins counts in the first or last
/// bin.
class BinnedValues {
 public:
  BinnedValues(double from, double to, double width)
      : from_(from),
        width_(width),
        bins_(static_cast<std::size_t>(std::lround((to - from) / width)) + 1, 0) {}

  void Add(double value) {
    const double bin = std::clamp((value - from_) / width_, 0.0, double(bins_.size() - 1));
    ++bins_[static_cast<std::size_t>(bin)];
    ++count_;
    sum_ += value;
    square_sum_ += value * value;
  }
  std::int64_t count() const { return count_; }
  double mean() const { return count_ > 0 ? sum_ / double(count_) : 0; }
  double rms() const { return count_ > 0 ? std::sqrt(square_sum_ / double(count_)) : 0; }
  /// The value below which the fraction `share` of the values lies, interpolated linearly within
  /// its bin; 0 if there are no values.
  double Quantile(double share) const {
    const double wanted = share * double(count_);
    double below = 0;
    for (std::size_t k = 0; k < bins_.size(); ++k) {
      const auto here = static_cast<double>(bins_[k]);
      if (here > 0 && below + here >= wanted) {
        return from_ + width_ * (double(k) + (wanted - below) / here);
      }
      below += here;
    }
    return 0;
  }

 private:
  double from_, width_;
  std::vector<std::int64_t> bins_;
  std::int64_t count_ = 0;
  double sum_ = 0, square_sum_ = 0;
};

}  // namespace tera
