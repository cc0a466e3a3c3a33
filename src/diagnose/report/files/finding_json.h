#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "diagnose/diagnosis.h"

namespace tera {

/// JSON whose keys keep the order in which they were written.
using OrderedJson = nlohmann::ordered_json;

/// Six significant digits; null for what is not finite, or not there.
OrderedJson JsonNumber(double value);
OrderedJson JsonNumber(const std::optional<double>& value);

/// Errors before and after, with the share of the variance beyond noise that was removed.
OrderedJson HeldOutJson(double before, double after, const std::string& unit, double removed);

/// The numbers of a finding, by their names.
OrderedJson ParametersJson(const Finding& finding);

/// A finding of a block, and of a sensor that sees: where it is, its mechanism and numbers, rivals,
/// evidence and held-out errors.
OrderedJson FindingJson(const DiagnosedBlock& diagnosed, const Finding& finding);
OrderedJson FindingJson(const PerceptionDiagnosis& sensor, const PerceptionFinding& found);
OrderedJson FindingJson(const SensorFound& found);

/// An error that no mechanism explains, in the form of a finding.
OrderedJson UnexplainedJson(const DiagnosedBlock& diagnosed, const Unexplained& unexplained);

/// A mechanism that was chosen and is no finding.
OrderedJson ChosenJson(const Finding& finding);

}  // namespace tera
