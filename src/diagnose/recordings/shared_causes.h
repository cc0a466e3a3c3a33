#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnose/diagnosis.h"
#include "diagnose/statistics/hypothesis_tests/heterogeneity.h"

namespace tera {

/// Result of one of several recordings for a cause.
struct CauseInRecording {
  enum class Kind {
    kNamed,
    kAsRival,          ///< explains as well as the named mechanism
    kWithinTolerance,  ///< acts, with parameters within tolerance
    kUnconfirmed,      ///< selected, but not confirmed
    kAbsent,           ///< not found, though an effect of this size would have been detected
    kTooFaint,         ///< an effect of this size would not have been detected
    kNotCompared,      ///< its target was not compared, or moved too little
  } kind = Kind::kNotCompared;
  const Finding* finding = nullptr;  ///< where the recording estimates it
};

/// A parameter of a cause over the recordings that have it.
struct SharedNumber {
  std::string name, unit;
  PooledNumber pooled;
  bool differs = false;  ///< significantly, over all compared parameters
};

/// A cause that one or several recordings of a machine name.
struct SharedCause {
  /// Mechanism that fits every recording with the cause and that most of these name; from one of
  /// them.
  const Candidate* candidate = nullptr;
  std::vector<const Candidate*> rivals;      ///< mechanisms that fit all of these equally, this one
                                             ///< first
  std::vector<CauseInRecording> recordings;  ///< in the order of the diagnoses
  std::vector<SharedNumber> numbers;

  const Mechanism& mechanism() const { return *candidate->mechanism; }
  const std::string& target() const { return candidate->target; }
  std::size_t CountOf(CauseInRecording::Kind kind) const;
  /// Number of recordings in which it is named, or an equal rival of the named mechanism.
  std::size_t Found() const;
  /// Whether some recording has it, none lacks it and its parameters agree.
  bool IsShared() const;
};

/// Causes across several recordings of one machine, sorted by the number of recordings that name
/// them.
///
/// Model   two recordings name one cause if their sets of equally good mechanisms intersect; the
///         class of the cause is the intersection over all. Parameters are pooled (Pool), and
///         differ with p of at most 0.01 (Holm over all of them). A recording lacks a cause that it
///         does not name, if an effect of the others' size was detectable in it. Sizes are compared
///         on the candidate's ladder of starts.
/// Omits   joint evidence of several recordings: each is diagnosed alone. The form error of the
///         library, five per cent of a parameter, is the same in all recordings. A pooled
///         parameter's deviation is therefore slightly too small, and differences below it are not
///         reported. Causes in the scene of lidars and cameras, which belong to a place and not to
///         a machine.
///
/// The diagnoses, of one machine and at least one, must outlive the result.
std::vector<SharedCause> SharedCausesOf(const std::vector<const Diagnosis*>& diagnoses);

}  // namespace tera
