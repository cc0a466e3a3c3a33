#include "blind/mujoco/sensors/measured.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "blind/mujoco/sensors/logger.h"

namespace tera::blind::mujoco {
namespace {

constexpr double kTau = 2 * std::numbers::pi;
constexpr double kEncoderCounts_1prad = 16384 / kTau;

/// The nearest of `per_unit` values in a unit.
double Rounded(double x, double per_unit) { return std::round(x * per_unit) / per_unit; }

double Counted(double angle_rad) {
  return Rounded(std::round(angle_rad * kEncoderCounts_1prad) / kEncoderCounts_1prad, 1e5);
}

Table CommandsOf(const Levers& levers) {
  Table table{{kAxisNames.begin(), kAxisNames.end()}, {}, {}};
  for (std::size_t k = 0; k < levers.rows.size(); ++k) {
    table.t_ns.push_back(std::llround(static_cast<double>(k) * levers.period_s * 1e9));
    table.rows.emplace_back(levers.rows[k].begin(), levers.rows[k].end());
  }
  return table;
}

/// Joints, or tracks, whose noise is another.
class Encoders {
 public:
  Encoders(const Readings& readings, const SensorsForm& form, std::uint64_t seed,
           const std::string& name)
      : readings_(readings), form_(form), seed_(seed), name_(name) {}

  Table Of(std::size_t first, std::size_t end, const ClockForm& clock, double rate_noise_radps,
           double duration_s) const {
    const std::string own = fmt::format("{}/encoders_{}", name_, first);
    Table table;
    for (std::size_t i = first; i < end; ++i)
      table.columns.push_back(fmt::format("{}_rad", kAxisNames[i]));
    for (std::size_t i = first; i < end; ++i)
      table.columns.push_back(fmt::format("{}_radps", kAxisNames[i]));
    const NoiseForm& noise = form_.noise;
    std::vector<Noise> angle, rate;
    for (std::size_t i = first; i < end; ++i) {
      angle.emplace_back(seed_, fmt::format("{}/{}/angle", own, i), noise.angle_rad, 0.0003,
                         noise.tails, 5);
      rate.emplace_back(seed_, fmt::format("{}/{}/rate", own, i), rate_noise_radps, 0.002,
                        noise.tails, 5);
    }
    for (const Row& row : Log(duration_s, kEncoderPeriod_s, clock, noise, seed_, own)) {
      std::vector<double> angles, rates;
      for (std::size_t i = first; i < end; ++i) {
        angles.push_back(Counted(readings_.Angle_rad(i, row.true_s) +
                                 angle[i - first].Next(row.number, kEncoderPeriod_s)));
        rates.push_back(Rounded(readings_.Rate_radps(i, row.true_s) +
                                    rate[i - first].Next(row.number, kEncoderPeriod_s),
                                1000));
      }
      angles.insert(angles.end(), rates.begin(), rates.end());
      table.t_ns.push_back(row.t_ns);
      table.rows.push_back(std::move(angles));
    }
    return table;
  }

 private:
  const Readings& readings_;
  const SensorsForm& form_;
  std::uint64_t seed_;
  std::string name_;
};

/// Two lines of the engine as an axis feels them, whose speed wanders a little.
double EngineAt(double t_s, double engine_hz, const Stream& axis) {
  const double turns = engine_hz * t_s + 0.3 * std::sin(0.2 * t_s);
  return axis.Uniform(0) * std::sin(kTau * (turns + axis.Uniform(1))) +
         0.5 * axis.Uniform(2) * std::sin(kTau * (2 * turns + axis.Uniform(3)));
}

Table UnitOf(const Readings& readings, std::size_t unit, const SensorsForm& form, double duration_s,
             std::uint64_t seed, const std::string& name) {
  const std::string own = fmt::format("{}/unit_{}", name, unit);
  const NoiseForm& n = form.noise;
  Table table{{"wx_radps", "wy_radps", "wz_radps", "ax_mps2", "ay_mps2", "az_mps2"}, {}, {}};
  std::vector<Noise> noise;
  std::vector<Stream> engine;
  for (std::size_t i = 0; i < 6; ++i) {
    const bool gyro = i < 3;
    noise.emplace_back(seed, fmt::format("{}/{}", own, i),
                       gyro ? n.gyro_radps : n.accelerometer_mps2,
                       gyro ? n.gyro_slow_radps : n.accelerometer_slow_mps2, n.tails, 20);
    engine.emplace_back(seed, fmt::format("{}/{}/engine", own, i));
  }
  for (const Row& row : Log(duration_s, kUnitPeriod_s, form.units[unit].clock, n, seed, own)) {
    const std::array<double, 6> ideal = readings.Unit(unit, row.true_s);
    std::vector<double> values;
    for (std::size_t i = 0; i < 6; ++i) {
      const double line =
          EngineAt(row.true_s, n.engine_hz, engine[i]) * (i < 3 ? n.engine_radps : n.engine_mps2);
      const double value = ideal[i] + line + noise[i].Next(row.number, kUnitPeriod_s);
      values.push_back(Rounded(value, i < 3 ? 2000 : 200));
    }
    table.t_ns.push_back(row.t_ns);
    table.rows.push_back(std::move(values));
  }
  return table;
}

/// Times without fixed ambiguities, and what the place is off by in them.
class Floats {
 public:
  Floats(const NoiseForm& noise, std::uint64_t seed, const std::string& name)
      : rate_1ps_(noise.floats_1ps), stream_(seed, name + "/floats") {}
  bool Has(const Row& row) {
    if (stream_.Uniform(row.number) < rate_1ps_ * kReceiverPeriod_s) {
      until_s_ = row.true_s + 3 + 5 * stream_.Uniform(row.number, 1);
      off_m = 0.2 * stream_.Gaussian3(row.number, 2);
    }
    return row.true_s < until_s_;
  }
  Vec3 off_m = Vec3::Zero();

 private:
  double rate_1ps_, until_s_ = 0;
  Stream stream_;
};

Table ReceiverOf(const Readings& readings, std::size_t receiver, const SensorsForm& form,
                 double duration_s, std::uint64_t seed, const std::string& name) {
  const std::string own = fmt::format("{}/receiver_{}", name, receiver);
  const NoiseForm& n = form.noise;
  Table table{{"lat_deg", "lon_deg", "alt_m", "east_m", "north_m", "up_m", "fix", "var_e_m2",
               "var_n_m2", "var_u_m2"},
              {},
              {}};
  std::vector<Noise> noise;
  for (std::size_t i = 0; i < 3; ++i) {
    noise.emplace_back(seed, fmt::format("{}/{}", own, i), i < 2 ? n.white_m : n.white_up_m,
                       i < 2 ? n.slow_m : n.slow_up_m, n.tails, 30);
  }
  Floats floats(n, seed, own);
  for (const Row& row :
       Log(duration_s, kReceiverPeriod_s, form.receivers[receiver].clock, n, seed, own)) {
    const bool is_float = floats.Has(row);
    Vec3 place_m = readings.Receiver_m(receiver, row.true_s);
    for (Eigen::Index i = 0; i < 3; ++i) {
      place_m[i] += noise[static_cast<std::size_t>(i)].Next(row.number, kReceiverPeriod_s) +
                    (is_float ? floats.off_m[i] : 0);
      place_m[i] = Rounded(place_m[i], 1000);
    }
    const Vec3 geodetic = Geodetic(place_m);
    const double var_m2 = is_float ? 0.04 : 0.00012, var_up_m2 = is_float ? 0.09 : 0.000384;
    table.t_ns.push_back(row.t_ns);
    table.rows.push_back({Rounded(geodetic.x(), 1e9), Rounded(geodetic.y(), 1e9),
                          Rounded(geodetic.z(), 1e4), place_m.x(), place_m.y(), place_m.z(),
                          is_float ? 5.0 : 4.0, var_m2, var_m2, var_up_m2});
  }
  return table;
}

}  // namespace

Measured Measure(const MachineNumbers& numbers, const Course& course, const SensorsForm& form,
                 double duration_s, bool has_tracks, std::uint64_t seed, const std::string& name) {
  const Readings readings(numbers, course, form);
  const Encoders encoders(readings, form, seed, name);
  const NoiseForm& noise = form.noise;
  Measured out;
  out.commands = CommandsOf(course.levers);
  out.joints = encoders.Of(kSlew, kAxisCount, form.joint_clock, noise.rate_radps, duration_s);
  if (has_tracks) {
    out.tracks = encoders.Of(kLeftTrack, kSlew, form.track_clock, noise.track_radps, duration_s);
  }
  for (std::size_t u = 0; u < kUnits; ++u) {
    out.units[u] = UnitOf(readings, u, form, duration_s, seed, name);
  }
  for (std::size_t r = 0; r < kReceivers; ++r) {
    out.receivers[r] = ReceiverOf(readings, r, form, duration_s, seed, name);
  }
  return out;
}

}  // namespace tera::blind::mujoco
