#include "blind/cases/recording_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/error.h"

namespace tera::blind {
namespace {

namespace fs = std::filesystem;

void Write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) {
    throw InputError(
        fmt::format("{}: cannot be written; check the disk and the path", file.string()));
  }
}

/// YAML of a real vehicle, whose effective gauge is known from elsewhere.
std::string VehicleYaml(const BenchmarkCase& c) {
  return fmt::format(R"(name: blind
seed: 1
duration_s: {}
terrain: {{size_m: [120, 120], cell_m: 0.5, soil: asphalt}}
machines:
  - name: {}
    machine: {}
    operator: {{type: idle}}
    ground: kinematic
    rig: {{sensors: [{{name: encoders, preset: "tera:config/sensors/encoder.yaml", joints: [left_track, right_track]}}]}}
effects:
  {}: {{base: {{effective_gauge: {{ratio: 1.75}}}}}}
)",
                     c.duration_s, kName, kVehicle, kName);
}

/// Expected deviations of the blind machine's owner: its numbers are off by up to 3 %, and
/// measurements are a few milliseconds late.
std::string OwnersTolerances(const std::vector<std::string>& axes) {
  std::string text = fmt::format("tolerances:\n  {}:\n", kName);
  for (const std::string& axis : axes) {
    text += fmt::format(
        "    {}: {{rate_gain: {{gain: 0.03}}, asymmetric_gain: {{ratio: 0.03}}, "
        "lever_saturation: {{limit: 0.03}}, valve_curve: {{exponent: 0.05}}, "
        "command_delay: {{delay_s: 0.015}}, actuator_lag: {{time_s: 0.015}}, "
        "input_hold: {{period_s: 0.03}}, drive_friction: {{lost_radps: 0.003}}}}\n",
        axis);
  }
  return text +
         "    base: {track_scale: {scale: 0.01}, track_slip: {slip: 0.01}, "
         "effective_gauge: {ratio: 0.03}}\n";
}

/// Start, encoders, tolerances, and the rings that the machine's file has and this machine has not.
std::string ScenarioYaml(const BenchmarkCase& c) {
  std::string start, rings;
  std::vector<std::string> measured;
  if (c.joints) {
    for (std::size_t i = 0; i < kAxes; ++i) {
      start +=
          fmt::format("{}: {:.6f}, ", kJoints[i], c.joints->start_rad[i] * 180 / std::numbers::pi);
    }
    for (const std::size_t axis : c.joints->measured) measured.push_back(kJoints[axis]);
  } else {
    measured = {"left_track", "right_track"};
  }
  for (const std::string& axis : measured) {
    rings += fmt::format("    {}: {{actuator_ring: none}}\n", axis);
  }
  return fmt::format(R"(name: blind
seed: 1
duration_s: {}
terrain: {{size_m: [24, 24], cell_m: 0.5, soil: asphalt}}
machines:
  - name: {}
    machine: {}
    start: {{joints_deg: {{{}blade: 20}}}}
    operator: {{type: idle}}
    ground: kinematic
    rig: {{sensors: [{{name: encoders, preset: "tera:config/sensors/encoder.yaml", joints: [{}]}}]}}
effects:
  {}:
{}{})",
                     c.duration_s, kName, kMachine, start, fmt::join(measured, ", "), kName, rings,
                     OwnersTolerances(measured));
}

std::string DatasetYaml(const BenchmarkCase& c) {
  const std::string commands =
      c.injected ? "" : fmt::format("  - {{path: \"{}/commands.csv\", type: table}}\n", kName);
  const std::string pose =
      c.tracks || c.injected
          ? fmt::format("  - {{path: \"truth/{}/pose.csv\", type: pose}}\n", kName)
          : "";
  return fmt::format(R"(format: 1
tera_version: "0.1.0"
name: "blind"
simulated: false
seed: 0
duration_s: {}
origin: {{lat_deg: 0, lon_deg: 0, height_m: 0}}
channels:
{}  - {{path: "{}/encoders", type: encoder}}
{}classes:
  - {{id: 0, name: sky}}
instances: []
)",
                     c.duration_s, commands, kName, pose);
}

std::string Csv(const Table& table) {
  std::string csv = fmt::format("t_ns,{}\n", fmt::join(table.columns, ","));
  for (std::size_t k = 0; k < table.t_ns.size(); ++k) {
    csv += fmt::format("{},{}\n", table.t_ns[k], fmt::join(table.rows[k], ","));
  }
  return csv;
}

std::string SensorYaml() { return "type: encoder\nname: encoders\nrate_hz: 100\nlatency_s: 0\n"; }

}  // namespace

void WriteCase(const BenchmarkCase& c, const CaseRecording& recording, const fs::path& folder) {
  Write(folder / "scenario.yaml", c.injected ? VehicleYaml(c) : ScenarioYaml(c));
  const fs::path data = folder / "recording";
  if (!c.injected) Write(data / kName / "commands.csv", Csv(recording.commands));
  Write(data / kName / "encoders" / "data.csv", Csv(recording.encoders));
  Write(data / kName / "encoders" / "sensor.yaml", SensorYaml());
  if (!recording.poses.columns.empty())
    Write(data / "truth" / kName / "pose.csv", Csv(recording.poses));
  Write(data / "dataset.yaml", DatasetYaml(c));
}

std::string TruthJson(const BenchmarkCase& c, const CaseRecording& recording) {
  nlohmann::ordered_json json = {{"case", c.number + 1},
                                 {"kind", std::string(NameOf(c.kind))},
                                 {"hidden", nlohmann::ordered_json::array()}};
  if (HasStrength(c.kind)) json["strength"] = NameOf(c.strength);
  for (std::size_t i = 0; i < c.hidden.size(); ++i) {
    const Concealed& hidden = c.hidden[i];
    json["hidden"].push_back({{"target", hidden.target},
                              {"name", hidden.name},
                              {"form", hidden.form},
                              {"truth", hidden.truth},
                              {"variables", hidden.variables},
                              {"signal_to_noise", recording.changes[i].Rms()}});
  }
  return json.dump(2) + "\n";
}

}  // namespace tera::blind
