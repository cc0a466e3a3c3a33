#pragma once

#include <string>

#include "dataset/lint/lint.h"

/// A lint as text.

namespace tera {

/// For a terminal: findings worst first, each with its first places and its remedy, then one line
/// that says what was looked at.
std::string LintTable(const LintReport& report);

/// All rules: id, severity, what must hold and the remedy, as a table in Markdown.
std::string LintRulesTable();

/// The whole report: docs/reference/lint.md says what is in it.
std::string LintJson(const LintReport& report);

/// The report for programs that show findings of analysers beside files.
///
/// Source  OASIS, "Static Analysis Results Interchange Format (SARIF) Version 2.1.0".
std::string LintSarif(const LintReport& report);

/// A page of what the dataset holds: channels, classes, ranges, and the findings' table. It needs
/// nothing but itself.
std::string LintStatisticsPage(const LintReport& report);

}  // namespace tera
