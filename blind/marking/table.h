#pragma once

#include <optional>
#include <string>
#include <vector>

#include "blind/marking/mark.h"

namespace tera::blind {

/// A share of cases and where it may lie: Wilson's interval, 95 %.
struct Share {
  int hits = 0, cases = 0;
  double value() const { return cases > 0 ? static_cast<double>(hits) / cases : 0; }
  double low() const;
  double high() const;
};

/// One line of the table of proof.
struct Row {
  std::string measure, target;
  bool is_share = true;
  Share share;       ///< where it is one
  double value = 0;  ///< else this
  int cases = 0;     ///< that the value is from
  std::string Text() const;
};

/// One method beside others.
struct MethodRow {
  std::string method;
  std::optional<Share> false_alarm, right_first;  ///< of methods that give findings, or names
  std::vector<double> shares;                     ///< of the oracle's improvement, rising
};

/// The tool and every simpler method that answered.
std::vector<MethodRow> MethodsOf(const std::vector<Mark>& marks);
std::string MethodsMarkdown(const std::vector<MethodRow>& rows);

std::vector<Row> TableOf(const std::vector<Mark>& marks);

std::string TableMarkdown(const std::vector<Row>& rows);
/// Rows and all marks.
std::string TableJson(const std::vector<Row>& rows, const std::vector<Mark>& marks,
                      std::uint64_t seed);
/// What was hidden, what was answered.
std::string CaseLine(const Mark& mark);
/// One such line for each case.
std::string CasesMarkdown(const std::vector<Mark>& marks);

}  // namespace tera::blind
