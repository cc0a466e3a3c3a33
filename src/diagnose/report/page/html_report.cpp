#include "diagnose/report/page/html_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <vector>

#include "diagnose/diagnosis.h"
#include "diagnose/report/page/chain_figure.h"
#include "diagnose/report/page/figures.h"
#include "diagnose/report/page/page.h"
#include "diagnose/report/page/svg_plot.h"
#include "diagnose/report/text/cause_text.h"
#include "diagnose/report/text/channel_lines.h"
#include "diagnose/report/text/confirmation_text.h"
#include "diagnose/report/text/sensor_text.h"
#include "diagnose/report/text/sentence.h"
#include "diagnose/report/text/sentences.h"
#include "diagnose/report/text/words.h"

namespace tera {
namespace {

constexpr std::size_t kMostCauses = 12;  ///< number of causes with their own section

std::string Paragraph(std::string_view css_class, const std::string& text) {
  return text.empty() ? "" : fmt::format("<p class='{}'>{}</p>\n", css_class, Escaped(text));
}

/// A section of the first screen: heading, meaning, picture, and sentences with the evidence.
std::string Section(std::string_view css_class, const std::string& heading,
                    const std::string& meaning, const std::string& picture,
                    const std::vector<std::string>& sentences) {
  std::string html;
  for (const std::string& sentence : sentences) html += Paragraph("soft", sentence);
  return fmt::format(
      "<section class='cause {}'>\n<h2>{}</h2>\n{}<div class='told'>\n{}<div>{}</div>\n</div>\n"
      "</section>\n",
      css_class, Escaped(heading), Paragraph("plain", meaning), picture, html);
}

std::string SectionOf(const Cause& cause, std::size_t number, const Diagnosis& diagnosis) {
  const std::string meaning = MeaningText(cause);
  std::vector<std::string> sentences = {SentenceOf(cause)};
  if (cause.mechanism().id == "command_delay") {
    sentences.push_back(SentenceOfSharedDelay(diagnosis));
  }
  return Section(
      "named",
      fmt::format("{}. {}", number,
                  HeadingOf(*cause.finding->term.candidate, cause.finding->evidence.rivals)),
      meaning + (meaning.empty() ? "" : " ") + HowSureText(cause),
      cause.block != nullptr ? PredictionFigure(*cause.block, cause.finding->location) : "",
      sentences);
}

std::string SectionOf(const UnexplainedInBlock& entry) {
  const auto& [diagnosed, left] = entry;
  const Location& at = left->location;
  const Channel& channel = diagnosed->block.channels[at.channel];
  std::vector<std::string> sentences = {SentenceOf(*diagnosed, *left)};
  if (const Learned* learned = LearnedOf(*diagnosed, at.channel)) {
    sentences.push_back(SentenceOf(diagnosed->block, *learned));
  }
  for (const Finding& proxy : diagnosed->diagnosis.proxies) {
    if (proxy.location.channel == at.channel) {
      sentences.push_back(SentenceOfProxy(*diagnosed, proxy));
    }
  }
  return Section("unexplained", Capitalised(QuantityOf(channel.name)) + ": unexplained", "",
                 PredictionFigure(*diagnosed, at), sentences);
}

/// Section on sensors that disagree for an unknown reason.
std::string SectionOf(const std::vector<const ChannelError*>& left) {
  return Section("unexplained", "Sensors that do not agree", SentenceOfUnexplained(left), "", {});
}

/// The answer where no cause is named and no error is left.
std::string NothingSection(const Diagnosis& diagnosis) {
  std::string html;
  if (!diagnosis.blocks.empty() || diagnosis.perception.empty()) {
    html += Paragraph("answer", SentenceOfNothing(diagnosis));
  }
  for (const std::string& text : PerceptionSentences(diagnosis.perception)) {
    html += Paragraph("answer", text);
  }
  return html;
}

/// Problems to solve first: missing input, clocks that differ.
std::string FirstThings(const Diagnosis& diagnosis) {
  std::string html;
  for (const MissingInput& missing : diagnosis.missing_input) {
    html += fmt::format("<p class='first'><b class='sign open'>?</b> {}</p>\n",
                        Escaped(SentenceOf(missing)));
  }
  if (const std::string text = SentenceOfEncoderLead(diagnosis); !text.empty()) {
    html += fmt::format("<p class='first'><b class='sign wrong'>!</b> {}</p>\n", Escaped(text));
  }
  return html;
}

/// A section for each cause, by descending size, and for each unexplained error.
std::string CauseSections(const Diagnosis& diagnosis) {
  std::string html;
  const std::vector<Cause> causes = CausesOf(diagnosis);
  for (std::size_t c = 0; c < std::min(causes.size(), kMostCauses); ++c) {
    html += SectionOf(causes[c], c + 1, diagnosis);
  }
  if (causes.size() > kMostCauses) {
    html += fmt::format("<p>{} smaller ones stand under \"Everything else\" below.</p>\n",
                        causes.size() - kMostCauses);
  }
  for (const UnexplainedInBlock& entry : RankedUnexplained(diagnosis)) html += SectionOf(entry);
  const std::vector<const ChannelError*> left = UnexplainedOfSensors(diagnosis);
  if (!left.empty()) html += SectionOf(left);
  return html.empty() ? NothingSection(diagnosis) : html;
}

constexpr std::size_t kMostRegimesShown = 2;

/// Sentences that `page` does not contain.
std::string OtherSentences(const Diagnosis& diagnosis, const std::string& page) {
  std::string html;
  for (const std::string& sentence : SentencesOf(diagnosis)) {
    const std::string text = Escaped(sentence);
    if (page.find(text) == page.npos) html += fmt::format("<li>{}</li>\n", text);
  }
  return html.empty() ? "" : "<ol class='findings'>\n" + html + "</ol>\n";
}

/// A collapsible part of the page.
std::string Folded(const std::string& title, const std::string& html) {
  if (html.empty()) return "";
  return fmt::format("<details class='part'><summary>{}</summary>\n{}</details>\n", title, html);
}

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
  }
  return html;
}

/// Table of all compared channels, and list of measurements that were not compared.
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

/// Table of the smallest detectable size of each mechanism.
std::string SmallestSizes(const Diagnosis& diagnosis) {
  Table table({"On", "Mechanism", "Seen from about"});
  const auto add = [&](const Candidate& candidate, std::size_t parameter,
                       const std::optional<double>& smallest) {
    const auto& numbers = candidate.mechanism->parameters;
    std::string size = smallest ? "yes" : "not at any size";
    if (smallest && !numbers.empty()) {
      const EffectParameter& number = numbers[parameter];
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

/// The levers that would answer what is open.
std::string NextSection(const Diagnosis& diagnosis) {
  if (!diagnosis.next) return "";
  return "<section>\n<h2>What to record next</h2>\n" +
         Paragraph("soft", SentenceOf(*diagnosis.next)) + LeversFigure(*diagnosis.next) +
         "</section>\n";
}

/// All that stands below the first screen and the table of channels.
std::string Details(const Diagnosis& diagnosis, const std::string& page) {
  std::string html;
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
  return "<section>\n<h2>Details</h2>\n" +
         Folded("Everything else that is to be said", OtherSentences(diagnosis, page + html)) +
         html + "</section>\n";
}

}  // namespace

std::string HtmlReport(const Diagnosis& diagnosis, const std::string& recording) {
  const std::string first =
      fmt::format(
          "<h1>Simulation against recording: {}</h1>\n<p class='soft'>Recording {}; times from its "
          "start.</p>\n",
          Escaped(diagnosis.machine), Code(recording)) +
      Paragraph("answer", SummaryOf(diagnosis)) + FirstThings(diagnosis) + ChainFigure(diagnosis) +
      CauseSections(diagnosis) + NextSection(diagnosis) + ChannelsSection(diagnosis);
  return Page("Diagnosis of " + diagnosis.machine, first + Details(diagnosis, first));
}

}  // namespace tera
