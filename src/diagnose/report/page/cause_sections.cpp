#include "diagnose/report/page/cause_sections.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "diagnose/diagnosis.h"
#include "diagnose/report/page/figures.h"
#include "diagnose/report/page/svg_plot.h"
#include "diagnose/report/text/cause_text.h"
#include "diagnose/report/text/confirmation_text.h"
#include "diagnose/report/text/mechanism_words.h"
#include "diagnose/report/text/proposal_text.h"
#include "diagnose/report/text/sensor_text.h"
#include "diagnose/report/text/sentence.h"
#include "diagnose/report/text/sentences.h"
#include "diagnose/report/text/wording.h"

namespace tera {
namespace {

constexpr std::size_t kMostCauses = 12;  ///< with a section of their own

std::string Paragraph(std::string_view css_class, const std::string& text) {
  return text.empty() ? "" : fmt::format("<p class='{}'>{}</p>\n", css_class, Escaped(text));
}

/// A section of the first screen: a heading, what it means, a picture, and sentences with the
/// evidence.
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
  std::vector<std::string> sentences = {SentenceOf(cause), WhatToDriveText(cause, diagnosis)};
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

/// Recording to make for an unexplained error.
std::string DriveText(const DiagnosedBlock& diagnosed, const Location& at) {
  if (at.regimes.empty() || at.regimes.front().variable == "time") {
    return "Record more of the driving in which the error is.";
  }
  return fmt::format("Drive so that the {} takes all its values, again and again.",
                     VariableText(at.regimes.front().variable, diagnosed.block));
}

std::string SectionOf(const UnexplainedInBlock& entry) {
  const auto& [diagnosed, left] = entry;
  const Location& at = left->location;
  const Channel& channel = diagnosed->block.channels[at.channel];
  const std::string quantity = QuantityOf(channel.name);
  std::vector<std::string> sentences = {SentenceOf(*diagnosed, *left)};
  if (const Proposal* proposal = ProposalFor(*diagnosed, at.channel)) {
    sentences.push_back(SentenceOf(diagnosed->block, *proposal));
  }
  for (const Finding& proxy : diagnosed->diagnosis.proxies) {
    if (proxy.location.channel == at.channel) {
      sentences.push_back(SentenceOfProxy(*diagnosed, proxy));
    }
  }
  sentences.push_back(DriveText(*diagnosed, at));
  return Section("unexplained", Capitalised(quantity) + ": unexplained",
                 fmt::format("The {} differs from the simulation, and nothing that is known "
                             "explains it: {} are left, where noise makes {}.",
                             quantity, Readable(left->rmse, channel.unit),
                             Readable(left->noise, channel.unit)),
                 PredictionFigure(*diagnosed, at), sentences);
}

/// Section on sensors that disagree for no known reason.
std::string SectionOf(const std::vector<const ChannelError*>& left) {
  std::vector<std::string> errors;
  for (const ChannelError* channel : left) {
    errors.push_back(fmt::format("{} {} (noise {})", QuantityOf(channel->name),
                                 Readable(channel->rms_after, channel->unit),
                                 Readable(channel->noise, channel->unit)));
  }
  return Section(
      "unexplained", "Sensors that do not agree",
      fmt::format("Error is left that no number of a sensor explains: {}.", Listed(errors)), "",
      {});
}

/// Undetectable mechanisms of each block.
std::vector<std::string> UnseenTexts(const Diagnosis& diagnosis) {
  std::vector<std::string> texts;
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) {
    const std::string name = Capitalised(Spaced(diagnosed.block.name));
    if (!diagnosed.diagnosis.is_testable) {
      texts.push_back(fmt::format(
          "{}: anything at all, {}.", name,
          diagnosed.diagnosis.out_of_time ? "for the time was over" : "for it was hardly driven"));
      continue;
    }
    std::vector<std::string> labels;
    for (const Detectability& one : diagnosed.diagnosis.detectability) {
      if (one.smallest) continue;
      labels.emplace_back(WordsOf(one.candidate->mechanism->id, one.candidate->target)->label);
    }
    if (!labels.empty()) texts.push_back(fmt::format("{}: {}.", name, Listed(labels)));
  }
  return texts;
}

std::string NothingSection(const Diagnosis& diagnosis) {
  std::string html = "<section class='cause none'>\n";
  if (!diagnosis.blocks.empty()) {
    html += fmt::format("<p class='plain'>{}</p>\n", Escaped(SentenceOfNothing(diagnosis)));
  }
  for (const std::string& text : PerceptionSentences(diagnosis.perception)) {
    html += fmt::format("<p>{}</p>\n", Escaped(text));
  }
  const std::vector<std::string> unseen = UnseenTexts(diagnosis);
  if (!unseen.empty()) {
    html += "<h3>What could not have been seen</h3>\n<ul>\n";
    for (const std::string& text : unseen) html += fmt::format("<li>{}</li>\n", Escaped(text));
    html += "</ul>\n";
  }
  if (diagnosis.next) {
    html += fmt::format("<p>To see more of it, drive the levers in {}.</p>\n", kNextManoeuvreFile);
  }
  return html + "</section>\n";
}

bool IsAnythingJudged(const Diagnosis& diagnosis) {
  const std::vector<Verdict> verdicts = VerdictsOf(diagnosis);
  return std::any_of(verdicts.begin(), verdicts.end(),
                     [](Verdict verdict) { return verdict != Verdict::kUntestable; });
}

}  // namespace

std::string AnswerText(const Diagnosis& diagnosis) {
  const std::vector<Cause> all = CausesOf(diagnosis);
  const std::size_t causes = all.size();
  const auto open = std::count_if(
      all.begin(), all.end(), [](const Cause& cause) { return !RivalsOf(*cause.finding).empty(); });
  const std::size_t left =
      RankedUnexplained(diagnosis).size() + UnexplainedOfSensors(diagnosis).size();
  std::string text;
  if (causes > 0) text = fmt::format("{} cause{} found.", causes, causes == 1 ? "" : "s");
  if (open > 0) {
    text += causes == 1 ? " This recording leaves several explanations of it."
                        : fmt::format(" Of {} this recording leaves several explanations.", open);
  }
  if (left > 0) {
    text += fmt::format("{}In {} quantit{} error is left that nothing explains.",
                        text.empty() ? "" : " ", left, left == 1 ? "y" : "ies");
  }
  if (!text.empty()) return text;
  if (!diagnosis.missing_input.empty()) return "Input is missing; beyond that nothing was found.";
  return IsAnythingJudged(diagnosis) ? "Nothing is wrong that this recording could show."
                                     : "Nothing could be judged by this recording.";
}

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

}  // namespace tera
