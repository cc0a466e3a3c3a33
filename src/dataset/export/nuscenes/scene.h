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

/// The folder of tables; nuScenes' programs take it as the dataset's version.
inline constexpr char kNuScenesVersion[] = "v1.0-tera";

/// One machine's drive: a log with one scene. All constructor arguments must outlive it.
///
/// Model   samples are at frames of the first lidar, or of the first camera without a lidar, at
///         least their period apart. A scan's time is its middle. A sensor gets a new calibration
///         row whenever it has moved against the machine's root link since its last frame.
class NuScenesScene {
 public:
  /// `scene` is the index of the scene, `first_sensor` the number of sensors in earlier scenes.
  NuScenesScene(ExportJob* job, const NuScenesRig& rig, std::size_t scene, std::size_t first_sensor,
                const NuTokens& tokens, NuTables* tables);

  void Write();

 private:
  struct Mount {
    Pose X_BF = Pose::Identity();
    std::int64_t count = 0;  ///< number of the sensor's rows
  };

  std::int64_t sample_count() const { return static_cast<std::int64_t>(samples_ns_.size()); }
  std::string SampleToken(std::int64_t sample) const;  ///< empty without a sample
  void WriteLogAndScene();
  void WriteSensors();
  void WriteSamples();
  void WriteAnnotations();
  /// Objects in view at a sample. `scans_ns` has the time of each sensor's scan then, or none.
  std::vector<AnnotatedObject> ObjectsOf(std::size_t sample,
                                         const std::vector<TimeNs>& scans_ns) const;
  void WriteData();
  /// The files of a frame that are being written.
  struct WrittenFrame {
    std::size_t sensor = 0;
    TimeNs t_ns = 0;
    std::vector<std::filesystem::path> files;
  };
  using WrittenFrames = InOrder<WrittenFrame>;
  void WriteFrame(std::size_t sensor, std::size_t frame, WrittenFrames* frames);
  /// Queues the files of a frame, and adds the labels of a key scan to their table.
  void GiveFiles(std::size_t sensor, TimeNs t_ns, const std::string& file,
                 const std::string& key_token, WrittenFrames* frames);
  WrittenFrame WriteFiles(WrittenFrame frame) const;
  /// Token of the calibration row of the sensor's mount at a time. Writes a new row for a new
  /// mount.
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
  std::set<std::uint16_t> own_;                     ///< instances of the machine itself
  std::map<std::size_t, Mount> mounts_;
};

}  // namespace tera
