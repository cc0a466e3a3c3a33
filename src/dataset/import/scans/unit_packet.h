#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "core/error.h"
#include "core/time.h"

namespace tera {

/// A datagram of a lidar, as a capture or a bag keeps it.
struct UnitPacket {
  TimeNs received_ns = 0;  ///< by the clock of the computer that received it
  std::string_view bytes;  ///< without the headers of its network
  std::string place;       ///< "drive.pcap: packet 12"
};

using TakePacket = std::function<void(const UnitPacket& packet)>;

/// Throws the InputError of a packet that cannot be what it should be.
[[noreturn]] inline void RefusePacket(const UnitPacket& packet, const std::string& finding,
                                      FaultKind kind = FaultKind::kMalformed) {
  throw InputError(packet.place, {kind, finding});
}
inline constexpr const char* kOrLeaveOut = "; leave such packets out by --skip-bad-rows";

/// Faults that are left out and counted where the user asks for that, and else are thrown.
using LeaveOut = std::function<void(const InputError& fault)>;

}  // namespace tera
