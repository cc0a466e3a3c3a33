#include "dataset/import/suggest/gnss_guess.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/config/spelling.h"
#include "core/quantile.h"
#include "core/types/sample_rows.h"
#include "core/units.h"

namespace tera {
namespace {

constexpr double kMostLat_deg = 90, kMostLon_deg = 180, kMinutes = 60;

bool AreWholeNumbers(const NumbersOfColumn& column) {
  return std::all_of(column.values.begin(), column.values.end(),
                     [](double value) { return value == std::round(value); });
}

bool AreDegreesAndMinutes(const NumbersOfColumn& column) {
  return std::all_of(column.values.begin(), column.values.end(),
                     [](double value) { return std::fmod(std::abs(value), 100) < kMinutes; });
}

/// The scale given in a name, such as "e7" or "1e-7"; 0 if none.
double ScaleOfName(std::string_view name) {
  const std::string lower = LowerCase(std::string(name));
  for (const auto& [ending, scale] :
       {std::pair{"e7", 1e-7}, {"e-7", 1e-7}, {"e6", 1e-6}, {"e-6", 1e-6}}) {
    if (lower.find(ending) != std::string::npos) return scale;
  }
  return 0;
}

double DegreesOf(double number, const UnitGuess& unit) {
  if (unit.unit == "rad") return number * unit.scale / kDeg;
  if (unit.unit == "deg") return number * unit.scale;
  const double degrees = std::trunc(number / 100);
  return degrees + (number - 100 * degrees) / kMinutes;
}

/// True if the fix values are fix types, in which 3 means 3D. GGA qualities use 4 and 5 for RTK and
/// never 3.
bool AreFixTypes(const NumbersOfColumn& fix) {
  const auto has = [&](double value) {
    return std::find(fix.values.begin(), fix.values.end(), value) != fix.values.end();
  };
  const std::vector<std::string> words = WordsOfName(fix.name);
  const bool names_type = std::find(words.begin(), words.end(), "type") != words.end() ||
                          std::find(words.begin(), words.end(), "fixtype") != words.end();
  return names_type || has(3);
}

UnitGuess GuessHeightUnit(const NumbersOfColumn& alt, bool beside_whole_numbers) {
  if (const auto told = ToldUnit(alt, Dimension::kLength)) return *told;
  constexpr double kHighest_m = 9000;
  if (alt.LargestSize() > kHighest_m) {
    return {kUnknownUnit, 1.0,
            fmt::format("up to {:.6g}, higher than any ground in m", alt.LargestSize())};
  }
  if (beside_whole_numbers && AreWholeNumbers(alt) && alt.LargestSize() > 0) {
    return {kUnknownUnit, 1.0,
            fmt::format("whole numbers up to {:.6g}: m or mm", alt.LargestSize())};
  }
  return {"m", 1.0, ""};
}

std::string WithSide(const std::string& column_yaml, const std::string& side) {
  if (side.empty()) return column_yaml;
  return column_yaml.substr(0, column_yaml.size() - 1) + ", hemisphere: " + YamlWord(side) + "}";
}

}  // namespace

std::string SideColumn(const CsvFile& csv, const std::vector<NumbersOfColumn>& columns,
                       const std::string& letters) {
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (columns[c].words == 0 || columns[c].words + columns[c].missing != csv.row_count()) continue;
    bool fits = true;
    for (std::size_t row = 0; row < csv.row_count() && fits; ++row) {
      const std::string_view text = csv.Field(row, c);
      fits = !csv.IsPresent(row, c) ||
             (text.size() == 1 && letters.find(text.front()) != std::string::npos);
    }
    if (fits) return columns[c].name;
  }
  return "";
}

UnitGuess GuessGeodeticUnit(const NumbersOfColumn& lat, const NumbersOfColumn& lon) {
  const double most_lat = lat.LargestSize(), most_lon = lon.LargestSize();
  const auto fits = [&](double scale) {
    return most_lat * scale <= kMostLat_deg && most_lon * scale <= kMostLon_deg;
  };
  if (const double scale = ScaleOfName(lat.name); scale > 0 && fits(scale)) {
    return {"deg", scale, ""};
  }
  const auto told = ToldUnit(lat, Dimension::kAngle);
  if (told && (told->unit == "rad" || fits(told->scale))) return *told;
  // If degrees were this small, the place would be near latitude 0, longitude 0, where there is
  // only sea.
  if (most_lat <= kPi / 2 && most_lon <= kPi) {
    return {"rad", 1.0, fmt::format("the largest is {:.4g}", std::max(most_lat, most_lon))};
  }
  if (fits(1)) return {"deg", 1.0, ""};
  const std::string size = fmt::format("up to {:.10g} and {:.10g}", most_lat, most_lon);
  // If only the latitude exceeds 90, it may be a longitude.
  const bool beyond_degrees = std::max(most_lat, most_lon) > kMostLon_deg;
  if (beyond_degrees && fits(0.01) && AreDegreesAndMinutes(lat) && AreDegreesAndMinutes(lon)) {
    return {"ddmm", 1.0, "degrees and minutes, " + size};
  }
  if (AreWholeNumbers(lat) && AreWholeNumbers(lon) && fits(1e-7)) {
    if (!fits(1e-6)) return {"deg", 1e-7, "whole numbers of 1e-7 deg, " + size};
    return {kUnknownUnit, 1.0, "whole numbers of 1e-7 or 1e-6 deg: deg with scale, " + size};
  }
  return {kUnknownUnit, 1.0, "no degrees, " + size};
}

std::optional<GnssGuess> GuessGnss(const CsvFile& csv, const PlaceColumns& columns) {
  const UnitGuess angle = GuessGeodeticUnit(*columns.lat, *columns.lon);
  const UnitGuess height = GuessHeightUnit(*columns.alt, angle.scale != 1.0);
  GnssGuess guess;
  const bool has_types = columns.fix != nullptr && AreFixTypes(*columns.fix);
  const auto has_fix = [&](double value) {
    const auto fix = FixOfQuality(value);
    return has_types ? value > 2 : fix && *fix != GnssFix::kNone;
  };
  const auto number = [&](std::size_t row, const NumbersOfColumn* column) {
    return csv.NumberIfAny(row, csv.Column(column->name));
  };
  const auto signed_by = [&](std::size_t row, double value, const std::string& side) {
    if (side.empty()) return value;
    const std::string_view text = csv.Field(row, csv.Column(side));
    return text == "S" || text == "W" ? -value : value;
  };
  bool has_place = false;
  for (std::size_t row = 0; row < csv.row_count() && !has_place; ++row) {
    const auto lat = number(row, columns.lat), lon = number(row, columns.lon),
               alt = number(row, columns.alt);
    if (!lat || !lon || !alt || (*lat == 0 && *lon == 0)) continue;
    if (columns.fix != nullptr && !has_fix(number(row, columns.fix).value_or(0))) continue;
    has_place = true;
    const auto metres = height.is_known() ? FindUnit(height.unit) : nullptr;
    if (!angle.is_known() || metres == nullptr) {
      guess.origin =
          "# origin: {lat_deg: , lon_deg: , height_m: }   # to fill in beside the units\n";
      continue;
    }
    guess.origin = fmt::format(
        "origin: {{lat_deg: {:.7f}, lon_deg: {:.7f}, height_m: {:.3f}}}   # guessed: the first row "
        "with a place\n",
        signed_by(row, DegreesOf(*lat, angle), columns.lat_side),
        signed_by(row, DegreesOf(*lon, angle), columns.lon_side),
        *alt * height.scale * metres->factor);
  }
  if (!has_place) return std::nullopt;
  const auto line = [&](const char* key, const std::string& yaml, const std::string& remark) {
    guess.columns += fmt::format("      {}: {}{}\n", key, yaml, remark);
  };
  line("lat", WithSide(ColumnYaml(columns.lat->name, angle), columns.lat_side), DoubtRemark(angle));
  line("lon", WithSide(ColumnYaml(columns.lon->name, angle), columns.lon_side), "");
  line("alt", ColumnYaml(columns.alt->name, height), DoubtRemark(height));
  if (!columns.fix_words.empty()) {
    line("fix", "{constant: unknown}",
         fmt::format("   # to fill in: '{0}' has words; 1 for rows that valid_if: [{{column: {0}, "
                     "equals: WORD}}] takes",
                     PlainNameOf(columns.fix_words)));
  } else if (columns.fix == nullptr) {
    line("fix", "{constant: 1}", "   # guessed: no column of it");
  } else if (has_types) {
    guess.rules = fmt::format("{{column: {}, above: 2}}", YamlWord(columns.fix->name));
    line("fix", "{constant: 1}",
         fmt::format("   # guessed: '{}' is a type of fix, 3 in three dimensions",
                     PlainNameOf(columns.fix->name)));
  } else {
    line("fix", ColumnYaml(columns.fix->name, {"1"}), "   # guessed: a quality as of GGA");
  }
  for (const char* key : {"var_e", "var_n", "var_u"}) {
    line(key, "{constant: 4}", "   # guessed: no column of it");
  }
  return guess;
}

std::string MapPositionYaml(const std::vector<const NumbersOfColumn*>& columns, bool far) {
  std::string yaml;
  if (far) {
    yaml +=
        "    # coordinates of a map: for a gnss channel write columns of latitude and longitude "
        "first, for instance by cs2cs EPSG:25832 EPSG:4979\n";
  }
  yaml += "    columns:\n";
  const char* const names[] = {"east_m", "north_m", "up_m"};
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const auto told = ToldUnit(*columns[k], Dimension::kLength);
    const UnitGuess unit = told.value_or(UnitGuess{"m", 1.0, "no unit is given"});
    yaml += fmt::format("      {}: {}{}\n", names[k], ColumnYaml(columns[k]->name, unit),
                        DoubtRemark(unit));
  }
  return yaml;
}

UnitGuess GuessPlaceUnit(const std::vector<const NumbersOfColumn*>& place,
                         const std::vector<TimeNs>& t_ns) {
  if (const auto told = ToldUnit(*place.front(), Dimension::kLength)) return *told;
  constexpr double kFastest_mps = 30;
  std::vector<double> speeds;
  const bool is_whole = std::all_of(place.begin(), place.end(), [&](const NumbersOfColumn* axis) {
    return axis->values.size() == t_ns.size();
  });
  for (std::size_t k = 1; is_whole && k < t_ns.size(); ++k) {
    double squares = 0;
    for (const NumbersOfColumn* axis : place) {
      squares += std::pow(axis->values[k] - axis->values[k - 1], 2);
    }
    const double dt_s = ToSeconds(t_ns[k] - t_ns[k - 1]);
    if (squares > 0 && dt_s > 0) speeds.push_back(std::sqrt(squares) / dt_s);
  }
  const double usual = speeds.empty() ? 0 : Median(std::move(speeds));
  if (usual <= kFastest_mps) return {"m", 1.0, ""};
  return {kUnknownUnit, 1.0,
          fmt::format("it moves {:.4g} a second, too fast for a machine in m", usual)};
}

}  // namespace tera
