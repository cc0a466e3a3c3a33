#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace tera {

/// The quantity that a figure, a map or a curve measures of its subject.
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
  // Only maps and curves have these.
  kSeenMap,
  kDetectedMap,
  kProbabilityMap,
  kWorstProbabilityMap,
  kPixelMap,
  kPersonCurve,
  kPixelCurve,
};

/// The kinds of subject that a measure may have.
enum class Subject {
  kZone,
  kHeight,  ///< above the ground
  kPosture,
  kShovel,
  kElevation,
  kPurpose,  ///< of cameras
  kAntenna,
  kOccupancy,
  kEntropy,
  kEye,
  kState
};

/// Identifies a figure, map or curve of a layout.
struct FigureId {
  Measure measure = Measure::kSeenBy1;
  std::string of = {};                      ///< name of the subject; empty of what there is one of
  std::optional<std::size_t> quarter = {};  ///< number in kQuarters

  bool operator==(const FigureId&) const = default;
};

Subject SubjectOf(Measure measure);
/// "" for shares.
std::string_view UnitOf(Measure measure);
bool IsMoreBetter(Measure measure);

/// As files have it: "zone/behind/seen_by_1".
std::string NameOf(const FigureId& id);
/// The inverse; nothing for a name of none.
std::optional<FigureId> FigureIdOf(std::string_view name);

}  // namespace tera
