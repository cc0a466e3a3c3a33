#include "sensors/lidar/scan_pattern.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/config/csv.h"
#include "core/error.h"
#include "core/units.h"

namespace tera {
namespace {

constexpr double kMost_pulses_per_s = 1e7;
constexpr double kSecondsPerMinute = 60;

/// Throws InputError where an angle lies outside its range, as one in another unit does.
void CheckAngles(const std::filesystem::path& file, const std::string& column,
                 const std::vector<double>& angles_deg, double least, double most) {
  constexpr std::size_t kFirstRowLine = 2;
  for (std::size_t row = 0; row < angles_deg.size(); ++row) {
    if (angles_deg[row] >= least && angles_deg[row] <= most) continue;
    throw InputError(fmt::format("{}:{}", file.string(), row + kFirstRowLine),
                     {FaultKind::kOutOfRange, fmt::format("column '{}' is {}; need {} to {} deg",
                                                          column, angles_deg[row], least, most)});
  }
}

/// Directions of a file's rows. Throws InputError.
std::vector<Eigen::Vector3f> DirectionsOf(const std::filesystem::path& file) {
  const std::vector<std::string> header = ReadCsvHeader(file);
  const bool is_livox = std::find(header.begin(), header.end(), "Zenith/deg") != header.end();
  const std::vector<std::string> names =
      is_livox ? std::vector<std::string>{"Azimuth/deg", "Zenith/deg"}
               : std::vector<std::string>{"azimuth_deg", "elevation_deg"};
  const auto columns = ReadCsvColumns(file, names);
  CheckAngles(file, names[0], columns[0], -360, 360);
  CheckAngles(file, names[1], columns[1], is_livox ? 0 : -90, is_livox ? 180 : 90);
  std::vector<Eigen::Vector3f> d_S;
  for (std::size_t row = 0; row < columns[0].size(); ++row) {
    const double azimuth_rad = columns[0][row] * kDeg;
    const double elevation_rad = (is_livox ? 90 - columns[1][row] : columns[1][row]) * kDeg;
    d_S.push_back(Vec3(std::cos(elevation_rad) * std::cos(azimuth_rad),
                       std::cos(elevation_rad) * std::sin(azimuth_rad), std::sin(elevation_rad))
                      .cast<float>());
  }
  return d_S;
}

}  // namespace

void Serialize(ModelArchive* archive, RisleyPrisms* prisms) {
  archive->Need("deflection_deg", &prisms->deflection_rad, Between(0, 45, "deg"), 2, kDeg);
  archive->Need("speed_rpm", &prisms->speed_rpm, Between(-1e5, 1e5, "rpm"), 2);
  archive->Check(prisms->deflection_rad.size() == 2 && prisms->speed_rpm.size() == 2, "",
                 "need two deflections and two speeds, one of each prism");
}

void Serialize(ModelArchive* archive, ScanPattern* pattern) {
  archive->Need("pulses_per_s", &pattern->pulses_per_s, Between(1, kMost_pulses_per_s, "1/s"));
  archive->Visit("prisms", &pattern->prisms);
  archive->Visit("csv", &pattern->csv);
  archive->Check(pattern->prisms.has_value() != pattern->csv.has_value(), "",
                 "need either prisms or csv");
  if (!pattern->csv || pattern->csv->empty()) return;
  try {
    pattern->d_S = DirectionsOf(*pattern->csv);
    archive->Check(!pattern->d_S.empty(), "csv", "has no rows; need a row for each pulse");
  } catch (const InputError& e) {
    archive->Check(false, "csv", e.AsFinding());
  }
}

Vec3 ScanPattern::Direction(std::uint64_t pulse) const {
  if (!d_S.empty()) return d_S[pulse % d_S.size()].cast<double>();
  if (!prisms) return Vec3::UnitX();
  double y_rad = 0, z_rad = 0;
  for (std::size_t k = 0; k < 2; ++k) {
    // Whole turns are taken off first: they would cost digits after hours.
    const double turns =
        static_cast<double>(pulse) / pulses_per_s / kSecondsPerMinute * prisms->speed_rpm[k];
    const double angle_rad = 2 * kPi * (turns - std::floor(turns));
    y_rad += prisms->deflection_rad[k] * std::cos(angle_rad);
    z_rad += prisms->deflection_rad[k] * std::sin(angle_rad);
  }
  const double lean_rad = std::hypot(y_rad, z_rad);
  const double across = lean_rad > 0 ? std::sin(lean_rad) / lean_rad : 1;
  return {std::cos(lean_rad), across * y_rad, across * z_rad};
}

}  // namespace tera
