#include "diagnose/blocks/axis_readings.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "diagnose/search/fit/static_map.h"

namespace tera {
namespace {

constexpr std::array kLags_s = {0.0, 0.06, 0.15, 0.3, 0.6, 1.0};
constexpr double kDelayStep_s = 0.04, kLongestReadDelay_s = 0.7;
constexpr std::size_t kMostReadRows = 3000;  ///< samples used; enough to determine the ramps
constexpr Eigen::Index kWidestBand = 16;     ///< knots in the widest dead band: 0.8 of full lever
constexpr std::size_t kMostReadings = 3;
/// Starting values in place of a zero estimate, because fits have no gradient at zero effect.
constexpr double kLeastBand = 0.02, kSpreadShare = 0.2, kLeastLag_s = 0.02;

/// Static map of one direction: zero up to `dead`, then linear with `gain` up to `limit`.
struct Ramp {
  double dead = 0, limit = 1, gain = 0;
  Eigen::VectorXd shape;  ///< values at the knots for a gain of 1
  double taken = 0;       ///< energy of the measurement that the ramp explains
};

/// All ramps with corners at knots.
const std::vector<Ramp>& RampsBetweenKnots() {
  static const std::vector<Ramp> shapes = [] {
    std::vector<Ramp> all;
    for (Eigen::Index limit = kMapKnots; limit >= 4; --limit) {
      for (Eigen::Index dead = 0; dead < std::min(limit, kWidestBand + 1); ++dead) {
        Ramp ramp{static_cast<double>(dead) / kMapKnots, static_cast<double>(limit) / kMapKnots, 0,
                  Eigen::VectorXd::Zero(kMapKnots)};
        for (Eigen::Index k = 0; k < kMapKnots; ++k) {
          const double u = static_cast<double>(k + 1) / kMapKnots;
          ramp.shape[k] = std::max(0.0, std::min(u, ramp.limit) - ramp.dead);
        }
        all.push_back(std::move(ramp));
      }
    }
    return all;
  }();
  return shapes;
}

/// The ramp with positive gain that explains most energy. Returns a ramp with zero gain if none
/// explains any energy.
Ramp BestRamp(const Eigen::MatrixXd& information, const Eigen::VectorXd& pull) {
  Ramp best{.shape = Eigen::VectorXd::Zero(kMapKnots)};
  for (const Ramp& ramp : RampsBetweenKnots()) {
    const double along = ramp.shape.dot(pull);
    const double energy = ramp.shape.dot(information * ramp.shape);
    if (along <= 0 || energy <= 0 || along * along <= best.taken * energy) continue;
    best = ramp;
    best.gain = along / energy;
    best.taken = along * along / energy;
  }
  return best;
}

/// Estimate of the chain at one lag and delay. `left` is the unexplained energy.
struct ReadChain {
  double lag_s = 0, delay_s = 0, left = 0;
  bool has_cylinder = false;
  Ramp positive, negative;
};

/// Estimates the ramp of each direction in turn, given the other. The positive direction is
/// estimated again at the end.
void ReadRamps(const MapProducts& products, ReadChain* out) {
  const auto of = [&](Eigen::Index row, Eigen::Index column) {
    return products.information.block(row, column, kMapKnots, kMapKnots);
  };
  const Eigen::VectorXd up = products.pull.head(kMapKnots), down = -products.pull.tail(kMapKnots);
  out->positive = BestRamp(of(0, 0), up);
  out->negative = BestRamp(of(kMapKnots, kMapKnots),
                           down + of(kMapKnots, 0) * out->positive.shape * out->positive.gain);
  out->positive =
      BestRamp(of(0, 0), up + of(0, kMapKnots) * out->negative.shape * out->negative.gain);
  Eigen::VectorXd map(2 * kMapKnots);
  map << out->positive.gain * out->positive.shape, -out->negative.gain * out->negative.shape;
  out->left = products.energy - 2 * map.dot(products.pull) + map.dot(products.information * map);
}

/// The estimate with the best delay for one lag. `weight` is the cylinder's gain, or one.
ReadChain ReadAtLag(const Channel& channel, const std::vector<Eigen::Index>& rows, double lag_s,
                    const Eigen::VectorXd& weight) {
  const Series& lever = channel.variables[0].series;
  const Eigen::MatrixXd hats = HatsOf(lever, lag_s);
  const auto step = std::max<Eigen::Index>(1, std::lround(kDelayStep_s / lever.period_s));
  ReadChain best;
  for (Eigen::Index late = 0; static_cast<double>(late) * lever.period_s <= kLongestReadDelay_s;
       late += step) {
    ReadChain one{.lag_s = lag_s, .delay_s = static_cast<double>(late) * lever.period_s};
    ReadRamps(ProductsOf(hats, channel.measured, rows, late, weight), &one);
    if (late == 0 || one.left < best.left) best = std::move(one);
  }
  return best;
}

/// Mean of two values, and half their difference over the mean.
std::vector<double> MeanAndAsymmetry(double positive, double negative) {
  const double mean = 0.5 * (positive + negative);
  return {mean, mean > 0 ? 0.5 * (positive - negative) / mean : 0};
}

std::vector<Reading> ReadingsOf(const AxisChain& chain, ReadChain read) {
  if (read.positive.gain <= 0) read.positive = read.negative;
  if (read.negative.gain <= 0) read.negative = read.positive;
  const double full_positive =
      chain.full_positive_radps > 0 ? chain.full_positive_radps : chain.full_negative_radps;
  const double full_negative =
      chain.full_negative_radps > 0 ? chain.full_negative_radps : full_positive;
  const double gain = std::max(read.positive.gain / full_positive, 1e-3);
  const double ratio = read.negative.gain / full_negative / gain;
  const double delay_s = std::max(read.delay_s, kLeastLag_s);
  std::vector<Reading> readings = {
      {"command_delay", chain.axis, {delay_s, kSpreadShare * delay_s}},
      {"lever_saturation", chain.axis, MeanAndAsymmetry(read.positive.limit, read.negative.limit)},
      {"dead_band", chain.axis,
       MeanAndAsymmetry(std::max(read.positive.dead, kLeastBand),
                        std::max(read.negative.dead, kLeastBand))},
      {"valve_curve", chain.axis, {1.0}},
      {"asymmetric_gain", chain.axis, {ratio}},
      {"rate_gain", chain.axis, {gain}},
      {"actuator_lag", chain.axis, {std::max(read.lag_s, kLeastLag_s), 0.1}},
      {"pressure_droop", chain.axis, {}}};
  if (!chain.pump.empty()) readings.push_back({"flow_sharing", chain.pump, {}});
  if (read.has_cylinder) {
    // The fourth parameter, the angle of unit gain, is redundant with rate_gain.
    readings.push_back(
        {"cylinder_lever", chain.axis, {0, 0, 0, chain.cylinder_reference_rad}, {3}});
  }
  return readings;
}

}  // namespace

std::vector<std::vector<Reading>> ReadAxisChain(const AxisChain& chain, const Channel& channel,
                                                const Mask& seen) {
  const std::vector<Eigen::Index> rows = RowsOf(channel.measured, seen, kMostReadRows);
  const auto size = static_cast<Eigen::Index>(channel.measured.size());
  std::vector<Eigen::VectorXd> weights = {Eigen::VectorXd::Ones(size)};
  if (chain.cylinder_gain) {
    weights.emplace_back(size);
    for (Eigen::Index k = 0; k < size; ++k) {
      weights[1][k] =
          chain.cylinder_gain(channel.variables[1].series.value[static_cast<std::size_t>(k)]);
    }
  }
  std::vector<ReadChain> chains;
  for (const double lag_s : kLags_s) {
    std::optional<ReadChain> best;
    for (std::size_t w = 0; w < weights.size(); ++w) {
      ReadChain one = ReadAtLag(channel, rows, lag_s, weights[w]);
      one.has_cylinder = w == 1;
      if (!best || one.left < best->left) best = std::move(one);
    }
    chains.push_back(*std::move(best));
  }
  std::stable_sort(chains.begin(), chains.end(),
                   [](const ReadChain& a, const ReadChain& b) { return a.left < b.left; });
  std::vector<std::vector<Reading>> readings;
  for (std::size_t k = 0; k < std::min(kMostReadings, chains.size()); ++k) {
    if (chains[k].positive.gain > 0 || chains[k].negative.gain > 0) {
      readings.push_back(ReadingsOf(chain, chains[k]));
    }
  }
  return readings;
}

}  // namespace tera
