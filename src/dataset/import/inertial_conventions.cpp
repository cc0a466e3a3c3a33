#include "dataset/import/inertial_conventions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/quantile.h"
#include "core/units.h"
#include "dataset/import/import_options.h"

namespace tera {
namespace {

constexpr double kMostGravityFree = 0.2;  ///< fraction of gravity that the median stays below
/// Acceleration in g: the median is within kAboutOne of 1, and nine tenths of the samples exceed
/// kHalfOfOne.
constexpr double kAboutOne = 0.3, kHalfOfOne = 0.5, kTenth = 0.1;
constexpr double kNearDown_rad = 25 * kDeg, kMostlyDown_rad = 60 * kDeg, kMostly = 0.9;
constexpr TimeNs kPiece_ns = kNsPerSecond / 4;
constexpr std::size_t kPiecesOfSpan = 8, kFewestSpans = 8;
constexpr double kSeenTurn_rad = 5 * kDeg, kSureTurn_rad = 20 * kDeg;
constexpr double kNearRatio = 3;  ///< a factor
constexpr double kShareOfFast = 0.1;

double AngleBetweenDirections(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Mean specific force and integrated rates over a quarter of a second.
struct Piece {
  TimeNs begin_ns = 0;
  Vec3 f_mps2 = Vec3::Zero();
  double across_rad = 0;
};

Piece PieceOf(const std::vector<ImuSample>& samples, std::size_t begin, std::size_t end) {
  Piece piece{.begin_ns = samples[begin].t_ns};
  for (std::size_t i = begin; i < end; ++i) piece.f_mps2 += samples[i].f_S_mps2;
  piece.f_mps2 /= static_cast<double>(end - begin);
  const Vec3 up = piece.f_mps2.normalized();
  for (std::size_t i = begin; i + 1 < samples.size() && i < end; ++i) {
    const double dt_s = ToSeconds(samples[i + 1].t_ns - samples[i].t_ns);
    piece.across_rad += dt_s * samples[i].w_WS_S_radps.cross(up).norm();
  }
  return piece;
}

std::vector<Piece> PiecesOf(const std::vector<ImuSample>& samples) {
  std::vector<Piece> pieces;
  for (std::size_t begin = 0, i = 1; i <= samples.size(); ++i) {
    if (i < samples.size() && samples[i].t_ns - samples[begin].t_ns < kPiece_ns) continue;
    pieces.push_back(PieceOf(samples, begin, i));
    begin = i;
  }
  return pieces;
}

/// Median ratio of the rotation by rates to the rotation of gravity, over spans in which gravity
/// rotates by at least `least_rad`; 0 if there are too few spans.
double TurnRatio(const std::vector<Piece>& pieces, double least_rad) {
  std::vector<double> ratios;
  for (std::size_t k = 0; k + kPiecesOfSpan < pieces.size(); ++k) {
    const Piece &first = pieces[k], &last = pieces[k + kPiecesOfSpan];
    constexpr TimeNs kLongest_ns = 2 * static_cast<TimeNs>(kPiecesOfSpan) * kPiece_ns;
    if (last.begin_ns - first.begin_ns > kLongest_ns) continue;  // rows are missing
    const double turn_rad = AngleBetweenDirections(first.f_mps2, last.f_mps2);
    if (turn_rad < least_rad) continue;
    double across_rad = 0;
    for (std::size_t j = k; j < k + kPiecesOfSpan; ++j) across_rad += pieces[j].across_rad;
    ratios.push_back(across_rad / turn_rad);
  }
  return ratios.size() < kFewestSpans ? 0 : Quantile(std::move(ratios), 0.5);
}

bool IsNearRatio(double ratio, double expected) {
  return ratio > expected / kNearRatio && ratio < expected * kNearRatio;
}

TurnRatios RatiosOf(const std::vector<ImuSample>& samples) {
  const std::vector<Piece> pieces = PiecesOf(samples);
  return {TurnRatio(pieces, kSeenTurn_rad), TurnRatio(pieces, kSureTurn_rad)};
}

void JudgeRates(const std::vector<ImuSample>& samples, std::vector<InertialFinding>* findings) {
  constexpr double kDegreesOfRadian = 1 / kDeg;
  const auto [seen, sure] = RatiosOf(samples);
  if (IsNearRatio(seen, kDegreesOfRadian)) {
    findings->push_back(
        {InertialDoubt::kRatesInDegrees,
         fmt::format("the rates turn the unit {:.3g} times as far as gravity turns in it: are they "
                     "in deg/s? give them unit: deg/s",
                     seen)});
  } else if (IsNearRatio(sure, 1 / kDegreesOfRadian)) {
    findings->push_back(
        {InertialDoubt::kRatesInRadians,
         fmt::format("gravity turns in the unit {:.3g} times as far as the rates turn it: are they "
                     "in rad/s? give them unit: rad/s",
                     1 / sure)});
  } else if (seen == 0) {
    std::vector<double> sizes;
    for (const ImuSample& one : samples) sizes.push_back(one.w_WS_S_radps.norm());
    const double fast_radps = Quantile(std::move(sizes), 1 - kShareOfFast);
    if (fast_radps <= kFastestJoint_radps) return;
    if (fast_radps * kDeg > kFastestJoint_radps) {
      findings->push_back(
          {InertialDoubt::kRatesInDegrees,
           fmt::format("a tenth of the rates is beyond {:.3g}, too fast for a joint even in deg/s: "
                       "are they counts? give them their unit and scale",
                       fast_radps)});
      return;
    }
    findings->push_back({InertialDoubt::kRatesInDegrees,
                         fmt::format("a tenth of the rates is beyond {:.3g} rad/s, too fast for a "
                                     "joint: are they in deg/s? give them unit: deg/s",
                                     fast_radps)});
  }
}

void JudgeDown(const std::vector<ImuSample>& samples, const Vec3& up_S,
               std::vector<InertialFinding>* findings) {
  std::vector<double> from_down_rad, along_z_mps2;
  for (const ImuSample& one : samples) {
    from_down_rad.push_back(AngleBetweenDirections(one.f_S_mps2, -up_S));
    along_z_mps2.push_back(one.f_S_mps2.z());
  }
  const double median_rad = Quantile(from_down_rad, 0.5);
  if (median_rad > kNearDown_rad || Quantile(from_down_rad, kMostly) > kMostlyDown_rad) return;
  const bool is_z = up_S.z() > std::cos(kNearDown_rad);
  findings->push_back(
      {InertialDoubt::kZDown,
       is_z ? fmt::format("at rest az is {:.3g} m/s2, about -g: does its z point down? give it "
                          "rpy_deg: [180, 0, 0], or an upside-down mount",
                          Quantile(std::move(along_z_mps2), 0.5))
            : fmt::format("the specific force is {:.0f} deg from the downward direction of its "
                          "mount: are axes and mount right?",
                          median_rad / kDeg)});
}

std::vector<ImuSample> SamplesOf(std::size_t count,
                                 const std::function<ImuSample(std::size_t row)>& sample) {
  std::vector<ImuSample> samples;
  for (std::size_t i = 0; i < count; ++i) samples.push_back(sample(i));
  return samples;
}

std::vector<double> SizesOf(const std::vector<ImuSample>& samples) {
  std::vector<double> sizes_mps2;
  for (const ImuSample& one : samples) sizes_mps2.push_back(one.f_S_mps2.norm());
  return sizes_mps2;
}

bool IsInG(const std::vector<ImuSample>& samples) {
  return !samples.empty() && std::abs(Quantile(SizesOf(samples), 0.5) - 1) < kAboutOne &&
         Quantile(SizesOf(samples), kTenth) > kHalfOfOne;
}

}  // namespace

TurnRatios TurnsOverGravity(std::size_t count,
                            const std::function<ImuSample(std::size_t row)>& sample) {
  return count == 0 ? TurnRatios{} : RatiosOf(SamplesOf(count, sample));
}

std::vector<InertialFinding> JudgeLogged(std::size_t count,
                                         const std::function<ImuSample(std::size_t row)>& sample,
                                         bool knows_mount) {
  struct Side {
    const char* axis;
    Vec3 up;
    const char* rpy_deg;  ///< rotation that makes z vertical
  };
  const std::vector<ImuSample> samples = SamplesOf(count, sample);
  if (IsInG(samples)) {
    return {{InertialDoubt::kInG,
             "the acceleration is about 1 m/s2 at all times: is it in g? give it unit: g"}};
  }
  if (knows_mount) return {};
  for (const Side& side : {Side{"x", Vec3::UnitX(), "[0, -90, 0]"},
                           {"-x", -Vec3::UnitX(), "[0, 90, 0]"},
                           {"y", Vec3::UnitY(), "[90, 0, 0]"},
                           {"-y", -Vec3::UnitY(), "[-90, 0, 0]"}}) {
    std::vector<double> away_rad;
    for (const ImuSample& one : samples) {
      away_rad.push_back(AngleBetweenDirections(one.f_S_mps2, side.up));
    }
    if (away_rad.empty() || Quantile(away_rad, 0.5) > kNearDown_rad ||
        Quantile(away_rad, kMostly) > kMostlyDown_rad) {
      continue;
    }
    return {
        {InertialDoubt::kOnItsSide,
         fmt::format("at rest {} points up: give it rpy_deg: {}, with a further turn about z until "
                     "x points forward, or a mount; for a unit on an upright arm this is correct",
                     side.axis, side.rpy_deg)}};
  }
  return {};
}

std::vector<InertialFinding> JudgeInertial(std::size_t count,
                                           const std::function<ImuSample(std::size_t row)>& sample,
                                           const Vec3& up_S) {
  if (count == 0) return {};
  const std::vector<ImuSample> samples = SamplesOf(count, sample);
  const double size_mps2 = Quantile(SizesOf(samples), 0.5);
  if (size_mps2 < kMostGravityFree * kStandardGravity_mps2) {
    if (IsInG(samples)) return {};
    return {{InertialDoubt::kNoGravity,
             fmt::format("the acceleration is {:.2g} m/s2 in the median: was gravity subtracted? "
                         "need the raw specific force, {:.2f} m/s2 at rest",
                         size_mps2, kStandardGravity_mps2)}};
  }
  std::vector<InertialFinding> findings;
  JudgeDown(samples, up_S, &findings);
  JudgeRates(samples, &findings);
  return findings;
}

}  // namespace tera
