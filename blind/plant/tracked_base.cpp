#include "blind/plant/tracked_base.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "blind/plant/integrator.h"
#include "core/error.h"

namespace tera::blind {
namespace {

constexpr double kTrackedBaseGravity_mps2 = 9.80665;
constexpr int kShoes = 11;
constexpr double kCreep_mps = 0.002;   ///< sliding at which friction is three quarters there
constexpr double kSlowest_mps = 0.02;  ///< of a shoe over the ground that it shears
constexpr double kGear_s = 0.01;       ///< of a sprocket after its lever

enum Place : std::size_t {
  kX,
  kY,
  kYaw,
  kForward,
  kLeft,
  kTurn,
  kRateL,
  kRateR,
  kAngleL,
  kAngleR,
  kSize
};

/// Force of the ground on a shoe that slides by (x, y), over its friction's limit and its sliding.
double Grip(const TrackForm& form, double slide_mps, double shoe_mps, double behind_front_m) {
  if (form.shear_m <= 0) {
    return slide_mps < 1e-9 ? 1 / kCreep_mps : std::tanh(slide_mps / kCreep_mps) / slide_mps;
  }
  const double sheared_s = behind_front_m / std::max(std::abs(shoe_mps), kSlowest_mps);
  if (slide_mps < 1e-9) return sheared_s / form.shear_m;
  return -std::expm1(-slide_mps * sheared_s / form.shear_m) / slide_mps;
}

struct Push {
  double forward_n = 0, left_n = 0, turning_nm = 0;
};

/// One track at y_m, its shoes running at shoe_mps, under a base that moves.
Push PushOf(const PlainTracks& tracks, const TrackForm& form, double y_m, double shoe_mps,
            std::span<const double> x) {
  Push push;
  const double load_n = tracks.mass_kg * kTrackedBaseGravity_mps2 / (2 * kShoes);
  const double direction = shoe_mps < 0 ? -1 : 1;
  for (int i = 0; i < kShoes; ++i) {
    const double along = (i + 0.5) / kShoes - 0.5;
    const double at_m = along * form.contact * tracks.contact_m;
    const double slide_x = x[kForward] - x[kTurn] * y_m - shoe_mps;
    const double slide_y = x[kLeft] + x[kTurn] * at_m;
    const double behind_m = (0.5 - direction * along) * tracks.contact_m;
    const double grip =
        form.friction * load_n * Grip(form, std::hypot(slide_x, slide_y), shoe_mps, behind_m);
    push.forward_n -= grip * slide_x;
    push.left_n -= grip * slide_y;
    push.turning_nm += grip * slide_x * y_m - grip * slide_y * at_m;
  }
  const double drag_n = form.drag * tracks.mass_kg * kTrackedBaseGravity_mps2 / 2 *
                        std::tanh(shoe_mps / kSlowest_mps);
  push.forward_n -= drag_n;
  push.turning_nm += drag_n * y_m;
  return push;
}

void Derive(const PlainTracks& tracks, const TrackForm& form, const TrackLevers& lever,
            std::span<const double> x, std::span<double> dx) {
  const double radius_m = tracks.radius_m;
  const Push left =
      PushOf(tracks, form, tracks.gauge_m / 2, x[kRateL] * radius_m * form.worn_left, x);
  const Push right =
      PushOf(tracks, form, -tracks.gauge_m / 2, x[kRateR] * radius_m * form.worn_right, x);
  dx[kX] = x[kForward] * std::cos(x[kYaw]) - x[kLeft] * std::sin(x[kYaw]);
  dx[kY] = x[kForward] * std::sin(x[kYaw]) + x[kLeft] * std::cos(x[kYaw]);
  dx[kYaw] = x[kTurn];
  dx[kForward] = (left.forward_n + right.forward_n) / tracks.mass_kg + x[kTurn] * x[kLeft];
  dx[kLeft] = (left.left_n + right.left_n) / tracks.mass_kg - x[kTurn] * x[kForward];
  dx[kTurn] = (left.turning_nm + right.turning_nm) / tracks.turning_kgm2;
  dx[kRateL] = (lever.left * tracks.full_rate_radps - x[kRateL]) / kGear_s;
  dx[kRateR] = (lever.right * tracks.full_rate_radps - x[kRateR]) / kGear_s;
  dx[kAngleL] = x[kRateL];
  dx[kAngleR] = x[kRateR];
}

void Sample(double t_s, std::span<const double> x, Drive* drive) {
  drive->t_s.push_back(t_s);
  drive->x_m.push_back(x[kX]);
  drive->y_m.push_back(x[kY]);
  drive->yaw_rad.push_back(x[kYaw]);
  drive->forward_mps.push_back(x[kForward]);
  drive->yaw_radps.push_back(x[kTurn]);
  drive->angle_rad.push_back({x[kAngleL], x[kAngleR]});
  drive->rate_radps.push_back({x[kRateL], x[kRateR]});
}

}  // namespace

PlainTracks PlainTracks::Read(const std::filesystem::path& machine_yaml) {
  try {
    const YAML::Node file = YAML::LoadFile(machine_yaml.string());
    const YAML::Node track = file["tracks"]["left_track"];
    PlainTracks tracks;
    tracks.gauge_m = file["gauge_m"].as<double>();
    tracks.radius_m = track["radius_m"].as<double>();
    tracks.contact_m = track["wheelbase_m"].as<double>();
    tracks.full_rate_radps = track["max_speed_mps"].as<double>() / tracks.radius_m;
    for (const auto& link : file["links"]) {
      const YAML::Node part = link.second;
      const double mass_kg = part["mass_kg"].as<double>();
      const double x_m = part["com_m"][0].as<double>();
      tracks.mass_kg += mass_kg;
      tracks.turning_kgm2 += part["inertia_kgm2"][2].as<double>() + mass_kg * x_m * x_m;
    }
    return tracks;
  } catch (const YAML::Exception& e) {
    throw InputError(
        fmt::format("{}: {}; need a machine on two tracks", machine_yaml.string(), e.what()));
  }
}

PlainTracks PlainTracks::Off(double share, const Stream& stream) const {
  PlainTracks off = *this;
  std::uint64_t draw = 0;
  for (double* number : {&off.full_rate_radps, &off.mass_kg, &off.turning_kgm2, &off.contact_m}) {
    *number *= 1 + share * (2 * stream.Uniform(draw++) - 1);
  }
  return off;
}

Drive DriveAlong(const PlainTracks& tracks, const TrackForm& form, double duration_s,
                 const std::vector<double>& sample_s, const TrackDriver& driver) {
  Drive drive;
  TrackLevers lever;
  Integrator integrator(
      std::vector<double>(kSize, 0.0),
      [&](double, auto x, auto dx) { Derive(tracks, form, lever, x, dx); }, 0, nullptr);
  std::size_t sample = 0;
  const auto commands = static_cast<std::size_t>(duration_s / drive.command_s + 0.5);
  for (std::size_t k = 0; k < commands; ++k) {
    const double t_s = static_cast<double>(k) * drive.command_s;
    const double end_s = static_cast<double>(k + 1) * drive.command_s;
    const TrackLevers next = driver(t_s);
    drive.lever.push_back(next);
    if (k > 0 && (next.left != lever.left || next.right != lever.right)) integrator.Restart();
    lever = next;
    for (; sample < sample_s.size() && sample_s[sample] < end_s; ++sample) {
      Sample(sample_s[sample], integrator.To(std::max(t_s, sample_s[sample])), &drive);
    }
    integrator.To(end_s);
  }
  return drive;
}

TrackDriver Replayed(const Drive& drive) {
  return [levers = drive.lever, command_s = drive.command_s](double t_s) {
    const auto k = static_cast<std::size_t>(t_s / command_s + 0.5);
    return levers[std::min(k, levers.size() - 1)];
  };
}

}  // namespace tera::blind
