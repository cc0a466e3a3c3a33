#pragma once

#include <string>
#include <vector>

#include "core/time.h"
#include "dataset/compare/receiver_tracks.h"

namespace tera {

/// Times of a frame in both recordings, each in the time of its own recording.
struct FramePair {
  TimeNs a_ns = 0, b_ns = 0;
};

/// A camera or lidar that both machines have.
struct SensorInBoth {
  std::string name;                ///< folder within the machine, such as "roof"
  std::string folder_a, folder_b;  ///< channel paths
  std::size_t frames_a = 0, frames_b = 0;
  std::vector<FramePair> pairs;
  std::string remark;  ///< difference of the mounts; empty if they are equal or unknown
};

/// A pair of frames with a large difference.
struct WorstFrame {
  FramePair t;
  double difference = 0;
};

/// Sensors of the form that have equal names and types on both machines.
///
/// Model   A frame of `a` is paired with the nearest frame of `b`. The distance must be at most
///         half of a's median interval, or 0.5 s if `a` has a single frame. One pair out of `every`
///         is kept.
std::vector<SensorInBoth> SensorsInBoth(const RecordedMachine& a, const RecordedMachine& b,
                                        ChannelForm form, std::size_t every);

/// Inserts the frame into the list of worst frames, worst first, if it is among them.
void KeepWorst(const WorstFrame& frame, std::vector<WorstFrame>* worst);

}  // namespace tera
