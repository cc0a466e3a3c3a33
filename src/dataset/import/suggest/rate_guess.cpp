#include "dataset/import/suggest/rate_guess.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/quantile.h"
#include "core/units.h"
#include "dataset/import/angle_wrap.h"
#include "dataset/import/import_options.h"
#include "dataset/import/inertial_conventions.h"
#include "dataset/import/suggest/doubted_numbers.h"

namespace tera {
namespace {

using AxisColumns = std::vector<const NumbersOfColumn*>;

bool AreWhole(const AxisColumns& columns, std::size_t rows) {
  return rows > 0 && std::all_of(columns.begin(), columns.end(), [&](const NumbersOfColumn* one) {
           return one == nullptr || one->values.size() == rows;
         });
}

bool IsNear(double ratio, double expected, double factor) {
  return ratio > expected / factor && ratio < expected * factor;
}

/// Unit of rates, from the ratio of their integral (as rad/s) to the rotation observed otherwise.
std::optional<UnitGuess> UnitOfRatio(double deg_ratio, double rad_ratio, double factor,
                                     const char* what) {
  const auto guess = [&](const char* unit, double ratio) {
    return UnitGuess{unit, 1.0,
                     fmt::format("in rad/s they turn {:.3g} times as far as {}", ratio, what)};
  };
  if (IsNear(deg_ratio, 1 / kDeg, factor)) return guess("deg/s", deg_ratio);
  if (IsNear(rad_ratio, 1, factor)) return guess("rad/s", rad_ratio);
  return std::nullopt;
}

std::optional<UnitGuess> ByGravity(const AxisColumns& rates, const TurnWitness& witness) {
  const std::size_t rows = witness.t_ns.size();
  if (rates.size() != 3 || witness.forces.size() != 3 || !AreWhole(rates, rows) ||
      !AreWhole(witness.forces, rows)) {
    return std::nullopt;
  }
  const auto vector = [](const AxisColumns& axes, std::size_t row) {
    return Vec3(axes[0]->values[row], axes[1]->values[row], axes[2]->values[row]);
  };
  const TurnRatios ratios = TurnsOverGravity(rows, [&](std::size_t row) {
    return ImuSample{witness.t_ns[row], witness.t_ns[row], vector(rates, row),
                     vector(witness.forces, row)};
  });
  constexpr double kFactor = 3;  // as in JudgeInertial
  return UnitOfRatio(ratios.seen, ratios.sure, kFactor, "gravity does");
}

/// The unwrapped angle in rad; nullopt if its unit is uncertain.
std::optional<std::vector<double>> SureAngle_rad(const NumbersOfColumn& angle) {
  const AngleGuess guess = GuessAngle(angle);
  constexpr double kBeyondAnyTurn = 8 * kPi;
  const bool is_sure = ToldUnit(angle, Dimension::kAngle) || guess.begins_anew ||
                       angle.LargestSize() > kBeyondAnyTurn;
  if (!is_sure || !guess.unit.is_known()) return std::nullopt;
  std::vector<double> turned_rad;
  for (const double value : angle.values) {
    turned_rad.push_back(value * guess.unit.scale * (guess.unit.unit == "deg" ? kDeg : 1));
  }
  Unwrap(2 * kPi, &turned_rad);
  return turned_rad;
}

/// Ratio of the rate's integral to the angle's change over spans of rows; 0 if they do not
/// correlate.
double RatioToAngle(const std::vector<TimeNs>& t_ns, const NumbersOfColumn& rate,
                    const std::vector<double>& angle_rad) {
  constexpr std::size_t kFewestSpans = 8;
  const double length_s = ToSeconds(t_ns.back() - t_ns.front());
  const double rows_of_second = length_s > 0 ? static_cast<double>(t_ns.size()) / length_s : 0;
  // A span lasts about a second; a recording has at least four.
  const auto span = static_cast<std::size_t>(
      std::clamp(rows_of_second, 1.0, std::max(1.0, static_cast<double>(t_ns.size()) / 4)));
  constexpr double kLeastCorrelation = 0.8, kLeastTurn_rad = 2 * kDeg;
  std::vector<double> turned = {0};
  for (std::size_t k = 1; k < t_ns.size(); ++k) {
    turned.push_back(turned.back() + 0.5 * (rate.values[k] + rate.values[k - 1]) *
                                         ToSeconds(t_ns[k] - t_ns[k - 1]));
  }
  double rr = 0, ra = 0, aa = 0, most_rad = 0;
  std::size_t spans = 0;
  for (std::size_t k = span; k < t_ns.size(); ++k, ++spans) {
    const double r = turned[k] - turned[k - span];
    const double a = angle_rad[k] - angle_rad[k - span];
    rr += r * r;
    ra += r * a;
    aa += a * a;
    most_rad = std::max(most_rad, std::abs(a));
  }
  if (spans < kFewestSpans || most_rad < kLeastTurn_rad || aa == 0 || rr == 0) return 0;
  return std::abs(ra) > kLeastCorrelation * std::sqrt(rr * aa) ? rr / std::abs(ra) : 0;
}

std::optional<UnitGuess> ByAngles(const AxisColumns& rates, const TurnWitness& witness) {
  const std::size_t rows = witness.t_ns.size();
  if (!AreWhole(rates, rows) || !AreWhole(witness.angles, rows)) return std::nullopt;
  for (std::size_t k = 0; k < std::min(rates.size(), witness.angles.size()); ++k) {
    const auto angle_rad =
        witness.angles[k] == nullptr ? std::nullopt : SureAngle_rad(*witness.angles[k]);
    if (!angle_rad) continue;
    const double ratio = RatioToAngle(witness.t_ns, *rates[k], *angle_rad);
    constexpr double kFactor = 2;
    if (auto unit = UnitOfRatio(ratio, ratio, kFactor, "the angle does")) return unit;
  }
  return std::nullopt;
}

}  // namespace

UnitGuess GuessRateUnit(const AxisColumns& rates, const TurnWitness& witness) {
  double largest = 0;
  for (const NumbersOfColumn* rate : rates) {
    if (const auto unit = ToldUnit(*rate, Dimension::kRate)) return *unit;
    largest = std::max(largest, rate->LargestSize());
  }
  if (largest == 0) return {"rad/s", 1.0, ""};
  if (const auto unit = ByGravity(rates, witness)) return *unit;
  if (const auto unit = ByAngles(rates, witness)) return *unit;
  constexpr double kTenth = 0.1;
  double fast = 0;
  for (const NumbersOfColumn* rate : rates) {
    std::vector<double> sizes;
    for (const double value : rate->values) sizes.push_back(std::abs(value));
    if (!sizes.empty()) fast = std::max(fast, Quantile(std::move(sizes), 1 - kTenth));
  }
  if (fast * kDeg > kFastestJoint_radps) {
    return {kUnknownUnit, 1.0,
            fmt::format("a tenth is beyond {:.4g}, faster than any joint in rad/s and in deg/s: "
                        "counts? they need a scale",
                        fast)};
  }
  const bool are_counts =
      !witness.forces.empty() && !GuessAccelerationUnit(witness.forces).is_known();
  if (fast > kFastestJoint_radps && !are_counts) {
    return {"deg/s", 1.0,
            fmt::format("a tenth is beyond {:.4g}, too fast for a joint in rad/s", fast)};
  }
  return {kUnknownUnit, 1.0,
          fmt::format("rad/s or deg/s is unknown; the largest is {:.4g}", largest)};
}

}  // namespace tera
