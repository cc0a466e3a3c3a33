#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "dataset/export/nuscenes/annotations.h"
#include "dataset/export/nuscenes/key_frames.h"
#include "dataset/export/nuscenes/nuscenes_rig.h"
#include "dataset/export/nuscenes/nuscenes_tables.h"
#include "dataset/export/nuscenes/sensor_frames.h"
#include "dataset/files/in_order.h"

namespace tera {

/// The name of the folder of tables, which nuScenes' programs are given as the dataset's version.
inline constexpr char kNuScenesVersion[] = "v1.0-tera";

/// One machine's drive: a log with one scene. All that it is given outlives it.
///
/// Model   samples are at frames of the first lidar, else of the first camera, and their period
///         apart; a scan is at its middle. A sensor has a new row of calibration whenever it has
///         moved against the machine's root link since its last frame.
class NuScenesScene {
 public:
  /// `scene` counts scenes, `first_sensor` the sensors of the scenes before.
  NuScenesScene(ExportJob* job, const NuScenesRig& rig, std::size_t scene, std::size_t first_sensor,
                const NuTokens& tokens, NuTables* tables);

  void Write();

 private:
  struct Mount {
    Pose X_BF = Pose::Identity();
    std::int64_t count = 0;  ///< of the rows that the sensor has
  };

  std::int64_t sample_count() const { return static_cast<std::int64_t>(samples_ns_.size()); }
  std::string SampleToken(std::int64_t sample) const;  ///< empty: there is none
  void WriteLogAndScene();
  void WriteSensors();
  void WriteSamples();
  void WriteAnnotations();
  /// What is to be seen at a sample; of each sensor the time of its scan then, or none.
  std::vector<AnnotatedObject> ObjectsOf(std::size_t sample,
                                         const std::vector<TimeNs>& scans_ns) const;
  void WriteData();
  /// The files of a frame that are written.
  struct WrittenFrame {
    std::size_t sensor = 0;
    TimeNs t_ns = 0;
    std::vector<std::filesystem::path> files;
  };
  using WrittenFrames = InOrder<WrittenFrame>;
  void WriteFrame(std::size_t sensor, std::size_t frame, WrittenFrames* frames);
  /// Gives the files to be written; their names are in tables then.
  void GiveFiles(std::size_t sensor, TimeNs t_ns, const std::string& file,
                 const std::string& key_token, WrittenFrames* frames);
  WrittenFrame WriteFiles(WrittenFrame frame) const;
  /// Of the row of the sensor's mount at a time, which is written where it is a new one.
  std::string MountToken(std::size_t sensor, TimeNs t_ns);

  ExportJob* job_;
  const NuScenesRig& rig_;
  std::size_t scene_, first_sensor_;
  const NuTokens& tokens_;
  NuTables* tables_;
  std::string log_name_;
  TimeNs period_ns_ = 0;
  std::vector<TimeNs> samples_ns_;
  std::vector<SensorFrames> files_;                 ///< of each sensor
  std::vector<std::vector<FrameOfSample>> frames_;  ///< of each sensor
  std::set<std::uint16_t> own_;                     ///< instances of the machine itself
  std::map<std::size_t, Mount> mounts_;
};

}  // namespace tera
