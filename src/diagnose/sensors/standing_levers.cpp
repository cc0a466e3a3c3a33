#include "diagnose/sensors/standing_levers.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace tera {
namespace {

constexpr double kWindow_s = 0.1;
constexpr double kNeutral = 0.02;       ///< expected dead band of a lever
constexpr double kLongestEffect_s = 2;  ///< longest effect of a lever after its return to neutral
constexpr double kStampedLate_s = 0.5;  ///< largest delay of lever stamps
constexpr double kTurnsOver_s = 1;      ///< span of the mean turn rate
constexpr double kLeastTurn_radps = 0.15;  ///< three times the rocking of a base

/// The column of the first lever that satisfies `moves_it`. None where it was not recorded.
template <typename Predicate>
std::optional<std::size_t> ColumnOf(const DiagnosisInput& input, const Predicate& moves_it) {
  const std::vector<Lever>& levers = input.model->levers;
  const auto lever = std::find_if(levers.begin(), levers.end(), moves_it);
  if (lever == levers.end()) return std::nullopt;
  const std::vector<std::string>& names = input.commands.columns;
  const auto name = std::find(names.begin(), names.end(), lever->name);
  if (name == names.end()) return std::nullopt;
  return static_cast<std::size_t>(name - names.begin());
}

/// Columns of the levers of all running gears. Empty where one is missing.
std::vector<std::size_t> GearColumns(const DiagnosisInput& input) {
  std::vector<std::size_t> columns;
  for (std::size_t g = 0; g < input.model->ground_tools.gears.size(); ++g) {
    const auto column =
        ColumnOf(input, [&](const Lever& lever) { return lever.gear == static_cast<int>(g); });
    if (!column) return {};
    columns.push_back(*column);
  }
  return columns;
}

/// Detects turning that no encoder measures, from inertial units and the encoders before them.
class UnmeasuredTurning {
 public:
  UnmeasuredTurning(const DiagnosisInput& input, const Measurements& measured) {
    for (std::size_t s = 0; s < input.sensors.size(); ++s) {
      if (measured.imus[s].empty()) continue;
      units_.push_back(
          {&measured.imus[s],
           AnglesTo(*input.model, measured, input.model->LinkIndex(input.sensors[s].link))});
    }
  }

  /// True if a unit turns faster than its encoders explain, averaged over kTurnsOver_s about
  /// `at_ns`.
  bool IsSeen(TimeNs at_ns) const {
    const TimeNs from_ns = at_ns - FromSeconds(kTurnsOver_s / 2),
                 to_ns = at_ns + FromSeconds(kTurnsOver_s / 2);
    return std::any_of(units_.begin(), units_.end(), [&](const Unit& unit) {
      double most = MeanRate_radps(*unit.samples, from_ns, to_ns);
      for (const Angle& angle : unit.angles)
        most -= WayOf_rad(angle, from_ns, to_ns) / kTurnsOver_s;
      return most > kLeastTurn_radps;
    });
  }

 private:
  struct Angle {
    const std::vector<EncoderSample>* samples = nullptr;
    std::size_t axis = 0;
  };
  struct Unit {
    const std::vector<ImuSample>* samples = nullptr;
    std::vector<Angle> angles;
  };

  /// Encoders of the rotary joints between the base and a link, as far as they exist.
  static std::vector<Angle> AnglesTo(const MachineModel& model, const Measurements& measured,
                                     int link) {
    std::vector<Angle> angles;
    for (; link > 0; link = model.joints[static_cast<std::size_t>(link) - 1].parent) {
      const Joint& joint = model.joints[static_cast<std::size_t>(link) - 1];
      if (joint.type == JointType::kPrismatic) continue;
      for (const NamedEncoders& named : measured.encoders) {
        const auto& axes = named.recording.axes;
        const auto axis = std::find_if(axes.begin(), axes.end(), [&](const EncoderAxis& one) {
          return one.name == joint.name;
        });
        if (axis == axes.end()) continue;
        angles.push_back({&named.recording.samples, static_cast<std::size_t>(axis - axes.begin())});
        break;
      }
    }
    return angles;
  }

  template <typename Sample>
  static auto FirstFrom(const std::vector<Sample>& samples, TimeNs t_ns) {
    return std::lower_bound(samples.begin(), samples.end(), t_ns,
                            [](const Sample& one, TimeNs t) { return one.t_ns < t; });
  }

  static double MeanRate_radps(const std::vector<ImuSample>& samples, TimeNs from_ns,
                               TimeNs to_ns) {
    double sum = 0, count = 0;
    for (auto one = FirstFrom(samples, from_ns); one != samples.end() && one->t_ns < to_ns; ++one) {
      sum += one->w_WS_S_radps.norm();
      ++count;
    }
    return count > 0 ? sum / count : 0;
  }

  /// Total variation of an angle.
  static double WayOf_rad(const Angle& angle, TimeNs from_ns, TimeNs to_ns) {
    double way = 0;
    std::optional<double> last;
    for (auto one = FirstFrom(*angle.samples, from_ns);
         one != angle.samples->end() && one->t_ns <= to_ns; ++one) {
      if (last) way += std::abs(one->q_rad[angle.axis] - *last);
      last = one->q_rad[angle.axis];
    }
    return way;
  }

  std::vector<Unit> units_;
};

struct Rest {
  double from_s = 0, to_s = 0;
};

/// Times in which the levers of all `columns` rest. Each row holds until the next.
std::vector<Rest> RestsOf(const TableRecording& levers, const std::vector<std::size_t>& columns,
                          TimeNs zero_ns) {
  std::vector<Rest> rests;
  bool rested = false;
  for (std::size_t k = 0; k < levers.t_ns.size(); ++k) {
    const double t_s = ToSeconds(levers.t_ns[k] - zero_ns);
    if (rested) rests.back().to_s = t_s;
    const bool now = std::all_of(columns.begin(), columns.end(), [&](std::size_t c) {
      return std::abs(levers.rows[k][c]) <= kNeutral;
    });
    if (now && !rested) rests.push_back({t_s, t_s});
    rested = now;
  }
  return rests;
}

std::vector<TravelWindow> StillWindows(const DiagnosisInput& input, const Measurements& measured,
                                       const std::vector<std::size_t>& columns, TimeNs zero_ns) {
  std::vector<TravelWindow> windows;
  const UnmeasuredTurning turning(input, measured);
  for (const Rest& rest : RestsOf(input.commands, columns, zero_ns)) {
    const double end_s = rest.to_s - kStampedLate_s;
    for (double t_s = rest.from_s + kLongestEffect_s; t_s + kWindow_s <= end_s; t_s += kWindow_s) {
      if (turning.IsSeen(zero_ns + FromSeconds(t_s + kWindow_s / 2))) continue;
      TravelWindow window{t_s, t_s + kWindow_s};
      window.is_still = true;
      windows.push_back(window);
    }
  }
  return windows;
}

}  // namespace

std::vector<TravelWindow> StandingByLevers(const DiagnosisInput& input,
                                           const Measurements& measured, TimeNs zero_ns) {
  const std::vector<std::size_t> columns = GearColumns(input);
  if (columns.empty()) return {};
  return StillWindows(input, measured, columns, zero_ns);
}

std::vector<TravelWindow> RestingByLever(const DiagnosisInput& input, const Measurements& measured,
                                         std::size_t joint, TimeNs zero_ns) {
  const auto column =
      ColumnOf(input, [&](const Lever& lever) { return lever.joint == static_cast<int>(joint); });
  if (!column) return {};
  return StillWindows(input, measured, {*column}, zero_ns);
}

}  // namespace tera
