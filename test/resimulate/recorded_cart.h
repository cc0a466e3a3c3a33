#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/config/config.h"
#include "core/units.h"
#include "dataset/files/checked_file.h"
#include "dataset/format/recording.h"
#include "resimulate/motion/recorded_motion.h"
#include "sim/scenario/scenario.h"

/// A cart with a turning mast, and recordings of it without any simulation.

namespace tera {

inline constexpr double kMastHeight_m = 1.2;

/// The mast turns about z of the base, `kMastHeight_m` above it, by the lever `turn`.
inline constexpr const char* kCartMachine = R"(
kind: cart
fixed_base: FIXED
links:
  base: {mass_kg: 100, com_m: [0, 0, 0.2], inertia_kgm2: [10, 10, 10], label: structure}
  mast: {mass_kg: 10, com_m: [0, 0, 0.2], inertia_kgm2: [1, 1, 1], label: structure}
joints:
  turn: {type: revolute, parent: base, child: mast, xyz_m: [0, 0, 1.2], axis: [0, 0, 1],
         limits_deg: [-170, 170], max_rate_degps: 60, max_effort_nm: 500, initial_deg: 25}
levers: [turn]
)";

/// A wall of 8 m in x and 6 m in z whose face of -y is the plane y = 0.
inline constexpr const char* kWallMesh = R"(o body
v -4 0 0
v 4 0 0
v 4 0 6
v -4 0 6
v -4 0.2 0
v 4 0.2 0
v 4 0.2 6
v -4 0.2 6
f 1 2 3 4
f 6 5 8 7
f 5 1 4 8
f 2 6 7 3
f 4 3 7 8
f 5 6 2 1
)";

/// The cart on level ground at z = 0, and `more` of the scenario in YAML; files go to `folder`.
inline Scenario CartScenario(const std::filesystem::path& folder, const std::string& more = "",
                             bool fixed_base = false) {
  std::string machine = kCartMachine;
  machine.replace(machine.find("FIXED"), 5, fixed_base ? "true" : "false");
  WriteWholeFile(folder / "cart.yaml", machine);
  WriteWholeFile(folder / "wall.obj", kWallMesh);
  const Config config = Config::FromText(
      "name: cart\nduration_s: 10\nterrain: {size_m: [40, 40], cell_m: 0.5, soil: asphalt}\n"
      "machines:\n  - name: cart1\n    machine: " +
          (folder / "cart.yaml").string() +
          "\n    start: {xy_m: [3, -2], yaw_deg: 30, joints_deg: {turn: 40}}\n"
          "    operator: {type: idle}\n" +
          more,
      "cart.yaml");
  Scenario scenario = ReadScenario(config.root());
  config.Finish();
  return scenario;
}

/// Contents of a recording of the cart.
struct RecordedCart {
  std::vector<TimeNs> pose_t_ns, turn_t_ns;
  std::function<Pose(double t_s)> X_WB;        ///< empty: no poses
  std::function<double(double t_s)> turn_rad;  ///< empty: no encoder
  std::string machine = "real_cart";
  /// Times of pictures or scans; their files are not written.
  struct Frames {
    std::string sensor, type;
    std::vector<TimeNs> t_ns;
  };
  std::vector<Frames> frames = {};
};

inline std::vector<TimeNs> EvenTimes(double from_s, double to_s, double period_s) {
  std::vector<TimeNs> times;
  for (int k = 0; from_s + k * period_s < to_s + 0.5 * period_s; ++k) {
    times.push_back(FromSeconds(from_s + k * period_s));
  }
  return times;
}

inline Recording WriteCart(const std::filesystem::path& folder, const RecordedCart& cart) {
  std::string channels;
  if (cart.X_WB) {
    const std::string file = "truth/" + cart.machine + "/pose.csv";
    channels += "  - {path: " + file + ", type: pose}\n";
    std::string rows = "t_ns,x_m,y_m,z_m,qw,qx,qy,qz\n";
    for (const TimeNs t_ns : cart.pose_t_ns) {
      const Pose X_WB = cart.X_WB(ToSeconds(t_ns));
      const Vec3 p = X_WB.translation();
      const Eigen::Quaterniond q(X_WB.linear());
      rows += fmt::format("{},{:.9f},{:.9f},{:.9f},{:.12f},{:.12f},{:.12f},{:.12f}\n", t_ns, p.x(),
                          p.y(), p.z(), q.w(), q.x(), q.y(), q.z());
    }
    MakeWritableFolder((folder / file).parent_path());
    WriteWholeFile(folder / file, rows);
  }
  if (cart.turn_rad) {
    const std::string channel = cart.machine + "/encoders";
    channels += "  - {path: " + channel + ", type: encoder}\n";
    std::string rows = "t_ns,turn_rad,turn_radps\n";
    for (const TimeNs t_ns : cart.turn_t_ns) {
      rows += fmt::format("{},{:.12f},0\n", t_ns, cart.turn_rad(ToSeconds(t_ns)));
    }
    MakeWritableFolder(folder / channel);
    WriteWholeFile(folder / channel / "data.csv", rows);
  }
  for (const RecordedCart::Frames& frames : cart.frames) {
    const std::string channel = cart.machine + "/" + frames.sensor;
    channels += "  - {path: " + channel + ", type: " + frames.type + "}\n";
    std::string rows = "t_ns,filename\n";
    for (const TimeNs t_ns : frames.t_ns) rows += fmt::format("{},{}.png\n", t_ns, t_ns);
    MakeWritableFolder(folder / channel);
    WriteWholeFile(folder / channel / "data.csv", rows);
  }
  MakeWritableFolder(folder);
  WriteWholeFile(folder / "dataset.yaml",
                 "format: 1\ntera_version: \"0.1.0\"\nname: cart\nsimulated: false\nseed: 0\n"
                 "duration_s: 10\norigin: {lat_deg: 0, lon_deg: 0, height_m: 0}\nchannels:" +
                     (channels.empty() ? std::string(" []\n") : "\n" + channels) +
                     "classes:\n  - {id: 0, name: sky}\ninstances: []\n");
  return Recording(folder);
}

}  // namespace tera
