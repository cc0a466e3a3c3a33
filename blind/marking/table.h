#pragma once

#include <optional>
#include <string>
#include <vector>

#include "blind/marking/mark.h"

namespace tera::blind {

/// A share of cases with Wilson's 95 % interval.
struct Share {
  int hits = 0, cases = 0;
  double value() const { return cases > 0 ? static_cast<double>(hits) / cases : 0; }
  double low() const;
  double high() const;
};

/// One line of the table of results.
struct Row {
  std::string measure, target;
  bool is_share = true;
  Share share;       ///< used if is_share
  double value = 0;  ///< used otherwise
  int cases = 0;     ///< number of cases behind the value
  std::string Text() const;
};

/// One method in the comparison.
struct MethodRow {
  std::string method;
  std::optional<Share> false_alarm, right_first;  ///< for methods that give findings, or names
  std::vector<double> shares;                     ///< shares of the oracle's improvement, ascending
};

/// The tool and every baseline method with an answer.
std::vector<MethodRow> MethodsOf(const std::vector<Mark>& marks);
std::string MethodsMarkdown(const std::vector<MethodRow>& rows);

std::vector<Row> TableOf(const std::vector<Mark>& marks);

std::string TableMarkdown(const std::vector<Row>& rows);
/// Rows and all marks.
std::string TableJson(const std::vector<Row>& rows, const std::vector<Mark>& marks,
                      std::uint64_t seed);
/// One line on a case: hidden effects and answer.
std::string CaseLine(const Mark& mark);
/// CaseLine of every case.
std::string CasesMarkdown(const std::vector<Mark>& marks);

}  // namespace tera::blind
