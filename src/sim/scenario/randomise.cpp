#include "sim/scenario/randomise.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "core/random.h"
#include "sim/scenario/random_site.h"

namespace tera {
namespace {

constexpr int kMostDraws = 1000;  ///< tries to find a place that is far enough from all others
constexpr std::array<std::string_view, 5> kKinds = {"key", "together", "keys", "places", "site"};
constexpr std::array<std::string_view, 5> kOfKey = {"uniform", "log_uniform", "normal", "integer",
                                                    "choice"};

/// The shortest text that represents the number exactly.
std::string NumberText(double value) { return fmt::format("{}", value); }

struct Interval {
  double lower = 0, upper = 1;

  double At(double share) const { return lower + share * (upper - lower); }
};

/// Reads two numbers, of which the second is not less than the first.
Interval IntervalAt(const ConfigMap& entry, std::string_view key, const Range& range) {
  const std::vector<double> ends = entry.Numbers(key, range, 2, 2);
  if (ends.size() != 2) return {};
  if (ends[1] < ends[0]) entry.Fault(key, "the ends are swapped, need [least, most]");
  return {ends[0], std::max(ends[0], ends[1])};
}

/// Draws the entries of one episode.
class Draw {
 public:
  Draw(const ConfigMap& scenario, std::uint64_t seed, std::uint64_t episode)
      : scenario_(scenario), seed_(seed), episode_(episode) {}

  void Entry(const ConfigMap& entry);
  std::vector<Config::GivenValue> Take() { return std::move(values_); }

 private:
  Stream StreamOf(const std::string& keys) const { return {seed_, "randomise/" + keys}; }
  void Give(const ConfigMap& entry, const std::string& key, std::string yaml) {
    const std::string place = entry.Place();
    values_.push_back({key, std::move(yaml), fmt::format("{} (drawn)", place)});
  }
  std::size_t Chosen(const ConfigMap& entry, std::size_t count, const Stream& stream) const;
  double Normal(const ConfigMap& entry, double share) const;
  void OneKey(const ConfigMap& entry);
  void Together(const ConfigMap& entry);
  void Correlated(const ConfigMap& entry);
  void Places(const ConfigMap& entry);
  void WholeSite(const ConfigMap& entry);

  const ConfigMap& scenario_;
  std::uint64_t seed_, episode_;
  bool has_site_ = false;
  std::vector<Config::GivenValue> values_;
};

/// The one of `keys` that the entry has. Reports a fault if it has none or several.
std::optional<std::string_view> OneOf(const ConfigMap& entry,
                                      std::span<const std::string_view> keys) {
  std::optional<std::string_view> found;
  int count = 0;
  for (const std::string_view key : keys) {
    if (!entry.Has(key)) continue;
    found = key;
    ++count;
  }
  if (count == 1) return found;
  entry.Fault("", fmt::format("{} found, need one of {}",
                              count == 0 ? "nothing" : "several of these", fmt::join(keys, ", ")));
  return std::nullopt;
}

void Draw::Entry(const ConfigMap& entry) {
  const auto kind = OneOf(entry, kKinds);
  if (!kind) return;
  if (*kind == "key") OneKey(entry);
  if (*kind == "together") Together(entry);
  if (*kind == "keys") Correlated(entry);
  if (*kind == "places") Places(entry);
  if (*kind == "site") WholeSite(entry);
}

/// A random index less than `count`, with `weights` as probabilities if given.
std::size_t Draw::Chosen(const ConfigMap& entry, std::size_t count, const Stream& stream) const {
  if (count == 0) return 0;
  std::vector<double> weights(count, 1.0);
  if (entry.Has("weights")) {
    weights = entry.Numbers("weights", AtLeast(0, ""), count, count);
  }
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  if (weights.size() != count) return 0;
  if (sum <= 0) entry.Fault("weights", {FaultKind::kOutOfRange, "all are 0, need one above"});
  double left = stream.Uniform(episode_) * sum;
  for (std::size_t i = 0; i + 1 < count; ++i) {
    if (left < weights[i]) return i;
    left -= weights[i];
  }
  return count - 1;
}

/// A normal number, truncated by `within`. `share` is its cumulative probability.
double Draw::Normal(const ConfigMap& entry, double share) const {
  const std::vector<double> of = entry.Numbers("normal", Any(""), 2, 2);
  if (of.size() != 2 || of[1] <= 0) {
    if (of.size() == 2) entry.Fault("normal", "need [mean, sigma], sigma > 0");
    return 0;
  }
  const boost::math::normal normal(of[0], of[1]);
  Interval below;
  Interval cut = {-std::numeric_limits<double>::infinity(),
                  std::numeric_limits<double>::infinity()};
  if (entry.Has("within")) {
    const Interval within = IntervalAt(entry, "within", Any(""));
    cut = within;
    below = {cdf(normal, within.lower), cdf(normal, within.upper)};
    if (below.upper <= below.lower) {
      entry.Fault("within", "contains no value of the distribution; widen it");
      return of[0];
    }
  }
  // In a far tail the cumulative probability rounds to 0 or 1, where the quantile is infinite.
  constexpr double kLeast = std::numeric_limits<double>::min();
  constexpr double kMost = 1 - std::numeric_limits<double>::epsilon() / 2;
  const double drawn = quantile(normal, std::clamp(below.At(share), kLeast, kMost));
  return std::clamp(drawn, cut.lower, cut.upper);
}

void Draw::OneKey(const ConfigMap& entry) {
  const std::string key = entry.Text("key");
  const auto kind = OneOf(entry, kOfKey);
  if (!kind || key.empty()) return;
  const Stream stream = StreamOf(key);
  const double share = stream.Uniform(episode_);
  if (*kind == "uniform") {
    Give(entry, key, NumberText(IntervalAt(entry, "uniform", Any("")).At(share)));
  } else if (*kind == "log_uniform") {
    const Interval of = IntervalAt(entry, "log_uniform", Positive(""));
    Give(entry, key, NumberText(of.lower * std::pow(of.upper / of.lower, share)));
  } else if (*kind == "normal") {
    Give(entry, key, NumberText(Normal(entry, share)));
  } else if (*kind == "integer") {
    constexpr double kLargest = 9e15;  // integers that doubles hold exactly
    const Interval of = IntervalAt(entry, "integer", Between(-kLargest, kLargest, ""));
    const double drawn = std::floor(of.lower) + std::floor(share * (of.upper - of.lower + 1));
    if (of.lower != std::floor(of.lower) || of.upper != std::floor(of.upper)) {
      entry.Fault("integer", {FaultKind::kMistyped, "need whole numbers"});
    }
    Give(entry, key, fmt::format("{}", static_cast<std::int64_t>(drawn)));
  } else {
    const std::vector<std::string> values = entry.YamlItems("choice");
    if (values.empty()) {
      entry.Fault("choice", {FaultKind::kMissing, "nothing to choose from"});
      return;
    }
    Give(entry, key, values[Chosen(entry, values.size(), stream)]);
  }
}

void Draw::Together(const ConfigMap& entry) {
  const std::vector<ConfigMap> sets = entry.List("together");
  if (sets.empty()) {
    entry.Fault("together", {FaultKind::kMissing, "nothing to choose from"});
    return;
  }
  std::string keys;
  for (const ConfigMap& set : sets) {
    for (const std::string& key : set.Keys()) {
      set.Has(key);
      keys += key + " ";
    }
  }
  const ConfigMap& set = sets[Chosen(entry, sets.size(), StreamOf(keys))];
  for (const std::string& key : set.Keys()) Give(set, key, set.Yaml(key));
}

void Draw::Correlated(const ConfigMap& entry) {
  const std::vector<std::string> keys = entry.Texts("keys");
  const std::size_t count = keys.size();
  const std::vector<double> mean = entry.Numbers("mean", Any(""), count, count),
                            sigma = entry.Numbers("sigma", Positive(""), count, count);
  const double least = count > 1 ? -1 / (static_cast<double>(count) - 1) : -1;
  const double correlation =
      entry.Number("correlation", {.min = least, .max = 1, .min_excluded = true});
  if (count < 2) entry.Fault("keys", {FaultKind::kOutOfRange, "need two or more"});
  if (count < 2 || mean.size() != count || sigma.size() != count) return;
  const auto n = static_cast<Eigen::Index>(count);
  const Eigen::MatrixXd alike = Eigen::MatrixXd::Constant(n, n, correlation) +
                                (1 - correlation) * Eigen::MatrixXd::Identity(n, n);
  // LDLT also handles a semidefinite matrix. At a correlation of 1 all numbers are equal.
  const auto factor = alike.ldlt();
  Eigen::VectorXd drawn(n);
  const Stream stream = StreamOf(fmt::format("{}", fmt::join(keys, " ")));
  for (Eigen::Index i = 0; i < n; ++i) {
    drawn[i] = stream.Gaussian(episode_, static_cast<std::uint32_t>(i));
  }
  const Eigen::VectorXd root = factor.vectorD().cwiseMax(0).cwiseSqrt();
  const Eigen::VectorXd correlated =
      factor.transpositionsP().transpose() *
      Eigen::VectorXd(factor.matrixL() * Eigen::VectorXd(root.cwiseProduct(drawn)));
  for (std::size_t i = 0; i < count; ++i) {
    Give(entry, keys[i], NumberText(mean[i] + sigma[i] * correlated[static_cast<Eigen::Index>(i)]));
  }
}

void Draw::Places(const ConfigMap& entry) {
  const std::vector<std::string> keys = entry.Texts("places");
  const Interval x_m = IntervalAt(entry, "x_m", Any("m")), y_m = IntervalAt(entry, "y_m", Any("m"));
  Interval yaw_deg{0, 0};
  if (entry.Has("yaw_deg")) yaw_deg = IntervalAt(entry, "yaw_deg", Between(-360, 360, "deg"));
  const double apart_m = entry.Number("apart_m", AtLeast(0, "m"), 0),
               clear_m = entry.Number("clear_m", AtLeast(0, "m"), 0);
  std::vector<Vec2> clear_of_m, placed_m;
  for (const auto& row : entry.NumberRows("clear_of_m", Any("m"), 2, 0)) {
    if (row.size() == 2) clear_of_m.emplace_back(row[0], row[1]);
  }
  const auto is_free = [](const std::vector<Vec2>& others_m, const Vec2& at_m, double away_m) {
    return std::all_of(others_m.begin(), others_m.end(),
                       [&](const Vec2& other_m) { return (other_m - at_m).norm() >= away_m; });
  };
  for (const std::string& key : keys) {
    const Stream stream = StreamOf(key);
    std::uint32_t tries = 0;
    Vec2 at_m;
    do {
      at_m = {x_m.At(stream.Uniform(episode_, 2 * tries)),
              y_m.At(stream.Uniform(episode_, 2 * tries + 1))};
    } while ((!is_free(placed_m, at_m, apart_m) || !is_free(clear_of_m, at_m, clear_m)) &&
             ++tries < kMostDraws);
    if (tries == kMostDraws) {
      entry.Fault("places", fmt::format("no place found for '{}' in {} tries; widen x_m and y_m, "
                                        "or lessen apart_m or clear_m",
                                        key, kMostDraws));
      return;
    }
    placed_m.push_back(at_m);
    Give(entry, key + ".xy_m", fmt::format("[{}, {}]", at_m.x(), at_m.y()));
    if (entry.Has("yaw_deg")) {
      Give(entry, key + ".yaw_deg",
           NumberText(yaw_deg.At(stream.Uniform(episode_, 2 * kMostDraws))));
    }
  }
}

void Draw::WholeSite(const ConfigMap& entry) {
  const SiteDraw draw{seed_, episode_, &scenario_, &values_};
  const ConfigMap site = entry.Map("site");
  if (std::exchange(has_site_, true))
    site.Fault("", {FaultKind::kRepeated, "is the second site, need only one"});
  std::vector<Config::GivenValue> lists;
  for (auto& [key, yaml] : DrawSite(site, draw)) {
    lists.push_back({key, std::move(yaml), fmt::format("{} (drawn)", entry.Place())});
  }
  // Inserted first, so that other entries' draws for items of the same lists override these.
  values_.insert(values_.begin(), lists.begin(), lists.end());
}

}  // namespace

std::vector<Config::GivenValue> DrawEpisode(const ConfigMap& scenario, std::uint64_t seed,
                                            std::uint64_t episode) {
  Draw draw(scenario, seed, episode);
  for (const ConfigMap& entry : scenario.List("randomise")) draw.Entry(entry);
  std::vector<Config::GivenValue> values = draw.Take();
  for (const Config::GivenValue& value : values) {
    const bool is_own = value.path == "seed" || value.path.starts_with("randomise") ||
                        value.path.starts_with("drawn");
    if (is_own) scenario.Fault("randomise", "'" + value.path + "' cannot be drawn");
  }
  return values;
}

}  // namespace tera
