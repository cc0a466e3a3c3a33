#include "dataset/compare/track_doubts.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

namespace tera {
namespace {

/// Positions of both tracks at those times of `a` that lie within `b`.
struct CommonPlaces {
  Eigen::Matrix3Xd a_m, b_m;
};

CommonPlaces PlacesInCommon(const Trajectory& a, const Trajectory& b, TimeNs max_gap_ns) {
  std::vector<Vec3> of_a, of_b;
  for (const TimedPose& pose : a) {
    const auto other = PoseAt(b, pose.t_ns, max_gap_ns);
    if (!other) continue;
    of_a.push_back(pose.X_WB.translation());
    of_b.push_back(other->translation());
  }
  const auto matrix = [](const std::vector<Vec3>& places) {
    Eigen::Matrix3Xd m(3, static_cast<Eigen::Index>(places.size()));
    for (std::size_t k = 0; k < places.size(); ++k) m.col(static_cast<Eigen::Index>(k)) = places[k];
    return m;
  };
  return {matrix(of_a), matrix(of_b)};
}

double Rms(const Eigen::Matrix3Xd& m) {
  return std::sqrt(m.squaredNorm() / static_cast<double>(m.cols()));
}

double SizeOf(const Eigen::Matrix3Xd& places) {
  return Rms(places.colwise() - Vec3(places.rowwise().mean()));
}

constexpr Eigen::Index kLeastPlaces = 10;

void DoubtUnits(const CommonPlaces& places, std::vector<std::string>* doubts) {
  struct Factor {
    double of_b;
    const char* text;
  };
  constexpr std::array kFactors = {
      Factor{1000, "the second in millimetres"}, Factor{0.001, "the reference in millimetres"},
      Factor{100, "the second in centimetres"},  Factor{0.01, "the reference in centimetres"},
      Factor{1 / 0.3048, "the second in feet"},  Factor{0.3048, "the reference in feet"},
  };
  constexpr double kLeastSize_m = 1, kWithin = 0.01, kMostLeft = 0.05;
  const double size_m = SizeOf(places.a_m);
  if (std::max(size_m, SizeOf(places.b_m)) < kLeastSize_m) return;
  const Eigen::Matrix4d X = Eigen::umeyama(places.b_m, places.a_m, true);
  const Eigen::Matrix3d sR = X.topLeftCorner<3, 3>();
  const Eigen::Matrix3Xd left =
      ((sR * places.b_m).colwise() + Vec3(X.topRightCorner<3, 1>())) - places.a_m;
  if (!(Rms(left) < kMostLeft * size_m)) return;
  const double of_b = 1 / sR.col(0).norm();
  for (const Factor& factor : kFactors) {
    if (std::abs(of_b / factor.of_b - 1) > kWithin) continue;
    doubts->push_back(fmt::format("the second is {:.4g} times as large as the reference: {}?", of_b,
                                  factor.text));
  }
}

/// Errors of a track after a time shift, without alignment and with SE(2) alignment.
struct ShiftedError {
  double none_m = 0, se2_m = 0;
  std::size_t count = 0;
};

std::optional<ShiftedError> ErrorAt(const Trajectory& a, Trajectory b, TimeNs shift_ns,
                                    TimeNs max_gap_ns) {
  for (TimedPose& pose : b) pose.t_ns += shift_ns;
  const auto is_common = [&](const TimedPose& pose) {
    return PoseAt(b, pose.t_ns, max_gap_ns).has_value();
  };
  const auto count = std::count_if(a.begin(), a.end(), is_common);
  if (count < kLeastPlaces) return std::nullopt;
  TrajectoryErrorOptions options{.max_gap_ns = max_gap_ns};
  const double none_m = EvaluateTrajectory(a, b, options).ape_translation_m.rmse;
  options.alignment = Alignment::kSe2;
  return ShiftedError{none_m, EvaluateTrajectory(a, b, options).ape_translation_m.rmse,
                      static_cast<std::size_t>(count)};
}

void DoubtTimes(const Trajectory& a, const Trajectory& b, TimeNs max_gap_ns,
                std::vector<std::string>* doubts) {
  struct Scales {
    int apart_s;
    const char* text;
  };
  constexpr std::array kScales = {Scales{18, "GPS time and UTC"}, Scales{37, "TAI and UTC"},
                                  Scales{19, "TAI and GPS time"}};
  constexpr double kOfError = 1 / 3.0;
  const auto at = [&](int shift_s) { return ErrorAt(a, b, shift_s * kNsPerSecond, max_gap_ns); };
  const auto unshifted = at(0);
  if (!unshifted) return;
  const auto is_better = [&](double ShiftedError::*member, const ShiftedError& error, int shift_s) {
    if (!(error.*member < kOfError * (*unshifted).*member)) return false;
    for (const int beside_s : {shift_s - 1, shift_s + 1}) {
      const auto beside = at(beside_s);
      if (beside && (*beside).*member <= error.*member) return false;
    }
    return true;
  };
  for (const Scales& scales : kScales) {
    for (const int shift_s : {scales.apart_s, -scales.apart_s}) {
      const auto error = at(shift_s);
      if (!error || 2 * error->count < unshifted->count) continue;
      const bool is_in_place = is_better(&ShiftedError::none_m, *error, shift_s);
      if (!is_in_place && !is_better(&ShiftedError::se2_m, *error, shift_s)) continue;
      const auto member = is_in_place ? &ShiftedError::none_m : &ShiftedError::se2_m;
      doubts->push_back(
          fmt::format("{} s {}, the second has an APE of {:.3f} m instead of {:.3f} m{}: {}?",
                      scales.apart_s, shift_s > 0 ? "later" : "earlier", (*error).*member,
                      (*unshifted).*member, is_in_place ? "" : ", SE(2) aligned", scales.text));
    }
  }
}

void DoubtFrames(const CommonPlaces& places, std::vector<std::string>* doubts) {
  constexpr double kOfMaps_m = 10e3;
  const double apart_m = (places.b_m.rowwise().mean() - places.a_m.rowwise().mean()).norm();
  if (apart_m < kOfMaps_m) return;
  doubts->push_back(
      fmt::format("the two lie {:.0f} km apart: map coordinates in one, site coordinates in the "
                  "other? only aligned errors are meaningful",
                  apart_m / 1000));
}

}  // namespace

std::vector<std::string> TrackDoubts(const Trajectory& a, const Trajectory& b, TimeNs max_gap_ns) {
  std::vector<std::string> doubts;
  const CommonPlaces places = PlacesInCommon(a, b, max_gap_ns);
  if (places.a_m.cols() < kLeastPlaces) return doubts;
  DoubtUnits(places, &doubts);
  if (!doubts.empty()) return doubts;  // if the scale is not metric, distances are meaningless
  DoubtTimes(a, b, max_gap_ns, &doubts);
  DoubtFrames(places, &doubts);
  return doubts;
}

}  // namespace tera
