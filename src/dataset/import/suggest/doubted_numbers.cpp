#include "dataset/import/suggest/doubted_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "core/quantile.h"
#include "core/units.h"
#include "dataset/import/angle_wrap.h"
#include "dataset/import/inertial_conventions.h"

namespace tera {
namespace {

/// Full turn of an angle, in the unit of its numbers.
struct TurnOfUnit {
  double turn = 0;
  UnitGuess unit;
};

std::vector<TurnOfUnit> TurnsOfUnits(const std::optional<UnitGuess>& told) {
  if (told) return {{2 * kPi / (told->scale * (told->unit == "rad" ? 1 : kDeg)), *told}};
  std::vector<TurnOfUnit> turns = {{2 * kPi, {"rad", 1.0, ""}}, {360, {"deg", 1.0, ""}}};
  const auto add = [&](double turn) {
    turns.push_back({turn, {"deg", 360 / turn, fmt::format("one turn is {:g}", turn)}});
  };
  for (const double turn : {1.0, 400.0, 3600.0, 36000.0}) add(turn);
  for (int bits = 8; bits <= 24; ++bits) add(1 << bits);
  std::sort(turns.begin(), turns.end(),
            [](const TurnOfUnit& a, const TurnOfUnit& b) { return a.turn < b.turn; });
  return turns;
}

/// True if all numbers fit a sensor that counts from 0 or from minus half a turn. A few rows are
/// not sufficient.
bool MayBeWithin(double turn, const std::vector<double>& angle) {
  constexpr std::size_t kLeastRows = 8;
  constexpr double kSlack = 0.01;
  if (angle.size() < kLeastRows) return false;
  const auto [low, high] = std::minmax_element(angle.begin(), angle.end());
  const auto is_from = [&](double least) {
    return *low >= least - kSlack * turn && *high <= least + (1 + kSlack) * turn;
  };
  return is_from(0) || is_from(-0.5 * turn);
}

double RateFactor(const UnitGuess& unit) {
  constexpr double kMinute_s = 60;
  const double factor = unit.unit == "deg/s" ? kDeg
                        : unit.unit == "rpm" ? 2 * kPi / kMinute_s
                                             : 1.0;
  return factor * unit.scale;
}

double ForceFactor(const UnitGuess& unit) {
  return (unit.unit == "g" ? kStandardGravity_mps2 : 1.0) * unit.scale;
}

}  // namespace

AngleGuess GuessAngle(const NumbersOfColumn& angle,
                      const std::vector<const NumbersOfColumn*>& others) {
  const auto told = ToldUnit(angle, Dimension::kAngle);
  for (const TurnOfUnit& one : TurnsOfUnits(told)) {
    if (!told && !MayBeWithin(one.turn, angle.values)) continue;
    if (BeginsAnew(angle.values, one.turn)) return {one.unit, true};
  }
  std::vector<const NumbersOfColumn*> all = {&angle};
  for (const NumbersOfColumn* other : others) {
    if (other != &angle && !ToldUnit(*other, Dimension::kAngle)) all.push_back(other);
  }
  return {GuessAngleUnit(all), false};
}

std::string JointYaml(const std::string& joint, const std::string& column, const AngleGuess& angle,
                      const std::optional<RateColumn>& rate) {
  UnitGuess remark = angle.unit;
  if (angle.begins_anew) {
    remark.doubt =
        "it wraps after a turn" + (angle.unit.doubt.empty() ? "" : "; " + angle.unit.doubt);
  }
  std::string keys = "angle: " + ColumnYaml(column, angle.unit);
  if (angle.begins_anew) keys += ", wrap_deg: 360";
  if (rate) keys += ", rate: " + ColumnYaml(rate->column, rate->unit);
  if (rate && !rate->unit.doubt.empty()) {
    remark.doubt +=
        (remark.doubt.empty() ? "" : "; ") + std::string("the rate: ") + rate->unit.doubt;
    if (!rate->unit.is_known()) remark.unit = kUnknownUnit;
  }
  return fmt::format("      - {{name: {}, {}}}{}\n", joint, keys, DoubtRemark(remark));
}

std::string JointYaml(const std::string& joint, const RateColumn& rate) {
  return fmt::format("      - {{name: {}, rate: {}}}{}\n", joint,
                     ColumnYaml(rate.column, rate.unit), DoubtRemark(rate.unit));
}

std::string InertialRemarks(const std::vector<TimeNs>& t_ns,
                            const std::vector<const NumbersOfColumn*>& rates,
                            const UnitGuess& rate_unit,
                            const std::vector<const NumbersOfColumn*>& forces,
                            const UnitGuess& force_unit) {
  const std::size_t rows = rates[0]->values.size();
  const auto is_whole = [&](const NumbersOfColumn* column) {
    return column->values.size() == rows;
  };
  if (rows == 0 || !std::all_of(rates.begin(), rates.end(), is_whole) ||
      !std::all_of(forces.begin(), forces.end(), is_whole)) {
    return "";
  }
  // Without times or a unit, the rates cannot be integrated.
  const bool knows_turns = t_ns.size() == rows && rate_unit.is_known();
  const double rate_factor = knows_turns ? RateFactor(rate_unit) : 0;
  const auto vector = [](const std::vector<const NumbersOfColumn*>& axes, std::size_t row) {
    return Vec3(axes[0]->values[row], axes[1]->values[row], axes[2]->values[row]);
  };
  double force_factor = ForceFactor(force_unit);
  if (!force_unit.is_known()) {
    // For raw counts of unknown scale, only the direction is examined.
    std::vector<double> sizes;
    for (std::size_t row = 0; row < rows; ++row) sizes.push_back(vector(forces, row).norm());
    force_factor = std::min(1.0, kStandardGravity_mps2 / std::max(Median(sizes), 1e-9));
  }
  const auto sample = [&](std::size_t row) {
    const TimeNs at_ns = t_ns.size() == rows ? t_ns[row] : static_cast<TimeNs>(row);
    return ImuSample{at_ns, at_ns, rate_factor * vector(rates, row),
                     force_factor * vector(forces, row)};
  };
  std::vector<InertialFinding> findings = JudgeInertial(rows, sample);
  if (findings.empty()) findings = JudgeLogged(rows, sample, /*knows_mount=*/false);
  std::string remarks;
  for (const InertialFinding& one : findings) remarks += "    # guessed: " + one.text + "\n";
  return remarks;
}

}  // namespace tera
