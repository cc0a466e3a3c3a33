#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "dataset/import/left_out_rows.h"
#include "dataset/import/row_table.h"

/// Logs whose form is known, so that a mapping need not say what their columns are.

namespace tera {

inline constexpr const char *kPosType = "rtklib/pos", *kNmeaType = "nmea/0183",
                            *kKittiType = "kitti/oxts", *kUlogType = "px4/ulog";
/// The types of text files of poses, whose form a mapping names.
inline constexpr const char *kTumPosesType = "poses/tum", *kEurocPosesType = "poses/euroc",
                            *kKittiPosesType = "poses/kitti";
/// The column of their times, UTC.
inline constexpr const char* kLogTimeColumn = "time";

/// The one of these types that a file has. Its first bytes tell sentences of NMEA 0183 and a ULog
/// of PX4. Its name tells NAME.pos, NAME.nmea, NAME.ulg, and oxts/timestamps.txt beside oxts/data
/// of a KITTI drive. Empty: none.
std::string TypeOfLog(const std::filesystem::path& file);

/// Reads a log of such a type, but a ULog, of which a topic is read (ulog.h); of NMEA the sentences
/// of one `talker`, or where that is empty of all. Faults are InputErrors with file and line; lines
/// that cannot be read are `left_out` where that is given.
std::unique_ptr<const RowTable> ReadLog(const std::filesystem::path& file, const std::string& type,
                                        const std::string& talker, LeftOutRows* left_out);

// The types.
/// A solution file of RTKLIB in latitude, longitude and height. Columns: latitude, longitude (deg),
/// height (m above the ellipsoid), Q, fix (the quality of GGA that Q is), ns, sdn, sde, sdu, sdne,
/// sdeu, sdun (m), var_n, var_e, var_u (m2), age (s), ratio.
///
/// Source  RTKLIB 2.4.2 manual, appendix B.1, "Positioning solution file".
std::unique_ptr<const RowTable> ReadPosLog(const std::filesystem::path& file,
                                           LeftOutRows* left_out);
/// Sentences of NMEA 0183, a row for each time of which there are any: GGA, GNS, GGK (`$PTNL,GGK`),
/// RMC, GST, ZDA, and VTG and HDT, which have no time, where they stand. Columns: latitude,
/// longitude (deg), altitude (m, above the ellipsoid), msl (m), fix (of GGA), satellites, hdop,
/// speed (m/s), course, heading (deg, clockwise from north), sdn, sde, sdu (m), var_n, var_e, var_u
/// (m2). InputError where several talkers say of the same times where they are and none is chosen.
///
/// Model   a sentence with a checksum that is not its own is a line that cannot be read. The date
///         is that of RMC, ZDA or GGK; of times before the first of these it is the day that they
///         lead up to, and of a log without any 1970-01-01. A logger's own times before sentences
///         are passed over, and so are frames of UBX and RTCM 3 between them.
/// Source  NMEA 0183, as gpsd's "NMEA Revealed" describes it; Trimble, "NMEA-0183 messages:
/// PTNL,GGK".
std::unique_ptr<const RowTable> ReadNmeaLog(const std::filesystem::path& file,
                                            const std::string& talker, LeftOutRows* left_out);

/// The contents of a log of NMEA, as far as its lines can be read.
struct NmeaContents {
  std::vector<std::string> rivals;  ///< talkers of several receivers; none where there is one
  std::string kinds;                ///< "10 GGA, 10 RMC"
  bool has_dates = false;
};
NmeaContents ContentsOfNmea(const std::filesystem::path& file);

/// The frames of a drive of KITTI's raw data. Columns: the 30 of its dataformat.txt under their own
/// names, `lat` and `lon` in deg; and x, y, z (m, east, north, up of the first frame) and qw, qx,
/// qy, qz, the pose.
///
/// Source  Geiger et al. 2013, "Vision meets robotics: the KITTI dataset".
std::unique_ptr<const RowTable> ReadKittiLog(const std::filesystem::path& timestamps,
                                             LeftOutRows* left_out);

/// The type of poses of a mapping's `form:`, "tum", "euroc" or "kitti".
std::string TypeOfTrajectory(std::string_view form);
/// Poses, one a line. Columns: x, y, z (m), qw, qx, qy, qz. TUM: seconds, x, y, z, qx, qy, qz, qw.
/// EuRoC: nanoseconds, x, y, z, qw, qx, qy, qz and whatever stands behind. KITTI: the three rows of
/// rotation and place. Fields are separated by blanks or commas; lines that begin
/// with '#', and a first one that begins with a name, are passed over.
///
/// Source  "File Formats" of the RGB-D SLAM benchmark, TU Munich; Burri et al. 2016 (EuRoC); KITTI
///         odometry, devkit.
/// Poses without times take those of the file `times`, a number of seconds a line, where it is
/// named.
std::unique_ptr<const RowTable> ReadTrajectoryLog(const std::filesystem::path& file,
                                                  const std::string& type, LeftOutRows* left_out,
                                                  const std::filesystem::path& times = {});

}  // namespace tera
