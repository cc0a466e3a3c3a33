#include "blind/marking/answer.h"

#include <fmt/format.h>

#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/error.h"

namespace tera::blind {
namespace {

using Json = nlohmann::json;

double Number(const Json& json) {
  return json.is_number() ? json.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

std::string Text(const Json& json) { return json.is_string() ? json.get<std::string>() : ""; }

/// Keys that are read here have the same names in all formats up to this one.
constexpr int kLatestFormat = 2;

/// Files of format 1 do not say which they are.
void RequireKnownFormat(const Json& json, const std::string& file) {
  const int format = json.value("format", 1);
  if (format >= 1 && format <= kLatestFormat) return;
  throw InputError(
      fmt::format("{}: format {}; need 1 to {}, as docs/reference/diagnose.md describes them", file,
                  format, kLatestFormat));
}

Finding FindingOf(const Json& json) {
  Finding finding;
  finding.channel = Text(json.at("channel"));
  finding.mechanism = Text(json.at("mechanism"));
  finding.target = Text(json.at("target"));
  for (const Json& name : json.at("class")) finding.names.push_back(Text(name));
  if (finding.names.empty()) finding.names.push_back(finding.mechanism);
  finding.confidence = Number(json.at("confidence"));
  for (const auto& [name, parameter] : json.at("parameters").items()) {
    const auto sigma = parameter.find("sigma");
    finding.parameters[name] = {Number(parameter.at("value")),
                                sigma == parameter.end() ? 0 : Number(*sigma)};
  }
  if (json.at("regime").is_object()) finding.variable = Text(json["regime"].at("variable"));
  for (const Json& interval : json.at("intervals_s")) {
    finding.intervals_s.emplace_back(Number(interval.at(0)), Number(interval.at(1)));
  }
  return finding;
}

}  // namespace

Answer ReadAnswer(const std::filesystem::path& diagnosis_json) {
  try {
    std::ifstream file(diagnosis_json);
    const Json json = Json::parse(file);
    RequireKnownFormat(json, diagnosis_json.string());
    Answer answer;
    for (const Json& verdict : json.at("verdict")) answer.verdicts.push_back(Text(verdict));
    for (const Json& one : json.at("untestable")) {
      answer.untestable.emplace_back(Text(one.at("mechanism")), Text(one.at("target")));
    }
    for (const Json& one : json.at("held_out")) {
      answer.rmse_after[Text(one.at("channel"))] = Number(one.at("rmse_after"));
    }
    for (const Json& finding : json.at("findings")) {
      answer.findings.push_back(FindingOf(finding));
      const auto learned = finding.find("learned");
      if (learned == finding.end() || !learned->is_object()) continue;
      answer.rmse_after[Text(finding.at("channel"))] = Number(learned->at("rmse_after"));
    }
    return answer;
  } catch (const Json::exception& e) {
    throw InputError(
        fmt::format("{}: {}; need a diagnosis as docs/reference/diagnose.md describes it",
                    diagnosis_json.string(), e.what()));
  }
}

}  // namespace tera::blind
