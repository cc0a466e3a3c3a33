#pragma once

#include <string>
#include <string_view>

#include "core/types/measurement.h"

/// Sentences of NMEA 0183, each with its checksum and line end. Fields that a recording lacks
/// (satellites, dilution, speed and course of the receiver) are empty.
///
/// Omits   the geoid: GGA's altitude is above the ellipsoid and the separation is 0. Readers add
///         the two to the ellipsoidal height.
/// Source  NMEA 0183 4.11 as gpsd's "NMEA Revealed" describes it.

namespace tera {

/// "$BODY*HH\r\n": HH is the exclusive or of the body's bytes.
std::string NmeaSentence(std::string_view body);

/// Without a fix: time and quality 0.
std::string Gga(TimeNs utc_ns, const GnssSample& sample);
/// Status V without a fix.
std::string Rmc(TimeNs utc_ns, const GnssSample& sample);
/// Standard deviations of a sample with a fix.
std::string Gst(TimeNs utc_ns, const GnssSample& sample);
/// True heading, clockwise from north.
std::string Hdt(double heading_rad);

}  // namespace tera
