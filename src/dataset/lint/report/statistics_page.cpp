#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "core/html.h"
#include "dataset/lint/report/lint_report.h"

namespace tera {
namespace {

constexpr std::string_view kStyle = R"(<style>
:root{color-scheme:light dark}
body{font-family:system-ui,"DejaVu Sans",sans-serif;line-height:1.5;max-width:64rem;margin:2rem auto;padding:0 1rem}
table{border-collapse:collapse;font-variant-numeric:tabular-nums}
th,td{padding:.2rem .8rem;border-bottom:1px solid #8884;text-align:right}
th:first-child,td:first-child{text-align:left}
.bar{display:inline-block;height:.7em;background:#1769aa}
</style>)";

/// An HTML table. Cells are escaped.
class HtmlTable {
 public:
  explicit HtmlTable(const std::vector<std::string>& head) : html_("<table>\n") {
    AddRow(head, "th");
  }
  void Add(const std::vector<std::string>& cells) { AddRow(cells, "td"); }
  std::string Html() const { return html_ + "</table>\n"; }

 private:
  void AddRow(const std::vector<std::string>& cells, const char* tag) {
    html_ += "<tr>";
    for (const std::string& cell : cells) html_ += fmt::format("<{0}>{1}</{0}>", tag, cell);
    html_ += "</tr>\n";
  }
  std::string html_;
};

std::string Channels(const DatasetStatistics& statistics) {
  HtmlTable table({"channel", "type", "rows", "first, s", "last, s", "rate, Hz", "longest gap, s"});
  for (const auto& [path, c] : statistics.channels) {
    const double rate_hz = c.median_interval_ns > 0 ? 1 / ToSeconds(c.median_interval_ns) : 0;
    table.Add({Escaped(path), Escaped(c.type), std::to_string(c.rows),
               fmt::format("{:.3f}", ToSeconds(c.first_ns)),
               fmt::format("{:.3f}", ToSeconds(c.last_ns)), fmt::format("{:.4g}", rate_hz),
               fmt::format("{:.4g}", ToSeconds(c.longest_interval_ns))});
  }
  return table.Html();
}

std::string Bar(double share) {
  constexpr double kWidth_em = 16;
  return fmt::format("<span class=\"bar\" style=\"width:{:.2f}em\"></span>", kWidth_em * share);
}

std::string Classes(const DatasetStatistics& statistics) {
  std::int64_t pixels = 0;
  for (const auto& [name, c] : statistics.classes) pixels += c.pixels;
  HtmlTable table({"class", "pixels", "share", "boxes", "points of scans"});
  for (const auto& [name, c] : statistics.classes) {
    const double share =
        pixels > 0 ? static_cast<double>(c.pixels) / static_cast<double>(pixels) : 0;
    table.Add({Escaped(name), std::to_string(c.pixels), fmt::format("{:.2f} %", 100 * share),
               std::to_string(c.boxes), std::to_string(c.points)});
  }
  return table.Html();
}

std::string Ranges(const RangeHistogram& histogram) {
  const std::int64_t most = *std::max_element(histogram.begin(), histogram.end());
  HtmlTable table({"metres", "count", ""});
  for (std::size_t m = 0; m < histogram.size(); ++m) {
    if (histogram[m] == 0) continue;
    table.Add({m + 1 == histogram.size() ? fmt::format("{} and more", m)
                                         : fmt::format("{} to {}", m, m + 1),
               std::to_string(histogram[m]),
               Bar(static_cast<double>(histogram[m]) / static_cast<double>(most))});
  }
  return table.Html();
}

bool HasAny(const RangeHistogram& histogram) {
  return std::any_of(histogram.begin(), histogram.end(), [](std::int64_t n) { return n > 0; });
}

}  // namespace

std::string LintStatisticsPage(const LintReport& report) {
  const DatasetStatistics& statistics = report.statistics;
  std::string html = "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n";
  const auto out = std::back_inserter(html);
  fmt::format_to(out, "<title>{0}</title>\n{1}</head><body>\n<h1>{0}</h1>\n", Escaped(report.name),
                 kStyle);
  const auto section = [&](const char* title, const std::string& body) {
    fmt::format_to(out, "<h2>{}</h2>\n{}", title, body);
  };
  section("Findings", "<pre>" + Escaped(LintTable(report)) + "</pre>\n");
  section("Channels", Channels(statistics));
  if (!statistics.classes.empty()) section("Classes", Classes(statistics));
  if (HasAny(statistics.depth_m)) section("Depth of pixels", Ranges(statistics.depth_m));
  if (HasAny(statistics.range_m)) section("Ranges of scans", Ranges(statistics.range_m));
  return html + "</body></html>\n";
}

}  // namespace tera
