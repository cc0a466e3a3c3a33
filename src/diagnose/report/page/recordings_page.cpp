#include "diagnose/report/page/recordings_page.h"

#include <fmt/format.h>

#include "diagnose/report/page/page_style.h"
#include "diagnose/report/page/svg_plot.h"
#include "diagnose/report/page/table.h"
#include "diagnose/report/text/shared_cause_text.h"
#include "diagnose/report/text/wording.h"

namespace tera {
namespace {

/// The numbers of a cause over all recordings: "width 0.121 ± 0.003"; what differs has its spread.
std::string TogetherCell(const SharedCause& cause) {
  std::string text;
  for (const SharedNumber& number : cause.numbers) {
    const PooledNumber& pooled = number.pooled;
    const ReadableUnit unit =
        ReadableUnitOf(ParameterEstimate{number.name, number.unit, pooled.value, {}});
    text += fmt::format(
        "{}{} {}", text.empty() ? "" : "<br>", Escaped(WithoutUnit(number.name)),
        Escaped(WithUnit(WithSigma(pooled.value * unit.factor, pooled.sigma * unit.factor), unit)));
    if (number.differs) {
      text += Escaped(fmt::format(" (differs by {}, {})",
                                  WithUnit(Significant(pooled.between * unit.factor, 2), unit),
                                  ProbabilityText(pooled.p)));
    }
  }
  return text;
}

std::string CauseTable(const std::vector<RecordingOnPage>& recordings,
                       const std::vector<SharedCause>& causes) {
  std::vector<std::string> headings{"Cause"};
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    headings.push_back(fmt::format("Recording {}", r + 1));
  }
  headings.push_back("Together");
  Table table(headings);
  for (const SharedCause& cause : causes) {
    std::vector<std::string> cells{Escaped(HeadingOf(cause))};
    for (const CauseInRecording& one : cause.recordings) {
      cells.push_back(Escaped(CellOf(cause, one)));
    }
    cells.push_back(TogetherCell(cause));
    table.Row(cells);
  }
  return table.Take();
}

/// Findings of each recording, tested on the others.
std::string HeldOutTable(const std::vector<RecordingOnPage>& recordings) {
  Table table({"Found in", "Judged on", "Channel", ">RMSE without", ">with", "Unit"});
  bool any = false;
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    for (const HeldOutRecording& further : recordings[r].diagnosis->held_out) {
      for (const HeldOutChannel& one : further.channels) {
        const ReadableUnit unit = ReadableUnitOf(one.unit);
        table.Row({std::to_string(r + 1), Code(further.recording),
                   Escaped(Capitalised(QuantityOf(one.channel))) + " " + Code(one.channel),
                   Significant(one.rmse_before * unit.factor, 3),
                   Significant(one.rmse_after * unit.factor, 3), unit.name});
        any = true;
      }
    }
  }
  if (!any) return "";
  return "<section>\n<h2>Found in one, judged on the others</h2>\n" + table.Take() + "</section>\n";
}

std::string ListOfRecordings(const std::vector<RecordingOnPage>& recordings) {
  std::string html = "<section>\n<h2>Recordings</h2>\n<ol>\n";
  for (const RecordingOnPage& one : recordings) {
    html +=
        fmt::format("<li><a href='{}'>report</a> of {}</li>\n", Escaped(one.page), Code(one.name));
  }
  return html + "</ol>\n</section>\n";
}

}  // namespace

std::string RecordingsPage(const std::string& machine,
                           const std::vector<RecordingOnPage>& recordings,
                           const std::vector<SharedCause>& causes) {
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang='en'>\n<head>\n<meta charset='utf-8'>\n<meta name='viewport' "
      "content='width=device-width, initial-scale=1'>\n<title>Recordings of "
      "{}</title>\n<style>{}</style>\n</head>\n<body><main>\n",
      Escaped(machine), kPageStyle);
  html += fmt::format("<h1>Simulation against recordings: {}</h1>\n<p class='answer'>{}</p>\n",
                      Escaped(machine), Escaped(AnswerText(causes, recordings.size())));
  for (const SharedCause& cause : causes) {
    html += fmt::format("<p class='plain'>{}</p>\n", Escaped(SentenceOf(cause)));
  }
  if (!causes.empty()) {
    html += "<section>\n<h2>Every cause</h2>\n" + CauseTable(recordings, causes) + "</section>\n";
  }
  return html + HeldOutTable(recordings) + ListOfRecordings(recordings) +
         "</main></body>\n</html>\n";
}

}  // namespace tera
