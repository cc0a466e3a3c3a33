#pragma once

#include <memory>

#include "dataset/import/scans/revolution.h"
#include "dataset/import/scans/unit_packet.h"

namespace tera {

/// How packets become scans.
struct DecodeOptions {
  ReturnsKept returns = ReturnsKept::kStrongest;
  bool by_unit_clock = false;  ///< else by when packets were received
};

/// Makes scans of the packets of one unit, in the order in which they were received.
///
/// Frames  points in the sensor's frame S, x forward, y left, z up.
class PacketDecoder {
 public:
  virtual ~PacketDecoder() = default;
  /// Throws InputError, of the packet's place, for one that is not of this unit.
  virtual void Take(const UnitPacket& packet) = 0;
  /// Hands on the last scan.
  virtual void Finish() = 0;
};

}  // namespace tera
