#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "dataset/format/dataset_description.h"
#include "dataset/lint/report/lint_report.h"

namespace tera {
namespace {

using Json = nlohmann::ordered_json;

constexpr char kSarifSchema[] =
    "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json";
/// SARIF identifier of the folder that paths are relative to.
constexpr char kBaseId[] = "DATASET";

/// Replaces invalid UTF-8, which messages may quote from a damaged file.
std::string Dumped(const Json& json) {
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + '\n';
}

Json RuleIds(const std::vector<const LintRule*>& rules) {
  Json ids = Json::array();
  for (const LintRule* rule : rules) ids.push_back(rule->id);
  return ids;
}

Json ToJson(const LintFinding& finding) {
  Json json = {{"rule", finding.rule->id},      {"severity", NameOf(finding.rule->severity)},
               {"channel", finding.channel},    {"count", finding.count},
               {"places", Json::array()},       {"text", finding.rule->text},
               {"remedy", finding.rule->remedy}};
  for (const LintPlace& place : finding.places) {
    Json told = {{"file", place.file}, {"message", place.message}};
    if (place.line > 0) told["line"] = place.line;
    json["places"].push_back(told);
  }
  return json;
}

Json ToJson(const DatasetStatistics& statistics) {
  Json channels = Json::object(), classes = Json::object();
  for (const auto& [path, c] : statistics.channels) {
    channels[path] = {{"type", c.type},
                      {"rows", c.rows},
                      {"first_ns", c.first_ns},
                      {"last_ns", c.last_ns},
                      {"median_interval_ns", c.median_interval_ns},
                      {"longest_interval_ns", c.longest_interval_ns}};
  }
  for (const auto& [name, c] : statistics.classes) {
    classes[name] = {{"pixels", c.pixels}, {"boxes", c.boxes}, {"points", c.points}};
  }
  return {{"channels", channels},
          {"classes", classes},
          {"pictures", statistics.pictures},
          {"boxes", statistics.boxes},
          {"scans", statistics.scans},
          {"points", statistics.points},
          {"depth_m", statistics.depth_m},
          {"range_m", statistics.range_m}};
}

/// Converts a relative path to a URI reference (RFC 3986).
std::string UriOf(const std::string& path) {
  constexpr std::string_view kPlain = "-._~/";
  std::string uri;
  for (const char c : path) {
    const auto code = static_cast<unsigned char>(c);
    const bool plain = code < 0x80 && (std::isalnum(code) != 0 || kPlain.find(c) != kPlain.npos);
    uri += plain ? std::string(1, c) : fmt::format("%{:02X}", code);
  }
  return uri;
}

Json SarifRules() {
  Json rules = Json::array();
  for (const LintRule& rule : kLintRules) {
    rules.push_back({{"id", rule.id},
                     {"shortDescription", {{"text", rule.text}}},
                     {"help", {{"text", rule.remedy}}},
                     {"defaultConfiguration", {{"level", NameOf(rule.severity)}}}});
  }
  return rules;
}

Json SarifResult(const LintFinding& finding, const LintPlace& place) {
  // A finding without a file is reported for dataset.yaml.
  const std::string file = place.file.empty() ? "dataset.yaml" : place.file;
  Json physical = {{"artifactLocation", {{"uri", UriOf(file)}, {"uriBaseId", kBaseId}}}};
  if (place.line > 0) physical["region"] = {{"startLine", place.line}};
  return {{"ruleId", finding.rule->id},
          {"ruleIndex", finding.rule - kLintRules.data()},
          {"level", NameOf(finding.rule->severity)},
          {"message", {{"text", place.message}}},
          {"locations", {{{"physicalLocation", physical}}}},
          {"properties", {{"channel", finding.channel}, {"count", finding.count}}}};
}

}  // namespace

std::string LintJson(const LintReport& report) {
  Json findings = Json::array();
  for (const LintFinding& finding : report.findings) findings.push_back(ToJson(finding));
  return Dumped({{"dataset", report.dataset.string()},
                 {"name", report.name},
                 {"tera_version", TeraVersion()},
                 {"errors", report.CountOf(Severity::kError)},
                 {"warnings", report.CountOf(Severity::kWarning)},
                 {"notes", report.CountOf(Severity::kNote)},
                 {"findings", findings},
                 {"applied", RuleIds(report.applied)},
                 {"not_applicable", RuleIds(report.not_applicable)},
                 {"statistics", ToJson(report.statistics)}});
}

std::string LintSarif(const LintReport& report) {
  Json results = Json::array();
  for (const LintFinding& finding : report.findings) {
    for (const LintPlace& place : finding.places) results.push_back(SarifResult(finding, place));
  }
  const std::string root = std::filesystem::absolute(report.dataset).lexically_normal().string();
  const Json driver = {{"name", "tera lint"}, {"version", TeraVersion()}, {"rules", SarifRules()}};
  const Json base = {
      {kBaseId, {{"uri", "file://" + UriOf(root) + (root.ends_with('/') ? "" : "/")}}}};
  Json run = {{"tool", {{"driver", driver}}}, {"originalUriBaseIds", base}, {"results", results}};
  return Dumped({{"$schema", kSarifSchema}, {"version", "2.1.0"}, {"runs", Json::array({run})}});
}

}  // namespace tera
