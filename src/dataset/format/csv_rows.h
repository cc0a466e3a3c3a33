#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/types/measurement.h"
#include "dataset/format/writer.h"

/// Headers and rows of the CSV files of a dataset. Numbers are the shortest decimals that read back
/// as the same double, so that files are exact and the same on every machine.

namespace tera {

inline constexpr std::string_view kImuHeader =
    "t_ns,wx_radps,wy_radps,wz_radps,ax_mps2,ay_mps2,az_mps2";
inline constexpr std::string_view kGnssHeader =
    "t_ns,lat_deg,lon_deg,alt_m,east_m,north_m,up_m,fix,var_e_m2,var_n_m2,var_u_m2";
inline constexpr std::string_view kFrameHeader = "t_ns,filename";
inline constexpr std::string_view kPoseHeader =
    "t_ns,x_m,y_m,z_m,qw,qx,qy,qz,vx_mps,vy_mps,vz_mps,wx_radps,wy_radps,wz_radps";

/// Pose of a reference that measures no velocities.
inline constexpr std::string_view kReferencePoseHeader = "t_ns,x_m,y_m,z_m,qw,qx,qy,qz";

/// t_ns and the columns of a table, which may have none: times alone.
std::string TableHeader(const std::vector<std::string>& columns);

/// <joint>_rad or, where it is linear, <joint>_m of all joints; then <joint>_radps or <joint>_mps.
std::vector<std::string> EncoderColumns(const std::vector<EncoderAxis>& axes);

/// The fix of a GGA quality, or nothing for those that are no measurement (estimated, by hand).
std::optional<GnssFix> FixOfQuality(double quality);

/// The qualities that FixOfQuality takes, for messages.
inline constexpr std::string_view kNeedFix =
    "need 0 none, 1 single, 2 differential, 4 RTK fixed or 5 RTK float";

// Rows with their line ends. Every number must be finite.
std::string ImuRow(const ImuSample& sample);
std::string GnssRow(const GnssSample& sample);
std::string EncoderRow(const EncoderSample& sample);
std::string PoseRow(const TruthPose& pose, bool with_velocity);
std::string FrameRow(TimeNs t_ns, std::string_view filename);
std::string TableRow(TimeNs t_ns, const std::vector<double>& values);

}  // namespace tera
