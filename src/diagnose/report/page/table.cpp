#include "diagnose/report/page/table.h"

#include <fmt/format.h>

#include "diagnose/report/page/svg_plot.h"
#include "diagnose/report/text/wording.h"

namespace tera {
namespace {

/// Indices of the parameters that a fit may move, or of all where it moves none.
std::vector<std::size_t> ShownParameters(const Candidate& candidate) {
  std::vector<std::size_t> shown;
  for (const FreeParameter& free : candidate.free) shown.push_back(free.index);
  for (std::size_t i = 0; candidate.free.empty() && i < candidate.mechanism->parameters.size();
       ++i) {
    shown.push_back(i);
  }
  return shown;
}

}  // namespace

Table::Table(const std::vector<std::string>& headings) {
  html_ = "<div class='wide'><table><tr>";
  for (const std::string& heading : headings) {
    const bool is_number = heading.starts_with('>');
    classes_.push_back(is_number ? " class='r'" : "");
    html_ += fmt::format("<th{}>{}</th>", classes_.back(), heading.substr(is_number ? 1 : 0));
  }
  html_ += "</tr>\n";
}

void Table::Row(const std::vector<std::string>& cells) {
  html_ += "<tr>";
  for (std::size_t i = 0; i < cells.size(); ++i) {
    html_ += fmt::format("<td{}>{}</td>", classes_[i], cells[i]);
  }
  html_ += "</tr>\n";
}

std::string Code(std::string_view text) { return "<code>" + Escaped(text) + "</code>"; }

std::string UnitCell(std::string_view unit) { return unit == "1" ? "" : Escaped(unit); }

std::string ParameterTable(const std::vector<const Finding*>& findings) {
  Table table({"Mechanism", "On", "Parameter", ">Value", ">±", "Unit", ">Chosen", ">Confirmed"});
  for (const Finding* finding : findings) {
    const Candidate& candidate = *finding->term.candidate;
    bool is_first = true;
    for (const std::size_t index : ShownParameters(candidate)) {
      const ParameterEstimate& estimate = finding->parameters[index];
      std::string value = WithSigma(estimate.value, estimate.sigma);
      std::string sigma = candidate.free.empty() ? "" : "unknown";
      if (const auto at = value.find(" ± "); at != std::string::npos) {
        sigma = value.substr(at + std::string_view(" ± ").size());
        value.resize(at);
      }
      if (finding->term.IsHeld(index)) sigma = "not determined";
      table.Row({is_first ? Code(candidate.mechanism->id) : "",
                 is_first ? Escaped(candidate.target) : "", Code(estimate.name), value, sigma,
                 UnitCell(estimate.unit),
                 is_first ? Escaped(ProbabilityText(finding->evidence.p)) : "",
                 is_first ? Escaped(ProbabilityText(finding->held_out.p)) : ""});
      is_first = false;
    }
  }
  return "<h3>Parameters</h3>\n" + table.Take();
}

}  // namespace tera
