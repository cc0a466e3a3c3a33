#include <fmt/format.h>

#include <iterator>

#include "dataset/lint/report/lint_report.h"

namespace tera {
namespace {

std::string PlaceText(const LintPlace& place) {
  return place.line > 0 ? fmt::format("{}:{}", place.file, place.line) : place.file;
}

void AppendFinding(const LintFinding& finding, std::string* text) {
  const auto out = std::back_inserter(*text);
  const LintRule& rule = *finding.rule;
  fmt::format_to(out, "{} {}{}{}: {}\n", NameOf(rule.severity), rule.id,
                 finding.channel.empty() ? "" : " in ", finding.channel, rule.text);
  for (const LintPlace& place : finding.places) {
    fmt::format_to(out, "    {}: {}\n", PlaceText(place), place.message);
  }
  const auto shown = static_cast<std::int64_t>(finding.places.size());
  if (finding.count > shown) fmt::format_to(out, "    and {} more\n", finding.count - shown);
  fmt::format_to(out, "    {}\n", rule.remedy);
}

std::string Counted(std::int64_t count, const char* one) {
  return fmt::format("{} {}{}", count, one, count == 1 ? "" : "s");
}

/// Text such as "3 channels, 120 rows, 6 pictures".
std::string LookedAt(const DatasetStatistics& statistics) {
  std::int64_t rows = 0;
  for (const auto& [path, channel] : statistics.channels) rows += channel.rows;
  std::string text = fmt::format(
      "{}, {}", Counted(static_cast<std::int64_t>(statistics.channels.size()), "channel"),
      Counted(rows, "row"));
  if (statistics.pictures > 0) text += ", " + Counted(statistics.pictures, "picture");
  if (statistics.boxes > 0) {
    text += fmt::format(", {} box{}", statistics.boxes, statistics.boxes == 1 ? "" : "es");
  }
  if (statistics.scans > 0) text += ", " + Counted(statistics.scans, "scan");
  return text;
}

}  // namespace

std::string LintTable(const LintReport& report) {
  std::string text;
  for (const LintFinding& finding : report.findings) AppendFinding(finding, &text);
  const std::string found =
      report.findings.empty()
          ? "clean"
          : fmt::format("{}, {}, {}", Counted(report.CountOf(Severity::kError), "error"),
                        Counted(report.CountOf(Severity::kWarning), "warning"),
                        Counted(report.CountOf(Severity::kNote), "note"));
  fmt::format_to(std::back_inserter(text), "{}: {}; {} of {} rules apply; looked at {}\n",
                 report.dataset.string(), found, report.applied.size(), kLintRules.size(),
                 LookedAt(report.statistics));
  return text;
}

std::string LintRulesTable() {
  std::string text = "| rule | severity | requirement | remedy |\n| --- | --- | --- | --- |\n";
  for (const LintRule& rule : kLintRules) {
    fmt::format_to(std::back_inserter(text), "| `{}` | {} | {} | {} |\n", rule.id,
                   NameOf(rule.severity), rule.text, rule.remedy);
  }
  return text;
}

}  // namespace tera
