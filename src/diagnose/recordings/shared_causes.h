#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnose/diagnosis.h"
#include "diagnose/statistics/tests/heterogeneity.h"

namespace tera {

/// What one of several recordings says of a cause.
struct CauseInRecording {
  enum class Kind {
    kNamed,
    kAsRival,          ///< another mechanism is named that this one does as well as
    kWithinTolerance,  ///< it acts, and its numbers are as expected
    kUnconfirmed,      ///< chosen, and not confirmed
    kAbsent,           ///< not found, though one of this size would have been seen
    kTooFaint,         ///< one of this size would not have been seen
    kNotCompared,      ///< what it acts on was not compared, or moved too little
  } kind = Kind::kNotCompared;
  const Finding* finding = nullptr;  ///< where the recording has its numbers
};

/// A number of a cause over the recordings that hold it.
struct SharedNumber {
  std::string name, unit;
  PooledNumber pooled;
  bool differs = false;  ///< by more than errors, over all numbers that were compared
};

/// A cause that one recording of a machine names, or several.
struct SharedCause {
  /// What fits every recording that has the cause and what most of these name; of one of them.
  const Candidate* candidate = nullptr;
  std::vector<const Candidate*> rivals;      ///< that fit all of these as well; itself first
  std::vector<CauseInRecording> recordings;  ///< in the order of the diagnoses
  std::vector<SharedNumber> numbers;

  const Mechanism& mechanism() const { return *candidate->mechanism; }
  const std::string& target() const { return candidate->target; }
  std::size_t CountOf(CauseInRecording::Kind kind) const;
  /// Named, or as well as what is named, in how many recordings.
  std::size_t Found() const;
  /// Whether some recording has it, none lacks it and its numbers agree.
  bool IsShared() const;
};

/// Causes of several recordings of one machine beside each other, those first that most recordings
/// name.
///
/// Model   two recordings name one cause where the mechanisms that do as well in each have one in
///         common: what remains of a class is what fits them all. Numbers are pooled (Pool) and
///         differ with p of at most 0.01 (Holm over all of them). A recording that does not name a
///         cause lacks it where the candidate's ladder of starts, from faint to strong, would have
///         been seen no later than at the number of the others.
/// Omits   evidence that no recording has by itself: each is diagnosed alone. That five per cent of
///         a number, by which the form of the library is off, are the same in all recordings: a
///         pooled number is known a little less well than it says, and what differs by less than
///         that is not told to differ. Causes in the scene
///         of lidars and cameras, which have a place and not a machine.
///
/// The diagnoses, of one machine and at least one, must outlive the result.
std::vector<SharedCause> SharedCausesOf(const std::vector<const Diagnosis*>& diagnoses);

}  // namespace tera
