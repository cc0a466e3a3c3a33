#include "sensors/lidar/pulse_train.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace tera {
namespace {

constexpr double kSigmaOfWidth = 0.42466;  ///< standard deviation over full width at half power
constexpr double kApart = 8;               ///< distance in sigma beyond which echoes do not overlap
constexpr double kTogether = 2;            ///< distance in sigma within which echoes share a
                                           ///< maximum
constexpr double kNegligible = 0.05;       ///< spread in sigma at which the centroid is the maximum
constexpr double kSettled = 1e-4;          ///< last step of a search, in sigma
constexpr int kMostSteps = 200;

struct Place {
  double mean_m, power;
};

/// Power at `at_m` and the centroid of the echoes there, weighted by their contributions.
Place Weigh(std::span<const Echo> echoes, double at_m, double sigma_m) {
  double sum = 0, moment = 0;
  for (const Echo& echo : echoes) {
    const double off = (echo.range_m - at_m) / sigma_m;
    const double adds = echo.power * std::exp(-0.5 * off * off);
    sum += adds;
    moment += adds * echo.range_m;
  }
  return {sum > 0 ? moment / sum : at_m, sum};
}

/// Climbs to a maximum: the centroid of the echoes is where the gradient leads to (mean shift).
Place Climb(std::span<const Echo> echoes, double from_m, double sigma_m) {
  Place place{from_m, 0};
  for (int step = 0; step < kMostSteps; ++step) {
    const Place next = Weigh(echoes, place.mean_m, sigma_m);
    const bool settled = std::abs(next.mean_m - place.mean_m) < kSettled * sigma_m;
    place = next;
    if (settled) break;
  }
  place.power = Weigh(echoes, place.mean_m, sigma_m).power;
  return place;
}

Echo PeakAt(std::span<const Echo> echoes, const Place& place, double sigma_m) {
  const auto adds = [&](const Echo& echo) {
    const double off = (echo.range_m - place.mean_m) / sigma_m;
    return echo.power * std::exp(-0.5 * off * off);
  };
  Echo peak = *std::max_element(echoes.begin(), echoes.end(),
                                [&](const Echo& a, const Echo& b) { return adds(a) < adds(b); });
  peak.range_m = place.mean_m;
  peak.power = place.power;
  return peak;
}

void FindPeaksOf(std::span<const Echo> echoes, double sigma_m, std::vector<Echo>* peaks) {
  const double spread_m = echoes.back().range_m - echoes.front().range_m;
  double sum = 0, moment = 0;
  for (const Echo& echo : echoes) {
    sum += echo.power;
    moment += echo.power * (echo.range_m - echoes.front().range_m);
  }
  const double centroid_m = echoes.front().range_m + (sum > 0 ? moment / sum : 0);
  if (spread_m <= kNegligible * sigma_m) {
    peaks->push_back(PeakAt(echoes, {centroid_m, sum}, sigma_m));
    return;
  }
  if (spread_m <= kTogether * sigma_m) {
    peaks->push_back(PeakAt(echoes, Climb(echoes, centroid_m, sigma_m), sigma_m));
    return;
  }
  // A maximum of the sum has an echo from which the climb leads to it.
  const std::size_t before = peaks->size();
  for (const Echo& echo : echoes) {
    const Place place = Climb(echoes, echo.range_m, sigma_m);
    const bool is_known =
        peaks->size() > before && place.mean_m < peaks->back().range_m + kNegligible * sigma_m;
    if (!is_known) peaks->push_back(PeakAt(echoes, place, sigma_m));
  }
}

}  // namespace

void FindPeaks(std::vector<Echo>* echoes, double pulse_m, std::vector<Echo>* peaks) {
  peaks->clear();
  if (echoes->size() < 2) {
    *peaks = *echoes;
    return;
  }
  std::stable_sort(echoes->begin(), echoes->end(),
                   [](const Echo& a, const Echo& b) { return a.range_m < b.range_m; });
  const double sigma_m = kSigmaOfWidth * pulse_m;
  for (std::size_t begin = 0; begin < echoes->size();) {
    std::size_t end = begin + 1;
    while (end < echoes->size() &&
           (*echoes)[end].range_m - (*echoes)[end - 1].range_m < kApart * sigma_m) {
      ++end;
    }
    FindPeaksOf(std::span(*echoes).subspan(begin, end - begin), sigma_m, peaks);
    begin = end;
  }
}

}  // namespace tera
