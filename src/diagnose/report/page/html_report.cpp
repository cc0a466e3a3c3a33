#include "diagnose/report/page/html_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "diagnose/diagnosis.h"
#include "diagnose/report/page/cause_sections.h"
#include "diagnose/report/page/chain_figure.h"
#include "diagnose/report/page/figures.h"
#include "diagnose/report/page/page.h"
#include "diagnose/report/text/channel_lines.h"
#include "diagnose/report/text/confirmation_text.h"
#include "diagnose/report/text/proposal_text.h"
#include "diagnose/report/text/sentences.h"
#include "diagnose/report/text/wording.h"

namespace tera {
namespace {

constexpr std::size_t kMostRegimesShown = 2;

/// The sentences that the page does not have yet.
std::string OtherSentences(const Diagnosis& diagnosis, const std::string& page) {
  std::string html;
  for (const std::string& sentence : SentencesOf(diagnosis)) {
    const std::string text = Escaped(sentence);
    if (page.find(text) == page.npos) html += fmt::format("<li>{}</li>\n", text);
  }
  return html.empty() ? "" : "<ol class='findings'>\n" + html + "</ol>\n";
}

/// A part of the page that is folded.
std::string Folded(const std::string& title, const std::string& html) {
  if (html.empty()) return "";
  return fmt::format("<details class='part'><summary>{}</summary>\n{}</details>\n", title, html);
}

/// The figures of one location under a heading.
std::string LocationFigures(const DiagnosedBlock& diagnosed, const std::string& heading,
                            const std::string& error, const Location& location) {
  const std::string& channel = diagnosed.block.channels[location.channel].name;
  std::string html = fmt::format(
      "<h3>{}: {} <span class='soft'>{}</span></h3>\n{}<div class='pair'>", Escaped(heading),
      Escaped(QuantityOf(channel)), Code(channel), ResidualFigure(diagnosed, location));
  for (std::size_t r = 0; r < std::min(location.regimes.size(), kMostRegimesShown); ++r) {
    html += RegimeFigure(diagnosed, location, location.regimes[r], error);
  }
  return html + "</div>\n";
}

std::string BlockSection(const DiagnosedBlock& diagnosed) {
  std::string html;
  for (const Finding* finding : RankedFindings(diagnosed)) {
    const std::string name = Spaced(finding->term.candidate->mechanism->id);
    html += LocationFigures(diagnosed, Capitalised(name), "The error without " + name,
                            finding->location);
  }
  for (const Unexplained& unexplained : diagnosed.diagnosis.unexplained) {
    html +=
        LocationFigures(diagnosed, "Unexplained", "The error that is left", unexplained.location);
    const Proposal* proposal = ProposalFor(diagnosed, unexplained.location.channel);
    if (proposal != nullptr && proposal->learned) html += LearnedFigure(diagnosed, *proposal);
  }
  return html;
}

/// A line for every compared channel, and the measurements that were not compared.
std::string ChannelsSection(const Diagnosis& diagnosis) {
  Table table({"Channel", ">Motion", ">Noise", ">Error before", ">after", "Unit", "Explained by",
               "What is left"});
  for (const ChannelLine& line : ChannelLines(diagnosis)) {
    const ReadableUnit unit = ReadableUnitOf(line.unit);
    const auto number = [&](const std::optional<double>& value) {
      return value ? Significant(*value * unit.factor, 3) : "";
    };
    std::string causes;
    for (const std::string& id : line.explained_by) {
      causes += (causes.empty() ? "" : ", ") + Code(id);
    }
    table.Row({Escaped(Capitalised(QuantityOf(line.channel))) + " " + Code(line.channel),
               number(line.motion), number(line.noise), number(line.before), number(line.after),
               unit.name, causes, Escaped(line.left)});
  }
  std::string html = table.Take();
  for (const std::string& obstacle : diagnosis.not_compared) {
    html += fmt::format("<p>Not compared: {}.</p>\n", Escaped(obstacle));
  }
  if (html.empty()) return "";
  return fmt::format(
      "<section>\n<h2>Every channel</h2>\n<p class='soft'>RMS over the whole recording; errors of "
      "the simulation as it was, and with all that was found.</p>\n{}</section>\n",
      html);
}

/// The smallest size of each mechanism that would have been seen.
std::string SmallestSizes(const Diagnosis& diagnosis) {
  Table table({"On", "Mechanism", "Seen from about"});
  const auto add = [&](const Candidate& candidate, std::size_t parameter,
                       const std::optional<double>& smallest) {
    std::string size = "not at any size";
    if (smallest) {
      const EffectParameter& number = candidate.mechanism->parameters[parameter];
      size = fmt::format(
          "{} {}", Code(number.name),
          WithUnit(Significant(*smallest, 3), {1, number.unit == "1" ? "" : Escaped(number.unit)}));
    }
    table.Row({Escaped(candidate.target), Code(candidate.mechanism->id), size});
  };
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) {
    if (!diagnosed.diagnosis.is_testable) {
      table.Row({Escaped(diagnosed.block.name), "all",
                 diagnosed.diagnosis.out_of_time ? "the time was over" : "too few manoeuvres"});
    }
    for (const Detectability& one : diagnosed.diagnosis.detectability) {
      const Candidate& candidate = *one.candidate;
      add(candidate, candidate.free.empty() ? 0 : candidate.free.front().index, one.smallest);
    }
  }
  for (const PerceptionDiagnosis& sensor : diagnosis.perception) {
    for (const ParameterDetectability& one : sensor.detectability) {
      add(*one.candidate, one.parameter, one.smallest);
    }
  }
  return table.Take();
}

/// All that stands below the first screen and the table of channels.
std::string Details(const Diagnosis& diagnosis, const std::string& page) {
  std::string html = "<section>\n<h2>Details</h2>\n";
  html += Folded("Everything else that is to be said", OtherSentences(diagnosis, page));
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) {
    html += Folded(Escaped(Capitalised(Spaced(diagnosed.block.name))) + ": figures",
                   BlockSection(diagnosed));
  }
  for (const PerceptionDiagnosis& sensor : diagnosis.perception) {
    html += Folded(Escaped(Capitalised(Spaced(sensor.target))) + ": ground",
                   GroundFigure(sensor.ground));
  }
  html +=
      Folded("What this recording can show, were noise the only trouble", SmallestSizes(diagnosis));
  if (diagnosis.next) {
    html += Folded("What to record next",
                   fmt::format("<p>{}</p>\n{}", Escaped(SentenceOf(*diagnosis.next)),
                               LeversFigure(*diagnosis.next)));
  }
  return html + "</section>\n";
}

}  // namespace

std::string HtmlReport(const Diagnosis& diagnosis, const std::string& recording) {
  const std::string first =
      fmt::format(
          "<h1>Simulation against recording: {}</h1>\n<p class='soft'>Recording {}; times from its "
          "start.</p>\n<p class='answer'>{}</p>\n",
          Escaped(diagnosis.machine), Code(recording), AnswerText(diagnosis)) +
      FirstThings(diagnosis) + ChainFigure(diagnosis) + CauseSections(diagnosis) +
      ChannelsSection(diagnosis);
  return Page("Diagnosis of " + diagnosis.machine, first + Details(diagnosis, first));
}

}  // namespace tera
