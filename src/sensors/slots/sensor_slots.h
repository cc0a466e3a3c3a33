#pragma once

#include <string>
#include <vector>

#include "core/types/effects.h"
#include "core/types/measurement.h"
#include "sensors/slots/encoder_errors.h"
#include "sensors/slots/gnss_errors.h"
#include "sensors/slots/imu_errors.h"
#include "sensors/slots/low_pass.h"
#include "sensors/slots/range_errors.h"
#include "sensors/slots/report_clock.h"

/// What lies between the measurement of a sensor's own model and the one it reports: the slots
/// `sensor_static` and `sensor_timing`, and signs of axes. In the order of a real sensor: what its
/// element senses (sign, scale, bias, drift and the like), the filter behind it, what reading it
/// out adds (outliers, saturation, quantisation), the time stamp. One object for each sensor, built
/// from its effects; without effects every measurement passes unchanged. The same in a simulation
/// and over replayed measurements. Measurements are given in the order of their times; random
/// numbers come from streams under `stream_name`, "excavator1/imu_boom". (Where a sensor truly
/// sits: true_mount.h.)

namespace tera {

class ImuSlots {
 public:
  ImuSlots(const Effects& effects, std::uint64_t seed, const std::string& stream_name);
  void Apply(ImuSample* sample);

 private:
  bool ideal_;
  Vec3 axis_signs_;
  ImuErrors errors_;
  LowPass filter_;
  ReportClock clock_;
  std::int64_t next_ = 0;
};

class GnssSlots {
 public:
  GnssSlots(const Effects& effects, std::uint64_t seed, const std::string& stream_name);
  void Apply(const RaisedBoom& boom, const SiteFrame& site, GnssSample* sample);

 private:
  bool ideal_;
  GnssErrors errors_;
  LowPass filter_;
  ReportClock clock_;
  std::int64_t next_ = 0;
};

class EncoderSlots {
 public:
  /// `axis_effects` has the own effects of each axis or is empty; `linear` says of each whether it
  /// is in metres.
  EncoderSlots(const Effects& effects, const std::vector<Effects>& axis_effects,
               const std::vector<bool>& linear, const std::vector<std::string>& axes,
               std::uint64_t seed, const std::string& stream_name);
  void Apply(EncoderSample* sample);

 private:
  bool ideal_;
  std::vector<AxisErrors> axes_;
  LowPass filter_;
  ReportClock clock_;
  std::int64_t next_ = 0;
};

/// Of a lidar or a camera, whose measurements can be left out when their files are there already.
class FrameSlots {
 public:
  FrameSlots(const Effects& effects, std::uint64_t seed, const std::string& stream_name);
  /// The times that measurement `k`, valid at `t_ns`, gets; once for each, in order.
  ReportClock::Times Stamp(std::int64_t k, TimeNs t_ns);
  void Apply(std::int64_t k, const ReportClock::Times& times, LidarScan* scan) const;
  void Apply(std::int64_t k, const ReportClock::Times& times, CameraFrame* frame) const;

 private:
  RangeErrors errors_;
  ReportClock clock_;
};

}  // namespace tera
