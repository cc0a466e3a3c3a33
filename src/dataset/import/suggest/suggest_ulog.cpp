#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "core/error.h"
#include "dataset/import/logs/ulog.h"
#include "dataset/import/suggest/guess.h"
#include "dataset/import/suggest/suggest.h"

// Guesses about a log of PX4.

namespace tera {
namespace {

using Columns = std::vector<std::pair<const char*, const char*>>;  // key, field

bool HasAll(const UlogTopic& topic, const Columns& columns) {
  return std::all_of(columns.begin(), columns.end(), [&](const auto& column) {
    return std::find(topic.fields.begin(), topic.fields.end(), column.second) != topic.fields.end();
  });
}

std::string UlogColumnsYaml(const Columns& columns, const std::string& unit) {
  std::string yaml;
  for (const auto& [key, field] : columns) {
    yaml += fmt::format("      {}: {{column: \"{}\", {}}}\n", key, field, unit);
  }
  return yaml;
}

/// "sensor_combined", of the topic "sensor_combined" or "sensor_combined[1]".
bool IsOf(const UlogTopic& topic, const std::string& format) {
  return topic.name == format || topic.name.starts_with(format + "[");
}

std::string HeadYaml(const UlogTopic& topic) {
  return fmt::format("  - name: {}\n    topic: {}\n", PlainNameOf(topic.name),
                     YamlWord(topic.name));
}

}  // namespace

std::string SuggestForUlog(const std::filesystem::path& log) {
  const Columns rates = {{"wx", "gyro_rad[0]"}, {"wy", "gyro_rad[1]"}, {"wz", "gyro_rad[2]"}};
  const Columns forces = {{"ax", "accelerometer_m_s2[0]"},
                          {"ay", "accelerometer_m_s2[1]"},
                          {"az", "accelerometer_m_s2[2]"}};
  const Columns angles = {{"lat", "latitude_deg"}, {"lon", "longitude_deg"}};
  const Columns height = {{"alt", "altitude_ellipsoid_m"}};
  std::string imus, gnss, others;
  for (const UlogTopic& topic : UlogTopics(log)) {
    if (IsOf(topic, "sensor_combined") && HasAll(topic, rates) && HasAll(topic, forces)) {
      imus += HeadYaml(topic) +
              "    rpy_deg: [180, 0, 0]   # its axes are forward, right and down\n    columns:\n" +
              UlogColumnsYaml(rates, "unit: rad/s") + UlogColumnsYaml(forces, "unit: m/s2");
    } else if (IsOf(topic, "vehicle_gps_position") && HasAll(topic, angles) &&
               HasAll(topic, height)) {
      gnss += HeadYaml(topic) + "    columns:\n" + UlogColumnsYaml(angles, "unit: deg") +
              UlogColumnsYaml(height, "unit: m") +
              "      fix: {constant: 1}   # guessed: fix_type is not GGA's quality\n"
              "      var_e: {constant: 4}   # guessed\n      var_n: {constant: 4}   # guessed\n"
              "      var_u: {constant: 9}   # guessed\n";
    } else {
      others += fmt::format("# not imported: {}, {} messages\n", topic.name, topic.messages);
    }
  }
  std::string yaml = fmt::format(
      "# A first mapping by 'tera import --suggest': look at what is marked as guessed.\n"
      "name: {}\nmachine: machine   # guessed: name the machine's folder\nfile: {}\nzero: start\n",
      PlainNameOf(log.stem().string()), YamlWord(log.string()));
  if (!gnss.empty()) {
    yaml += "origin: {lat_deg: 0, lon_deg: 0, height_m: 0}   # guessed: give a place near by\n";
  }
  return yaml + (imus.empty() ? "" : "imus:\n" + imus) + (gnss.empty() ? "" : "gnss:\n" + gnss) +
         others;
}

}  // namespace tera
