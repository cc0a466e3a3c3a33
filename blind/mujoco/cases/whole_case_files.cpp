#include <fmt/format.h>
#include <fmt/ranges.h>

#include <fstream>
#include <numbers>

#include "blind/cases/recording_files.h"
#include "blind/mujoco/cases/whole_case.h"
#include "core/error.h"

namespace tera::blind::mujoco {
namespace {

namespace fs = std::filesystem;

constexpr double kGround_m = 28;  ///< from the origin to each side

double Degrees(double rad) { return rad * 180 / std::numbers::pi; }

bool IsLevel(const Ground& ground) { return !ground.has_waves && ground.slope.isZero(0); }

/// As an owner writes it who takes his machine to be as its files say.
std::string ScenarioYaml(const WholeCase& c, const OwnersMachine& machine) {
  const std::string terrain =
      IsLevel(c.start.ground)
          ? fmt::format("{{size_m: [{0}, {0}], cell_m: 0.25, soil: asphalt}}", 2 * kGround_m)
          : "{geotiff: ground.tif, cell_m: 0.25, soil: asphalt}";
  std::string joints;
  for (std::size_t i = kSlew; i < kAxisCount; ++i) {
    joints += fmt::format("{}{}: {:.6f}", joints.empty() ? "" : ", ", kAxisNames[i],
                          Degrees(c.start.joints_rad[i - kSlew]));
  }
  return fmt::format(R"(name: owner
seed: 1
duration_s: {}
site: {{lat_deg: {}, lon_deg: {}, height_m: {}}}
terrain: {}
machines:
  - name: {}
    machine: {}
    ground: kinematic
    start: {{xy_m: [0, 0], yaw_deg: {:.6f}, joints_deg: {{{}}}}}
    operator: {{type: idle}}
    rig: {}
)",
                     c.about.duration_s, kLatitude_deg, kLongitude_deg, kHeight_m, terrain, kName,
                     machine.machine_yaml.filename().string(), Degrees(c.start.yaw_rad), joints,
                     machine.rig_yaml.filename().string());
}

std::string SensorYaml(const std::string& type, const std::string& link, const Vec3& xyz_m,
                       double period_s) {
  return fmt::format(
      "type: {}\nparent_link: {}\nX_parent_sensor: {{xyz_m: [{}, {}, {}], quaternion_wxyz: [1, 0, "
      "0, 0]}}\nrate_hz: {:.0f}\nmodel: {{}}\n",
      type, link, xyz_m.x(), xyz_m.y(), xyz_m.z(), 1 / period_s);
}

/// Writes the files of a recording and keeps the list of its channels.
class Folder {
 public:
  explicit Folder(fs::path recording) : recording_(std::move(recording)) {}

  static void Write(const fs::path& file, const std::string& text) {
    fs::create_directories(file.parent_path());
    std::ofstream stream(file, std::ios::binary);
    stream << text;
    stream.close();
    if (!stream)
      throw InputError(fmt::format("{}: cannot be written; check the disk", file.string()));
  }
  void WriteSensor(const std::string& name, const std::string& type, const std::string& yaml,
                   const Table& table) {
    const std::string path = fmt::format("{}/{}", kName, name);
    Write(recording_ / path / "sensor.yaml", yaml);
    WriteTable(path + "/data.csv", table);
    channels_ += fmt::format("  - {{path: \"{}\", type: {}}}\n", path, type);
  }
  void WriteFile(const std::string& path, const std::string& type, const Table& table) {
    WriteTable(path, table);
    channels_ += fmt::format("  - {{path: \"{}\", type: {}}}\n", path, type);
  }
  void Close(double duration_s) const {
    Write(recording_ / "dataset.yaml",
          fmt::format("format: 1\ntera_version: \"0.1.0\"\nname: \"owner\"\nsimulated: "
                      "false\nseed: 0\nduration_s: {}\norigin: {{lat_deg: {}, lon_deg: {}, "
                      "height_m: {}}}\nchannels:\n{}classes: []\ninstances: []\ninputs: []\n",
                      duration_s, kLatitude_deg, kLongitude_deg, kHeight_m, channels_));
  }

 private:
  void WriteTable(const std::string& path, const Table& table) const {
    std::string csv = fmt::format("t_ns,{}\n", fmt::join(table.columns, ","));
    for (std::size_t k = 0; k < table.t_ns.size(); ++k) {
      csv += fmt::format("{},{}\n", table.t_ns[k], fmt::join(table.rows[k], ","));
    }
    Write(recording_ / path, csv);
  }

  fs::path recording_;
  std::string channels_;
};

}  // namespace

void WriteWholeCase(const WholeCase& c, const OwnersMachine& machine, const Measured& measured,
                    const fs::path& folder) {
  Folder::Write(folder / "scenario.yaml", ScenarioYaml(c, machine));
  for (const fs::path& file : {machine.machine_yaml, machine.rig_yaml}) {
    fs::copy_file(file, folder / file.filename(), fs::copy_options::overwrite_existing);
  }
  if (!IsLevel(c.start.ground)) WriteGeoTiff(c.start.ground, kGround_m, folder / "ground.tif");
  Folder recording(folder / "recording");
  recording.WriteFile(fmt::format("{}/commands.csv", kName), "table", measured.commands);
  const std::string of_encoders = SensorYaml("encoders", "machine", Vec3::Zero(), kEncoderPeriod_s);
  recording.WriteSensor("encoders", "encoder", of_encoders, measured.joints);
  if (measured.tracks) {
    recording.WriteSensor("track_encoders", "encoder", of_encoders, *measured.tracks);
  }
  for (std::size_t u = 0; u < kUnits; ++u) {
    const Mount& mount = machine.numbers.units[u];
    recording.WriteSensor(mount.name, "imu",
                          SensorYaml("imu", kLinkNames[mount.link], mount.xyz_m, kUnitPeriod_s),
                          measured.units[u]);
  }
  for (std::size_t r = 0; r < kReceivers; ++r) {
    const Mount& mount = machine.numbers.antennas[r];
    recording.WriteSensor(
        mount.name, "gnss",
        SensorYaml("gnss", kLinkNames[mount.link], mount.xyz_m, kReceiverPeriod_s),
        measured.receivers[r]);
  }
  if (measured.poses && !measured.poses->rows.empty()) {
    recording.WriteFile(fmt::format("truth/{}/pose.csv", kName), "pose", *measured.poses);
  }
  recording.Close(c.about.duration_s);
}

}  // namespace tera::blind::mujoco
