#pragma once

#include <filesystem>
#include <map>

#include "dataset/import/scans/unit_packet.h"

namespace tera {

/// Number of datagrams by destination port.
using PortCounts = std::map<int, std::int64_t>;

/// Passes the UDP datagrams sent to `port` in a network capture to `take`. Memory holds one
/// datagram.
///
/// Model   Supports pcap and pcapng with Ethernet (including VLAN tags), Linux cooked captures,
///         loopback and raw IP, over IPv4 and IPv6. IPv4 fragments are joined; an incomplete
///         datagram is dropped, as an operating system does.
/// Omits   fragments of IPv6, tunnels, checksums.
/// Throws  InputError if the file is not such a capture, or if no datagram has the port; the
///         message lists the ports that occur. A file that ends within a packet is reported to
///         `leave_out`.
void ReadCapture(const std::filesystem::path& file, int port, const LeaveOut& leave_out,
                 const TakePacket& take);

/// True if the file begins like a capture.
bool LooksLikeCapture(const std::filesystem::path& file);

/// Datagrams by port among the first `most_packets` packets.
PortCounts PortsOfCapture(const std::filesystem::path& file, std::int64_t most_packets);

}  // namespace tera
