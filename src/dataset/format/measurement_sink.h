#pragma once

#include "core/time.h"
#include "core/types/measurement.h"
#include "dataset/format/channel.h"

namespace tera {

using ChannelId = int;

/// Receives the measurements of a run; a dataset writer is one example. All channels are added
/// before the first measurement. Within a channel, times increase.
class MeasurementSink {
 public:
  virtual ~MeasurementSink() = default;

  virtual ChannelId AddChannel(const ChannelInfo& info) = 0;
  /// The alternative held by `measurement` must match the form of the channel.
  virtual void Write(ChannelId channel, Measurement measurement) = 0;

  /// False if the sink already has the frame of this channel at `t_ns`. The caller then calls
  /// MarkPresent instead of rendering and writing the frame. `next_ns` is the time of the channel's
  /// next frame on the simulation clock, even if the sensor's clock deviates.
  virtual bool NeedsFrame(ChannelId channel, TimeNs t_ns, TimeNs next_ns) const = 0;
  virtual void MarkPresent(ChannelId channel, TimeNs t_ns) = 0;

  /// Whether a frame may come after other channels' later measurements, so that it can be measured
  /// in parallel with the run.
  virtual bool AcceptsOutOfOrderFrames() const { return false; }
};

}  // namespace tera
