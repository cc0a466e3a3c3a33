#pragma once

#include <string>
#include <vector>

#include "diagnose/diagnosis.h"

namespace tera {

/// A finding with its origin: one of `block`, `sensor` and `seen_by` is set.
struct Cause {
  const Finding* finding = nullptr;
  const DiagnosedBlock* block = nullptr;
  const SensorFound* sensor = nullptr;
  const PerceptionDiagnosis* seen_by = nullptr;
  const PerceptionFinding* seen = nullptr;  ///< together with `seen_by`

  const Mechanism& mechanism() const { return *finding->term.candidate->mechanism; }
  const std::string& target() const { return finding->term.candidate->target; }
  /// SI unit of the errors before and after; "px" for pictures; empty if unknown.
  std::string ErrorUnit() const;
  /// "boom rate": the quantity whose error falls; empty if unknown.
  std::string Quantity() const;
  /// Ratio of the error without the cause to that with it.
  double ErrorRatio() const;
};

/// Causes that a diagnosis names, sorted by descending ErrorRatio. The diagnosis must outlive the
/// result.
std::vector<Cause> CausesOf(const Diagnosis& diagnosis);

/// Channels of compared sensors with a residual that no sensor parameter explains, and that no
/// block was judged by later.
std::vector<const ChannelError*> UnexplainedOfSensors(const Diagnosis& diagnosis);

/// Other candidates that explain as well as the finding.
std::vector<const Candidate*> RivalsOf(const Finding& finding);

}  // namespace tera
