#include "layout/measures/detection_probability.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/math/special_functions/gamma.hpp>

#include "core/check.h"
#include "layout/measures/polar_grid.h"
#include "layout/measures/quarter.h"

namespace tera {
namespace {

constexpr double kStep_m = 1.0;
constexpr int kNearSteps = 12;

/// A running mean.
struct Sum {
  double value = 0;
  std::size_t count = 0;

  double Mean() const { return count > 0 ? value / static_cast<double>(count) : 0; }
};

}  // namespace

double ProbabilityOfAtLeast(int least, double expected) {
  TERA_CHECK(least > 0, least);
  if (expected <= 0) return 0;
  return boost::math::gamma_p(static_cast<double>(least), expected);
}

DetectionProbability::DetectionProbability(const std::string& posture, int least, int steps)
    : posture_(posture),
      least_(least),
      steps_(steps),
      sum_(static_cast<std::size_t>(PolarGrid::kSectors * steps)),
      lowest_(sum_.size(), 1),
      moments_(sum_.size()),
      quarters_(kQuarters.size()) {}

void DetectionProbability::Add(const std::vector<PersonPlace>& places,
                               const std::vector<double>& expected) {
  Sum all;
  std::array<Sum, kQuarters.size()> quarters;
  for (std::size_t p = 0; p < places.size(); ++p) {
    const auto& [sector, step, X_WP] = places[p];
    const double probability = ProbabilityOfAtLeast(least_, expected[p]);
    const auto i = static_cast<std::size_t>(sector * steps_ + step);
    sum_[i] += probability;
    lowest_[i] = std::min(lowest_[i], probability);
    moments_[i] += 1;
    if (step >= kNearSteps) continue;
    all.value += probability;
    ++all.count;
    for (std::size_t q = 0; q < quarters.size(); ++q) {
      if (!kQuarters[q].Holds(PolarGrid::Azimuth_rad(sector))) continue;
      quarters[q].value += probability;
      ++quarters[q].count;
    }
  }
  const auto keep = [](const Sum& of, Share* share) {
    share->mean.push_back(of.Mean());
    share->error.push_back(ShareError(of.Mean(), of.count));
  };
  keep(all, &all_);
  for (std::size_t q = 0; q < quarters.size(); ++q) keep(quarters[q], &quarters_[q]);
}

std::vector<Figure> DetectionProbability::Figures() const {
  std::vector<Figure> figures = {{{Measure::kProbability, posture_}, all_.mean, all_.error}};
  for (std::size_t q = 0; q < kQuarters.size(); ++q) {
    figures.push_back(
        {{Measure::kProbabilityOfQuarter, posture_, q}, quarters_[q].mean, quarters_[q].error});
  }
  return figures;
}

std::vector<PolarMap> DetectionProbability::Maps() const {
  PolarMap mean{.id = {Measure::kProbabilityMap, posture_},
                .title = fmt::format("Probability that lidars detect a {} person, mean over the "
                                     "cycle; rings are metres from the machine's outline",
                                     posture_),
                .sectors = PolarGrid::kSectors,
                .rings = steps_,
                .ring_m = kStep_m};
  mean.value.assign(sum_.size(), -1);
  PolarMap worst = mean;
  worst.id.measure = Measure::kWorstProbabilityMap;
  worst.title = fmt::format(
      "Probability that lidars detect a {} person, at the worst moment of each place", posture_);
  for (std::size_t i = 0; i < sum_.size(); ++i) {
    if (moments_[i] == 0) continue;
    mean.value[i] = sum_[i] / moments_[i];
    worst.value[i] = lowest_[i];
  }
  return {mean, worst};
}

}  // namespace tera
