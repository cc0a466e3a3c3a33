#pragma once

#include <string>
#include <string_view>

#include "core/types/measurement.h"

/// Sentences of NMEA 0183, each with its checksum and its line end. Fields that a recording does
/// not hold (satellites, dilution, speed and course of the receiver) are empty.
///
/// Omits   the geoid: the altitude of GGA is that above the ellipsoid, and the separation 0, so
///         that their sum is the ellipsoidal height, as readers take it.
/// Source  NMEA 0183 4.11 as gpsd's "NMEA Revealed" describes it.

namespace tera {

/// "$BODY*HH\r\n": HH is the exclusive or of the body's bytes.
std::string NmeaSentence(std::string_view body);

/// Without a fix: its time and the quality 0.
std::string Gga(TimeNs utc_ns, const GnssSample& sample);
/// Status V without a fix.
std::string Rmc(TimeNs utc_ns, const GnssSample& sample);
/// Standard deviations, of a sample that has a fix.
std::string Gst(TimeNs utc_ns, const GnssSample& sample);
/// True heading, clockwise from north.
std::string Hdt(double heading_rad);

}  // namespace tera
