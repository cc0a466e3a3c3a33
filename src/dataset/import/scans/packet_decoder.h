#pragma once

#include <memory>

#include "dataset/import/scans/revolution.h"
#include "dataset/import/scans/unit_packet.h"

namespace tera {

/// Options for decoding packets to scans.
struct DecodeOptions {
  ReturnsKept returns = ReturnsKept::kStrongest;
  bool by_unit_clock = false;  ///< times are those of the unit's clock; otherwise of the receiver's
                               ///< clock
};

/// Decodes the packets of one unit, given in the order of reception, to scans.
///
/// Frames  Points are in the sensor frame S: x forward, y left, z up.
class PacketDecoder {
 public:
  virtual ~PacketDecoder() = default;
  /// Throws InputError with the place of the packet if it belongs to a different unit.
  virtual void Take(const UnitPacket& packet) = 0;
  /// Emits the last scan.
  virtual void Finish() = 0;
};

}  // namespace tera
