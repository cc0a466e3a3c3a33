#pragma once

#include "core/time.h"
#include "core/types/measurement.h"
#include "dataset/format/channel.h"

namespace tera {

/// Handle of one channel of a sink.
using ChannelId = int;

/// Receiver of a run's measurements, such as a dataset. Channels are added before the first
/// measurement; measurements of a channel come in the order of their times.
class MeasurementSink {
 public:
  virtual ~MeasurementSink() = default;

  virtual ChannelId AddChannel(const ChannelInfo& info) = 0;
  /// `measurement` must be of the channel's form.
  virtual void Write(ChannelId channel, Measurement measurement) = 0;

  /// False if the sink does not need this channel's frame of time stamp `t_ns`; the caller then
  /// calls MarkPresent instead of measuring and writing it. `next_ns` is the true time of the
  /// channel's next frame, whatever the sensor's clock.
  virtual bool NeedsFrame(ChannelId channel, TimeNs t_ns, TimeNs next_ns) const = 0;
  virtual void MarkPresent(ChannelId channel, TimeNs t_ns) = 0;

  /// Whether a frame may come after other channels' later measurements, so that it can be measured
  /// in parallel with the run.
  virtual bool AcceptsOutOfOrderFrames() const { return false; }
};

}  // namespace tera
