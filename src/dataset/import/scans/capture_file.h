#pragma once

#include <filesystem>
#include <map>

#include "dataset/import/scans/unit_packet.h"

namespace tera {

/// What was seen in a capture: the number of datagrams by the UDP port that they go to.
using PortCounts = std::map<int, std::int64_t>;

/// Shows the UDP datagrams to one port of a capture of a network, one in memory at a time.
///
/// Model   pcap and pcapng of Ethernet (with VLAN tags), Linux's cooked forms, loopback and raw IP;
///         IPv4 and IPv6. Fragments of IPv4 are joined; those of a datagram that lacks one are
///         dropped, as the receiver's system would.
/// Omits   fragments of IPv6, tunnels, checksums.
/// Throws  InputError where the file is no such capture or is cut off within a packet; the latter
///         goes to `leave_out`. Nothing to the port is a fault that names the ports that are there.
void ReadCapture(const std::filesystem::path& file, int port, const LeaveOut& leave_out,
                 const TakePacket& take);

/// Whether the file's first bytes are those of a capture.
bool LooksLikeCapture(const std::filesystem::path& file);

/// The ports of the first `most_packets` packets.
PortCounts PortsOfCapture(const std::filesystem::path& file, std::int64_t most_packets);

}  // namespace tera
