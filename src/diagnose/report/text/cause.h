#pragma once

#include <string>
#include <vector>

#include "diagnose/diagnosis.h"

namespace tera {

/// A finding, with where it was made: one of `block`, `sensor` and `seen_by` is set.
struct Cause {
  const Finding* finding = nullptr;
  const DiagnosedBlock* block = nullptr;
  const SensorFound* sensor = nullptr;
  const PerceptionDiagnosis* seen_by = nullptr;
  const PerceptionFinding* seen = nullptr;  ///< together with `seen_by`

  const Mechanism& mechanism() const { return *finding->term.candidate->mechanism; }
  const std::string& target() const { return finding->term.candidate->target; }
  /// SI unit of the errors before and after; "px" of pictures, empty where they are not known.
  std::string ErrorUnit() const;
  /// "boom rate": the quantity whose error falls; empty where it is not known.
  std::string Quantity() const;
  /// How many times as large the error is without it.
  double ErrorRatio() const;
};

/// The causes that a diagnosis names, those first without which the error grows most, as a ratio.
/// The diagnosis must outlive the result.
std::vector<Cause> CausesOf(const Diagnosis& diagnosis);

/// The channels of sensors beside each other in which error is left that no number of a sensor
/// explains, and which no block was judged by after that.
std::vector<const ChannelError*> UnexplainedOfSensors(const Diagnosis& diagnosis);

/// The other candidates that do as well as what was found.
std::vector<const Candidate*> RivalsOf(const Finding& finding);

}  // namespace tera
