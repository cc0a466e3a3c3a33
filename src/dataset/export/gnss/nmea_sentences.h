#pragma once

#include <string>
#include <string_view>

#include "core/types/measurement.h"

/// NMEA 0183 sentences with checksum and line end. Fields that a recording lacks are empty:
/// satellites, dilution of precision, speed and course.
///
/// Omits   the geoid. The altitude in GGA is the ellipsoidal height, with a geoid separation of 0,
///         so the sum that readers form is correct.
/// Source  NMEA 0183 4.11 as gpsd's "NMEA Revealed" describes it.

namespace tera {

/// "$BODY*HH\r\n", where HH is the exclusive or of the bytes of the body.
std::string NmeaSentence(std::string_view body);

/// A sample without a fix gives only the time and quality 0.
std::string Gga(TimeNs utc_ns, const GnssSample& sample);
/// A sample without a fix gives status V.
std::string Rmc(TimeNs utc_ns, const GnssSample& sample);
/// Standard deviations of the position. The sample must have a fix.
std::string Gst(TimeNs utc_ns, const GnssSample& sample);
/// True heading, clockwise from north.
std::string Hdt(double heading_rad);

}  // namespace tera
