#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "dataset/import/left_out_rows.h"
#include "dataset/import/row_table.h"

/// Logs whose form is known, so that a mapping need not say what their columns are.

namespace tera {

inline constexpr const char *kPosType = "rtklib/pos", *kNmeaType = "nmea/0183",
                            *kKittiType = "kitti/oxts", *kUlogType = "px4/ulog";
/// The column of their times, UTC.
inline constexpr const char* kLogTimeColumn = "time";

/// Which of these a file is, by its name: NAME.pos; NAME.nmea; oxts/timestamps.txt beside oxts/data
/// of a KITTI drive; NAME.ulg of PX4. Empty: none.
std::string TypeOfLog(const std::filesystem::path& file);

/// Reads a log of such a type, but a ULog, of which a topic is read (ulog.h). Faults are
/// InputErrors with file and line; lines that cannot be read are `left_out` where that is given.
std::unique_ptr<const RowTable> ReadLog(const std::filesystem::path& file, const std::string& type,
                                        LeftOutRows* left_out);

// The types.
/// A solution file of RTKLIB in latitude, longitude and height. Columns: latitude, longitude (deg),
/// height (m above the ellipsoid), Q, fix (the quality of GGA that Q is), ns, sdn, sde, sdu, sdne,
/// sdeu, sdun (m), var_n, var_e, var_u (m2), age (s), ratio.
///
/// Source  RTKLIB 2.4.2 manual, appendix B.1, "Positioning solution file".
std::unique_ptr<const RowTable> ReadPosLog(const std::filesystem::path& file,
                                           LeftOutRows* left_out);
/// Sentences of NMEA 0183, a row for each time of which there are any: GGA, RMC, GST, ZDA, and VTG
/// and HDT, which have no time, where they stand. Columns: latitude, longitude (deg), altitude (m,
/// above the ellipsoid), msl (m), fix, satellites, hdop, speed (m/s), course, heading (deg,
/// clockwise from north), sdn, sde, sdu (m), var_n, var_e, var_u (m2).
///
/// Model   a sentence with a checksum that is not its own is a line that cannot be read. The date
/// is
///         that of RMC or ZDA; of times before the first of these it is the day that they lead up
///         to, and of a log without any 1970-01-01.
/// Source  NMEA 0183, as gpsd's "NMEA Revealed" describes it.
std::unique_ptr<const RowTable> ReadNmeaLog(const std::filesystem::path& file,
                                            LeftOutRows* left_out);
/// The frames of a drive of KITTI's raw data. Columns: the 30 of its dataformat.txt under their own
/// names, `lat` and `lon` in deg; and x, y, z (m, east, north, up of the first frame) and qw, qx,
/// qy, qz, the pose.
///
/// Source  Geiger et al. 2013, "Vision meets robotics: the KITTI dataset".
std::unique_ptr<const RowTable> ReadKittiLog(const std::filesystem::path& timestamps,
                                             LeftOutRows* left_out);

}  // namespace tera
