#include "diagnose/report/files/diagnosis_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "diagnose/report/text/next_manoeuvre_text.h"
#include "diagnose/report/text/proposal_text.h"
#include "diagnose/report/text/ranking.h"

namespace tera {
namespace {

using Json = nlohmann::ordered_json;

/// Raised when a key changes its name or meaning. Files without it are of format 1.
constexpr int kFormat = 2;
/// Stands for the p of an error that no flexible regressor follows.
constexpr double kPOfUnfollowed = 0.5;

Json Number(double value) {
  if (!std::isfinite(value)) return nullptr;
  return std::strtod(fmt::format("{:.6g}", value).c_str(), nullptr);
}

Json Number(const std::optional<double>& value) { return value ? Number(*value) : Json(nullptr); }

Json Intervals(const Location& location, const ReplayBlock& block) {
  Json list = Json::array();
  for (const Segment& segment : location.intervals) {
    list.push_back({Number(block.time_s(segment.begin)), Number(block.time_s(segment.end))});
  }
  return list;
}

std::string ShapeOf(const CurveShape& shape) {
  std::string text;
  if (shape.parity == CurveParity::kOdd || shape.parity == CurveParity::kEven) {
    text = std::string(NameOf(shape.parity)) + " ";
  }
  text += NameOf(shape.form);
  return shape.outside ? text + " outside" : text;
}

Json RegimeOf(const Location& location) {
  if (location.regimes.empty()) return nullptr;
  const Regime& regime = location.regimes.front();
  const bool has_range = regime.shape.form != CurveForm::kNone;
  return {{"variable", regime.variable},
          {"error", regime.is_share ? "share of simulated" : "value"},
          {"low", has_range ? Number(regime.shape.low) : Json(nullptr)},
          {"high", has_range ? Number(regime.shape.high) : Json(nullptr)},
          {"shape", ShapeOf(regime.shape)},
          {"p", Number(regime.p)}};
}

Json ParametersOf(const Finding& finding) {
  const std::vector<double>& present = finding.term.candidate->present;
  Json map = Json::object();
  for (std::size_t i = 0; i < finding.parameters.size(); ++i) {
    const ParameterEstimate& estimate = finding.parameters[i];
    Json& json = map[estimate.name];
    json = {{"value", Number(estimate.value)},
            {"sigma", Number(estimate.sigma)},
            {"unit", estimate.unit}};
    if (!present.empty()) json["instead_of"] = Number(present[i]);
    if (finding.term.IsHeld(i)) json["determined"] = false;
  }
  return map;
}

Json HeldOut(double before, double after, const std::string& unit, double removed) {
  return {{"rmse_before", Number(before)},
          {"rmse_after", Number(after)},
          {"unit", unit},
          {"excess_variance_removed", Number(removed)}};
}

/// The location, which named and unexplained findings both have.
Json Where(const DiagnosedBlock& diagnosed, const Location& location) {
  return {{"channel", diagnosed.block.channels[location.channel].name},
          {"intervals_s", Intervals(location, diagnosed.block)},
          {"regime", RegimeOf(location)}};
}

/// The location of a sensor's finding, with its place on the site if it has one.
Json Where(const PerceptionDiagnosis& sensor, const PerceptionFinding& found) {
  Json intervals = Json::array(), place = nullptr;
  for (const auto& [from_s, to_s] : found.intervals_s) {
    intervals.push_back({Number(from_s), Number(to_s)});
  }
  if (found.place) {
    const auto point = [](const Vec2& p) { return Json{Number(p.x()), Number(p.y())}; };
    place = {{"centre_m", point(found.place->centre_W_m)},
             {"low_m", point(found.place->low_W_m)},
             {"high_m", point(found.place->high_W_m)}};
  }
  return {{"channel", sensor.channel},
          {"intervals_s", std::move(intervals)},
          {"place", std::move(place)},
          {"regime", nullptr}};
}

/// A score that ranks findings by how sure they are. It is not calibrated, and no probability.
double ScoreOf(const Finding& finding) {
  const auto alike = static_cast<double>(finding.evidence.rivals.size());
  return (1 - finding.evidence.p) * (1 - finding.held_out.p) / alike;
}

/// Adds a finding to its location; `unit` is that of its error.
Json Named(Json json, const Finding& finding, const std::string& unit) {
  const Candidate& candidate = *finding.term.candidate;
  json["mechanism"] = std::string(candidate.mechanism->id);
  json["slot"] = std::string(NameOf(candidate.mechanism->slot));
  json["target"] = candidate.target;
  json["parameters"] = ParametersOf(finding);
  json["class"] = Json::array();
  for (const Candidate* rival : finding.evidence.rivals) {
    json["class"].push_back(std::string(rival->mechanism->id));
  }
  json["rejected"] = Json::array();
  for (const Rival& rival : finding.evidence.rejected) {
    json["rejected"].push_back(
        {{"mechanism", std::string(rival.candidate->mechanism->id)}, {"p", Number(rival.p)}});
  }
  json["evidence"] = {{"p_chosen", Number(finding.evidence.p)},
                      {"p_confirmed", Number(finding.held_out.p)}};
  json["confidence"] = Number(ScoreOf(finding));
  const HeldOutError& error = finding.held_out;
  json["held_out"] = HeldOut(error.rmse_before, error.rmse_after, unit, error.excess_removed);
  return json;
}

Json CurveOf(const ProposedCurve& proposed) {
  const auto list = [](const Eigen::VectorXd& values) {
    Json numbers = Json::array();
    for (const double value : values) numbers.push_back(Number(value));
    return numbers;
  };
  return {{"variable", proposed.variable},
          {"error", proposed.is_share ? "share of simulated" : "value"},
          {"at", list(proposed.at)},
          {"mean", list(proposed.mean)},
          {"low", list(proposed.low)},
          {"high", list(proposed.high)}};
}

/// The formula or curve for what is left of a channel, if there is one.
Json ProposalOf(const DiagnosedBlock& diagnosed, std::size_t channel) {
  for (const Proposal& proposal : diagnosed.proposals) {
    if (proposal.channel != channel) continue;
    Json terms = Json::array();
    for (const ProposedTerm& term : proposal.terms) {
      terms.push_back({{"term", TermText(diagnosed.block, term.factors)},
                       {"coefficient", Number(term.coefficient)},
                       {"sigma", Number(term.sigma)},
                       {"unit", CoefficientUnit(diagnosed.block, channel, term.factors)},
                       {"stability", Number(term.stability)}});
    }
    return {{"formula", FormulaText(diagnosed.block, proposal)},
            {"terms", std::move(terms)},
            {"curve", proposal.curve ? CurveOf(*proposal.curve) : Json(nullptr)},
            {"rmse_before", Number(proposal.rmse_before)},
            {"rmse_after", Number(proposal.rmse_after)},
            {"unit", diagnosed.block.channels[channel].unit}};
  }
  return nullptr;
}

Json NotNamed(const DiagnosedBlock& diagnosed, const Unexplained& unexplained) {
  Json json = Where(diagnosed, unexplained.location);
  json["mechanism"] = "unexplained";
  json["slot"] = nullptr;
  json["target"] = nullptr;
  json["parameters"] = Json::object();
  json["class"] = Json::array();
  json["rejected"] = Json::array();
  json["evidence"] = {{"p_chosen", Number(unexplained.p)}, {"p_confirmed", nullptr}};
  json["confidence"] = Number(1 - unexplained.p.value_or(kPOfUnfollowed));
  const std::string& unit = diagnosed.block.channels[unexplained.location.channel].unit;
  json["held_out"] = HeldOut(unexplained.rmse, unexplained.rmse, unit, 0);
  json["held_out"]["noise"] = Number(unexplained.noise);
  json["proposal"] = ProposalOf(diagnosed, unexplained.location.channel);
  return json;
}

/// A mechanism that was chosen and is no finding.
Json Chosen(const Finding& finding) {
  Json names = Json::array();
  for (const Candidate* rival : finding.evidence.rivals)
    names.push_back(std::string(rival->mechanism->id));
  return {
      {"mechanism", std::string(finding.term.candidate->mechanism->id)},
      {"target", finding.term.candidate->target},
      {"class", std::move(names)},
      {"evidence",
       {{"p_chosen", Number(finding.evidence.p)}, {"p_confirmed", Number(finding.held_out.p)}}}};
}

/// Mechanisms that come nearest to errors that stay unexplained.
Json Proxies(const Diagnosis& diagnosis) {
  Json list = Json::array();
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) {
    for (const Finding& finding : diagnosed.diagnosis.proxies) list.push_back(Chosen(finding));
  }
  return list;
}

/// Mechanisms that were found and whose numbers are as expected.
Json WithinTolerance(const Diagnosis& diagnosis) {
  Json list = Json::array();
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) {
    for (const Finding& finding : diagnosed.diagnosis.within_tolerance) {
      list.push_back(Chosen(finding));
      list.back()["parameters"] = ParametersOf(finding);
    }
  }
  return list;
}

/// Mechanisms that were chosen on SELECT and that FINAL did not confirm.
Json Unconfirmed(const Diagnosis& diagnosis) {
  Json list = Json::array();
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) {
    for (const Finding& finding : diagnosed.diagnosis.unconfirmed) {
      list.push_back(Chosen(finding));
    }
  }
  for (const PerceptionDiagnosis& sensor : diagnosis.perception) {
    for (const PerceptionFinding& found : sensor.unconfirmed) list.push_back(Chosen(found.finding));
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
      one.update(HeldOut(error.rmse_before, error.rmse_after, channel.unit, error.excess_removed));
      list.push_back(std::move(one));
    }
  }
  return list;
}

/// Channels of blocks for which there was no time.
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
          {"rmse_before", Number(before)},
          {"rmse_after", Number(after)},
          {"unit", unit}};
}

Json FurtherRecordings(const Diagnosis& diagnosis) {
  Json list = Json::array();
  for (const HeldOutRecording& further : diagnosis.held_out) {
    Json channels = Json::array();
    for (const HeldOutChannel& one : further.channels) {
      channels.push_back(BeforeAndAfter(one.channel, one.rmse_before, one.rmse_after, one.unit));
      channels.back()["p"] = Number(one.p);
    }
    list.push_back({{"recording", further.recording},
                    {"channels", std::move(channels)},
                    {"not_compared", further.missing}});
  }
  return list;
}

/// Errors of the scenario as it stands over all samples, without any fit, even of nuisances.
Json Channels(const Diagnosis& diagnosis) {
  Json list = Json::array();
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) {
    const std::vector<std::vector<double>> predicted = diagnosed.block.predict({});
    for (std::size_t c = 0; c < predicted.size(); ++c) {
      const Channel& channel = diagnosed.block.channels[c];
      double square = 0, error = 0, count = 0;
      for (std::size_t k = 0; k < channel.measured.size(); ++k) {
        if (!channel.measured.valid[k]) continue;
        square += std::pow(channel.measured.value[k], 2);
        error += std::pow(channel.measured.value[k] - predicted[c][k], 2);
        ++count;
      }
      count = std::max(count, 1.0);
      list.push_back({{"channel", channel.name},
                      {"unit", channel.unit},
                      {"rms", Number(std::sqrt(square / count))},
                      {"rmse", Number(std::sqrt(error / count))}});
    }
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
    path = {{"recorded_m", Number(whole.path->recorded_m)},
            {"before_m", Number(whole.path->before_m)},
            {"after_m", Number(whole.path->after_m)}};
  }
  return {{"until_s", Number(whole.until_s)},
          {"channels", std::move(channels)},
          {"path", std::move(path)},
          {"not_simulated", whole.not_simulated},
          {"obstacle", whole.obstacle.empty() ? Json(nullptr) : Json(whole.obstacle)}};
}

/// RMS and gain are null for channels that were not simulated.
Json DiscrepancyCorrectionsOf(const Diagnosis& diagnosis) {
  Json list = Json::array();
  for (const DiscrepancyCorrection& one : diagnosis.discrepancy_corrections) {
    list.push_back({{"channel", one.channel},
                    {"rms", one.is_simulated ? Number(one.rms) : Json(nullptr)},
                    {"unit", one.unit},
                    {"log_likelihood_gain", one.is_simulated ? Number(one.gain) : Json(nullptr)},
                    {"applied", one.is_applied()}});
  }
  return list;
}

/// Samples at which loose ground may let the base lag behind its tracks.
Json ExcludedSamplesOf(const Diagnosis& diagnosis) {
  Json list = Json::array();
  for (const ExcludedSamples& one : diagnosis.excluded_samples) {
    list.push_back({{"channel", one.channel}, {"share", Number(one.share)}});
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
  return list;
}

Json SetsOf(const std::vector<DiscriminatedSet>& sets) {
  Json list = Json::array();
  for (const DiscriminatedSet& set : sets) {
    list.push_back(
        {{"target", set.target}, {"members", set.members}, {"power", Number(set.power)}});
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
          {"duration_s", Number(next.duration_s)},
          {"discriminates", members},
          {"power", Number(next.power)},
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
    json["findings"].push_back(Named(Where(*diagnosed, finding->location), *finding,
                                     diagnosed->block.channels[finding->held_out.channel].unit));
  }
  for (const auto& [diagnosed, unexplained] : RankedUnexplained(diagnosis)) {
    json["findings"].push_back(NotNamed(*diagnosed, *unexplained));
  }
  for (const PerceptionDiagnosis& sensor : diagnosis.perception) {
    for (const PerceptionFinding& found : sensor.findings) {
      json["findings"].push_back(Named(Where(sensor, found), found.finding, sensor.unit));
    }
  }
  json["held_out"] = HeldOutOfAll(diagnosis);
  json["channels"] = Channels(diagnosis);
  json["unconfirmed"] = Unconfirmed(diagnosis);
  json["within_tolerance"] = WithinTolerance(diagnosis);
  json["proxies"] = Proxies(diagnosis);
  json["untestable"] = Untestable(diagnosis);
  json["not_judged"] = NotJudged(diagnosis);
  json["not_compared"] = diagnosis.not_compared;
  json["excluded_samples"] = ExcludedSamplesOf(diagnosis);
  json["out_of_time"] = OutOfTime(diagnosis);
  json["levers_of"] = diagnosis.levers_are_the_scenarios ? "scenario" : "recording";
  json["encoder_lead_s"] = diagnosis.encoder_lead_s ? Number(*diagnosis.encoder_lead_s) : Json();
  json["held_out_recordings"] = FurtherRecordings(diagnosis);
  json["discrepancy_corrections"] = DiscrepancyCorrectionsOf(diagnosis);
  json["whole_simulation"] = Whole(diagnosis);
  json["next_manoeuvre"] = Next(diagnosis);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace tera
