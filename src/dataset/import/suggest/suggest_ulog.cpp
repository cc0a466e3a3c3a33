#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "core/error.h"
#include "dataset/import/logs/ulog.h"
#include "dataset/import/suggest/guess.h"
#include "dataset/import/suggest/suggest.h"

// Suggests a mapping for a PX4 log.

namespace tera {
namespace {

using Columns = std::vector<std::pair<const char*, const char*>>;  // pairs of key and field

bool HasField(const UlogTopic& topic, const char* field) {
  return std::find(topic.fields.begin(), topic.fields.end(), field) != topic.fields.end();
}

bool HasAll(const UlogTopic& topic, const Columns& columns) {
  return std::all_of(columns.begin(), columns.end(),
                     [&](const auto& column) { return HasField(topic, column.second); });
}

std::string UlogColumnsYaml(const Columns& columns, const std::string& unit) {
  std::string yaml;
  for (const auto& [key, field] : columns) {
    yaml += fmt::format("      {}: {{column: \"{}\", {}}}\n", key, field, unit);
  }
  return yaml;
}

/// True if the topic is `format`, with or without an instance: "sensor_combined" or
/// "sensor_combined[1]".
bool IsOf(const UlogTopic& topic, const std::string& format) {
  return topic.name == format || topic.name.starts_with(format + "[");
}

std::string HeadYaml(const UlogTopic& topic) {
  return fmt::format("  - name: {}\n    topic: {}\n", PlainNameOf(topic.name),
                     YamlWord(topic.name));
}

/// Field names of a position, which differ between PX4 versions.
struct GpsFields {
  const char *lat, *lon, *height;  ///< above the ellipsoid
  double deg, m;                   ///< factors to deg and m
  const char *angle_unit, *height_unit;
};
constexpr std::array<GpsFields, 2> kGpsFields = {
    {{"latitude_deg", "longitude_deg", "altitude_ellipsoid_m", 1, 1, "unit: deg", "unit: m"},
     {"lat", "lon", "alt_ellipsoid", 1e-7, 1e-3, "unit: deg, scale: 1e-7", "unit: mm"}}};
constexpr const char* kFixTypeField = "fix_type";  ///< values of 3 and more are 3D fixes

const GpsFields* GpsFieldsOf(const UlogTopic& topic) {
  for (const GpsFields& f : kGpsFields) {
    if (HasField(topic, f.lat) && HasField(topic, f.lon) && HasField(topic, f.height)) return &f;
  }
  return nullptr;
}

/// The key `origin`, from the first row with a fix; empty without one.
std::string OriginOfGps(const std::filesystem::path& log, const UlogTopic& topic,
                        const GpsFields& f, bool has_fix_type) {
  std::vector<std::string> paths = {f.lat, f.lon, f.height};
  if (has_fix_type) paths.push_back(kFixTypeField);
  LeftOutRows left_out;
  const auto table = ReadUlog(log, topic.name, paths, &left_out);
  for (std::size_t row = 0; row < table->row_count(); ++row) {
    std::vector<double> v;
    for (const std::string& path : paths) {
      v.push_back(table->NumberIfAny(row, table->Column(path)).value_or(0));
    }
    const bool is_valid = (!has_fix_type || v[3] > 2) && (v[0] != 0 || v[1] != 0);
    if (is_valid) {
      return OriginYaml(v[0] * f.deg, v[1] * f.deg, v[2] * f.m, "the first row with a fix");
    }
  }
  return "";
}

std::string GpsYaml(const UlogTopic& topic, const GpsFields& f, bool has_fix_type) {
  RuleGuesses rules;
  if (has_fix_type) rules.Add("{column: fix_type, above: 2}", "others have no fix");
  return HeadYaml(topic) + rules.Yaml() + "    columns:\n" +
         UlogColumnsYaml({{"lat", f.lat}, {"lon", f.lon}}, f.angle_unit) +
         UlogColumnsYaml({{"alt", f.height}}, f.height_unit) +
         "      fix: {constant: 1}   # guessed: fix_type is not GGA's quality\n"
         "      var_e: {constant: 4}   # guessed\n      var_n: {constant: 4}   # guessed\n"
         "      var_u: {constant: 9}   # guessed\n";
}

}  // namespace

std::string SuggestForUlog(const std::filesystem::path& log) {
  const Columns rates = {{"wx", "gyro_rad[0]"}, {"wy", "gyro_rad[1]"}, {"wz", "gyro_rad[2]"}};
  const Columns forces = {{"ax", "accelerometer_m_s2[0]"},
                          {"ay", "accelerometer_m_s2[1]"},
                          {"az", "accelerometer_m_s2[2]"}};
  std::string imus, gnss, origin, others;
  for (const UlogTopic& topic : UlogTopics(log)) {
    if (IsOf(topic, "sensor_combined") && HasAll(topic, rates) && HasAll(topic, forces)) {
      imus += HeadYaml(topic) +
              "    rpy_deg: [180, 0, 0]   # its axes are forward, right and down\n    columns:\n" +
              UlogColumnsYaml(rates, "unit: rad/s") + UlogColumnsYaml(forces, "unit: m/s2");
    } else if (const GpsFields* const f = GpsFieldsOf(topic);
               f != nullptr && IsOf(topic, "vehicle_gps_position")) {
      const bool has_fix_type = HasField(topic, kFixTypeField);
      const std::string place = OriginOfGps(log, topic, *f, has_fix_type);
      if (origin.empty()) origin = place;
      if (!place.empty()) gnss += GpsYaml(topic, *f, has_fix_type);
      if (place.empty()) others += "# not imported: " + topic.name + ", no message has a fix\n";
    } else {
      others += fmt::format("# not imported: {}, {} messages\n", topic.name, topic.messages);
    }
  }
  std::string yaml = fmt::format(
      "# A first mapping by 'tera import --suggest': look at what is marked as guessed.\n"
      "name: {}\nmachine: machine   # guessed: name the machine's folder\nfile: {}\nzero: start\n",
      PlainNameOf(log.stem().string()), YamlWord(log.string()));
  return yaml + origin + (imus.empty() ? "" : "imus:\n" + imus) +
         (gnss.empty() ? "" : "gnss:\n" + gnss) + others;
}

}  // namespace tera
