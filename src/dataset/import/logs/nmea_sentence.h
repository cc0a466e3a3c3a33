#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

/// Finds the sentences of NMEA 0183 in a log.

namespace tera {

struct NmeaSentence {
  std::string_view body;  ///< between '$' and '*'
  bool is_sound = true;   ///< its checksum is right, or it has none
};

/// The sentence in a line. A logger's text may precede the '$'. Text without a leading letter or
/// digit may follow the checksum. A sentence without a checksum is the whole line.
std::optional<NmeaSentence> SentenceIn(std::string_view line);

/// The length of the binary frame at the beginning of `bytes`; 0 without a frame with a right
/// checksum.
///
/// Source  u-blox, "Interface description", UBX frame structure (8-bit Fletcher checksum); RTCM
///         10403, transport layer (CRC-24Q).
std::size_t BinaryFrameBytes(std::string_view bytes);

/// Whether the beginning of a file is a log of sentences. At least half of its lines, without
/// binary frames, must hold a receiver's sentence, with a right or wrong checksum.
bool BeginsAsNmea(std::string_view bytes);

}  // namespace tera
