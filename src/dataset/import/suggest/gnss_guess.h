#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/time.h"
#include "dataset/import/csv_file.h"
#include "dataset/import/suggest/guess.h"

namespace tera {

/// Columns of a table that tell of a receiver. Those that are not there are null.
struct PlaceColumns {
  const NumbersOfColumn *lat = nullptr, *lon = nullptr, *alt = nullptr, *fix = nullptr;
  std::string lat_side, lon_side;  ///< columns of N and S, of E and W; empty: none
  std::string fix_words;           ///< the column that says in words what the fix is
};

/// Names of the columns that hold nothing but N and S, or E and W.
std::string SideColumn(const CsvFile& csv, const std::vector<NumbersOfColumn>& columns,
                       const std::string& letters);

/// deg, rad, ddmm (degrees and minutes), or degrees by whole numbers of 1e-7 or 1e-6: by what their
/// names tell, and by sizes that a latitude and a longitude can have; else unknown.
UnitGuess GuessGeodeticUnit(const NumbersOfColumn& lat, const NumbersOfColumn& lon);

/// A channel of a mapping, and the origin at its first row with a fix.
struct GnssGuess {
  std::string origin;   ///< a line, "origin: {...}", or a remark where the place is not known
  std::string rules;    ///< items of `valid_if`, or nothing
  std::string columns;  ///< lines
};

/// Nothing where no row has a place: rows without a fix, and those at 0, 0, have none.
std::optional<GnssGuess> GuessGnss(const CsvFile& csv, const PlaceColumns& columns);

/// Lines of a table of east, north and, of three columns, up; those of a map lie `far` from zero.
std::string MapPositionYaml(const std::vector<const NumbersOfColumn*>& columns, bool far);

/// The unit of places x, y, z: as a name tells, else metres where a machine can move so far in
/// them; else unknown.
UnitGuess GuessPlaceUnit(const std::vector<const NumbersOfColumn*>& place,
                         const std::vector<TimeNs>& t_ns);

}  // namespace tera
