#pragma once

#include <pcap/pcap.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>

#include "core/time.h"
#include "dataset/files/checked_file.h"

namespace tera {

/// A pcap file of UDP datagrams from one lidar to one port, in Ethernet frames of at most 1514
/// bytes. Longer datagrams are fragments of IPv4, as a real unit's are.
///
/// Source  RFC 791, RFC 768. The UDP checksum is 0, which means that none was computed.
class CaptureWriter {
 public:
  CaptureWriter(const std::filesystem::path& file, std::uint16_t port);

  /// `sent_ns` counts from 1970; the file resolves microseconds.
  void Add(TimeNs sent_ns, std::string_view payload);
  void Commit();

 private:
  void AddFrame(TimeNs sent_ns, std::size_t offset, std::string_view part, bool is_last);
  void RequireWritten();

  CheckedFile file_;
  std::uint16_t port_;
  std::unique_ptr<pcap_t, decltype(&pcap_close)> link_;
  std::unique_ptr<pcap_dumper_t, decltype(&pcap_dump_close)> dump_;
  std::uint16_t datagrams_ = 0;
};

}  // namespace tera
