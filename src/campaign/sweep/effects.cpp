#include "campaign/sweep/effects.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <map>

#include "core/parse_number.h"

namespace tera {
namespace {

constexpr double kTail = 0.025;  ///< tail probability of a 95 % interval

double StudentFactor(int freedom) {
  return quantile(complement(boost::math::students_t(freedom), kTail));
}

LevelMean MeanOf(const std::string& level, const std::vector<double>& outcomes) {
  LevelMean mean{.level = level, .runs = static_cast<int>(outcomes.size())};
  for (const double outcome : outcomes) mean.mean += outcome / mean.runs;
  if (mean.runs < 2) return mean;
  double squares = 0;
  for (const double outcome : outcomes) squares += (outcome - mean.mean) * (outcome - mean.mean);
  const double half =
      StudentFactor(mean.runs - 1) * std::sqrt(squares / (mean.runs - 1) / mean.runs);
  mean.low = mean.mean - half;
  mean.high = mean.mean + half;
  return mean;
}

std::optional<Slope> SlopeOf(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<double>(x.size());
  if (x.size() < 3) return std::nullopt;
  double x_mean = 0, y_mean = 0, xx = 0, xy = 0, residual = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    x_mean += x[i] / n;
    y_mean += y[i] / n;
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - x_mean) * (x[i] - x_mean);
    xy += (x[i] - x_mean) * (y[i] - y_mean);
  }
  if (xx <= 0) return std::nullopt;
  const double slope = xy / xx;
  for (std::size_t i = 0; i < x.size(); ++i) {
    residual += std::pow(y[i] - y_mean - slope * (x[i] - x_mean), 2);
  }
  const int freedom = static_cast<int>(x.size()) - 2;
  const double half = StudentFactor(freedom) * std::sqrt(residual / freedom / xx);
  return Slope{slope, slope - half, slope + half};
}

FactorEffect EffectOf(const std::string& key, std::size_t factor,
                      const std::vector<SweptRun>& runs) {
  FactorEffect effect{.key = key, .levels = {}, .is_numeric = true};
  std::vector<std::string> order;
  std::map<std::string, std::vector<double>> outcomes;
  std::vector<double> x, y;
  for (const SweptRun& run : runs) {
    const std::string& level = run.values[factor];
    if (!outcomes.contains(level)) order.push_back(level);
    outcomes[level].push_back(run.outcome);
    const std::optional<double> number = ParseFinite(level);
    effect.is_numeric = effect.is_numeric && number.has_value();
    x.push_back(number.value_or(0));
    y.push_back(run.outcome);
  }
  if (effect.is_numeric) {
    std::ranges::sort(order, {}, [](const std::string& text) { return *ParseFinite(text); });
    effect.slope = SlopeOf(x, y);
  }
  for (const std::string& level : order) effect.levels.push_back(MeanOf(level, outcomes[level]));
  return effect;
}

}  // namespace

std::vector<FactorEffect> EffectsOf(const std::vector<std::string>& keys,
                                    const std::vector<SweptRun>& runs) {
  std::vector<FactorEffect> effects;
  for (std::size_t f = 0; f < keys.size(); ++f) effects.push_back(EffectOf(keys[f], f, runs));
  return effects;
}

}  // namespace tera
