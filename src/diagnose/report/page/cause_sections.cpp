#include "diagnose/report/page/cause_sections.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "diagnose/report/page/block_figures.h"
#include "diagnose/report/page/svg_plot.h"
#include "diagnose/report/text/cause.h"
#include "diagnose/report/text/cause_answers.h"
#include "diagnose/report/text/clock_text.h"
#include "diagnose/report/text/finding_text.h"
#include "diagnose/report/text/mechanism_words.h"
#include "diagnose/report/text/next_manoeuvre_text.h"
#include "diagnose/report/text/perception_text.h"
#include "diagnose/report/text/plain_sentence.h"
#include "diagnose/report/text/proposal_text.h"
#include "diagnose/report/text/ranking.h"
#include "diagnose/report/text/sentence.h"
#include "diagnose/report/text/sentences.h"
#include "diagnose/report/text/wording.h"

namespace tera {
namespace {

constexpr std::size_t kMostCauses = 12;  ///< with a section of their own

std::string Answer(std::string_view question, const std::string& answer) {
  return fmt::format("<dt>{}</dt><dd>{}</dd>\n", question, Escaped(answer));
}

/// A section of the first screen: a heading, sentences, a picture and answers.
std::string Section(std::string_view css_class, const std::string& heading,
                    const std::string& sentences, const std::string& picture,
                    const std::string& answers) {
  return fmt::format(
      "<section class='cause {}'>\n<h2>{}</h2>\n<p class='plain'>{}</p>\n<div class='told'>\n{}<dl>"
      "{}</dl>\n</div>\n</section>\n",
      css_class, Escaped(heading), Escaped(sentences), picture, answers);
}

std::string PictureOf(const Cause& cause) {
  if (cause.block != nullptr) return SmallPredictionFigure(*cause.block, cause.finding->location);
  if (cause.ErrorUnit().empty()) return "";
  const bool is_distance = cause.seen_by != nullptr && cause.ErrorUnit() == "m";
  const ReadableUnit unit =
      is_distance ? ReadableUnit{100, "cm"} : ReadableUnitOf(cause.ErrorUnit());
  return ErrorBars(cause.Quantity(), cause.finding->held_out, unit);
}

std::string SectionOf(const Cause& cause, std::size_t number, const Diagnosis& diagnosis) {
  std::string else_text = WhatElseText(cause);
  if (cause.mechanism().id == "command_delay") {
    if (const std::string shared = SentenceOfSharedDelay(diagnosis); !shared.empty()) {
      else_text = shared;
    }
  }
  std::string sentences = MeaningText(cause);
  for (const std::string& next : {ClassText(cause), FallText(cause)}) {
    if (!next.empty()) sentences += " " + next;
  }
  return Section(
      "named", fmt::format("{}. {}", number, HeadingOf(cause)), sentences, PictureOf(cause),
      Answer("How sure", HowSureText(cause)) + Answer("What else it could be", else_text) +
          Answer("What to drive to find out", WhatToDriveText(cause, diagnosis)));
}

/// The mechanisms that come nearest to what is left of a channel.
std::string ProxiesText(const DiagnosedBlock& diagnosed, std::size_t channel) {
  std::vector<std::string> near;
  for (const Finding& proxy : diagnosed.diagnosis.proxies) {
    if (proxy.location.channel == channel) near.push_back(MechanismText(diagnosed, proxy));
  }
  return near.empty() ? "No known mechanism comes near."
                      : fmt::format("Nearest comes {}, which is no name for it.", Listed(near));
}

/// Recording to make for an unexplained error.
std::string DriveText(const DiagnosedBlock& diagnosed, const Location& at) {
  if (at.regimes.empty() || at.regimes.front().variable == "time") {
    return "Record more of the driving in which the error is.";
  }
  return fmt::format("Drive so that the {} takes all its values, again and again.",
                     VariableText(at.regimes.front().variable, diagnosed.block));
}

/// Effect in the next simulation for a channel's residual; empty without a proposal.
std::string NextSimulationAnswer(const DiagnosedBlock& diagnosed, std::size_t channel) {
  const Proposal* proposal = ProposalFor(diagnosed, channel);
  if (proposal == nullptr) return "";
  return Answer("What the next simulation has of it", LearnedText(diagnosed.block, *proposal));
}

std::string SectionOf(const UnexplainedInBlock& entry) {
  const auto& [diagnosed, left] = entry;
  const Location& at = left->location;
  const Channel& channel = diagnosed->block.channels[at.channel];
  const ReadableUnit unit = ReadableUnitOf(channel.unit);
  const std::string quantity = QuantityOf(channel.name);
  std::string text = fmt::format(
      "The {} differs from the simulation, and nothing that is known explains it: {} are left, "
      "where noise makes {}.",
      quantity, WithUnit(Significant(left->rmse * unit.factor, 2), unit),
      WithUnit(Significant(left->noise * unit.factor, 2), unit));
  if (!at.regimes.empty()) {
    text +=
        fmt::format(" It depends on {}.", RegimeText(at.regimes.front(), *diagnosed, at.channel));
  }
  const std::string sure = left->p ? fmt::format(
                                         "Sure that it is there: chance alone would do as "
                                         "much in {} cases.",
                                         OddsText(*left->p))
                                   : "Sure that it is there: it is far louder than the noise.";
  return Section("unexplained", Capitalised(quantity) + ": unexplained", text,
                 SmallPredictionFigure(*diagnosed, at),
                 Answer("How sure", sure) +
                     Answer("What else it could be", ProxiesText(*diagnosed, at.channel)) +
                     NextSimulationAnswer(*diagnosed, at.channel) +
                     Answer("What to drive to find out", DriveText(*diagnosed, at)));
}

/// Section on sensors that disagree for no known reason.
std::string SectionOf(const std::vector<const ChannelError*>& left) {
  std::vector<std::string> errors;
  for (const ChannelError* channel : left) {
    const ReadableUnit unit = ReadableUnitOf(channel->unit);
    errors.push_back(fmt::format("{} {} (noise {})", QuantityOf(channel->name),
                                 WithUnit(Significant(channel->rms_after * unit.factor, 2), unit),
                                 WithUnit(Significant(channel->noise * unit.factor, 2), unit)));
  }
  return Section(
      "unexplained", "Sensors that do not agree",
      fmt::format("Error is left that no number of a sensor explains: {}.", Listed(errors)), "",
      "");
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
  for (const std::string& obstacle : diagnosis.not_compared) {
    texts.push_back(fmt::format("Not compared: {}.", obstacle));
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
    html += fmt::format("<p>{} smaller ones stand under \"Every sentence\" below.</p>\n",
                        causes.size() - kMostCauses);
  }
  for (const UnexplainedInBlock& entry : RankedUnexplained(diagnosis)) html += SectionOf(entry);
  const std::vector<const ChannelError*> left = UnexplainedOfSensors(diagnosis);
  if (!left.empty()) html += SectionOf(left);
  return html.empty() ? NothingSection(diagnosis) : html;
}

}  // namespace tera
