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

/// Name of the folder of tables, which nuScenes tools take as the dataset version.
inline constexpr char kNuScenesVersion[] = "v1.0-tera";

/// The recording of one machine, as one log with one scene. All constructor arguments must outlive
/// the object.
///
/// Model   Samples are taken from the first lidar, or from the first camera if there is no lidar;
///         SampleTimes selects them. The time of a scan is its middle. Whenever a sensor has moved
///         relative to the root link since its last frame, it gets a new row of calibration.
class NuScenesScene {
 public:
  /// `scene` is the index of the scene. `first_sensor` is the number of sensors in all earlier
  /// scenes.
  NuScenesScene(ExportJob* job, const NuScenesRig& rig, std::size_t scene, std::size_t first_sensor,
                const NuTokens& tokens, NuTables* tables);

  void Write();

 private:
  struct Mount {
    Pose X_BF = Pose::Identity();
    std::int64_t count = 0;  ///< calibration rows of the sensor so far
  };

  std::int64_t sample_count() const { return static_cast<std::int64_t>(samples_ns_.size()); }
  std::string SampleToken(std::int64_t sample) const;  ///< empty if there is no such sample
  void WriteLogAndScene();
  void WriteSensors();
  void WriteSamples();
  void WriteAnnotations();
  /// Objects in view at a sample. `scans_ns` holds, per sensor, the time of its scan for this
  /// sample, if it has one.
  std::vector<AnnotatedObject> ObjectsOf(std::size_t sample,
                                         const std::vector<TimeNs>& scans_ns) const;
  void WriteData();
  /// A frame whose files are being written.
  struct WrittenFrame {
    std::size_t sensor = 0;
    TimeNs t_ns = 0;
    std::vector<std::filesystem::path> files;
  };
  using WrittenFrames = InOrder<WrittenFrame>;
  void WriteFrame(std::size_t sensor, std::size_t frame, WrittenFrames* frames);
  /// Queues the writing of a frame's files. Labels of a key scan are added to their table.
  void GiveFiles(std::size_t sensor, TimeNs t_ns, const std::string& file,
                 const std::string& key_token, WrittenFrames* frames);
  WrittenFrame WriteFiles(WrittenFrame frame) const;
  /// Token of the calibration row for the sensor's mounting pose at `t_ns`. Writes a new row if the
  /// pose has changed.
  std::string MountToken(std::size_t sensor, TimeNs t_ns);

  ExportJob* job_;
  const NuScenesRig& rig_;
  std::size_t scene_, first_sensor_;
  const NuTokens& tokens_;
  NuTables* tables_;
  std::string log_name_;
  TimeNs period_ns_ = 0;
  std::vector<TimeNs> samples_ns_;
  std::vector<SensorFrames> files_;                 ///< per sensor
  std::vector<std::vector<FrameOfSample>> frames_;  ///< per sensor
  std::set<std::uint16_t> own_;                     ///< instances that belong to the machine itself
  std::map<std::size_t, Mount> mounts_;
};

}  // namespace tera
