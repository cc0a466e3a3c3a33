#include "diagnose/experiment_design/excitation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tera {
namespace {

/// Largest travel from the middle of the range, over the range.
constexpr double kMostTravelShare = 0.45;
constexpr double kEndlessTravel_s = 4;  ///< travel of an axis without limits, in time at full rate
constexpr double kShortestStep_s = 0.25, kLongestStep_s = 1.5;
constexpr double kPause_s = 0.4;  ///< pause between the moves of an excitation
constexpr double kRest_s = 1.2;   ///< rest at the end of an excitation
constexpr double kRow_s = 0.02;   ///< time between the moves of a ramp or wave
constexpr double kLongestSweep_s = 6;
/// Number of other axes that are moved away from their middle.
constexpr std::size_t kMostHeldAxes = 2;

/// Builds an excitation from consecutive moves.
class Course {
 public:
  explicit Course(std::size_t axis) : axis_(axis) {}

  Course& Hold(double lever, double for_s) {
    excitation_.moves.push_back({t_s_, axis_, lever});
    t_s_ += for_s;
    return *this;
  }
  Course& Rest(double for_s) { return Hold(0, for_s); }
  /// Moves the lever linearly from one value to another.
  Course& Ramp(double from, double to, double for_s) {
    const int rows = std::max(1, static_cast<int>(std::lround(for_s / kRow_s)));
    for (int r = 0; r < rows; ++r) Hold(std::lerp(from, to, (r + 0.5) / rows), for_s / rows);
    return *this;
  }
  Course& Of(std::size_t axis) {
    axis_ = axis;
    return *this;
  }
  Excitation Take(std::string what) {
    Rest(kRest_s);
    excitation_.what = std::move(what);
    excitation_.length_s = t_s_;
    return std::move(excitation_);
  }

 private:
  std::size_t axis_;
  Excitation excitation_;
  double t_s_ = 0;
};

/// Time for which a lever can be held from the middle of the range. Returns nothing if it is too
/// short.
std::optional<double> HoldTime_s(const AxisRange& range, double lever) {
  const double most_s =
      kMostTravelShare * range.Travel_rad() / (std::abs(lever) * range.full_rate_radps);
  if (most_s < kShortestStep_s) return std::nullopt;
  return std::min(most_s, kLongestStep_s);
}

void AddSteps(const AxisRange& range, std::vector<Excitation>* excitations) {
  for (const double u : {0.05, 0.1, 0.15, 0.25, 0.4, 0.6, 0.8, 1.0}) {
    const auto hold_s = HoldTime_s(range, u);
    if (!hold_s) continue;
    excitations->push_back(Course(range.axis)
                               .Hold(u, *hold_s)
                               .Rest(kPause_s)
                               .Hold(-u, *hold_s)
                               .Take(fmt::format("steps of {}", u)));
  }
  for (const double u : {0.15, 0.4, 1.0}) {
    const auto hold_s = HoldTime_s(range, u);
    if (!hold_s) continue;
    const double half_s = std::min(0.4, *hold_s);
    excitations->push_back(Course(range.axis)
                               .Hold(u, half_s)
                               .Hold(-u, half_s)
                               .Hold(u, half_s)
                               .Hold(-u, half_s)
                               .Take(fmt::format("reversals of {}", u)));
  }
}

void AddRamps(const AxisRange& range, std::vector<Excitation>* excitations) {
  for (const double u : {0.2, 0.5, 1.0}) {
    const double quarter_s =
        std::min(1.5, kMostTravelShare * range.Travel_rad() / (u * range.full_rate_radps));
    if (quarter_s < 0.4) continue;
    excitations->push_back(Course(range.axis)
                               .Ramp(0, u, quarter_s)
                               .Ramp(u, -u, 2 * quarter_s)
                               .Ramp(-u, 0, quarter_s)
                               .Take(fmt::format("a slow ramp through neutral to {} and back", u)));
  }
  constexpr double kLevels[] = {0.1, 0.2, 0.35, 0.5, 0.75, 1.0};
  double sum = 0;
  for (const double level : kLevels) sum += level;
  const double dwell_s =
      std::min(0.5, kMostTravelShare * range.Travel_rad() / (sum * range.full_rate_radps));
  if (dwell_s < 0.15) return;
  Course stairs(range.axis);
  for (const double level : kLevels) stairs.Hold(level, dwell_s);
  stairs.Rest(kPause_s);
  for (const double level : kLevels) stairs.Hold(-level, dwell_s);
  excitations->push_back(stairs.Take("stairs from 0.1 to 1"));
}

void AddWaves(const AxisRange& range, std::vector<Excitation>* excitations) {
  for (const double u : {0.3, 0.9}) {
    for (const double hz : {0.5, 1.5}) {
      // A sine of the lever moves the axis to one side only, because the rate is proportional to
      // the lever.
      if (u * range.full_rate_radps / (std::numbers::pi * hz) >
          kMostTravelShare * range.Travel_rad())
        continue;
      Course wave(range.axis);
      const int rows = static_cast<int>(std::lround(2 / kRow_s));
      for (int r = 0; r < rows; ++r) {
        wave.Hold(u * std::sin(2 * std::numbers::pi * hz * (r + 0.5) * kRow_s), kRow_s);
      }
      excitations->push_back(wave.Take(fmt::format("waves of {} at {} Hz", u, hz)));
    }
  }
}

void AddSweeps(const AxisRange& range, std::vector<Excitation>* excitations) {
  if (!range.lower_rad) return;
  for (const double u : {0.5, 1.0}) {
    const double half_s = kMostTravelShare * range.Travel_rad() / (u * range.full_rate_radps);
    if (half_s < kShortestStep_s || 2 * half_s > kLongestSweep_s) continue;
    excitations->push_back(Course(range.axis)
                               .Hold(-u, half_s)
                               .Rest(kPause_s)
                               .Hold(u, 2 * half_s)
                               .Rest(kPause_s)
                               .Hold(-u, half_s)
                               .Take(fmt::format("a sweep over the whole range at {}", u)));
  }
}

void AddCoordinated(const AxisRange& own, const std::vector<AxisRange>& others,
                    std::vector<Excitation>* excitations) {
  std::size_t added = 0;
  for (const AxisRange& other : others) {
    if (added == kMostHeldAxes) break;
    const auto away_s = HoldTime_s(other, 0.6), hold_s = HoldTime_s(own, 0.5);
    if (!away_s || !hold_s) continue;
    ++added;
    for (const double side : {0.6, -0.6}) {
      excitations->push_back(
          Course(other.axis)
              .Hold(side, *away_s)
              .Rest(kPause_s)
              .Of(own.axis)
              .Hold(0.5, *hold_s)
              .Rest(kPause_s)
              .Hold(-0.5, *hold_s)
              .Rest(kPause_s)
              .Of(other.axis)
              .Hold(-side, *away_s)
              .Take(fmt::format("steps of 0.5 with the {} {}", other.name,
                                side > 0 ? "forward of its middle" : "back from its middle")));
    }
  }
}

}  // namespace

double AxisRange::Travel_rad() const {
  return lower_rad && upper_rad ? *upper_rad - *lower_rad : kEndlessTravel_s * full_rate_radps;
}

double AxisRange::Middle_rad(double otherwise) const {
  return lower_rad && upper_rad ? 0.5 * (*lower_rad + *upper_rad) : otherwise;
}

std::vector<Excitation> ExcitationsFor(const AxisRange& own, const std::vector<AxisRange>& others) {
  std::vector<Excitation> excitations;
  AddSteps(own, &excitations);
  AddRamps(own, &excitations);
  AddWaves(own, &excitations);
  AddSweeps(own, &excitations);
  AddCoordinated(own, others, &excitations);
  return excitations;
}

Excitation Mirrored(Excitation excitation, std::size_t axis) {
  for (LeverMove& move : excitation.moves) {
    if (move.axis == axis) move.lever = -move.lever;
  }
  return excitation;
}

}  // namespace tera
