#pragma once

#include <filesystem>
#include <string>

#include "dataset/files/checked_file.h"
#include "own_folder.h"

/// A real recording of a boom with one camera and one lidar of two frames each, written by hand.

namespace tera {

inline void WriteFileAt(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::create_directories(file.parent_path());
  WriteWholeFile(file, text);
}

inline std::filesystem::path SmallRecording(const std::string& name) {
  const std::filesystem::path folder = OwnFolder() / name;
  WriteFileAt(folder / "dataset.yaml",
              "format: 1\ntera_version: \"0.2.0\"\nname: hand\nsimulated: false\nseed: 0\n"
              "duration_s: 2\norigin: {lat_deg: 47, lon_deg: 8, height_m: 460}\nchannels:\n"
              "  - {path: digger/commands.csv, type: table}\n"
              "  - {path: digger/camera, type: camera}\n"
              "  - {path: digger/lidar, type: lidar}\n"
              "classes:\n  - {id: 0, name: sky}\ninstances:\n"
              "  - {id: 1, name: \"truck\", class: truck}\n");
  WriteFileAt(folder / "digger/commands.csv", "t_ns,boom\n0,0.5\n1000000000,-1\n");
  WriteFileAt(folder / "digger/camera/data.csv",
              "t_ns,filename\n0,0.png\n1000000000,1000000000.png\n");
  WriteFileAt(folder / "digger/camera/sensor.yaml",
              "type: camera\nname: camera\nparent_link: boom\n"
              "X_parent_sensor: {xyz_m: [1, 2, 3], quaternion_wxyz: [1, 0, 0, 0]}\n"
              "model: {width_px: 8, height_px: 6, fx_px: 4, fy_px: 4, cx_px: 3.5, cy_px: 2.5}\n");
  WriteFileAt(folder / "digger/camera/rgb/0.png", "first picture");
  WriteFileAt(folder / "digger/camera/rgb/1000000000.png", "second picture");
  WriteFileAt(folder / "digger/lidar/data.csv",
              "t_ns,filename\n0,0.pcd\n1000000000,1000000000.pcd\n");
  WriteFileAt(folder / "digger/lidar/scans/0.pcd", "first scan");
  WriteFileAt(folder / "digger/lidar/scans/1000000000.pcd", "second scan");
  return folder;
}

}  // namespace tera
