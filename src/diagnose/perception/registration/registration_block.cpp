#include "diagnose/perception/registration/registration_block.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "core/check.h"
#include "diagnose/blocks/candidate_list.h"
#include "diagnose/statistics/series/robust.h"
#include "sensors/sensor_mechanisms.h"

namespace tera {
namespace {

constexpr TimeNs kShortestBlock_ns = 1'000'000'000;
constexpr TimeNs kMostBlocks = 40;  ///< longer recordings have longer blocks
/// Number of blocks in a round. Each round has the exact shares of TRAIN, SELECT and FINAL.
constexpr std::size_t kBlocksOfRound = 10;

/// Parts of one round's blocks, in random order.
std::array<Part, kBlocksOfRound> PartsOfRound(const Stream& stream, std::size_t round) {
  using enum Part;
  std::array<Part, kBlocksOfRound> parts = {kTrain,  kTrain,  kTrain, kTrain, kSelect,
                                            kSelect, kSelect, kFinal, kFinal, kFinal};
  for (std::size_t i = kBlocksOfRound - 1; i > 0; --i) {
    const double draw = stream.Uniform(round * kBlocksOfRound + i);
    std::swap(parts[i], parts[static_cast<std::size_t>(draw * static_cast<double>(i + 1))]);
  }
  return parts;
}

}  // namespace

ScanSplit SplitScans(const std::vector<TimeNs>& t_ns, const Stream& stream) {
  ScanSplit split;
  if (t_ns.empty()) return split;
  const TimeNs first_ns = t_ns.front();
  const TimeNs length_ns = std::max(kShortestBlock_ns, (t_ns.back() - first_ns) / kMostBlocks + 1);
  TimeNs last = -1;
  for (const TimeNs t : t_ns) {
    const TimeNs at = (t - first_ns) / length_ns;
    // Blocks without scans are not counted, so that the shares refer to blocks with scans.
    if (at != last) ++split.blocks;
    last = at;
    const std::size_t block = split.blocks - 1;
    split.block.push_back(block);
    split.part.push_back(PartsOfRound(stream, block / kBlocksOfRound)[block % kBlocksOfRound]);
  }
  return split;
}

namespace {

/// Step of the central difference, relative to a parameter's range. For angles: microradians.
constexpr double kDifference = 1e-7;

/// Small change from one calibration to another.
CalibrationVector ChangeBetween(const SensorCalibration& from, const SensorCalibration& to) {
  CalibrationVector change;
  change.segment<3>(kShiftOfMount) = to.X_BT.translation() - from.X_BT.translation();
  const Mat3 turn = to.X_BT.linear() * from.X_BT.linear().transpose();
  change.segment<3>(kTurnOfMount) =
      0.5 * Vec3(turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1));
  change[kRangeBias] = to.range_bias_m - from.range_bias_m;
  change[kRangeFactor] = to.range_factor - from.range_factor;
  change[kClockOffset] = to.clock_offset_s - from.clock_offset_s;
  return change;
}

}  // namespace

CalibrationJacobian JacobianOf(const Pose& X_BS, const Effects& present, const Structure& terms) {
  std::vector<CalibrationVector> columns;
  for (std::size_t t = 0; t < terms.size(); ++t) {
    for (const FreeParameter& free : terms[t].Free()) {
      const double step = kDifference * (free.upper - free.lower);
      const auto moved = [&](double by) {
        Structure near = terms;
        near[t].values[free.index] += by;
        return CalibrationUnder(X_BS, WithTerms(present, near));
      };
      columns.push_back(ChangeBetween(moved(-step), moved(step)) / (2 * step));
    }
  }
  CalibrationJacobian jacobian(kCalibrationElements, static_cast<Eigen::Index>(columns.size()));
  for (std::size_t c = 0; c < columns.size(); ++c) {
    jacobian.col(static_cast<Eigen::Index>(c)) = columns[c];
  }
  return jacobian;
}

namespace {

constexpr double kDegreesOfFreedom = 4;
constexpr double kFurthest = 30;     ///< standard deviations: points further away add no evidence
constexpr double kLeastScale = 0.2;  ///< actual noise is not far below the sensor's noise model
constexpr double kInlierShare = 0.95;
/// Ratio of standard deviation to median absolute deviation of normal noise.
constexpr double kSigmaOfMad = 1.4826;

}  // namespace

double LogDensityAt(double distance_over_sigma) {
  const double x = std::min(std::abs(distance_over_sigma), kFurthest);
  return -0.5 * (kDegreesOfFreedom + 1) * std::log1p(x * x / kDegreesOfFreedom);
}

double LogLikelihoodOf(const PointResidual& residual, double scale) {
  if (!residual.is_judged()) return LogDensityAt(kFurthest);
  return LogDensityAt(residual.distance / (scale * residual.sigma));
}

double LogLikelihoodOf(const std::vector<PointResidual>& residuals, double scale) {
  double sum = 0;
  for (const PointResidual& residual : residuals) sum += LogLikelihoodOf(residual, scale);
  return sum;
}

double ScaleOf(const std::vector<PointResidual>& residuals) {
  std::vector<double> distances;
  for (const PointResidual& r : residuals) {
    if (r.is_judged()) distances.push_back(std::abs(r.distance / r.sigma));
  }
  if (distances.empty()) return 1;
  return std::max(kLeastScale, kSigmaOfMad * Median(std::move(distances)));
}

double TrimmedRmse(const std::vector<PointResidual>& residuals) {
  std::vector<double> square;
  for (const PointResidual& r : residuals) {
    if (r.is_judged()) square.push_back(r.distance * r.distance);
  }
  if (square.empty()) return 0;
  const auto kept =
      static_cast<std::size_t>(std::ceil(kInlierShare * static_cast<double>(square.size())));
  std::nth_element(square.begin(), square.begin() + static_cast<std::ptrdiff_t>(kept) - 1,
                   square.end());
  double sum = 0;
  for (std::size_t i = 0; i < kept; ++i) sum += square[i];
  return std::sqrt(sum / static_cast<double>(kept));
}

double RobustWeightOf(const PointResidual& residual, double scale) {
  const double x = residual.distance / (scale * residual.sigma);
  return (kDegreesOfFreedom + 1) / (kDegreesOfFreedom + x * x);
}

namespace {

/// Starting values of the clock search.
constexpr double kClockOffsets_s[] = {0.1, -0.1, 0.3, -0.3, 1, -1, 3, -3, 18, -18};

/// Standard deviation of a mounting error after careful installation, by unit of the parameter.
double PriorSigmaOf(std::string_view unit) {
  if (unit == "m") return 0.3;
  if (unit == "deg") return 5;
  if (unit == "s") return 1;
  TERA_CHECK(unit == "1", unit);
  return 0.05;
}

}  // namespace

std::vector<Candidate> CandidatesOf(EffectTarget kind, ComparedBy compared,
                                    const std::string& sensor, const Effects& present) {
  CandidateList candidates(sensor, kind, present, SensorMechanisms());
  // Mechanisms that the kind has, with all parameters free in the ranges of the table.
  const auto add = [&](std::string_view id, const std::vector<std::vector<double>>& starts) {
    const auto mechanism =
        std::find_if(SensorMechanisms().begin(), SensorMechanisms().end(),
                     [&](const Mechanism& one) { return one.id == id && one.ActsOn(kind); });
    if (mechanism == SensorMechanisms().end()) return;
    std::vector<FreeParameter> free;
    for (const EffectParameter& parameter : mechanism->parameters) {
      free.push_back({.index = free.size(),
                      .lower = parameter.lower,
                      .upper = parameter.upper,
                      .prior_sigma = PriorSigmaOf(parameter.unit)});
    }
    candidates.Add(id, std::move(free), starts);
  };
  add("extrinsic", {{0, 0, 0, 0, 0, 0}});
  if (compared == ComparedBy::kRanges) {
    add("range_bias", {{0}});
    add("scale", {{1}});
  }
  std::vector<std::vector<double>> offsets = {{0}};
  for (const double offset_s : kClockOffsets_s) offsets.push_back({offset_s});
  add("clock_offset", offsets);
  return candidates.Take();
}

}  // namespace tera
