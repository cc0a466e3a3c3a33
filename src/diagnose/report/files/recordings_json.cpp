#include "diagnose/report/files/recordings_json.h"

#include "diagnose/report/files/finding_json.h"
#include "diagnose/report/text/shared_cause_text.h"

namespace tera {
namespace {

using Json = OrderedJson;
using Kind = CauseInRecording::Kind;

/// Raised when a key changes its name or meaning.
constexpr int kRecordingsFormat = 1;

std::string_view NameOf(Kind kind) {
  switch (kind) {
    case Kind::kNamed:
      return "named";
    case Kind::kAsRival:
      return "as_rival";
    case Kind::kWithinTolerance:
      return "within_tolerance";
    case Kind::kUnconfirmed:
      return "unconfirmed";
    case Kind::kAbsent:
      return "absent";
    case Kind::kTooFaint:
      return "too_faint";
    case Kind::kNotCompared:
      return "not_compared";
  }
  return "";
}

Json RecordingsOf(const SharedCause& cause) {
  Json list = Json::array();
  for (const CauseInRecording& one : cause.recordings) {
    list.push_back({{"answer", NameOf(one.kind)}});
    if (one.finding != nullptr) list.back()["parameters"] = ParametersJson(*one.finding);
  }
  return list;
}

Json NumbersOf(const SharedCause& cause) {
  Json numbers = Json::object();
  for (const SharedNumber& one : cause.numbers) {
    numbers[one.name] = {{"value", JsonNumber(one.pooled.value)},
                         {"sigma", JsonNumber(one.pooled.sigma)},
                         {"unit", one.unit},
                         {"between", JsonNumber(one.pooled.between)},
                         {"p_same", JsonNumber(one.pooled.p)},
                         {"differs", one.differs}};
  }
  return numbers;
}

Json CauseJson(const SharedCause& cause) {
  Json alike = Json::array();
  for (const Candidate* one : cause.rivals) {
    alike.push_back(one->target == cause.target()
                        ? std::string(one->mechanism->id)
                        : one->target + "/" + std::string(one->mechanism->id));
  }
  return {{"target", cause.target()},       {"mechanism", cause.mechanism().id},
          {"class", std::move(alike)},      {"shared", cause.IsShared()},
          {"parameters", NumbersOf(cause)}, {"recordings", RecordingsOf(cause)},
          {"sentence", SentenceOf(cause)}};
}

}  // namespace

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

}  // namespace tera
