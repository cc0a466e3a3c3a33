#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "diagnose/diagnosis.h"

namespace tera {

using OrderedJson = nlohmann::ordered_json;

/// Six significant digits; null for missing values or values that are not finite.
OrderedJson JsonNumber(double value);
OrderedJson JsonNumber(const std::optional<double>& value);

/// Errors before and after, and the removed share of the excess variance.
OrderedJson HeldOutJson(double before, double after, const std::string& unit, double removed);

OrderedJson ParametersJson(const Finding& finding);

/// A finding: location, mechanism, parameters, rivals, evidence and held-out errors.
OrderedJson FindingJson(const Cause& cause);

/// An unexplained error, in the form of a finding.
OrderedJson UnexplainedJson(const DiagnosedBlock& diagnosed, const Unexplained& unexplained);

/// A mechanism that was selected but is no finding.
OrderedJson ChosenJson(const Finding& finding);

}  // namespace tera
