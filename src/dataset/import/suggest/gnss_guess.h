#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/time.h"
#include "dataset/import/csv_file.h"
#include "dataset/import/suggest/guess.h"

namespace tera {

/// Columns of a GNSS receiver in a table; null if absent.
struct PlaceColumns {
  const NumbersOfColumn *lat = nullptr, *lon = nullptr, *alt = nullptr, *fix = nullptr;
  std::string lat_side, lon_side;  ///< columns with N or S, and with E or W; empty if absent
  std::string fix_words;           ///< column with the fix as a word
};

/// Name of the column that holds only the given letters, N and S or E and W.
std::string SideColumn(const CsvFile& csv, const std::vector<NumbersOfColumn>& columns,
                       const std::string& letters);

/// Guesses deg, rad, ddmm (degrees and minutes), or integers of 1e-7 or 1e-6 degrees, by name and
/// by the possible range of latitude and longitude. Otherwise unknown.
UnitGuess GuessGeodeticUnit(const NumbersOfColumn& lat, const NumbersOfColumn& lon);

/// Mapping text of a GNSS channel, with the origin at its first row that has a fix.
struct GnssGuess {
  std::string origin;   ///< line "origin: {...}", or a remark if the position is unknown
  std::string rules;    ///< items of `valid_if`; may be empty
  std::string columns;  ///< lines of the key `columns`
};

/// Returns nullopt if no row has a position. A row without a fix or at latitude 0, longitude 0 has
/// none.
std::optional<GnssGuess> GuessGnss(const CsvFile& csv, const PlaceColumns& columns);

/// Lines of a pose table with columns for east, north and, if there are three, up. `far` means that
/// map coordinates are far from zero.
std::string MapPositionYaml(const std::vector<const NumbersOfColumn*>& columns, bool far);

/// Unit of the positions x, y, z. A name decides; otherwise metres if the motion is plausible for a
/// machine; otherwise unknown.
UnitGuess GuessPlaceUnit(const std::vector<const NumbersOfColumn*>& place,
                         const std::vector<TimeNs>& t_ns);

}  // namespace tera
