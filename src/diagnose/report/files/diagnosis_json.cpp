#include "diagnose/report/files/diagnosis_json.h"

#include <algorithm>
#include <cmath>

#include "diagnose/report/files/finding_json.h"
#include "diagnose/report/text/channel_lines.h"
#include "diagnose/report/text/next_manoeuvre_text.h"
#include "diagnose/report/text/ranking.h"

namespace tera {
namespace {

using Json = OrderedJson;

/// Raised when a key changes its name or meaning. Files without it are of format 1.
constexpr int kFormat = 2;

/// Mechanisms that come nearest to errors that stay unexplained.
Json Proxies(const Diagnosis& diagnosis) {
  Json list = Json::array();
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) {
    for (const Finding& finding : diagnosed.diagnosis.proxies) list.push_back(ChosenJson(finding));
  }
  return list;
}

/// Mechanisms that were found and whose numbers are as expected.
Json WithinTolerance(const Diagnosis& diagnosis) {
  Json list = Json::array();
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) {
    for (const Finding& finding : diagnosed.diagnosis.within_tolerance) {
      list.push_back(ChosenJson(finding));
      list.back()["parameters"] = ParametersJson(finding);
    }
  }
  for (const SensorFound& found : diagnosis.sensors.within_tolerance) {
    list.push_back(ChosenJson(found.finding));
    list.back()["parameters"] = ParametersJson(found.finding);
  }
  return list;
}

/// Mechanisms that were chosen on SELECT and that FINAL did not confirm.
Json Unconfirmed(const Diagnosis& diagnosis) {
  Json list = Json::array();
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) {
    for (const Finding& finding : diagnosed.diagnosis.unconfirmed) {
      list.push_back(ChosenJson(finding));
    }
  }
  for (const SensorFound& found : diagnosis.sensors.unconfirmed) {
    list.push_back(ChosenJson(found.finding));
  }
  for (const PerceptionDiagnosis& sensor : diagnosis.perception) {
    for (const PerceptionFinding& found : sensor.unconfirmed)
      list.push_back(ChosenJson(found.finding));
  }
  return list;
}

/// Held-out errors of every judged channel, with nothing and with all that was found.
Json HeldOutOfAll(const Diagnosis& diagnosis) {
  Json list = Json::array();
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) {
    for (const HeldOutError& error : diagnosed.diagnosis.confirmed) {
      const Channel& channel = diagnosed.block.channels[error.channel];
      Json one = {{"channel", channel.name}};
      one.update(
          HeldOutJson(error.rmse_before, error.rmse_after, channel.unit, error.excess_removed));
      const std::optional<PlainComparison>& plain = diagnosed.diagnosis.plain;
      one["plain_map_rmse"] = plain ? JsonNumber(plain->rmse) : Json(nullptr);
      list.push_back(std::move(one));
    }
  }
  return list;
}

/// Channels of blocks for which there was no time.
Json MissingInputJson(const Diagnosis& diagnosis) {
  Json list = Json::array();
  for (const MissingInput& one : diagnosis.missing_input) {
    list.push_back({{"channel", one.channel},
                    {"axis", one.axis},
                    {"share_of_motion", JsonNumber(one.share)},
                    {"one_sided", one.is_one_sided}});
  }
  return list;
}

Json OutOfTime(const Diagnosis& diagnosis) {
  Json list = Json::array();
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) {
    if (!diagnosed.diagnosis.out_of_time) continue;
    for (const Channel& channel : diagnosed.block.channels) list.push_back(channel.name);
  }
  return list;
}

Json BeforeAndAfter(const std::string& channel, double before, double after,
                    const std::string& unit) {
  return {{"channel", channel},
          {"rmse_before", JsonNumber(before)},
          {"rmse_after", JsonNumber(after)},
          {"unit", unit}};
}

Json FurtherRecordings(const Diagnosis& diagnosis) {
  Json list = Json::array();
  for (const HeldOutRecording& further : diagnosis.held_out) {
    Json channels = Json::array();
    for (const HeldOutChannel& one : further.channels) {
      channels.push_back(BeforeAndAfter(one.channel, one.rmse_before, one.rmse_after, one.unit));
      channels.back()["p"] = JsonNumber(one.p);
    }
    list.push_back({{"recording", further.recording},
                    {"channels", std::move(channels)},
                    {"not_compared", further.missing}});
  }
  return list;
}

/// A line for every channel. `rmse` is the error of the scenario as it stands, without any fit,
/// even of nuisances, which the errors before and after have.
Json Channels(const Diagnosis& diagnosis) {
  Json list = Json::array();
  for (const ChannelLine& line : ChannelLines(diagnosis)) {
    list.push_back({{"channel", line.channel},
                    {"unit", line.unit},
                    {"rms", JsonNumber(line.rms)},
                    {"rmse", JsonNumber(line.rmse)},
                    {"motion", JsonNumber(line.motion)},
                    {"noise", JsonNumber(line.noise)},
                    {"before", JsonNumber(line.before)},
                    {"after", JsonNumber(line.after)},
                    {"explained_by", line.explained_by},
                    {"left", line.left}});
  }
  return list;
}

Json Whole(const Diagnosis& diagnosis) {
  if (!diagnosis.whole) return nullptr;
  const WholeSimulation& whole = *diagnosis.whole;
  Json channels = Json::array();
  for (const SimulatedChannel& one : whole.channels) {
    channels.push_back(BeforeAndAfter(one.channel, one.rmse_before, one.rmse_after, one.unit));
    channels.back()["follows"] = one.Follows();
  }
  Json path = nullptr;
  if (whole.path) {
    path = {{"recorded_m", JsonNumber(whole.path->recorded_m)},
            {"before_m", JsonNumber(whole.path->before_m)},
            {"after_m", JsonNumber(whole.path->after_m)}};
  }
  return {{"from_s", JsonNumber(whole.from_s)},
          {"until_s", JsonNumber(whole.until_s)},
          {"channels", std::move(channels)},
          {"path", std::move(path)},
          {"not_simulated", whole.not_simulated},
          {"obstacle", whole.obstacle.empty() ? Json(nullptr) : Json(whole.obstacle)}};
}

/// RMS and gain are null for channels that were not simulated.
Json DiscrepancyCorrectionsOf(const Diagnosis& diagnosis) {
  Json list = Json::array();
  for (const DiscrepancyCorrection& one : diagnosis.discrepancy_corrections) {
    list.push_back(
        {{"channel", one.channel},
         {"rms", one.is_simulated ? JsonNumber(one.rms) : Json(nullptr)},
         {"unit", one.unit},
         {"log_likelihood_gain", one.is_simulated ? JsonNumber(one.gain) : Json(nullptr)},
         {"applied", one.is_applied()}});
  }
  return list;
}

/// Samples at which loose ground may let the base lag behind its tracks.
Json ExcludedSamplesOf(const Diagnosis& diagnosis) {
  Json list = Json::array();
  for (const ExcludedSamples& one : diagnosis.excluded_samples) {
    list.push_back({{"channel", one.channel}, {"share", JsonNumber(one.share)}});
  }
  return list;
}

/// Channels of blocks with too few manoeuvres, or for which there was no time.
Json NotJudged(const Diagnosis& diagnosis) {
  Json list = Json::array();
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) {
    if (diagnosed.diagnosis.is_testable) continue;
    for (const Channel& channel : diagnosed.block.channels) list.push_back(channel.name);
  }
  for (const PerceptionDiagnosis& sensor : diagnosis.perception) {
    if (!sensor.is_judged()) list.push_back(sensor.channel);
  }
  return list;
}

Json Untestable(const Diagnosis& diagnosis) {
  Json list = Json::array();
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) {
    for (const Detectability& one : diagnosed.diagnosis.detectability) {
      if (one.smallest) continue;
      list.push_back({{"mechanism", std::string(one.candidate->mechanism->id)},
                      {"target", one.candidate->target},
                      {"smallest_detectable", nullptr}});
    }
  }
  for (const SensorFinding& one : diagnosis.sensors.estimate.untestable) {
    list.push_back({{"mechanism", std::string(one.mechanism->id)},
                    {"target", one.target},
                    {"smallest_detectable", nullptr}});
  }
  return list;
}

/// Mechanisms of sensors whose effects cancel, so that none of them is named.
Json NotToldApart(const Diagnosis& diagnosis) {
  Json list = Json::array();
  for (const std::vector<TargetMechanism>& set : diagnosis.sensors.estimate.not_told_apart) {
    list.push_back(Json::array());
    for (const TargetMechanism& one : set) list.back().push_back(one.Name());
  }
  return list;
}

Json SetsOf(const std::vector<DiscriminatedSet>& sets) {
  Json list = Json::array();
  for (const DiscriminatedSet& set : sets) {
    list.push_back(
        {{"target", set.target}, {"members", set.members}, {"power", JsonNumber(set.power)}});
  }
  return list;
}

Json Next(const Diagnosis& diagnosis) {
  if (!diagnosis.next) return nullptr;
  const NextManoeuvre& next = *diagnosis.next;
  Json members = Json::array();
  for (const DiscriminatedSet& set : next.discriminated) members.push_back(set.members);
  return {{"description", next.description},
          {"commands_csv", kNextManoeuvreFile},
          {"duration_s", JsonNumber(next.duration_s)},
          {"discriminates", members},
          {"power", JsonNumber(next.power)},
          {"discriminated", SetsOf(next.discriminated)},
          {"not_discriminated", SetsOf(next.not_discriminated)},
          {"deferred", next.deferred}};
}

}  // namespace

std::string DiagnosisJson(const Diagnosis& diagnosis) {
  Json json = {{"format", kFormat}, {"verdict", Json::array()}, {"findings", Json::array()}};
  for (const Verdict verdict : VerdictsOf(diagnosis)) {
    json["verdict"].push_back(std::string(NameOf(verdict)));
  }
  for (const auto& [diagnosed, finding] : RankedFindings(diagnosis)) {
    json["findings"].push_back(FindingJson(*diagnosed, *finding));
  }
  for (const SensorFound& found : diagnosis.sensors.findings) {
    json["findings"].push_back(FindingJson(found));
  }
  for (const auto& [diagnosed, unexplained] : RankedUnexplained(diagnosis)) {
    json["findings"].push_back(UnexplainedJson(*diagnosed, *unexplained));
  }
  for (const PerceptionDiagnosis& sensor : diagnosis.perception) {
    for (const PerceptionFinding& found : sensor.findings) {
      json["findings"].push_back(FindingJson(sensor, found));
    }
  }
  json["held_out"] = HeldOutOfAll(diagnosis);
  json["channels"] = Channels(diagnosis);
  json["unconfirmed"] = Unconfirmed(diagnosis);
  json["within_tolerance"] = WithinTolerance(diagnosis);
  json["proxies"] = Proxies(diagnosis);
  json["not_told_apart"] = NotToldApart(diagnosis);
  json["untestable"] = Untestable(diagnosis);
  json["not_judged"] = NotJudged(diagnosis);
  json["not_compared"] = diagnosis.not_compared;
  json["missing_input"] = MissingInputJson(diagnosis);
  json["excluded_samples"] = ExcludedSamplesOf(diagnosis);
  json["out_of_time"] = OutOfTime(diagnosis);
  json["levers_of"] = diagnosis.levers_are_the_scenarios ? "scenario" : "recording";
  json["encoder_lead_s"] =
      diagnosis.encoder_lead_s ? JsonNumber(*diagnosis.encoder_lead_s) : Json();
  json["held_out_recordings"] = FurtherRecordings(diagnosis);
  json["discrepancy_corrections"] = DiscrepancyCorrectionsOf(diagnosis);
  json["whole_simulation"] = Whole(diagnosis);
  json["next_manoeuvre"] = Next(diagnosis);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace tera
