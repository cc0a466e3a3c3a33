#include "diagnose/report/page/html_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "diagnose/report/page/block_figures.h"
#include "diagnose/report/page/cause_sections.h"
#include "diagnose/report/page/chain_figure.h"
#include "diagnose/report/page/page_style.h"
#include "diagnose/report/page/perception_figures.h"
#include "diagnose/report/page/svg_plot.h"
#include "diagnose/report/page/table.h"
#include "diagnose/report/text/channel_lines.h"
#include "diagnose/report/text/next_manoeuvre_text.h"
#include "diagnose/report/text/proposal_text.h"
#include "diagnose/report/text/ranking.h"
#include "diagnose/report/text/sentences.h"
#include "diagnose/report/text/summary.h"
#include "diagnose/report/text/wording.h"

namespace tera {
namespace {

constexpr std::size_t kMostRegimesShown = 2;

/// The command's output: the summary and all sentences.
std::string EverySentence(const Diagnosis& diagnosis) {
  std::string html;
  if (const std::string summary = SummaryOf(diagnosis); !summary.empty()) {
    html += fmt::format("<p>{}</p>\n", Escaped(summary));
  }
  html += "<ol class='findings'>\n";
  for (const std::string& sentence : SentencesOf(diagnosis)) {
    html += fmt::format("<li>{}</li>\n", Escaped(sentence));
  }
  return html + "</ol>\n";
}

/// A part of the page that is folded.
std::string Folded(const std::string& title, const std::string& html) {
  if (html.empty()) return "";
  return fmt::format("<details class='part'><summary>{}</summary>\n{}</details>\n", title, html);
}

void AddErrorRow(const DiagnosedBlock& diagnosed, const std::string& what,
                 const HeldOutError& error, Table* table) {
  const Channel& channel = diagnosed.block.channels[error.channel];
  const ReadableUnit unit = ReadableUnitOf(channel.unit);
  table->Row({Escaped(Capitalised(QuantityOf(channel.name))), what,
              Significant(error.rmse_before * unit.factor, 3),
              Significant(error.rmse_after * unit.factor, 3), unit.name,
              PercentText(std::max(error.excess_removed, 0.0)), Escaped(ProbabilityText(error.p))});
}

std::string ErrorTable(const DiagnosedBlock& diagnosed) {
  Table table({"Channel", "With against without", ">RMSE without", ">with", "Unit",
               ">Excess variance removed", ">By chance"});
  for (const HeldOutError& error : diagnosed.diagnosis.confirmed) {
    AddErrorRow(diagnosed, "all that was found", error, &table);
  }
  if (diagnosed.diagnosis.findings.size() > 1) {
    for (const Finding* finding : RankedFindings(diagnosed)) {
      AddErrorRow(diagnosed, Code(finding->term.candidate->mechanism->id) + " alone left out",
                  finding->held_out, &table);
    }
  }
  return "<h3>Errors on manoeuvres that nothing was fitted to</h3>\n" + table.Take();
}

/// The figures of one location under a heading.
std::string LocationFigures(const DiagnosedBlock& diagnosed, const std::string& heading,
                            const std::string& error, const Location& location) {
  std::string html =
      fmt::format("<h3>{}: {} <span class='soft'>{}</span></h3>\n", Escaped(heading),
                  Escaped(QuantityOf(diagnosed.block.channels[location.channel].name)),
                  Code(diagnosed.block.channels[location.channel].name));
  html += PredictionFigure(diagnosed, location) + ResidualFigure(diagnosed, location);
  html += "<div class='pair'>";
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
  if (!diagnosed.diagnosis.findings.empty()) {
    html += ParameterTable(RankedFindings(diagnosed));
  }
  html += ErrorTable(diagnosed);
  return html + "<h3>Evidence</h3>\n" + EvidenceFigure(diagnosed);
}

bool HasAnything(const DiagnosedBlock& diagnosed) {
  return !diagnosed.diagnosis.findings.empty() || !diagnosed.diagnosis.unexplained.empty();
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
  std::string html =
      "<section>\n<h2>Every channel</h2>\n<p class='soft'>RMS over the whole recording; errors of "
      "the simulation as it was, and with all that was found.</p>\n" +
      table.Take();
  for (const std::string& obstacle : diagnosis.not_compared) {
    html += fmt::format("<p>Not compared: {}.</p>\n", Escaped(obstacle));
  }
  return html + "</section>\n";
}

/// The smallest detectable size of a candidate with the name of its number.
std::string SmallestCell(const Detectability& one) {
  const auto& parameters = one.candidate->mechanism->parameters;
  if (parameters.empty()) return "";
  const std::size_t main = one.candidate->free.empty() ? 0 : one.candidate->free.front().index;
  return fmt::format("{} {} {}", Code(parameters[main].name), Significant(*one.smallest, 3),
                     UnitCell(parameters[main].unit));
}

/// The mechanisms of each block that would not have been seen at any size.
std::string UnseenTable(const Diagnosis& diagnosis) {
  Table unseen({"On", "Mechanisms"});
  bool any = false;
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) {
    if (diagnosed.diagnosis.out_of_time) continue;
    std::string names;
    for (const Detectability& one : diagnosed.diagnosis.detectability) {
      if (one.smallest) continue;
      names += (names.empty() ? "" : ", ") + Code(one.candidate->mechanism->id);
    }
    if (!diagnosed.diagnosis.is_testable) names = "all: too few manoeuvres";
    if (names.empty()) continue;
    unseen.Row({Escaped(Capitalised(Spaced(diagnosed.block.name))), names});
    any = true;
  }
  return any ? "<p class='soft'>These would not have been seen at any size looked for, were noise "
               "the only trouble.</p>\n" +
                   unseen.Take()
             : "<p>Every mechanism looked for would have been seen, were it strong enough.</p>\n";
}

std::string SmallestSizes(const Diagnosis& diagnosis) {
  Table seen({"On", "Mechanism", "Seen from about"});
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) {
    for (const Detectability& one : diagnosed.diagnosis.detectability) {
      if (!one.smallest) continue;
      seen.Row(
          {Escaped(one.candidate->target), Code(one.candidate->mechanism->id), SmallestCell(one)});
    }
  }
  return "<details><summary>Smallest sizes that would have been seen</summary>\n" + seen.Take() +
         "</details>\n";
}

std::string OutOfTimeText(const Diagnosis& diagnosis) {
  std::vector<std::string> blocks;
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) {
    if (diagnosed.diagnosis.out_of_time) blocks.push_back(Spaced(diagnosed.block.name));
  }
  if (blocks.empty()) return "";
  return fmt::format("<p>Not looked at, for the time was over: {}.</p>\n", Escaped(Listed(blocks)));
}

std::string UnseenSection(const Diagnosis& diagnosis) {
  const bool any_judged =
      std::any_of(diagnosis.blocks.begin(), diagnosis.blocks.end(),
                  [](const DiagnosedBlock& diagnosed) { return !diagnosed.diagnosis.out_of_time; });
  return OutOfTimeText(diagnosis) +
         (any_judged ? UnseenTable(diagnosis) + SmallestSizes(diagnosis) : "");
}

/// The section of held-out recordings and of the whole simulation.
std::string ConfirmationSection(const Diagnosis& diagnosis) {
  Table table({"Against", "Channel", ">RMSE without", ">with", "Unit"});
  bool any = false;
  const auto row = [&](const std::string& against, const std::string& channel,
                       const std::string& si_unit, double before, double after) {
    const ReadableUnit unit = ReadableUnitOf(si_unit);
    table.Row({against, Escaped(Capitalised(QuantityOf(channel))) + " " + Code(channel),
               Significant(before * unit.factor, 3), Significant(after * unit.factor, 3),
               unit.name});
    any = true;
  };
  for (const HeldOutRecording& further : diagnosis.held_out) {
    for (const HeldOutChannel& one : further.channels) {
      row(Code(further.recording), one.channel, one.unit, one.rmse_before, one.rmse_after);
    }
  }
  if (diagnosis.whole) {
    for (const SimulatedChannel& one : diagnosis.whole->channels) {
      row("the whole simulation", one.channel, one.unit, one.rmse_before, one.rmse_after);
    }
  }
  return any ? table.Take() : "";
}

void AddSetRows(const std::vector<DiscriminatedSet>& sets, Table* table) {
  for (const DiscriminatedSet& set : sets) {
    std::string members;
    for (const std::string& member : set.members) {
      members += (members.empty() ? "" : ", ") + (member == "nothing" ? member : Code(member));
    }
    table->Row({Escaped(set.target), members, Significant(set.power, 2)});
  }
}

std::string NextSection(const Diagnosis& diagnosis) {
  if (!diagnosis.next) return "";
  const NextManoeuvre& next = *diagnosis.next;
  std::string html = fmt::format(
      "<p>{}</p>\n<p class='soft'>Levers in {}, of {:.0f} s, from the scenario's initial position. "
      "Power: how often a recording of it would tell, by "
      "the noise of this one.</p>\n",
      Escaped(next.description), Code(kNextManoeuvreFile), next.duration_s);
  Table resolved({"On", "Discriminated", ">Power"}), open({"On", "Still open", ">Power"});
  AddSetRows(next.discriminated, &resolved);
  AddSetRows(next.not_discriminated, &open);
  html += LeversFigure(next) + resolved.Take();
  if (!next.not_discriminated.empty()) html += open.Take();
  return html;
}

/// All that stands below the first screen and the table of channels.
std::string Details(const Diagnosis& diagnosis) {
  std::string html = "<section>\n<h2>Details</h2>\n";
  html += Folded("Every sentence, with p-values, classes and rivals", EverySentence(diagnosis));
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) {
    if (!HasAnything(diagnosed)) continue;
    html += Folded(
        Escaped(Capitalised(Spaced(diagnosed.block.name))) + ": figures, parameters, evidence",
        BlockSection(diagnosed));
  }
  html += Folded("Further confirmation", ConfirmationSection(diagnosis));
  html += Folded("Lidars and cameras", PerceptionSections(diagnosis));
  if (!diagnosis.blocks.empty()) {
    html += Folded("What this recording cannot show", UnseenSection(diagnosis));
  }
  html += Folded("What to record next", NextSection(diagnosis));
  return html + "</section>\n";
}

}  // namespace

std::string HtmlReport(const Diagnosis& diagnosis, const std::string& recording) {
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang='en'>\n<head>\n<meta charset='utf-8'>\n<meta name='viewport' "
      "content='width=device-width, initial-scale=1'>\n<title>Diagnosis of "
      "{}</title>\n<style>{}</style>\n</head>\n<body><main>\n",
      Escaped(diagnosis.machine), kPageStyle);
  html += fmt::format(
      "<h1>Simulation against recording: {}</h1>\n<p class='soft'>Recording {}; times from its "
      "start.</p>\n<p class='answer'>{}</p>\n",
      Escaped(diagnosis.machine), Code(recording), AnswerText(diagnosis));
  html += FirstThings(diagnosis) + ChainFigure(diagnosis) + CauseSections(diagnosis);
  if (!ChannelLines(diagnosis).empty()) html += ChannelsSection(diagnosis);
  html += Details(diagnosis);
  return html + "</main></body>\n</html>\n";
}

}  // namespace tera
