#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

/// An NMEA 0183 sentence found in a log.

namespace tera {

struct NmeaSentence {
  std::string_view body;  ///< between '$' and '*'
  bool is_sound = true;   ///< the checksum is correct or absent
};

/// Finds the sentence in a line. Any text may precede the '$'. Text after the checksum must not
/// begin with a letter or digit. A sentence without a checksum extends to the end of the line.
std::optional<NmeaSentence> SentenceIn(std::string_view line);

/// Length of a binary frame at the beginning of `bytes`; 0 if there is none with a correct
/// checksum.
///
/// Source  u-blox, "Interface description", UBX frame structure (8-bit Fletcher checksum); RTCM
///         10403, transport layer (CRC-24Q).
std::size_t BinaryFrameBytes(std::string_view bytes);

/// True if a file begins like an NMEA log: apart from binary frames, at least half of its lines
/// hold a sentence of a receiver. The checksum may be wrong.
bool BeginsAsNmea(std::string_view bytes);

}  // namespace tera
