#include "diagnose/statistics/tests/cross_correlation.h"

#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/FFT>

#include "core/check.h"
#include "diagnose/statistics/series/robust.h"

namespace tera {
namespace {

using Values = std::vector<double>;
using Spectrum = std::vector<std::complex<double>>;

/// c[s] = sum_t a_t b_(t-s), the index of b taken circularly, for s = 0 .. size - 1.
Values CircularProducts(const double* a, const double* b, std::size_t size) {
  std::size_t padded = 1;
  while (padded < 2 * size) padded *= 2;
  Values left(padded, 0.0), right(padded, 0.0), linear;
  std::copy(a, a + size, left.begin());
  std::copy(b, b + size, right.begin());
  Eigen::FFT<double> fft;
  fft.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  Spectrum of_left, of_right;
  fft.fwd(of_left, left);
  fft.fwd(of_right, right);
  for (std::size_t k = 0; k < of_left.size(); ++k) of_left[k] *= std::conj(of_right[k]);
  fft.inv(linear, of_left, static_cast<Eigen::Index>(padded));
  Values out(size);
  for (std::size_t s = 0; s < size; ++s) {
    out[s] = linear[s] + (s > 0 ? linear[padded - (size - s)] : 0);
  }
  return out;
}

/// The products of two series at all circular lags, block by block.
class LagTable {
 public:
  LagTable(const Values& a, const Values& b, const std::vector<Segment>& blocks) {
    for (const Segment& block : blocks) {
      products_.push_back(CircularProducts(&a[block.begin], &b[block.begin], block.size()));
    }
  }

  /// The product at `lag`, with each block of b turned by its own further offset.
  template <typename Offset>
  double At(std::ptrdiff_t lag, const Offset& offset) const {
    double sum = 0;
    for (std::size_t b = 0; b < products_.size(); ++b) {
      const auto size = static_cast<std::ptrdiff_t>(products_[b].size());
      const auto place = (static_cast<std::ptrdiff_t>(offset(b)) + lag) % size;
      sum += products_[b][static_cast<std::size_t>(place < 0 ? place + size : place)];
    }
    return sum;
  }

 private:
  std::vector<Values> products_;
};

/// The valid values standardised to mean 0 and variance 1; the others are 0.
Values Standardised(const Values& value, const Mask& valid) {
  const auto n = static_cast<double>(std::max<std::size_t>(CountValid(valid), 1));
  double mean = 0, variance = 0;
  for (std::size_t k = 0; k < value.size(); ++k) mean += valid[k] ? value[k] / n : 0;
  Values out(value.size(), 0.0);
  for (std::size_t k = 0; k < value.size(); ++k) {
    if (valid[k]) out[k] = value[k] - mean;
    variance += out[k] * out[k] / n;
  }
  for (double& x : out) x *= variance > 0 ? 1 / std::sqrt(variance) : 0;
  return out;
}

Values Squared(Values value) {
  for (double& x : value) x *= x;
  return value;
}

struct FormStatistics {
  LaggedCorrelation best;
  Values shifted;
};

template <typename Offset>
LaggedCorrelation Strongest(const LagTable& products, double pairs, std::size_t highest,
                            const Offset& offset) {
  LaggedCorrelation best;
  const auto reach = static_cast<std::ptrdiff_t>(highest);
  for (std::ptrdiff_t lag = -reach; lag <= reach; ++lag) {
    const double sum = products.At(lag, offset);
    if (sum * sum / pairs <= best.comparison.statistic) continue;
    best.comparison.statistic = sum * sum / pairs;
    best.lag = lag;
    best.correlation = sum / pairs;
  }
  return best;
}

FormStatistics Judge(const Values& a, const Values& b, double pairs, const CircularShifts& shifts,
                     std::size_t highest) {
  const LagTable products(a, b, shifts.blocks());
  FormStatistics out;
  out.best = Strongest(products, pairs, highest, [](std::size_t) { return std::size_t{0}; });
  for (std::size_t k = 0; k < shifts.count(); ++k) {
    const auto offset = [&](std::size_t block) { return shifts.offset(k, block); };
    out.shifted.push_back(Strongest(products, pairs, highest, offset).comparison.statistic);
  }
  out.best.comparison = CompareWithShifts(out.best.comparison.statistic, out.shifted);
  return out;
}

/// The p-value of the largest of several statistics, each over its median under shifts.
double JointP(const std::array<FormStatistics, 4>& forms) {
  const std::size_t count = forms[0].shifted.size();
  double observed = 0;
  Values largest(count, 0.0);
  for (const FormStatistics& form : forms) {
    if (count == 0) return 1;
    const double unit = std::max(Median(form.shifted), 1e-300);
    observed = std::max(observed, form.best.comparison.statistic / unit);
    for (std::size_t k = 0; k < count; ++k) {
      largest[k] = std::max(largest[k], form.shifted[k] / unit);
    }
  }
  return CompareWithShifts(observed, std::move(largest)).p;
}

}  // namespace

CrossCorrelationTest TestCrossCorrelation(const Series& residual, const Series& input,
                                          const CrossCorrelationOptions& options,
                                          const Stream& stream) {
  TERA_CHECK(residual.size() == input.size(), residual.size(), input.size());
  CrossCorrelationTest out;
  const Values known = ValidValues(residual);
  if (known.size() < 2) return out;
  const double limit = options.clip * std::max(RobustScale(known), 1e-300);
  const Values u = BridgedValues(input);
  const Values r1 = Standardised(Clipped(residual, limit).value, residual.valid);
  const Values r2 = Standardised(Squared(r1), residual.valid);
  const Mask everywhere(u.size(), 1);
  const Values u1 = Standardised(u, everywhere), u2 = Standardised(Squared(u1), everywhere);

  const std::size_t correlated = std::max(CorrelationLength(u1), CorrelationLength(u2));
  const CircularShifts shifts(u.size(), 2 * options.highest_lag + correlated, options.shifts,
                              options.block, stream);
  const auto pairs =
      static_cast<double>(known.size());  // at every lag, for gaps of the input are interpolated
  const std::array<FormStatistics, 4> forms = {Judge(r1, u1, pairs, shifts, options.highest_lag),
                                               Judge(r1, u2, pairs, shifts, options.highest_lag),
                                               Judge(r2, u1, pairs, shifts, options.highest_lag),
                                               Judge(r2, u2, pairs, shifts, options.highest_lag)};
  for (std::size_t f = 0; f < forms.size(); ++f) out.form[f] = forms[f].best;
  out.p = JointP(forms);
  return out;
}

}  // namespace tera
