#pragma once

#include "core/time.h"
#include "core/types/measurement.h"
#include "dataset/format/channel.h"

namespace tera {

/// Handle of one channel of a sink.
using ChannelId = int;

/// Where the measurements of a run go: a dataset, or whoever listens. Channels are added before
/// the first measurement; those of one channel come in the order of their times.
class MeasurementSink {
 public:
  virtual ~MeasurementSink() = default;

  virtual ChannelId AddChannel(const ChannelInfo& info) = 0;
  /// `measurement` must be of the channel's form.
  virtual void Write(ChannelId channel, Measurement measurement) = 0;

  /// False where the sink can do without this channel's frame of time stamp `t_ns`; the caller then
  /// only calls MarkPresent instead of measuring and writing it. `next_ns` is when the channel's
  /// next frame will truly come, whatever the sensor's clock says.
  virtual bool NeedsFrame(ChannelId channel, TimeNs t_ns, TimeNs next_ns) const = 0;
  virtual void MarkPresent(ChannelId channel, TimeNs t_ns) = 0;

  /// Whether a frame may come after other channels' measurements of later times, so that it can be
  /// measured while the run goes on.
  virtual bool TakesFramesLate() const { return false; }
};

}  // namespace tera
