#include "diagnose/blocks/effort_block.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "diagnose/blocks/candidate_list.h"
#include "diagnose/blocks/sample_grid.h"
#include "diagnose/replay/effort_log.h"
#include "diagnose/statistics/series/robust.h"
#include "physics/actuation/actuation_mechanisms.h"

namespace tera {
namespace {

constexpr std::size_t kFewestEfforts = 200;
/// Relative standard deviation of inertial effort and weight.
constexpr double kNominalMass = 0.03;
/// Quantile of |effort| that counts as the largest effort.
constexpr double kLargestQuantile = 0.99;
/// Width of the smoothed sign in the flexible regressor, relative to the largest rate.
constexpr double kSignWidth = 0.02;

/// Largest effort and rate in the log, as bounds on the sizes of candidates.
struct EffortReach {
  double effort_nm = 0, rate_radps = 0;
  double viscous_nmsprad() const { return effort_nm / rate_radps; }
};

EffortReach ReachOf(const EffortLog& log) {
  std::vector<double> magnitude_nm = ValidValues(log.measured);
  for (double& e : magnitude_nm) e = std::abs(e);
  return {Quantile(magnitude_nm, kLargestQuantile), LargestMagnitude(log.rate_radps)};
}

std::vector<Candidate> CandidatesOf(const std::string& joint, const Effects& present,
                                    const EffortReach& reach) {
  const double f = reach.effort_nm, w = reach.rate_radps, c = reach.viscous_nmsprad();
  CandidateList out(joint, EffectTarget::kJoint, present, ActuationMechanisms());
  out.Add("coulomb_friction", {{0, 0, 2 * f}}, {{0.02 * f}, {0.07 * f}, {0.2 * f}, {0.6 * f}});
  out.Add("viscous_friction", {{0, 0, 5 * c}},
          {{0.02 * c, 40}, {0.07 * c, 40}, {0.2 * c, 40}, {0.6 * c, 40}});
  out.Add("stribeck_friction", {{0, 0, 2 * f}, {1, 2e-3 * w, 0.5 * w, true}},
          {{0.02 * f, 0.03 * w}, {0.07 * f, 0.03 * w}, {0.2 * f, 0.03 * w}, {0.2 * f, 0.15 * w}});
  out.Add("asymmetric_friction", {{0, 0, 2 * f}, {2, 0, 5 * c}},
          {{0, 0, 0.05 * c, 0}, {0.05 * f, 0, 0, 0}, {0.05 * f, 0, 0.1 * c, 0}});
  out.Add("asymmetric_friction", {{1, 0, 2 * f}, {3, 0, 5 * c}},
          {{0, 0, 0, 0.05 * c}, {0, 0.05 * f, 0, 0}, {0, 0.05 * f, 0, 0.1 * c}});
  out.Add("effort_offset", {{0, -2 * f, 2 * f}},
          {{0.01 * f}, {-0.01 * f}, {0.04 * f}, {-0.04 * f}, {0.2 * f}, {-0.2 * f}});
  return out.Take();
}

/// Columns for friction of any form, also by position, and for the effort of a wrong mass.
Eigen::MatrixXd FlexibleRegressor(const EffortLog& log) {
  const double w = LargestMagnitude(log.rate_radps), a = LargestMagnitude(log.acceleration_radps2);
  const double middle = Median(log.position_rad);
  const double spread = std::max(RobustScale(log.position_rad), 1e-9);
  Eigen::MatrixXd columns(static_cast<Eigen::Index>(log.rate_radps.size()), 20);
  for (std::size_t k = 0; k < log.rate_radps.size(); ++k) {
    const double v = log.rate_radps[k] / w, b = log.acceleration_radps2[k] / std::max(a, 1e-9);
    const double sign = std::tanh(v / kSignWidth), slow = std::exp(-std::pow(v / 0.1, 2));
    const double q = std::clamp((log.position_rad[k] - middle) / (2 * spread), -2.0, 2.0);
    const std::array<double, 20> row = {
        1.0,      sign,         v,     std::abs(v), v * std::abs(v),
        v * v,    sign * slow,  q,     q * q,       q * q * q,
        sign * q, sign * q * q, v * q, v * q * q,   std::abs(v) * q,
        b,        b * sign,     b * b, b * v,       b * std::abs(v)};
    for (std::size_t c = 0; c < row.size(); ++c) {
      columns(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(c)) = row[c];
    }
  }
  return columns;
}

Eigen::MatrixXd NominalColumns(const EffortLog& log) {
  const auto size = static_cast<Eigen::Index>(log.inertial_nm.size());
  const bool heavy = LargestMagnitude(log.weight_nm) > 0;
  Eigen::MatrixXd columns(size, heavy ? 2 : 1);
  columns.col(0) = kNominalMass * Eigen::Map<const Eigen::VectorXd>(log.inertial_nm.data(), size);
  if (heavy) {
    columns.col(1) = kNominalMass * Eigen::Map<const Eigen::VectorXd>(log.weight_nm.data(), size);
  }
  return columns;
}

std::vector<RegimeVariable> VariablesOf(const std::string& joint, const EffortLog& log) {
  const double period_s = log.measured.period_s;
  std::vector<RegimeVariable> variables;
  const auto add = [&](const std::string& name, std::vector<double> values) {
    variables.push_back({name, WholeSeries(period_s, std::move(values))});
  };
  add("rate/" + joint, log.rate_radps);
  add("position/" + joint, log.position_rad);
  add("acceleration/" + joint, log.acceleration_radps2);
  if (LargestMagnitude(log.weight_nm) > 0) add("load/" + joint, log.weight_nm);
  std::vector<double> time_s;
  for (std::size_t k = 0; k < log.rate_radps.size(); ++k) {
    time_s.push_back(static_cast<double>(k) * period_s);
  }
  add("time", std::move(time_s));
  return variables;
}

/// Rate divided by its maximum, as the command that separates manoeuvres.
Series CommandOf(const EffortLog& log, double largest_radps) {
  Series command = WholeSeries(log.measured.period_s, log.rate_radps);
  for (double& share : command.value) share /= largest_radps;
  return command;
}

}  // namespace

std::optional<ReplayBlock> MakeEffortBlock(const MachineModel& model, EffortLog given) {
  if (CountValid(given.measured.valid) < kFewestEfforts) return std::nullopt;
  const EffortReach reach = ReachOf(given);
  if (reach.rate_radps <= 0 || reach.effort_nm <= 0) return std::nullopt;
  // The replay shares ownership of both.
  const auto log = std::make_shared<const EffortLog>(std::move(given));
  const auto machine = std::make_shared<const MachineModel>(model);
  const Joint& joint = machine->joints[log->joint];
  const bool slides = joint.type == JointType::kPrismatic;
  const Effects present = EffectsAt(machine->effects.joints, log->joint);
  ReplayBlock block;
  block.name = joint.name;
  block.first_ns = log->first_ns;
  block.slides = slides;
  block.channels.push_back(
      {log->channel,
       slides ? "N" : "N m",
       log->measured,
       {.offset = 1e-4 * reach.effort_nm, .gain = 0.005, .delay_s = log->fine_s},
       VariablesOf(joint.name, *log),
       FlexibleRegressor(*log),
       NominalColumns(*log)});
  block.commands = {CommandOf(*log, reach.rate_radps)};
  block.candidates = CandidatesOf(joint.name, present, reach);
  block.replay = WholeReplay([machine, log, present](const Structure& terms) {
    return std::vector<std::vector<double>>{
        EffortReplay(*machine, *log).Predict(WithTerms(present, terms))};
  });
  return block;
}

}  // namespace tera
