#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "dataset/import/left_out_rows.h"
#include "dataset/import/row_table.h"

/// Log formats with known columns, for which a mapping need not list columns.

namespace tera {

inline constexpr const char *kPosType = "rtklib/pos", *kNmeaType = "nmea/0183",
                            *kKittiType = "kitti/oxts", *kUlogType = "px4/ulog";
/// Formats of pose text files. The mapping must name them.
inline constexpr const char *kTumPosesType = "poses/tum", *kEurocPosesType = "poses/euroc",
                            *kKittiPosesType = "poses/kitti";
/// Column with the time in UTC.
inline constexpr const char* kLogTimeColumn = "time";

/// Type of a file; empty if unknown. NMEA 0183 and PX4 ULog are recognised by their first bytes.
/// NAME.pos, NAME.nmea and NAME.ulg are recognised by name, as is oxts/timestamps.txt next to
/// oxts/data of a KITTI drive.
std::string TypeOfLog(const std::filesystem::path& file);

/// Reads a log of any of these types except a ULog, which is read by topic (ulog.h). For NMEA, only
/// sentences of `talker` are read; an empty `talker` means all. Faults throw InputError with file
/// and line; with `left_out`, unreadable lines are added there instead.
std::unique_ptr<const RowTable> ReadLog(const std::filesystem::path& file, const std::string& type,
                                        const std::string& talker, LeftOutRows* left_out);

// Reads a position file of RTKLIB with latitude, longitude and height. Columns: latitude, longitude
// (deg), height (m above the ellipsoid), Q, fix (GGA quality that corresponds to Q), ns, sdn, sde,
// sdu, sdne, sdeu, sdun (m), var_n, var_e, var_u (m2), age (s), ratio.
//
// Source  RTKLIB 2.4.2 manual, appendix B.1, "Positioning solution file".
std::unique_ptr<const RowTable> ReadPosLog(const std::filesystem::path& file,
                                           LeftOutRows* left_out);
/// Reads NMEA 0183 sentences; rows are the distinct times. Sentences: GGA, GNS, GGK (`$PTNL,GGK`),
/// RMC, GST, ZDA. VTG and HDT carry no time and belong to the surrounding row. Columns: latitude,
/// longitude (deg), altitude (m, above the ellipsoid), msl (m), fix (GGA quality), satellites,
/// hdop, speed (m/s), course, heading (deg, clockwise from north), sdn, sde, sdu (m), var_n, var_e,
/// var_u (m2). Throws InputError if several talkers report positions at the same times and `talker`
/// is empty.
///
/// Model   A sentence with a wrong checksum is an unreadable line. Dates come from RMC, ZDA or GGK.
///         Times before the first date are dated backwards from it. A log without dates starts on
///         1970-01-01. Times that a logger writes in front of sentences are skipped, as are UBX and
///         RTCM 3 frames.
/// Source  NMEA 0183, as gpsd's "NMEA Revealed" describes it; Trimble, "NMEA-0183 messages:
///         PTNL,GGK".
std::unique_ptr<const RowTable> ReadNmeaLog(const std::filesystem::path& file,
                                            const std::string& talker, LeftOutRows* left_out);

/// Summary of the readable content of an NMEA log.
struct NmeaContents {
  std::vector<std::string> rivals;  ///< talkers that belong to different receivers; empty if there
                                    ///< is only one receiver
  std::string kinds;                ///< such as "10 GGA, 10 RMC"
  bool has_dates = false;
};
NmeaContents ContentsOfNmea(const std::filesystem::path& file);

/// Reads the frames of a KITTI raw data drive. Columns: the 30 values of dataformat.txt under their
/// own names, with `lat` and `lon` in deg, and a pose: x, y, z (m, east, north, up from the first
/// frame), qw, qx, qy, qz.
///
/// Source  Geiger et al. 2013, "Vision meets robotics: the KITTI dataset".
std::unique_ptr<const RowTable> ReadKittiLog(const std::filesystem::path& timestamps,
                                             LeftOutRows* left_out);

/// Pose type for the value "tum", "euroc" or "kitti" of a mapping's `form`.
std::string TypeOfTrajectory(std::string_view form);
/// Reads one pose per line. Columns: x, y, z (m), qw, qx, qy, qz. TUM lines: seconds, x, y, z, qx,
/// qy, qz, qw. EuRoC lines: nanoseconds, x, y, z, qw, qx, qy, qz, further fields ignored. KITTI
/// lines: the three rows of rotation and position. Fields are separated by blanks or commas. Lines
/// that begin with '#' and a header line are skipped. KITTI poses have no times; they take those of
/// the file `times`, if given, which has seconds on each line.
///
/// Source  "File Formats" of the RGB-D SLAM benchmark, TU Munich; Burri et al. 2016 (EuRoC); KITTI
///         odometry, devkit.
std::unique_ptr<const RowTable> ReadTrajectoryLog(const std::filesystem::path& file,
                                                  const std::string& type, LeftOutRows* left_out,
                                                  const std::filesystem::path& times = {});

}  // namespace tera
