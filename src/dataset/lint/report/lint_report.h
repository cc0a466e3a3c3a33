#pragma once

#include <string>

#include "dataset/lint/lint.h"

/// Text forms of a lint.

namespace tera {

/// For a terminal: findings worst first, each with its first places and its remedy, then one line
/// on the checked data.
std::string LintTable(const LintReport& report);

/// All rules as a Markdown table: id, severity, requirement and remedy.
std::string LintRulesTable();

/// The complete report, described in docs/reference/lint.md.
std::string LintJson(const LintReport& report);

/// The report for programs that show analysers' findings in files.
///
/// Source  OASIS, "Static Analysis Results Interchange Format (SARIF) Version 2.1.0".
std::string LintSarif(const LintReport& report);

/// A self-contained page of the dataset's contents: channels, classes, ranges, and the table of
/// findings.
std::string LintStatisticsPage(const LintReport& report);

}  // namespace tera
