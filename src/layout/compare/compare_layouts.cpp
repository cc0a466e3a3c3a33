#include "layout/compare/compare_layouts.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include "core/check.h"
#include "core/error.h"
#include "core/random.h"

namespace tera {
namespace {

constexpr int kResamples = 2000;
constexpr double kTail = 0.025;
constexpr double kTwoSided95 = 1.959964;
constexpr std::uint64_t kSeed = 1;

/// Means of resampled series, sorted.
std::vector<double> BlockBootstrap(const std::vector<double>& series, std::size_t block,
                                   const FigureId& figure) {
  const std::size_t n = series.size(), starts = n - block + 1;
  const Stream stream(kSeed, "layout/compare/" + NameOf(figure));
  std::vector<double> means;
  std::uint64_t draw = 0;
  for (int r = 0; r < kResamples; ++r) {
    double sum = 0;
    std::size_t count = 0;
    while (count < n) {
      const auto from = std::min(starts - 1, static_cast<std::size_t>(stream.Uniform(draw++) *
                                                                      static_cast<double>(starts)));
      for (std::size_t i = 0; i < block && count < n; ++i, ++count) sum += series[from + i];
    }
    means.push_back(sum / static_cast<double>(n));
  }
  std::sort(means.begin(), means.end());
  return means;
}

/// Factor from the spread of the resampled means to the half width of the interval, for a mean over
/// k blocks. Resampled means scatter too little, by sqrt((k - 1) / k). Student's t accounts for the
/// uncertainty of a spread estimated from k blocks.
double WidthFactor(double blocks) {
  if (blocks < 2) return 1;
  const boost::math::students_t_distribution<> t(blocks - 1);
  return boost::math::quantile(t, 1 - kTail) / kTwoSided95 * std::sqrt(blocks / (blocks - 1));
}

Difference DifferenceOf(const Figure& first, const Figure& other, std::size_t block) {
  Difference d{.figure = first.id, .of_first = MeanOf(first), .of_other = MeanOf(other)};
  std::vector<double> series;
  for (std::size_t m = 0; m < first.at.size(); ++m) series.push_back(other.at[m] - first.at[m]);
  const std::vector<double> means = BlockBootstrap(series, block, first.id);
  const double mean = d.of_other - d.of_first;
  const auto tail = static_cast<std::size_t>(kTail * kResamples);
  const double wider = WidthFactor(static_cast<double>(series.size()) / static_cast<double>(block));
  const double sampling = kTwoSided95 * std::hypot(ErrorOf(first), ErrorOf(other));
  // Layouts that agree at every moment do not differ, whatever their sampling errors.
  const bool same = std::all_of(series.begin(), series.end(), [](double x) { return x == 0; });
  if (same) return d;
  d.low = mean - std::hypot(wider * (mean - means[tail]), sampling);
  d.high = mean + std::hypot(wider * (means[kResamples - 1 - tail] - mean), sampling);
  if (series.size() < 2 * block) {  // one block gives no estimate of the spread between blocks
    d.low = std::min(d.low, 0.0);
    d.high = std::max(d.high, 0.0);
  }
  return d;
}

/// Marks the seen share and the unseen volume of a zone as doubted if their verdicts differ.
void DoubtByEachOther(std::vector<Difference>* differences) {
  for (Difference& seen : *differences) {
    if (seen.figure.measure != Measure::kSeenBy1) continue;
    const FigureId same{Measure::kBlindVolume, seen.figure.of};
    for (Difference& blind : *differences) {
      if (blind.figure != same || blind.verdict() == seen.verdict()) continue;
      seen.is_doubted = blind.is_doubted = true;
    }
  }
}

}  // namespace

Difference::Verdict Difference::verdict() const {
  if (is_doubted || (low <= 0 && high >= 0)) return Verdict::kUndecided;
  return (low > 0) == IsMoreBetter(figure.measure) ? Verdict::kBetter : Verdict::kWorse;
}

std::vector<Difference> Compare(const LayoutReport& first, const LayoutReport& other,
                                double block_s) {
  if (first.cycle == other.cycle && first.asked_sha256 != other.asked_sha256) {
    throw InputError(
        fmt::format("'{}' and '{}' have different studies or scenarios of {}; evaluate both with "
                    "one study over one cycle",
                    first.name, other.name, first.cycle));
  }
  if (first.cycle != other.cycle || first.t_s != other.t_s) {
    throw InputError(fmt::format(
        "'{}' and '{}' cover different moments or cycles ({} and {}); evaluate both over one cycle",
        first.name, other.name, first.cycle, other.cycle));
  }
  const std::size_t n = first.t_s.size();
  TERA_CHECK(n > 0);
  const double period_s =
      n > 1 ? (first.t_s.back() - first.t_s.front()) / static_cast<double>(n - 1) : block_s;
  const auto block =
      std::clamp<std::size_t>(static_cast<std::size_t>(std::lround(block_s / period_s)), 1,
                              std::max<std::size_t>(1, n / 2));
  std::vector<Difference> differences;
  for (const Figure& figure : first.figures) {
    const Figure* same = FindFigure(other, figure.id);
    if (same) differences.push_back(DifferenceOf(figure, *same, block));
  }
  DoubtByEachOther(&differences);
  return differences;
}

}  // namespace tera
