#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "dataset/import/left_out_rows.h"
#include "dataset/import/row_table.h"

/// Logs of known form, whose columns need no mapping.

namespace tera {

inline constexpr const char *kPosType = "rtklib/pos", *kNmeaType = "nmea/0183",
                            *kKittiType = "kitti/oxts", *kUlogType = "px4/ulog";
/// Types of pose text files, whose form a mapping names.
inline constexpr const char *kTumPosesType = "poses/tum", *kEurocPosesType = "poses/euroc",
                            *kKittiPosesType = "poses/kitti";
/// Column of the times, UTC.
inline constexpr const char* kLogTimeColumn = "time";

/// The type of a file, or empty. The first bytes identify NMEA 0183 sentences and a PX4 ULog. The
/// name identifies NAME.pos, NAME.nmea, NAME.ulg, and oxts/timestamps.txt next to oxts/data of a
/// KITTI drive.
std::string TypeOfLog(const std::filesystem::path& file);

/// Reads a log of such a type, except a ULog, which is read by topic (ulog.h). For NMEA it reads
/// the sentences of one `talker`, or of all if empty. Faults are InputErrors with file and line;
/// unreadable lines go to `left_out` if given.
std::unique_ptr<const RowTable> ReadLog(const std::filesystem::path& file, const std::string& type,
                                        const std::string& talker, LeftOutRows* left_out);

// The types.
// A solution file of RTKLIB in latitude, longitude and height. Columns: latitude, longitude (deg),
// height (m above the ellipsoid), Q, fix (GGA's quality for Q), ns, sdn, sde, sdu, sdne, sdeu, sdun
// (m), var_n, var_e, var_u (m2), age (s), ratio.
//
// Source  RTKLIB 2.4.2 manual, appendix B.1, "Positioning solution file".
std::unique_ptr<const RowTable> ReadPosLog(const std::filesystem::path& file,
                                           LeftOutRows* left_out);
/// Sentences of NMEA 0183, one row per time: GGA, GNS, GGK (`$PTNL,GGK`), RMC, GST, ZDA. VTG and
/// HDT have no time and belong to the row around them. Columns: latitude, longitude (deg), altitude
/// (m, above the ellipsoid), msl (m), fix (of GGA), satellites, hdop, speed (m/s), course, heading
/// (deg, clockwise from north), sdn, sde, sdu (m), var_n, var_e, var_u (m2). InputError if several
/// talkers give positions at the same times and none is chosen.
///
/// Model   a sentence with a wrong checksum is an unreadable line. The date comes from RMC, ZDA or
///         GGK. Times before the first of these count back from its day; a log without any has
///         1970-01-01. A logger's own times before sentences are skipped, as are UBX and RTCM 3
///         frames in between.
/// Source  NMEA 0183, as gpsd's "NMEA Revealed" describes it; Trimble, "NMEA-0183 messages:
///         PTNL,GGK".
std::unique_ptr<const RowTable> ReadNmeaLog(const std::filesystem::path& file,
                                            const std::string& talker, LeftOutRows* left_out);

/// The readable contents of an NMEA log.
struct NmeaContents {
  std::vector<std::string> rivals;  ///< talkers of several receivers; empty for one receiver
  std::string kinds;                ///< "10 GGA, 10 RMC"
  bool has_dates = false;
};
NmeaContents ContentsOfNmea(const std::filesystem::path& file);

/// The frames of a drive of KITTI's raw data. Columns: the 30 of its dataformat.txt under their own
/// names, `lat` and `lon` in deg; and the pose: x, y, z (m, east, north, up from the first frame)
/// and qw, qx, qy, qz.
///
/// Source  Geiger et al. 2013, "Vision meets robotics: the KITTI dataset".
std::unique_ptr<const RowTable> ReadKittiLog(const std::filesystem::path& timestamps,
                                             LeftOutRows* left_out);

/// The pose type for a mapping's `form:`, "tum", "euroc" or "kitti".
std::string TypeOfTrajectory(std::string_view form);
/// Poses, one per line. Columns: x, y, z (m), qw, qx, qy, qz. TUM: seconds, x, y, z, qx, qy, qz,
/// qw. EuRoC: nanoseconds, x, y, z, qw, qx, qy, qz and any further fields. KITTI: the three rows of
/// rotation and position. Blanks or commas separate fields. Lines that begin with '#', and a first
/// line that begins with a name, are skipped. Poses without times take those of the file `times`,
/// if named, with a number of seconds per line.
///
/// Source  "File Formats" of the RGB-D SLAM benchmark, TU Munich; Burri et al. 2016 (EuRoC); KITTI
///         odometry, devkit.
std::unique_ptr<const RowTable> ReadTrajectoryLog(const std::filesystem::path& file,
                                                  const std::string& type, LeftOutRows* left_out,
                                                  const std::filesystem::path& times = {});

}  // namespace tera
