#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/types/measurement.h"

/// Conversion between samples and rows of numbers. Each sample kind has a list of column names,
/// which include units.

namespace tera {

std::vector<std::string> ImuColumns();
RowSample RowOf(const ImuSample& sample);
ImuSample ImuSampleOf(const RowSample& row);

std::vector<std::string> GnssColumns();
RowSample RowOf(const GnssSample& sample);
/// Throws an internal error unless the column `fix` holds a value that FixOfQuality accepts.
GnssSample GnssSampleOf(const RowSample& row);

/// Converts the quality field of an NMEA GGA sentence. Returns nullopt for a quality that is not a
/// measurement, such as estimated or manual input.
std::optional<GnssFix> FixOfQuality(double quality);

/// The qualities that FixOfQuality accepts, for error messages.
inline constexpr std::string_view kNeedFix =
    "need 0 none, 1 single, 2 differential, 4 RTK fixed or 5 RTK float";

/// Position columns of every joint, then rate columns of every joint. Names end in _rad and _radps
/// for a revolute joint, and in _m and _mps for a prismatic joint.
std::vector<std::string> EncoderColumns(const std::vector<EncoderAxis>& axes);
RowSample RowOf(const EncoderSample& sample);
EncoderSample EncoderSampleOf(const RowSample& row);

/// Pass false for a reference without velocity measurements; the velocity columns are then absent.
std::vector<std::string> PoseColumns(bool with_velocity = true);
RowSample RowOf(const TruthPose& pose, bool with_velocity = true);

}  // namespace tera
