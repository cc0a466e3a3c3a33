#include "layout/measures/figure_id.h"

#include <array>

#include "core/check.h"
#include "layout/measures/quarter.h"

namespace tera {
namespace {

/// Name of a measure in files. `*` stands for the subject, `@` for the quarter.
struct MeasureEntry {
  Measure measure;
  Subject subject;
  std::string_view name, unit;
  bool more_is_better;
};

// A name that is a prefix of another comes after it.
constexpr std::array<MeasureEntry, 35> kMeasures = {
    {{Measure::kSeenBy1, Subject::kZone, "zone/*/seen_by_1", "", true},
     {Measure::kSeenBy2, Subject::kZone, "zone/*/seen_by_2", "", true},
     {Measure::kSeenBy3, Subject::kZone, "zone/*/seen_by_3", "", true},
     {Measure::kBlindVolume, Subject::kZone, "zone/*/blind_m3", "m^3", false},
     {Measure::kBlindAreaNear, Subject::kHeight, "map/* m/blind_m2_to_12m", "m^2", false},
     {Measure::kBlindAreaFar, Subject::kHeight, "map/* m/blind_m2_to_24m", "m^2", false},
     {Measure::kDetectedFrom, Subject::kPosture, "person/*/detected_from_m_@", "m", false},
     {Measure::kDetectedTo, Subject::kPosture, "person/*/detected_to_m_@", "m", true},
     {Measure::kDetectedOver, Subject::kPosture, "person/*/detected_over_m_@", "m", true},
     {Measure::kDetectedShare, Subject::kPosture, "person/*/detected_within_12m", "", true},
     {Measure::kProbability, Subject::kPosture, "person/*/probability_within_12m", "", true},
     {Measure::kProbabilityOfQuarter, Subject::kPosture, "person/*/probability_within_12m_@", "",
      true},
     {Measure::kEdgeSeen, Subject::kShovel, "dig/*/edge_seen", "", true},
     {Measure::kLoadSeen, Subject::kShovel, "dig/*/load_seen", "", true},
     {Measure::kElevationGaps, Subject::kElevation, "elevation/gaps", "", false},
     {Measure::kElevationSigma, Subject::kElevation, "elevation/sigma_m", "m", false},
     {Measure::kPixelShare, Subject::kPurpose, "pixels/*/share_to_12m", "", true},
     {Measure::kPixelReach, Subject::kPurpose, "pixels/*/mean_to_m_@", "m", true},
     {Measure::kSkyHidden, Subject::kAntenna, "sky/*/hidden", "", false},
     {Measure::kSkyHiddenBySite, Subject::kAntenna, "sky/*/hidden_by_site", "", false},
     {Measure::kInformation, Subject::kOccupancy, "information/smig", "nat", true},
     {Measure::kInformationInSight, Subject::kOccupancy, "information/smig_occluded", "nat", true},
     {Measure::kPerceptionEntropy, Subject::kEntropy, "information/perception_entropy", "nat",
      false},
     {Measure::kWidestMasking, Subject::kEye, "eye/*/widest_masking_m", "m", false},
     {Measure::kMaskedShare, Subject::kEye, "eye/*/masked_share", "", false},
     {Measure::kExceedsLimit, Subject::kEye, "eye/*/exceeds_limit", "", false},
     {Measure::kAngleSigma, Subject::kState, "state/*/sigma_deg", "deg", false},
     {Measure::kLengthSigma, Subject::kState, "state/*/sigma_m", "m", false},
     {Measure::kSeenMap, Subject::kHeight, "seen/* m", "", true},
     {Measure::kDetectedMap, Subject::kPosture, "detected/*", "", true},
     {Measure::kProbabilityMap, Subject::kPosture, "person/*/probability", "", true},
     {Measure::kWorstProbabilityMap, Subject::kPosture, "person/*/probability_worst", "", true},
     {Measure::kPixelMap, Subject::kHeight, "pixels/* m", "px/m", true},
     {Measure::kPersonCurve, Subject::kPosture, "person/*", "m", true},
     {Measure::kPixelCurve, Subject::kPurpose, "pixels/*", "m", true}}};

const MeasureEntry& EntryOf(Measure measure) {
  const MeasureEntry& entry = kMeasures[static_cast<std::size_t>(measure)];
  TERA_CHECK(entry.measure == measure, static_cast<int>(measure));
  return entry;
}

/// The name with the quarter inserted.
std::string WithQuarter(std::string_view name, std::optional<std::size_t> quarter) {
  std::string filled(name);
  const std::size_t at = filled.find('@');
  TERA_CHECK((at != filled.npos) == quarter.has_value(), name);
  return quarter ? filled.replace(at, 1, kQuarters[*quarter].name) : filled;
}

/// The subject in `name`: the text at the `*` of `pattern`, empty if the pattern has no `*`.
/// Nothing if the name does not match.
std::optional<std::string> SubjectIn(std::string_view name, std::string_view pattern) {
  const std::size_t star = pattern.find('*');
  if (star == pattern.npos) return name == pattern ? std::optional<std::string>("") : std::nullopt;
  const std::string_view before = pattern.substr(0, star), after = pattern.substr(star + 1);
  if (name.size() <= before.size() + after.size() || !name.starts_with(before) ||
      !name.ends_with(after)) {
    return std::nullopt;
  }
  name.remove_prefix(before.size());
  name.remove_suffix(after.size());
  return std::string(name);
}

}  // namespace

Subject SubjectOf(Measure measure) { return EntryOf(measure).subject; }
std::string_view UnitOf(Measure measure) { return EntryOf(measure).unit; }
bool IsMoreBetter(Measure measure) { return EntryOf(measure).more_is_better; }

std::string NameOf(const FigureId& id) {
  std::string name = WithQuarter(EntryOf(id.measure).name, id.quarter);
  const std::size_t star = name.find('*');
  return star == name.npos ? name : name.replace(star, 1, id.of);
}

std::optional<FigureId> FigureIdOf(std::string_view name) {
  for (const MeasureEntry& entry : kMeasures) {
    const bool has_quarter = entry.name.find('@') != entry.name.npos;
    for (std::size_t q = 0; q < (has_quarter ? kQuarters.size() : 1); ++q) {
      const auto quarter = has_quarter ? std::optional(q) : std::nullopt;
      if (const auto of = SubjectIn(name, WithQuarter(entry.name, quarter))) {
        return FigureId{entry.measure, *of, quarter};
      }
    }
  }
  return std::nullopt;
}

}  // namespace tera
