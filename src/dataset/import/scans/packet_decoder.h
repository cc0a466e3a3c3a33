#pragma once

#include <memory>

#include "dataset/import/scans/revolution.h"
#include "dataset/import/scans/unit_packet.h"

namespace tera {

/// Options of decoding packets into scans.
struct DecodeOptions {
  ReturnsKept returns = ReturnsKept::kStrongest;
  bool by_unit_clock = false;  ///< else by the receiver's
};

/// Decodes the packets of one unit into scans, in the order of reception.
///
/// Frames  points in the sensor's frame S, x forward, y left, z up.
class PacketDecoder {
 public:
  virtual ~PacketDecoder() = default;
  /// Throws InputError with the packet's place for a packet of another unit.
  virtual void Take(const UnitPacket& packet) = 0;
  /// Passes on the last scan.
  virtual void Finish() = 0;
};

}  // namespace tera
