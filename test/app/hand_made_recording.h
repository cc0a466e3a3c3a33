#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>

#include "dataset/files/checked_file.h"

/// A recording of a boom without any simulation: levers, and an encoder on a joint with a given
/// response.

namespace tera {

/// Full rates of tb235's boom up and down, rad/s.
inline constexpr double kUp_radps = 25.8 * 3.14159265358979323846 / 180;
inline constexpr double kDown_radps = 30.8 * 3.14159265358979323846 / 180;

/// Pulse of 1 for `hold_s` from time 0, with flanks of 0.2 s that a boom's motor follows.
inline double HandMadePulse(double t_s, double hold_s) {
  return std::clamp(std::min(t_s, 0.2 + hold_s - t_s) / 0.2, 0.0, 1.0);
}

/// Strokes of many sizes with rests, equal for all recordings.
inline double HandMadeLever(double t_s) {
  constexpr double kSizes[] = {0.2, 0.5, 0.9, 0.3, 0.7, 0.15, 1.0, 0.4, 0.6, 0.25, 0.8, 0.35};
  constexpr double kPeriod_s = 2.8;
  const double u = kSizes[static_cast<int>(t_s / kPeriod_s) % 12];
  const double in_s = std::fmod(t_s, kPeriod_s), hold_s = std::min(0.9, 0.35 / u);
  return u * (HandMadePulse(in_s, hold_s) -
              HandMadePulse(in_s - 1.4, hold_s * kUp_radps / kDown_radps));
}

struct HandMade {
  double duration_s = 42, period_s = 0.02;
  double noise_radps = 0.003;
  double clock_s = 0;  ///< encoder's clock ahead of that of the commands
  std::function<double(double)> valve = [](double lever) { return lever; };
  double rate_factor = 1, position_factor = 1, lever_factor = 1;
  unsigned seed = 1;
};

/// Writes the recording to a new folder.
inline void WriteHandMade(const std::filesystem::path& folder, const HandMade& made) {
  namespace fs = std::filesystem;
  fs::create_directories(folder / "excavator1" / "encoders");
  WriteWholeFile(folder / "dataset.yaml",
                 "format: 1\ntera_version: \"0.1.0\"\nname: hand\nsimulated: false\nseed: 0\n"
                 "duration_s: 42\norigin: {lat_deg: 0, lon_deg: 0, height_m: 0}\nchannels:\n"
                 "  - {path: excavator1/commands.csv, type: table}\n"
                 "  - {path: excavator1/encoders, type: encoder}\n"
                 "classes:\n  - {id: 0, name: sky}\ninstances: []\n");
  std::ofstream commands(folder / "excavator1" / "commands.csv");
  std::ofstream encoders(folder / "excavator1" / "encoders" / "data.csv");
  commands << "t_ns,boom\n";
  encoders << "t_ns,boom_rad,boom_radps\n";
  unsigned state = made.seed;
  const auto noise = [&] {  // uniform, with the stated standard deviation
    state = state * 1664525u + 1013904223u;
    return made.noise_radps * std::sqrt(12.0) * (state / 4294967296.0 - 0.5);
  };
  double q_rad = 45 * 3.14159265358979323846 / 180;
  const int rows = static_cast<int>(made.duration_s / made.period_s);
  for (int k = 0; k < rows; ++k) {
    const double t_s = k * made.period_s;
    const long long t_ns = std::llround(t_s * 1e9), clock_ns = std::llround(made.clock_s * 1e9);
    const double lever = HandMadeLever(t_s);
    const double moved = made.valve(k > 0 ? HandMadeLever(t_s - made.period_s) : 0);
    const double rate_radps = moved * (moved > 0 ? kUp_radps : kDown_radps);
    q_rad += rate_radps * made.period_s;
    commands << t_ns << ',' << lever * made.lever_factor << '\n';
    encoders << t_ns + clock_ns << ',' << q_rad * made.position_factor << ','
             << (rate_radps + noise()) * made.rate_factor << '\n';
  }
}

/// The scenario for the comparison: a boom that follows its lever at once.
inline constexpr const char* kHandMadeScenario = R"(
name: boom
duration_s: 42
terrain: {size_m: [16, 16], cell_m: 0.2, soil: asphalt}
machines:
  - name: excavator1
    machine: tera:config/machines/tb235.yaml
    start: {joints_deg: {boom: 45, arm: -90, bucket: -40, blade: 20}}
    operator: {type: idle}
    rig: {sensors: [{name: encoders, preset: tera:config/sensors/encoder.yaml, joints: [boom]}]}
effects: {excavator1: {boom: {actuator_ring: none}}}
)";

/// A valve with a dead zone up to 0.1.
inline double DeadTo0_1(double lever) {
  return std::copysign(std::max(0.0, std::abs(lever) - 0.1), lever);
}

}  // namespace tera
