#include "diagnose/report/files/recordings_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "dataset/files/checked_file.h"
#include "diagnose/blocks/measured_poses.h"
#include "diagnose/report/files/effects_yaml.h"
#include "diagnose/report/files/finding_json.h"
#include "diagnose/report/files/write_report.h"
#include "diagnose/report/page/page.h"
#include "diagnose/report/text/cause_text.h"
#include "diagnose/report/text/confirmation_text.h"
#include "diagnose/report/text/words.h"

namespace tera {
namespace {

using Json = OrderedJson;
using Kind = CauseInRecording::Kind;

/// Raised when a key changes its name or meaning.
constexpr int kRecordingsFormat = 1;

/// A recording's evidence on a cause: in recordings.json, and as the end of a sentence.
struct KindWords {
  Kind kind;
  std::string_view name, clause;
};

constexpr KindWords kKinds[] = {
    {Kind::kNamed, "named", ""},
    {Kind::kAsRival, "as_rival", "does as well as what is named there"},
    {Kind::kWithinTolerance, "within_tolerance", "within tolerance"},
    {Kind::kAbsent, "absent", "not there, where one of this size would have shown"},
    {Kind::kUnconfirmed, "unconfirmed", "chosen, and not confirmed on what was kept back"},
    {Kind::kTooFaint, "too_faint", "one of this size would not have shown"},
    {Kind::kNotCompared, "not_compared", "not compared, or hardly moved"}};

const KindWords& WordsFor(Kind kind) {
  return *std::find_if(std::begin(kKinds), std::end(kKinds),
                       [&](const KindWords& words) { return words.kind == kind; });
}

/// Recordings of a kind, counted from 1: "recording 2", "recordings 1 and 3". Empty without any.
std::string RecordingsOf(const SharedCause& cause, Kind kind) {
  std::vector<std::string> numbers;
  for (std::size_t r = 0; r < cause.recordings.size(); ++r) {
    if (cause.recordings[r].kind == kind) numbers.push_back(std::to_string(r + 1));
  }
  if (numbers.empty()) return "";
  return (numbers.size() == 1 ? "recording " : "recordings ") + Listed(numbers);
}

std::string NumberText(const UncertainNumber& number, const ReadableUnit& unit) {
  return WithUnit(WithSigma(number.value * unit.factor, number.sigma * unit.factor), unit);
}

/// Pooled parameters of a cause: ", width 0.121 ± 0.003". If a parameter differs between
/// recordings, its spread and p follow.
std::string PooledText(const SharedCause& cause) {
  std::string text;
  for (const SharedNumber& number : cause.numbers) {
    const PooledNumber& pooled = number.pooled;
    const ReadableUnit unit =
        ReadableUnitOf(ParameterEstimate{number.name, number.unit, pooled.value, {}});
    text += fmt::format("{} {} {}", text.empty() ? "," : " and", WithoutUnit(number.name),
                        NumberText({pooled.value, pooled.sigma}, unit));
    if (!number.differs) continue;
    text += fmt::format(", which differs from one to another by {}, more than its errors ({})",
                        Readable(pooled.between, unit), ProbabilityText(pooled.p));
  }
  return text;
}

/// The recordings, and how the findings of each do on the others.
std::string ListOfRecordings(const std::vector<RecordingOnPage>& recordings) {
  std::string html;
  for (const RecordingOnPage& one : recordings) {
    html += fmt::format("<li><a href='{}'>report</a> of {}", Escaped(one.page), Code(one.name));
    for (const HeldOutRecording& further : one.diagnosis->held_out) {
      html += fmt::format("<p>{}</p>", Escaped(SentenceOf(further)));
    }
    html += "</li>\n";
  }
  return html;
}

Json CauseJson(const SharedCause& cause) {
  Json alike = Json::array(), recordings = Json::array(), numbers = Json::object();
  for (const Candidate* one : cause.rivals) {
    alike.push_back(one->target == cause.target()
                        ? std::string(one->mechanism->id)
                        : one->target + "/" + std::string(one->mechanism->id));
  }
  for (const SharedNumber& one : cause.numbers) {
    numbers[one.name] = {{"value", JsonNumber(one.pooled.value)},
                         {"sigma", JsonNumber(one.pooled.sigma)},
                         {"unit", one.unit},
                         {"between", JsonNumber(one.pooled.between)},
                         {"p_same", JsonNumber(one.pooled.p)},
                         {"differs", one.differs}};
  }
  for (const CauseInRecording& one : cause.recordings) {
    recordings.push_back({{"answer", WordsFor(one.kind).name}});
    if (one.finding != nullptr) recordings.back()["parameters"] = ParametersJson(*one.finding);
  }
  return {{"target", cause.target()},         {"mechanism", cause.mechanism().id},
          {"class", std::move(alike)},        {"shared", cause.IsShared()},
          {"parameters", std::move(numbers)}, {"recordings", std::move(recordings)},
          {"sentence", SentenceOf(cause)}};
}

/// Text of recordings.json: the recordings, and each cause with its result in every recording and
/// its pooled parameters.
std::string RecordingsJson(const std::vector<std::string>& recordings,
                           const std::vector<SharedCause>& causes) {
  Json list = Json::array();
  for (const SharedCause& cause : causes) list.push_back(CauseJson(cause));
  const Json all = {{"format", kRecordingsFormat},
                    {"recordings", recordings},
                    {"answer", AnswerText(causes, recordings.size())},
                    {"causes", std::move(list)}};
  return all.dump(2) + "\n";
}

/// A cause as a finding with pooled parameters. Returns nothing if no recording estimates them.
std::optional<Finding> PooledFinding(const SharedCause& cause) {
  for (const CauseInRecording& one : cause.recordings) {
    if (one.kind != CauseInRecording::Kind::kNamed) continue;
    Finding finding = *one.finding;
    for (const SharedNumber& number : cause.numbers) {
      for (std::size_t i = 0; i < finding.parameters.size(); ++i) {
        if (finding.parameters[i].name != number.name) continue;
        finding.parameters[i].value = finding.term.values[i] = number.pooled.value;
        finding.parameters[i].sigma = number.pooled.sigma;
      }
    }
    finding.evidence.rivals = cause.rivals;
    return finding;
  }
  return std::nullopt;
}

std::string OverlayOf(const std::string& scenario, const std::vector<SharedCause>& causes,
                      std::size_t recordings) {
  std::vector<Finding> pooled;
  for (const SharedCause& cause : causes) {
    std::optional<Finding> finding = PooledFinding(cause);
    if (cause.IsShared() && finding && cause.target() != kPoses) pooled.push_back(*finding);
  }
  std::vector<const Finding*> findings;
  for (const Finding& finding : pooled) findings.push_back(&finding);
  return EffectsYaml(
      scenario, findings,
      fmt::format("What {} recordings share of {} beyond its simulation.", recordings, scenario));
}

void WriteTogether(const std::filesystem::path& directory,
                   const std::vector<DiagnosedRecording>& recordings, std::size_t machine) {
  MakeWritableFolder(directory);
  const std::vector<const Diagnosis*> diagnoses = OfMachine(recordings, machine);
  const std::vector<SharedCause> causes = SharedCausesOf(diagnoses);
  std::vector<std::string> names;
  std::vector<RecordingOnPage> on_page;
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    names.push_back(recordings[r].directory.string());
    on_page.push_back({names.back(), fmt::format("recording_{}/report.html", r + 1), diagnoses[r]});
    WriteReport(directory / fmt::format("recording_{}", r + 1), *diagnoses[r], names.back());
  }
  WriteWholeFile(directory / "recordings.json", RecordingsJson(names, causes));
  WriteWholeFile(directory / "effects.yaml",
                 OverlayOf(diagnoses.front()->scenario, causes, recordings.size()));
  WriteWholeFile(directory / kRecordingsPage,
                 RecordingsPage(diagnoses.front()->scenario, on_page, causes));
}

}  // namespace

std::string SentenceOf(const SharedCause& cause) {
  std::string named = RecordingsOf(cause, Kind::kNamed);
  if (cause.Found() == cause.recordings.size()) {
    named = fmt::format("all {} recordings", cause.recordings.size());
  }
  std::string text = HeadingOf(*cause.candidate, cause.rivals);
  if (!named.empty()) text += fmt::format(" in {}", named);
  text += PooledText(cause) + ".";
  for (const KindWords& words : kKinds) {
    const std::string recordings = RecordingsOf(cause, words.kind);
    if (recordings.empty() || words.clause.empty()) continue;
    text += fmt::format(" {}: {}.", Capitalised(recordings), words.clause);
  }
  return text;
}

std::string AnswerText(const std::vector<SharedCause>& causes, std::size_t recordings) {
  if (causes.empty()) return fmt::format("{} recordings: none of them names a cause.", recordings);
  const auto count = [&](auto&& is_so) {
    return std::count_if(causes.begin(), causes.end(), is_so);
  };
  std::vector<std::string> parts;
  const auto add = [&](auto number, const char* what_one, const char* what_many) {
    if (number == 1) parts.push_back(fmt::format("1 cause that {}", what_one));
    if (number > 1) parts.push_back(fmt::format("{} causes that {}", number, what_many));
  };
  add(count([](const SharedCause& one) { return one.IsShared() && one.Found() > 1; }), "they share",
      "they share");
  add(count([](const SharedCause& one) { return !one.IsShared() || one.Found() == 0; }),
      "differs from one to another", "differ from one to another");
  add(count([](const SharedCause& one) { return one.IsShared() && one.Found() == 1; }),
      "only one of them could show", "only one of them each could show");
  return fmt::format("{} recordings: {}.", recordings, Listed(parts));
}

std::string RecordingsPage(const std::string& machine,
                           const std::vector<RecordingOnPage>& recordings,
                           const std::vector<SharedCause>& causes) {
  std::string html =
      fmt::format("<h1>Simulation against recordings: {}</h1>\n<p class='answer'>{}</p>\n",
                  Escaped(machine), Escaped(AnswerText(causes, recordings.size())));
  for (const SharedCause& cause : causes) {
    html += fmt::format("<p class='plain'>{}</p>\n", Escaped(SentenceOf(cause)));
  }
  return Page("Recordings of " + machine,
              html + fmt::format("<section>\n<h2>Recordings</h2>\n<ol>\n{}</ol>\n</section>\n",
                                 ListOfRecordings(recordings)));
}

std::vector<std::filesystem::path> WriteRecordingsReport(
    const std::filesystem::path& out, const std::vector<DiagnosedRecording>& recordings,
    WholeFolder* whole) {
  std::vector<std::filesystem::path> pages;
  const std::size_t machines = recordings.front().machines.size();
  for (std::size_t m = 0; m < machines; ++m) {
    const std::filesystem::path part = machines == 1 ? "" : recordings.front().machines[m].scenario;
    WriteTogether(whole->temporary() / part, recordings, m);
    pages.push_back(out / part / kRecordingsPage);
  }
  whole->Commit();
  return pages;
}

}  // namespace tera
