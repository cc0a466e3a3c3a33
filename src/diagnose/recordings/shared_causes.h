#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnose/diagnosis.h"
#include "diagnose/statistics/hypothesis_tests/heterogeneity.h"

namespace tera {

/// Result of one recording for a cause that some recording names.
struct CauseInRecording {
  enum class Kind {
    kNamed,
    kAsRival,          ///< it names a rival that fits equally well
    kWithinTolerance,  ///< found, with parameters within tolerance
    kUnconfirmed,      ///< selected, but not confirmed
    kAbsent,           ///< not found, although an effect of this size was detectable
    kTooFaint,         ///< not found; an effect of this size was not detectable
    kNotCompared,      ///< its target was not compared, or moved too little
  } kind = Kind::kNotCompared;
  const Finding* finding = nullptr;  ///< set if the recording estimates the cause
};

/// A parameter of a cause, pooled over the recordings that estimate it.
struct SharedNumber {
  std::string name, unit;
  PooledNumber pooled;
  bool differs = false;  ///< significantly between recordings, corrected for all parameters
};

/// A cause that one or several recordings of a machine name.
struct SharedCause {
  /// Mechanism that most recordings name, among those that fit every recording with the cause.
  /// Points into the diagnosis of one of these recordings.
  const Candidate* candidate = nullptr;
  /// Mechanisms that fit all of these recordings equally; `candidate` comes first.
  std::vector<const Candidate*> rivals;
  /// One result per recording, in the order of the diagnoses.
  std::vector<CauseInRecording> recordings;
  std::vector<SharedNumber> numbers;

  const Mechanism& mechanism() const { return *candidate->mechanism; }
  const std::string& target() const { return candidate->target; }
  std::size_t CountOf(CauseInRecording::Kind kind) const;
  /// Number of recordings that name the cause or an equally good rival.
  std::size_t Found() const;
  /// True if no recording lacks the cause and its parameters agree between recordings.
  bool IsShared() const;
};

/// Causes across several recordings of one machine, sorted by the number of recordings that name
/// them.
///
/// Model   Two recordings name the same cause if their classes (a finding and its rivals)
///         intersect. The class of the cause is the intersection over all recordings. Parameters
///         are pooled (Pool). A parameter differs between recordings at p of at most 0.01, by
///         Holm's method over all parameters. A recording lacks a cause that it does not name if an
///         effect of the size in the other recordings was detectable in it. Sizes are compared on
///         the candidate's starting values, from faint to strong.
/// Omits   Joint evidence of several recordings: each is diagnosed alone. The form error of the
///         library is five per cent of a parameter, and it is the same in all recordings. Therefore
///         the standard deviation of a pooled parameter is slightly too small, and smaller
///         differences are not reported. Causes in the scene of lidars and cameras are left out,
///         because they belong to a place and not to a machine.
///
/// `diagnoses` belong to one machine, are not empty and must outlive the result.
std::vector<SharedCause> SharedCausesOf(const std::vector<const Diagnosis*>& diagnoses);

}  // namespace tera
