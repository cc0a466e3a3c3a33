#include "diagnose/report/files/diagnosis_json.h"

#include <algorithm>
#include <cmath>

#include "diagnose/diagnosis.h"
#include "diagnose/report/files/finding_json.h"
#include "diagnose/report/text/channel_lines.h"
#include "diagnose/report/text/confirmation_text.h"

namespace tera {
namespace {

using Json = OrderedJson;

/// Raised when a key changes its name or meaning. Files without this key have format 1.
constexpr int kFormat = 2;

template <typename List, typename ToJson>
Json ListOf(const List& list, ToJson to_json) {
  Json json = Json::array();
  for (const auto& one : list) json.push_back(to_json(one));
  return json;
}

Json Chosen(const Finding* finding) { return ChosenJson(*finding); }

/// A finding within tolerance.
Json AsExpected(const Finding* finding) {
  Json json = ChosenJson(*finding);
  json["parameters"] = ParametersJson(*finding);
  return json;
}

/// Held-out errors of every judged channel, without findings and with all findings.
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

Json MissingInputJson(const MissingInput& one) {
  return {{"channel", one.channel},
          {"axis", one.axis},
          {"share_of_motion", JsonNumber(one.share)},
          {"one_sided", one.is_one_sided}};
}

/// Channels of blocks for which the time was over.
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

Json FurtherRecording(const HeldOutRecording& further) {
  return {{"recording", further.recording},
          {"channels", ListOf(further.channels,
                              [](const HeldOutChannel& one) {
                                Json json = BeforeAndAfter(one.channel, one.rmse_before,
                                                           one.rmse_after, one.unit);
                                json["p"] = JsonNumber(one.p);
                                return json;
                              })},
          {"not_compared", further.missing}};
}

/// `rmse` is the error of the unchanged scenario without any fit. The errors before and after
/// include a fit of the nuisances.
Json ChannelJson(const ChannelLine& line) {
  return {{"channel", line.channel},           {"unit", line.unit},
          {"rms", JsonNumber(line.rms)},       {"rmse", JsonNumber(line.rmse)},
          {"motion", JsonNumber(line.motion)}, {"noise", JsonNumber(line.noise)},
          {"before", JsonNumber(line.before)}, {"after", JsonNumber(line.after)},
          {"explained_by", line.explained_by}, {"left", line.left}};
}

Json Whole(const Diagnosis& diagnosis) {
  if (!diagnosis.whole) return nullptr;
  const WholeSimulation& whole = *diagnosis.whole;
  Json channels = ListOf(whole.channels, [](const SimulatedChannel& one) {
    Json json = BeforeAndAfter(one.channel, one.rmse_before, one.rmse_after, one.unit);
    json["follows"] = one.Follows();
    return json;
  });
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
Json CorrectionJson(const DiscrepancyCorrection& one) {
  return {{"channel", one.channel},
          {"rms", one.is_simulated ? JsonNumber(one.rms) : Json(nullptr)},
          {"unit", one.unit},
          {"log_likelihood_gain", one.is_simulated ? JsonNumber(one.gain) : Json(nullptr)},
          {"applied", one.is_applied()}};
}

/// Channels of blocks with too few manoeuvres, or for which the time was over.
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
  const auto add = [&](const Mechanism& mechanism, const std::string& target) {
    list.push_back({{"mechanism", mechanism.id}, {"target", target}});
  };
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) {
    for (const Detectability& one : diagnosed.diagnosis.detectability) {
      if (!one.smallest) add(*one.candidate->mechanism, one.candidate->target);
    }
  }
  for (const SensorFinding& one : diagnosis.sensors.estimate.untestable) {
    add(*one.mechanism, one.target);
  }
  return list;
}

/// Sensor mechanisms whose effects cancel, so that none of them is named.
Json NotToldApart(const std::vector<TargetMechanism>& set) {
  return ListOf(set, [](const TargetMechanism& one) { return one.Name(); });
}

Json SetJson(const DiscriminatedSet& set) {
  return {{"target", set.target}, {"members", set.members}, {"power", JsonNumber(set.power)}};
}

Json Next(const Diagnosis& diagnosis) {
  if (!diagnosis.next) return nullptr;
  const NextManoeuvre& next = *diagnosis.next;
  return {{"description", next.description},
          {"commands_csv", kNextManoeuvreFile},
          {"duration_s", JsonNumber(next.duration_s)},
          {"power", JsonNumber(next.power)},
          {"discriminated", ListOf(next.discriminated, SetJson)},
          {"not_discriminated", ListOf(next.not_discriminated, SetJson)},
          {"deferred", next.deferred}};
}

}  // namespace

std::string DiagnosisJson(const Diagnosis& diagnosis) {
  Json json = {{"format", kFormat}};
  json["verdict"] = ListOf(VerdictsOf(diagnosis), [](Verdict verdict) { return NameOf(verdict); });
  Json findings = Json::array(), seen = Json::array();
  for (const Cause& cause : RankedCauses(diagnosis)) {
    (cause.seen == nullptr ? findings : seen).push_back(FindingJson(cause));
  }
  for (const auto& [diagnosed, unexplained] : RankedUnexplained(diagnosis)) {
    findings.push_back(UnexplainedJson(*diagnosed, *unexplained));
  }
  for (Json& one : seen) findings.push_back(std::move(one));
  json["findings"] = std::move(findings);
  json["held_out"] = HeldOutOfAll(diagnosis);
  json["channels"] = ListOf(ChannelLines(diagnosis), ChannelJson);
  json["unconfirmed"] = ListOf(UnconfirmedOf(diagnosis), Chosen);
  json["within_tolerance"] = ListOf(WithinToleranceOf(diagnosis), AsExpected);
  json["proxies"] = ListOf(ProxiesOf(diagnosis), Chosen);
  json["not_told_apart"] = ListOf(diagnosis.sensors.estimate.not_told_apart, NotToldApart);
  json["untestable"] = Untestable(diagnosis);
  json["not_judged"] = NotJudged(diagnosis);
  json["not_compared"] = diagnosis.not_compared;
  json["missing_input"] = ListOf(diagnosis.missing_input, MissingInputJson);
  json["excluded_samples"] = ListOf(diagnosis.excluded_samples, [](const ExcludedSamples& one) {
    return Json{{"channel", one.channel}, {"share", JsonNumber(one.share)}};
  });
  json["out_of_time"] = OutOfTime(diagnosis);
  json["levers_of"] = diagnosis.levers_are_the_scenarios ? "scenario" : "recording";
  json["encoder_lead_s"] =
      diagnosis.encoder_lead_s ? JsonNumber(*diagnosis.encoder_lead_s) : Json();
  json["held_out_recordings"] = ListOf(diagnosis.held_out, FurtherRecording);
  json["discrepancy_corrections"] = ListOf(diagnosis.discrepancy_corrections, CorrectionJson);
  json["whole_simulation"] = Whole(diagnosis);
  json["next_manoeuvre"] = Next(diagnosis);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace tera
