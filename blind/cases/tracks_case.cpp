#include "blind/cases/tracks_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace tera::blind {
namespace {

constexpr double kInterval_s = 0.2;  ///< over which the tool looks at poses

/// Someone who drives straight, in arcs and on the spot, forwards and back.
class Driving {
 public:
  explicit Driving(const Stream& stream) : stream_(stream) {}

  TrackLevers At(double t_s) {
    if (t_s >= to_s_) Next(t_s);
    const double share = std::min(1.0, (t_s - from_s_) / ramp_s_);
    const auto mixed = [&](double a, double b) {
      return std::round((a + share * (b - a)) * 250) / 250;
    };
    return {mixed(before_.left, goal_.left), mixed(before_.right, goal_.right)};
  }

 private:
  double Between(double low, double high) { return low + (high - low) * stream_.Uniform(draw_++); }

  void Next(double t_s) {
    before_ = goal_;
    from_s_ = t_s;
    to_s_ = t_s + Between(1.2, 3.0);
    ramp_s_ = Between(0.05, 0.8);
    const double kind = Between(0, 1), size = (Between(0, 1) < 0.5 ? -1 : 1) * Between(0.2, 0.9);
    const double other = size * Between(0.3, 0.9);
    if (kind < 0.15) {
      goal_ = {0, 0};
    } else if (kind < 0.4) {
      goal_ = {size, size};
    } else if (kind < 0.6) {
      goal_ = {size, other};
    } else if (kind < 0.8) {
      goal_ = {other, size};
    } else {
      goal_ = {size / 2, -size / 2};
    }
  }

  Stream stream_;
  std::uint64_t draw_ = 0;
  TrackLevers before_, goal_;
  double from_s_ = 0, to_s_ = 0, ramp_s_ = 1;
};

Table CommandsOf(const Drive& drive) {
  Table table{{"left_track", "right_track"}};
  for (std::size_t k = 0; k < drive.lever.size(); ++k) {
    table.t_ns.push_back(std::llround(static_cast<double>(k) * drive.command_s * 1e9));
    table.rows.push_back({drive.lever[k].left, drive.lever[k].right});
  }
  return table;
}

/// Sprockets as an encoder of two axes sees them.
Table EncodersOf(const Drive& drive, const EncoderNoise& noise, const Stream& stream) {
  Motion sprockets;
  sprockets.t_s = drive.t_s;
  for (std::size_t k = 0; k < drive.t_s.size(); ++k) {
    sprockets.q_rad.push_back({drive.angle_rad[k].left, drive.angle_rad[k].right, 0, 0});
    sprockets.w_radps.push_back({drive.rate_radps[k].left, drive.rate_radps[k].right, 0, 0});
  }
  const EncoderRows rows = Measure(sprockets, {0, 1}, noise, stream);
  Table table{{"left_track_rad", "right_track_rad", "left_track_radps", "right_track_radps"}};
  table.t_ns = rows.t_ns;
  for (std::size_t k = 0; k < rows.t_ns.size(); ++k) {
    table.rows.push_back(
        {rows.q_rad[k][0], rows.q_rad[k][1], rows.w_radps[k][0], rows.w_radps[k][1]});
  }
  return table;
}

/// Every second sample, as a reference that looks at the machine has it.
Table PosesOf(const Drive& drive, const PoseNoise& noise, const Stream& stream) {
  Table table{{"x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"}};
  double off[2] = {0, 0};
  const double fresh_m = noise.position_m * std::sqrt(1 - noise.memory * noise.memory);
  for (std::size_t k = 0; k < drive.t_s.size(); k += 2) {
    for (std::uint32_t i = 0; i < 2; ++i) {
      off[i] = noise.memory * off[i] + fresh_m * stream.Gaussian(k, i);
    }
    if (stream.Uniform(k, 5) < noise.lost) continue;
    const double half = (drive.yaw_rad[k] + noise.angle_rad * stream.Gaussian(k, 2)) / 2;
    const double sign = std::cos(half) < 0 ? -1 : 1;
    table.t_ns.push_back(std::llround(drive.t_s[k] * 1e6) * 1000);
    table.rows.push_back({drive.x_m[k] + off[0], drive.y_m[k] + off[1], 0, sign * std::cos(half), 0,
                          0, sign * std::sin(half)});
  }
  return table;
}

/// Noise of a difference of positions, and of headings, over the interval.
double TravelNoise_m(const PoseNoise& noise) {
  return noise.position_m * std::sqrt(2 * (1 - std::pow(noise.memory, 10)));
}
double TurnNoise_rad(const PoseNoise& noise) { return noise.angle_rad * std::sqrt(2.0); }

/// Change of forward speed or turning, whichever is stronger.
Change ChangeOf(const Drive& with, const Drive& without, const PoseNoise& noise) {
  Change change{with.t_s, {}};
  for (std::size_t k = 0; k < with.t_s.size(); ++k) {
    const double forward = (with.forward_mps[k] - without.forward_mps[k]) * kInterval_s;
    const double turn = (with.yaw_radps[k] - without.yaw_radps[k]) * kInterval_s;
    change.over_noise.push_back(
        std::max(std::abs(forward) / TravelNoise_m(noise), std::abs(turn) / TurnNoise_rad(noise)));
  }
  return change;
}

/// Slope of b over a through the origin.
double SlopeOf(const std::vector<double>& a, const std::vector<double>& b) {
  double ab = 0, aa = 0;
  for (std::size_t k = 0; k < a.size(); ++k) ab += a[k] * b[k], aa += a[k] * a[k];
  return ab / aa;
}

/// Sets the parameters of the names from the drive.
void SetTruth(const TracksCase& c, const Drive& drive, Concealed* hidden) {
  const double left_m = c.tracks.radius_m * c.form.worn_left;
  const double right_m = c.tracks.radius_m * c.form.worn_right;
  std::vector<double> middle, apart, forward = drive.forward_mps, turn = drive.yaw_radps;
  for (const TrackLevers& rate : drive.rate_radps) {
    middle.push_back((rate.left * left_m + rate.right * right_m) / 2);
    apart.push_back(rate.right * right_m - rate.left * left_m);
  }
  if (hidden->name == "effective_gauge") {
    hidden->truth["ratio"] = 1 / (c.tracks.gauge_m * SlopeOf(apart, turn));
  } else if (hidden->name == "track_slip") {
    hidden->truth["slip"] = 1 - SlopeOf(middle, forward);
  } else if (hidden->name == "track_scale") {
    hidden->truth["scale"] = (c.form.worn_left + c.form.worn_right) / 2;
  } else if (hidden->name == "track_asymmetry") {
    hidden->truth["difference"] =
        2 * (c.form.worn_right - c.form.worn_left) / (c.form.worn_right + c.form.worn_left);
  }
}

double SizeOf(Strength strength, const Stream& stream, double strong, double medium, double faint) {
  const double size = strength == Strength::kStrong   ? strong
                      : strength == Strength::kMedium ? medium
                                                      : faint;
  return size * std::exp(0.3 * (stream.Uniform(0) - 0.5));
}

}  // namespace

const std::vector<std::string>& NameableTrackEffects() {
  static const std::vector<std::string> names = {"effective_gauge", "track_slip", "track_scale",
                                                 "track_asymmetry"};
  return names;
}

Concealed HideInTracks(const std::string& name, Strength strength, const Stream& stream,
                       TrackForm* form) {
  Concealed concealed;
  concealed.target = "base";
  concealed.name = name;
  concealed.channels = {"base/forward_mps", "base/yaw_radps", "base/left_mps"};
  const auto size = [&](double strong, double medium, double faint) {
    return SizeOf(strength, stream, strong, medium, faint);
  };
  if (name == "effective_gauge") {
    form->contact = std::min(1.0, size(1, 0.6, 0.3));
    concealed.form = "friction of eleven shoes a track against their sliding";
    concealed.variables = {"turning", "speed"};
  } else if (name == "track_slip") {
    form->shear_m = 0.06;
    form->friction = 0.5;
    form->drag = size(0.33, 0.22, 0.12);
    concealed.form = "ground that shears under the thrust that rolling resistance needs";
    concealed.alike = {"track_scale", "rolling_resistance"};
    concealed.variables = {"speed", "turning"};  // of the speed ahead, and of the rate of turn
  } else if (name == "track_scale") {
    const double worn = 1 - size(0.12, 0.06, 0.03);
    form->worn_left *= worn;
    form->worn_right *= worn;
    concealed.form = "sprockets and shoes of another radius";
    concealed.alike = {"track_slip"};
    concealed.variables = {"speed", "turning"};
  } else {
    TERA_CHECK(name == "track_asymmetry", name);
    const double part = size(0.1, 0.05, 0.02) / 2;
    form->worn_left *= 1 - part;
    form->worn_right *= 1 + part;
    concealed.form = "one sprocket larger than the other";
    concealed.variables = {"speed"};
  }
  return concealed;
}

CaseRecording RecordTracks(const TracksCase& c, double duration_s, std::uint64_t seed,
                           const std::string& name, std::vector<Concealed>* hidden) {
  const std::vector<double> times = SampleTimes(duration_s, c.noise, Stream(seed, name + "/times"));
  Driving someone(Stream(seed, name + "/operator"));
  const Drive drive =
      DriveAlong(c.tracks, c.form, duration_s, times, [&](double t_s) { return someone.At(t_s); });
  CaseRecording recording;
  recording.commands = CommandsOf(drive);
  recording.encoders = EncodersOf(drive, c.noise, Stream(seed, name + "/measurement"));
  recording.poses = PosesOf(drive, c.pose_noise, Stream(seed, name + "/poses"));
  const std::string base = std::string(kName) + "/base/";
  recording.noise_rms[base + "forward_mps"] = TravelNoise_m(c.pose_noise) / kInterval_s;
  recording.noise_rms[base + "yaw_radps"] = TurnNoise_rad(c.pose_noise) / kInterval_s;
  if (hidden->empty()) return recording;
  for (std::size_t i = 0; i < hidden->size(); ++i) {
    SetTruth(c, drive, &(*hidden)[i]);
    const Drive without = DriveAlong(c.tracks, c.without[i], duration_s, times, Replayed(drive));
    recording.changes.push_back(ChangeOf(drive, without, c.pose_noise));
  }
  return recording;
}

}  // namespace tera::blind
