#include "diagnose/blocks/beats.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>

#include "diagnose/statistics/series/robust.h"

namespace tera {
namespace {

constexpr double kWindow_s = 60;  ///< part of the recording in which peaks are searched
/// Frequency steps per 1 / length, in the search for peaks and in their refinement.
constexpr double kCoarse = 4, kFine = 64;

constexpr double kBin_s = 0.01;  ///< changes within this time count as one

/// Absolute changes minus their mean, at the middles of their sample intervals.
struct Changes {
  std::vector<double> t_s, size;

  double length_s() const { return t_s.size() < 2 ? 0 : t_s.back() - t_s.front(); }
};

Changes ChangesOf(const std::vector<double>& t_s, const std::vector<double>& value) {
  std::vector<double> gaps_s;
  for (std::size_t k = 1; k < t_s.size(); ++k) gaps_s.push_back(t_s[k] - t_s[k - 1]);
  Changes changes;
  if (gaps_s.empty()) return changes;
  const double longest_s = 2 * Median(gaps_s);
  double mean = 0, first_s = 0;
  for (std::size_t k = 1; k < t_s.size(); ++k) {
    if (gaps_s[k - 1] > longest_s) continue;
    const double size = std::abs(value[k] - value[k - 1]);
    const double at_s = 0.5 * (t_s[k] + t_s[k - 1]);
    mean += size;
    if (!changes.t_s.empty() && at_s - first_s < kBin_s) {
      changes.size.back() += size;
      changes.t_s.back() = 0.5 * (first_s + at_s);
      continue;
    }
    first_s = at_s;
    changes.t_s.push_back(at_s);
    changes.size.push_back(size);
  }
  for (double& size : changes.size) size -= mean / static_cast<double>(changes.size.size());
  return changes;
}

/// The changes of the minute with the greatest energy of change.
Changes Liveliest(const Changes& all) {
  std::size_t from = 0, best_from = 0, best_to = 0;
  double energy = 0, most = -1;
  for (std::size_t to = 0; to < all.t_s.size(); ++to) {
    energy += all.size[to] * all.size[to];
    while (all.t_s[to] - all.t_s[from] > kWindow_s) {
      energy -= all.size[from] * all.size[from];
      ++from;
    }
    if (energy > most) most = energy, best_from = from, best_to = to + 1;
  }
  const auto part = [&](const std::vector<double>& x) {
    return std::vector<double>(x.begin() + static_cast<std::ptrdiff_t>(best_from),
                               x.begin() + static_cast<std::ptrdiff_t>(best_to));
  };
  return {part(all.t_s), part(all.size)};
}

std::complex<double> SumAt(const Changes& changes, double frequency_hz) {
  std::complex<double> sum = 0;
  for (std::size_t k = 0; k < changes.t_s.size(); ++k) {
    sum += std::polar(1.0, -2 * std::numbers::pi * frequency_hz * changes.t_s[k]) * changes.size[k];
  }
  return sum;
}

struct Peak {
  double frequency_hz = 0, height = 0;
};

/// Periodogram at evenly spaced frequencies. From one frequency to the next, the phasor of each
/// change turns by a constant angle.
std::vector<double> HeightsOf(const Changes& changes, double lowest_hz, double step_hz,
                              std::size_t count) {
  const auto size = static_cast<Eigen::Index>(changes.t_s.size());
  const Eigen::Map<const Eigen::ArrayXd> t_s(changes.t_s.data(), size);
  const auto turned = [&](double frequency_hz) -> Eigen::ArrayXcd {
    return (std::complex<double>(0, -2 * std::numbers::pi * frequency_hz) * t_s).exp();
  };
  Eigen::ArrayXcd phase =
      turned(lowest_hz) * Eigen::Map<const Eigen::ArrayXd>(changes.size.data(), size);
  const Eigen::ArrayXcd step = turned(step_hz);
  std::vector<double> height;
  for (std::size_t k = 0; k < count; ++k) {
    height.push_back(std::abs(phase.sum()));
    phase *= step;
  }
  return height;
}

/// Local maxima of the periodogram, in descending order.
std::vector<Peak> PeaksOf(const Changes& changes, double lowest_hz, double highest_hz,
                          double steps_of_resolution) {
  const double step_hz = 1 / (steps_of_resolution * changes.length_s());
  const auto steps = static_cast<std::size_t>((highest_hz - lowest_hz) / step_hz);
  const std::vector<double> height = HeightsOf(changes, lowest_hz, step_hz, steps + 1);
  std::vector<Peak> peaks;
  for (std::size_t k = 1; k + 1 < height.size(); ++k) {
    if (height[k] < height[k - 1] || height[k] <= height[k + 1]) continue;
    peaks.push_back({lowest_hz + static_cast<double>(k) * step_hz, height[k]});
  }
  std::stable_sort(peaks.begin(), peaks.end(),
                   [](const Peak& a, const Peak& b) { return a.height > b.height; });
  return peaks;
}

/// Frequency of the highest peak within `around_hz` of a frequency.
double Highest(const Changes& changes, double frequency_hz, double around_hz,
               double steps_of_resolution) {
  const std::vector<Peak> peaks =
      PeaksOf(changes, frequency_hz - around_hz, frequency_hz + around_hz, steps_of_resolution);
  return peaks.empty() ? frequency_hz : peaks.front().frequency_hz;
}

}  // namespace

std::vector<Beat> BeatsOf(const std::vector<double>& t_s, const std::vector<double>& value,
                          const BeatOptions& options) {
  const Changes all = ChangesOf(t_s, value);
  const Changes lively = Liveliest(all);
  if (lively.length_s() < 10 * options.longest_s) return {};
  double whole = 0;
  for (const double size : all.size) whole += std::abs(size);
  std::vector<Beat> beats;
  for (const Peak& coarse :
       PeaksOf(lively, 1 / options.longest_s, 1 / options.shortest_s, kCoarse)) {
    if (beats.size() == options.most || whole <= 0) break;
    double f = Highest(all, coarse.frequency_hz, 1 / lively.length_s(), kCoarse);
    f = Highest(all, f, 1 / all.length_s(), kFine);
    f = std::clamp(f, 1 / options.longest_s, 1 / options.shortest_s);
    const std::complex<double> sum = SumAt(all, f);
    const double turn = -std::arg(sum) / (2 * std::numbers::pi);
    beats.push_back({1 / f, turn - std::floor(turn), std::abs(sum) / whole});
  }
  return beats;
}

}  // namespace tera
