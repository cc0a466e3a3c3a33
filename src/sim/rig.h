#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "dataset/format/measurement_sink.h"
#include "sensors/slots/sensor_slots.h"
#include "sim/gnss_reflector.h"
#include "sim/scenario/scenario.h"
#include "sim/scene_assembly.h"
#include "sim/simulation.h"

namespace tera {

/// Axes that an encoder reads, joints before gears, as indices into the machine's lists.
struct EncodedAxes {
  std::vector<int> joints, gears;
  std::vector<std::string> unknown;  ///< names that the machine lacks
};

/// The axes that `encoder` names, or all that move where it names none.
EncodedAxes AxesOf(const EncoderModel& encoder, const MachineModel& machine);

/// Their names and kinds, in that order.
std::vector<EncoderAxis> NamesOf(const EncodedAxes& axes, const MachineModel& machine);

/// All sensors of a scenario, sampled as they fall due and written.
///
/// Frames  W; each sensor's S at X_BS on its link, or where its effects put it.
/// Model   what a sensor's own model measures passes through the slots that its effects make.
///         A sample due between two steps is taken from the state interpolated between them; the
///         terrain is that of the later step. A lidar's revolution is traced when it is complete.
/// Omits   motion of the ground within a revolution or an exposure: one terrain stands for each,
///         for a revolution that of its end; exposure time: a picture is of one instant.
class Rig {
 public:
  /// Keeps references to `assembly` and `sink`. The rasterizer and the ray scene are made only if
  /// a sensor needs them.
  Rig(const Scenario& scenario, const SceneAssembly& assembly, const EglOptions& egl, int threads,
      MeasurementSink* sink);
  ~Rig();

  /// Samples what is due at the start, t = 0.
  void SampleStart(const Simulation& simulation);
  /// Samples everything that falls due in (simulation.previous, simulation.state].
  void Sample(const Simulation& simulation);
  /// Writes the inertial samples that the last step left open, after the step that follows it, in
  /// which nothing else is sampled.
  void Finish(const Simulation& simulation);

  double camera_wall_s() const { return camera_wall_s_; }
  double lidar_wall_s() const { return lidar_wall_s_; }

 private:
  struct ImuUnit {
    Imu imu;
    ImuSlots slots;
    std::size_t machine;
    int link;
    ChannelId channel;
  };
  struct GnssUnit {
    Gnss gnss;
    GnssSlots slots;
    SampleClock clock;
    std::size_t machine;
    int link;
    Pose X_BT;                               ///< where it truly sits
    std::optional<GnssReflector> reflector;  ///< beside it
    ChannelId channel;
    std::int64_t next = 0;
  };
  struct EncoderUnit {
    Encoder encoder;
    EncoderSlots slots;
    SampleClock clock;
    std::size_t machine;
    std::vector<int> joints, gears;  ///< read in this order
    ChannelId channel;
    std::int64_t next = 0;
  };
  struct CameraUnit {
    Camera camera;
    FrameSlots slots;
    SampleClock clock;
    std::size_t machine;
    int link;
    Pose X_BT;  ///< where it truly sits
    ChannelId channel;
    std::int64_t next = 0;
  };
  struct LidarUnit {
    Lidar lidar;
    FrameSlots slots;
    SampleClock clock;
    std::size_t machine;
    int link;
    Pose X_BT;  ///< where it truly sits
    ChannelId channel;
    PoseTrack X_WS;
    std::int64_t next = 0;
  };
  /// Poses of all scene bodies at a step, kept as long as a revolution may need them.
  struct SceneMoment {
    TimeNs t_ns;
    std::vector<Pose> X_WB;
  };

  void Add(const Scenario& scenario, std::size_t machine, const SensorDescription& sensor);
  void AddEncoder(const MachineModel& model, std::size_t machine, const SensorDescription& sensor,
                  const std::string& folder);
  void SampleImus(const WorldState& before, const WorldState& after);
  void Report(ImuUnit* unit, std::vector<ImuSample>* samples);
  void SampleGnss(const WorldState& before, const WorldState& after);
  void SampleEncoders(const WorldState& before, const WorldState& after);
  void SampleCameras(const WorldState& before, const WorldState& after,
                     const TerrainSurface& ground);
  void SampleLidars(const WorldState& now, const TerrainSurface& ground);
  void RememberScene(const WorldState& state);
  std::vector<Pose> BodiesAt(TimeNs t_ns) const;

  std::uint64_t seed_;
  int threads_;
  MeasurementSink* sink_;
  SiteFrame site_;
  const SceneAssembly& assembly_;
  std::unique_ptr<Rasterizer> rasterizer_;
  std::unique_ptr<RayScene> ray_scene_;
  std::vector<ImuUnit> imus_;
  std::vector<GnssUnit> gnss_;
  std::vector<EncoderUnit> encoders_;
  std::vector<CameraUnit> cameras_;
  std::vector<LidarUnit> lidars_;
  std::deque<SceneMoment> history_;
  double camera_wall_s_ = 0, lidar_wall_s_ = 0;
};

}  // namespace tera
