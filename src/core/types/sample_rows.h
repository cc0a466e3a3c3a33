#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/types/measurement.h"

/// Conversion between samples and rows of numbers, with the columns of each sample kind. Each
/// column name includes its unit.

namespace tera {

std::vector<std::string> ImuColumns();
RowSample RowOf(const ImuSample& sample);
ImuSample ImuSampleOf(const RowSample& row);

std::vector<std::string> GnssColumns();
RowSample RowOf(const GnssSample& sample);
/// The column `fix` must hold a quality that FixOfQuality accepts.
GnssSample GnssSampleOf(const RowSample& row);

/// The fix of a GGA quality; nullopt for qualities without a measurement (estimated, manual).
std::optional<GnssFix> FixOfQuality(double quality);

/// Accepted qualities of FixOfQuality, for messages.
inline constexpr std::string_view kNeedFix =
    "need 0 none, 1 single, 2 differential, 4 RTK fixed or 5 RTK float";

/// <joint>_rad (<joint>_m for a linear joint) of all joints, followed by <joint>_radps or
/// <joint>_mps.
std::vector<std::string> EncoderColumns(const std::vector<EncoderAxis>& axes);
RowSample RowOf(const EncoderSample& sample);
EncoderSample EncoderSampleOf(const RowSample& row);

/// A reference without velocity measurements omits the velocity columns.
std::vector<std::string> PoseColumns(bool with_velocity = true);
RowSample RowOf(const TruthPose& pose, bool with_velocity = true);

}  // namespace tera
