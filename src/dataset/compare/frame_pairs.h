#pragma once

#include <string>
#include <vector>

#include "core/time.h"
#include "dataset/compare/receiver_tracks.h"

namespace tera {

/// A frame of a sensor in both recordings, each by its own recording's time.
struct FramePair {
  TimeNs a_ns = 0, b_ns = 0;
};

/// A sensor of frames that both machines have.
struct SensorInBoth {
  std::string name;                ///< "roof", its folder within the machine
  std::string folder_a, folder_b;  ///< channels
  std::size_t frames_a = 0, frames_b = 0;
  std::vector<FramePair> pairs;
  std::string remark;  ///< on its mounts; empty where they agree or are unknown
};

/// One frame of a pair that differs much, and how much.
struct WorstFrame {
  FramePair t;
  double difference = 0;
};

/// Sensors of a form with one name and type on both machines.
///
/// Model   each frame of `a` is paired with the nearest of `b`, at most half of a's median interval
///         away (0.5 s with a single frame), and one of `every` pairs is kept.
std::vector<SensorInBoth> SensorsInBoth(const RecordedMachine& a, const RecordedMachine& b,
                                        ChannelForm form, std::size_t every);

/// Keeps the worst frames of a comparison, the worst first.
void KeepWorst(const WorstFrame& frame, std::vector<WorstFrame>* worst);

}  // namespace tera
