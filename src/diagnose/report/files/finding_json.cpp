#include "diagnose/report/files/finding_json.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

namespace tera {
namespace {

using Json = OrderedJson;

/// p of an error that the flexible regressor does not explain.
constexpr double kPOfUnfollowed = 0.5;

Json Intervals(const Location& location, const ReplayBlock& block) {
  Json list = Json::array();
  for (const Segment& segment : location.intervals) {
    list.push_back(
        {JsonNumber(block.time_s(segment.begin)), JsonNumber(block.time_s(segment.end))});
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

template <typename Numbers>
Json ListOf(const Numbers& numbers) {
  Json list = Json::array();
  for (const double number : numbers) list.push_back(JsonNumber(number));
  return list;
}

/// Error as a function of a regime's variable, with its 90 % band. Only visited values appear.
Json CurveOf(const RegimeCurve& curve) {
  const auto visited = [&](const Eigen::VectorXd& values) {
    Json list = Json::array();
    for (Eigen::Index bin = 0; bin < values.size(); ++bin) {
      if (curve.count[bin] > 0) list.push_back(JsonNumber(values[bin]));
    }
    return list;
  };
  return {{"at", visited(curve.at)},
          {"mean", visited(curve.mean)},
          {"low", visited(curve.low)},
          {"high", visited(curve.high)}};
}

Json RegimeOf(const Location& location) {
  if (location.regimes.empty()) return nullptr;
  const Regime& regime = location.regimes.front();
  const bool has_range = regime.shape.form != CurveForm::kNone;
  return {{"variable", regime.variable},
          {"error", regime.is_share ? "share of simulated" : "value"},
          {"low", has_range ? JsonNumber(regime.shape.low) : Json(nullptr)},
          {"high", has_range ? JsonNumber(regime.shape.high) : Json(nullptr)},
          {"shape", ShapeOf(regime.shape)},
          {"p", JsonNumber(regime.p)},
          {"curve", CurveOf(regime.curve)}};
}

/// Location of a finding or an unexplained error.
Json Where(const DiagnosedBlock& diagnosed, const Location& location) {
  return {{"channel", diagnosed.block.channels[location.channel].name},
          {"intervals_s", Intervals(location, diagnosed.block)},
          {"regime", RegimeOf(location)}};
}

/// Location of a finding of a lidar or camera, with its place on the site for a difference of the
/// scene.
Json Where(const PerceptionDiagnosis& sensor, const PerceptionFinding& found) {
  Json intervals = Json::array(), place = nullptr;
  for (const auto& [from_s, to_s] : found.intervals_s) {
    intervals.push_back({JsonNumber(from_s), JsonNumber(to_s)});
  }
  if (found.place) {
    place = {{"centre_m", ListOf(found.place->centre_W_m)},
             {"low_m", ListOf(found.place->low_W_m)},
             {"high_m", ListOf(found.place->high_W_m)}};
  }
  return {{"channel", sensor.channel},
          {"intervals_s", std::move(intervals)},
          {"place", std::move(place)},
          {"regime", nullptr}};
}

Json Where(const Cause& cause) {
  if (cause.block != nullptr) return Where(*cause.block, cause.finding->location);
  if (cause.seen != nullptr) return Where(*cause.seen_by, *cause.seen);
  return {{"channel", cause.sensor->channel}, {"intervals_s", Json::array()}, {"regime", nullptr}};
}

/// Score that ranks findings by certainty. The score is not calibrated and is no probability.
double ScoreOf(const Finding& finding) {
  const auto alike = static_cast<double>(finding.evidence.rivals.size());
  return (1 - finding.evidence.p) * (1 - finding.held_out.p) / alike;
}

Json ClassJson(const Finding& finding) {
  Json ids = Json::array();
  for (const Candidate* rival : finding.evidence.rivals) ids.push_back(rival->mechanism->id);
  return ids;
}

Json EvidenceOf(const Finding& finding) {
  return {{"p_chosen", JsonNumber(finding.evidence.p)},
          {"p_confirmed", JsonNumber(finding.held_out.p)}};
}

/// The effect that a simulation runs for an unexplained error.
Json LearnedJson(const DiagnosedBlock& diagnosed, std::size_t channel) {
  const Learned* learned = LearnedOf(diagnosed, channel);
  if (learned == nullptr) return nullptr;
  const LearnedEffect& effect = learned->effect;
  return {{"variable", effect.variable.name},
          {"unit", effect.variable.unit},
          {"as", effect.is_share ? "share" : "added"},
          {"at", ListOf(effect.at)},
          {"value", ListOf(effect.value)},
          {"low", ListOf(effect.low)},
          {"high", ListOf(effect.high)},
          {"rmse_before", JsonNumber(learned->rmse_before)},
          {"rmse_after", JsonNumber(learned->rmse_after)}};
}

}  // namespace

Json JsonNumber(double value) {
  if (!std::isfinite(value)) return nullptr;
  return std::strtod(fmt::format("{:.6g}", value).c_str(), nullptr);
}

Json JsonNumber(const std::optional<double>& value) {
  return value ? JsonNumber(*value) : Json(nullptr);
}

Json ParametersJson(const Finding& finding) {
  const std::vector<double>& present = finding.term.candidate->present;
  Json map = Json::object();
  for (std::size_t i = 0; i < finding.parameters.size(); ++i) {
    const ParameterEstimate& estimate = finding.parameters[i];
    Json& json = map[estimate.name];
    json = {{"value", JsonNumber(estimate.value)},
            {"sigma", JsonNumber(estimate.sigma)},
            {"unit", estimate.unit}};
    if (!present.empty()) json["instead_of"] = JsonNumber(present[i]);
    if (finding.term.IsHeld(i)) json["determined"] = false;
  }
  return map;
}

Json HeldOutJson(double before, double after, const std::string& unit, double removed) {
  return {{"rmse_before", JsonNumber(before)},
          {"rmse_after", JsonNumber(after)},
          {"unit", unit},
          {"excess_variance_removed", JsonNumber(removed)}};
}

Json FindingJson(const Cause& cause) {
  const Finding& finding = *cause.finding;
  Json json = Where(cause);
  json["mechanism"] = cause.mechanism().id;
  json["slot"] = NameOf(cause.mechanism().slot);
  json["target"] = cause.target();
  json["parameters"] = ParametersJson(finding);
  json["class"] = ClassJson(finding);
  json["rejected"] = Json::array();
  for (const Rival& rival : finding.evidence.rejected) {
    json["rejected"].push_back(
        {{"mechanism", rival.candidate->mechanism->id}, {"p", JsonNumber(rival.p)}});
  }
  json["evidence"] = EvidenceOf(finding);
  json["confidence"] = JsonNumber(ScoreOf(finding));
  const HeldOutError& error = finding.held_out;
  json["held_out"] =
      HeldOutJson(error.rmse_before, error.rmse_after, cause.ErrorUnit(), error.excess_removed);
  return json;
}

Json UnexplainedJson(const DiagnosedBlock& diagnosed, const Unexplained& unexplained) {
  Json json = Where(diagnosed, unexplained.location);
  json["mechanism"] = "unexplained";
  json["slot"] = nullptr;
  json["target"] = nullptr;
  json["parameters"] = Json::object();
  json["class"] = Json::array();
  json["rejected"] = Json::array();
  json["evidence"] = {{"p_chosen", JsonNumber(unexplained.p)}, {"p_confirmed", nullptr}};
  json["confidence"] = JsonNumber(1 - unexplained.p.value_or(kPOfUnfollowed));
  const std::string& unit = diagnosed.block.channels[unexplained.location.channel].unit;
  json["held_out"] = HeldOutJson(unexplained.rmse, unexplained.rmse, unit, 0);
  json["held_out"]["noise"] = JsonNumber(unexplained.noise);
  json["learned"] = LearnedJson(diagnosed, unexplained.location.channel);
  return json;
}

Json ChosenJson(const Finding& finding) {
  return {{"mechanism", finding.term.candidate->mechanism->id},
          {"target", finding.term.candidate->target},
          {"class", ClassJson(finding)},
          {"evidence", EvidenceOf(finding)}};
}

}  // namespace tera
