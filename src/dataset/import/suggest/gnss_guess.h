#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/time.h"
#include "dataset/import/csv_file.h"
#include "dataset/import/suggest/guess.h"

namespace tera {

/// A table's columns of a receiver; absent ones are null.
struct PlaceColumns {
  const NumbersOfColumn *lat = nullptr, *lon = nullptr, *alt = nullptr, *fix = nullptr;
  std::string lat_side, lon_side;  ///< columns of N and S, of E and W; empty: none
  std::string fix_words;           ///< column with the fix in words
};

/// Name of the column that holds only N and S, or E and W.
std::string SideColumn(const CsvFile& csv, const std::vector<NumbersOfColumn>& columns,
                       const std::string& letters);

/// deg, rad, ddmm (degrees and minutes), or degrees as integers of 1e-7 or 1e-6. Names and the
/// possible range of a latitude and a longitude decide; else unknown.
UnitGuess GuessGeodeticUnit(const NumbersOfColumn& lat, const NumbersOfColumn& lon);

/// A channel of a mapping, and the origin at its first row with a fix.
struct GnssGuess {
  std::string origin;   ///< a line "origin: {...}", or a remark if the position is unknown
  std::string rules;    ///< items of `valid_if`, or nothing
  std::string columns;  ///< lines
};

/// Returns nothing if no row has a position. Rows without a fix, and those at 0, 0, have none.
std::optional<GnssGuess> GuessGnss(const CsvFile& csv, const PlaceColumns& columns);

/// Lines of a table of east, north and, with three columns, up. Map coordinates are `far` from
/// zero.
std::string MapPositionYaml(const std::vector<const NumbersOfColumn*>& columns, bool far);

/// The unit of positions x, y, z: from a name, else metres if the motion fits a machine; else
/// unknown.
UnitGuess GuessPlaceUnit(const std::vector<const NumbersOfColumn*>& place,
                         const std::vector<TimeNs>& t_ns);

}  // namespace tera
