#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace tera {

/// The quantity of a figure, map or curve.
enum class Measure {
  kSeenBy1,
  kSeenBy2,
  kSeenBy3,
  kBlindVolume,
  kBlindAreaNear,
  kBlindAreaFar,
  kDetectedFrom,
  kDetectedTo,
  kDetectedOver,
  kDetectedShare,
  kProbability,
  kProbabilityOfQuarter,
  kEdgeSeen,
  kLoadSeen,
  kElevationGaps,
  kElevationSigma,
  kPixelShare,
  kPixelReach,
  kSkyHidden,
  kSkyHiddenBySite,
  kInformation,
  kInformationInSight,
  kPerceptionEntropy,
  kWidestMasking,
  kMaskedShare,
  kExceedsLimit,
  kAngleSigma,
  kLengthSigma,
  // Only for maps and curves:
  kSeenMap,
  kDetectedMap,
  kProbabilityMap,
  kWorstProbabilityMap,
  kPixelMap,
  kPersonCurve,
  kPixelCurve,
};

/// The kind of object that a measure describes.
enum class Subject {
  kZone,
  kHeight,  ///< horizontal plane at a height above the ground
  kPosture,
  kShovel,
  kElevation,
  kPurpose,  ///< purpose of a camera picture, see PixelDensity
  kAntenna,
  kOccupancy,
  kEntropy,
  kEye,
  kState
};

/// Identifies a figure, map or curve of a layout.
struct FigureId {
  Measure measure = Measure::kSeenBy1;
  std::string of = {};                      ///< name of the subject; empty if there is only one
  std::optional<std::size_t> quarter = {};  ///< index in kQuarters

  bool operator==(const FigureId&) const = default;
};

Subject SubjectOf(Measure measure);
/// Empty for shares.
std::string_view UnitOf(Measure measure);
bool IsMoreBetter(Measure measure);

/// The name in files: "zone/behind/seen_by_1".
std::string NameOf(const FigureId& id);
/// Inverse of NameOf. Empty for an unknown name.
std::optional<FigureId> FigureIdOf(std::string_view name);

}  // namespace tera
