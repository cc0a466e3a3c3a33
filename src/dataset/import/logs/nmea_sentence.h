#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

/// Where the sentences of NMEA 0183 stand in a log.

namespace tera {

struct NmeaSentence {
  std::string_view body;  ///< between '$' and '*'
  bool is_sound = true;   ///< its checksum is its own, or it has none
};

/// The sentence of a line. A logger's own text may stand before the '$', and text that goes on
/// without a letter or digit behind the checksum; a sentence without a checksum is the whole line.
std::optional<NmeaSentence> SentenceIn(std::string_view line);

/// The length of the binary frame that `bytes` begin with; 0 where they begin with none whose
/// checksum is its own.
///
/// Source  u-blox, "Interface description", UBX frame structure (8-bit Fletcher checksum);
///         RTCM 10403, transport layer (CRC-24Q).
std::size_t BinaryFrameBytes(std::string_view bytes);

/// Whether the beginning of a file is a log of sentences: at least half of its lines, binary frames
/// left out, hold one of a receiver, whether its checksum is its own or not.
bool BeginsAsNmea(std::string_view bytes);

}  // namespace tera
