#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "blind/cases/recording_files.h"
#include "blind/mujoco/cases/whole_case.h"

namespace tera::blind::mujoco {
namespace {

constexpr double kGrid_s = 0.02;
constexpr double kInterval_s = 1;  ///< over which receivers tell a speed

std::string NameOf(const WholeCase& c) { return fmt::format("mujoco/{}", c.about.number); }

/// How fast the base goes ahead, and turns.
std::pair<double, double> Travel(const Course& course, double t_s) {
  const Instant &from = course.At(t_s - kInterval_s / 2), &to = course.At(t_s + kInterval_s / 2);
  const Vec3 ahead = from.q_WB * Vec3::UnitX(), later = to.q_WB * Vec3::UnitX();
  const double way_m = (to.p_WB_m - from.p_WB_m).dot((ahead + later).normalized());
  const double turn_rad =
      std::atan2(ahead.x() * later.y() - ahead.y() * later.x(), ahead.dot(later));
  return {way_m / kInterval_s, turn_rad / kInterval_s};
}

/// Change by one effect in the channels that show it, over their noise: the largest one.
class Comparison {
 public:
  Comparison(const MachineNumbers& numbers, const Forms& with, const Course& course_with,
             const Forms& without, const Course& course_without)
      : numbers_(numbers),
        with_(with),
        without_(without),
        course_with_(course_with),
        course_without_(course_without),
        readings_with_(numbers, course_with, with.sensors),
        readings_without_(numbers, course_without, without.sensors) {}

  double At(const std::string& channel, double t_s) const {
    const NoiseForm& noise = with_.sensors.noise;
    if (channel == "base") {
      const auto [forward, turn] = Travel(course_with_, t_s);
      const auto [other_forward, other_turn] = Travel(course_without_, t_s);
      const double noise_mps = std::sqrt(2.0) * noise.white_m / kInterval_s;
      return std::max(std::abs(forward - other_forward), std::abs(turn - other_turn)) / noise_mps;
    }
    for (std::size_t u = 0; u < kUnits; ++u) {
      if (channel == numbers_.units[u].name) return OfUnit(u, t_s);
    }
    for (std::size_t r = 0; r < kReceivers; ++r) {
      if (channel == numbers_.antennas[r].name) return OfReceiver(r, t_s);
    }
    for (std::size_t i = kSlew; i < kAxisCount; ++i) {
      if (channel.starts_with(fmt::format("encoders/{}", kAxisNames[i]))) return OfJoint(i, t_s);
    }
    return 0;
  }

 private:
  double OfUnit(std::size_t u, double t_s) const {
    const NoiseForm& noise = with_.sensors.noise;
    const auto a = readings_with_.Unit(u, t_s - Late(with_.sensors.units[u].clock, t_s));
    const auto b = readings_without_.Unit(u, t_s - Late(without_.sensors.units[u].clock, t_s));
    double most = 0;
    for (std::size_t i = 0; i < 6; ++i) {
      most = std::max(
          most, std::abs(a[i] - b[i]) / (i < 3 ? noise.gyro_radps : noise.accelerometer_mps2));
    }
    return most;
  }
  double OfReceiver(std::size_t r, double t_s) const {
    const ClockForm &a = with_.sensors.receivers[r].clock, &b = without_.sensors.receivers[r].clock;
    return (readings_with_.Receiver_m(r, t_s - Late(a, t_s)) -
            readings_without_.Receiver_m(r, t_s - Late(b, t_s)))
               .norm() /
           with_.sensors.noise.white_m;
  }
  double OfJoint(std::size_t i, double t_s) const {
    const NoiseForm& noise = with_.sensors.noise;
    const double rate = readings_with_.Rate_radps(i, t_s) - readings_without_.Rate_radps(i, t_s);
    if (with_.sensors.encoders[i] == without_.sensors.encoders[i]) {
      return std::abs(rate) / noise.rate_radps;
    }
    const double angle = readings_with_.Angle_rad(i, t_s) - readings_without_.Angle_rad(i, t_s);
    return std::max(std::abs(rate) / noise.rate_radps, std::abs(angle) / noise.angle_rad);
  }
  static double Late(const ClockForm& clock, double t_s) {
    return clock.OffsetAt(t_s) + clock.lateness_s;
  }

  const MachineNumbers& numbers_;
  const Forms &with_, &without_;
  const Course &course_with_, &course_without_;
  Readings readings_with_, readings_without_;
};

/// Slope of b over a through the origin.
double SlopeOf(const std::vector<double>& a, const std::vector<double>& b) {
  double ab = 0, aa = 0;
  for (std::size_t k = 0; k < a.size(); ++k) ab += a[k] * b[k], aa += a[k] * a[k];
  return ab / aa;
}

/// Sets the parameters of a track effect from the drive.
void SetTruth(const WholeCase& c, const MachineNumbers& numbers, const Forms& forms,
              const Course& course, Concealed* hidden) {
  std::vector<double> middle, apart, forward, turn;
  for (double t_s = 1; t_s < c.about.duration_s - 1; t_s += kGrid_s) {
    const Instant &from = course.At(t_s - kInterval_s / 2), &to = course.At(t_s + kInterval_s / 2);
    const auto way_m = [&](std::size_t i) {
      return numbers.radius_m * forms.plant.sprocket[static_cast<Eigen::Index>(i)] *
             (to.angle_rad[i] - from.angle_rad[i]);
    };
    middle.push_back((way_m(kLeftTrack) + way_m(kRightTrack)) / 2 / kInterval_s);
    apart.push_back((way_m(kRightTrack) - way_m(kLeftTrack)) / kInterval_s);
    const auto [ahead_mps, turn_radps] = Travel(course, t_s);
    forward.push_back(ahead_mps);
    turn.push_back(turn_radps);
  }
  if (hidden->name == "effective_gauge") {
    hidden->truth["ratio"] = 1 / (numbers.gauge_m * SlopeOf(apart, turn));
  } else if (hidden->name == "track_slip") {
    hidden->truth["slip"] = 1 - SlopeOf(middle, forward);
  }
}

Change ChangeOf(const Effect& effect, const Comparison& comparison, double duration_s) {
  Change change;
  for (double t_s = 0.1; t_s < duration_s; t_s += kGrid_s) {
    double most = 0;
    for (const std::string& channel : effect.concealed.channels) {
      most = std::max(most, comparison.At(channel, t_s));
    }
    change.t_s.push_back(t_s);
    change.over_noise.push_back(most);
  }
  return change;
}

}  // namespace

WholeRecording RecordWholeCase(WholeCase* c, const MachineNumbers& numbers, std::uint64_t seed) {
  const std::string name = NameOf(*c);
  const double duration_s = c->about.duration_s;
  const Stream messages(seed, name + "/messages");
  const Forms forms = c->With();
  const Course course = Drive(numbers, forms.plant, c->start, duration_s,
                              Hand(numbers, c->habit, Stream(seed, name + "/hand")), messages);
  WholeRecording out;
  out.measured = Measure(numbers, course, forms.sensors, duration_s, c->drives, seed, name);
  if (c->has_poses) {
    out.measured.poses = OwnersPoses(numbers, out.measured, c->start, !c->drives);
  }
  for (std::size_t i = 0; i < c->effects.size(); ++i) {
    SetTruth(*c, numbers, forms, course, &c->about.hidden[i]);
    const Forms without = c->With(i);
    Course other;
    if (c->effects[i].is_in_plant) {
      other =
          Drive(numbers, without.plant, c->start, duration_s, Replayed(course.levers), messages);
    }
    const Course& compared = c->effects[i].is_in_plant ? other : course;
    out.marks.changes.push_back(
        ChangeOf(c->effects[i], Comparison(numbers, forms, course, without, compared), duration_s));
  }
  for (std::size_t i = kSlew; i < kAxisCount; ++i) {
    out.marks.noise_rms[fmt::format("{}/encoders/{}_radps", kName, kAxisNames[i])] =
        forms.sensors.noise.rate_radps;
  }
  return out;
}

}  // namespace tera::blind::mujoco
