#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/types/measurement.h"

/// Samples as rows of numbers: which columns a kind of sample has, and a sample from and to a row.
/// Every column carries its unit in its name.

namespace tera {

std::vector<std::string> ImuColumns();
RowSample RowOf(const ImuSample& sample);
ImuSample ImuSampleOf(const RowSample& row);

std::vector<std::string> GnssColumns();
RowSample RowOf(const GnssSample& sample);
/// The number in the column `fix` must be one that FixOfQuality takes.
GnssSample GnssSampleOf(const RowSample& row);

/// The fix of a GGA quality, or nothing for those that are no measurement (estimated, by hand).
std::optional<GnssFix> FixOfQuality(double quality);

/// The qualities that FixOfQuality takes, for messages.
inline constexpr std::string_view kNeedFix =
    "need 0 none, 1 single, 2 differential, 4 RTK fixed or 5 RTK float";

/// <joint>_rad or, where it is linear, <joint>_m of all joints; then <joint>_radps or <joint>_mps.
std::vector<std::string> EncoderColumns(const std::vector<EncoderAxis>& axes);
RowSample RowOf(const EncoderSample& sample);
EncoderSample EncoderSampleOf(const RowSample& row);

/// A reference that measures no velocities leaves their columns out.
std::vector<std::string> PoseColumns(bool with_velocity = true);
RowSample RowOf(const TruthPose& pose, bool with_velocity = true);

}  // namespace tera
