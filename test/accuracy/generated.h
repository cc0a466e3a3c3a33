#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "core/config/config.h"
#include "core/units.h"
#include "dataset/format/recording.h"
#include "own_folder.h"
#include "physics/description/machine.h"
#include "sim/run/generate.h"

// A dataset written and read back, with its truth: a user's view of the files.

namespace tera {

inline Recording Generated(const std::string& name, const std::string& scenario_yaml) {
  const auto out = OwnFolder() / name;
  std::filesystem::remove_all(out);
  const Config config = Config::FromText(scenario_yaml, name + ".yaml");
  const Scenario scenario = ReadScenario(config.root());
  config.Finish();
  GenerateOptions options;
  options.out = out;
  Generate(scenario, config.ResolvedYaml(), options);
  return Recording(out);
}

/// X_parent_sensor of a sensor's folder.
inline Pose MountOf(const Recording& recording, const std::string& folder) {
  const Config config = Config::FromFile(recording.directory() / folder / "sensor.yaml");
  const auto rows = config.root().Map("X_parent_sensor").NumberRows("matrix", Any(""), 4, 4);
  Pose X_BS = Pose::Identity();
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 4; ++c) X_BS.matrix()(r, c) = rows.at(r).at(c);
  }
  return X_BS;
}

/// Intrinsics of a camera's folder.
inline CameraIntrinsics LensOf(const Recording& recording, const std::string& folder) {
  const Config config = Config::FromFile(recording.directory() / folder / "sensor.yaml");
  const ConfigMap model = config.root().Map("model");
  CameraIntrinsics lens;
  lens.width_px = static_cast<int>(model.Integer("width_px", Positive("px")));
  lens.height_px = static_cast<int>(model.Integer("height_px", Positive("px")));
  lens.fx_px = model.Number("fx_px", Positive("px"));
  lens.fy_px = model.Number("fy_px", Positive("px"));
  lens.cx_px = model.Number("cx_px", Any("px"));
  lens.cy_px = model.Number("cy_px", Any("px"));
  lens.k1 = model.Number("k1", Any("1"));
  lens.k2 = model.Number("k2", Any("1"));
  lens.p1 = model.Number("p1", Any("1"));
  lens.p2 = model.Number("p2", Any("1"));
  lens.k3 = model.Number("k3", Any("1"));
  return lens;
}

/// Poses of a machine's links from truth/<machine>/pose.csv and joints.csv.
class LinkTruth {
 public:
  LinkTruth(const Recording& recording, const std::string& machine, const std::string& file)
      : poses_(recording.LoadPose("truth/" + machine + "/pose.csv").poses),
        joints_(recording.LoadTable("truth/" + machine + "/joints.csv")) {
    const Config config = Config::FromFile(DataRoot() / "config/machines" / file);
    model_ = ReadMachine(config.root());
  }

  /// Index of the row at `t_ns`, or -1.
  int RowAt(TimeNs t_ns) const {
    const auto row = std::lower_bound(poses_.begin(), poses_.end(), t_ns,
                                      [](const TruthPose& p, TimeNs t) { return p.t_ns < t; });
    return row != poses_.end() && row->t_ns == t_ns ? static_cast<int>(row - poses_.begin()) : -1;
  }

  /// Pose of a link in row `row`, or extrapolated by `ahead_s` at that row's rates.
  Pose LinkPose(const std::string& link, int row, double ahead_s = 0) const {
    const TruthPose& root = poses_.at(row);
    std::vector<double> q_rad;
    for (std::size_t j = 0; j < model_.joints.size(); ++j) {
      q_rad.push_back(joints_.rows[row][3 * j] + ahead_s * joints_.rows[row][3 * j + 1]);
    }
    const Vec3 turn_B_rad = ahead_s * root.w_WB_B_radps;
    Pose X_WB = root.X_WB;
    X_WB.translation() += ahead_s * root.v_WB_mps;
    if (turn_B_rad.norm() > 0) {
      X_WB.rotate(Eigen::AngleAxisd(turn_B_rad.norm(), turn_B_rad.normalized()));
    }
    return ForwardKinematics(model_, X_WB, q_rad).at(model_.LinkIndex(link));
  }

  const std::vector<TruthPose>& root() const { return poses_; }

 private:
  std::vector<TruthPose> poses_;
  TableRecording joints_;
  MachineModel model_;
};

}  // namespace tera
