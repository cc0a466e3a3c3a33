#pragma once

#include <string>

#include "dataset/lint/lint.h"

/// Output formats of a lint.

namespace tera {

/// Text for a terminal: findings, worst first, each with its first places and a remedy, followed by
/// a line on the checked data.
std::string LintTable(const LintReport& report);

/// Markdown table of all rules: id, severity, requirement and remedy.
std::string LintRulesTable();

/// The complete report as JSON (docs/reference/lint.md).
std::string LintJson(const LintReport& report);

/// The report in SARIF, for programs that show findings of static analysers.
///
/// Source  OASIS, "Static Analysis Results Interchange Format (SARIF) Version 2.1.0".
std::string LintSarif(const LintReport& report);

/// A self-contained HTML page on the content of the dataset: channels, classes, ranges and
/// findings.
std::string LintStatisticsPage(const LintReport& report);

}  // namespace tera
