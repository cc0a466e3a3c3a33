#include "dataset/export/sensor_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/error.h"

namespace tera {

std::string FlatName(std::string sensor) {
  std::replace(sensor.begin(), sensor.end(), '/', '_');
  return sensor;
}

void RequireFlatNamesApart(const std::vector<std::string>& sensors) {
  std::map<std::string, std::string> sensor_of;
  for (const std::string& sensor : sensors) {
    const auto [other, is_new] = sensor_of.try_emplace(FlatName(sensor), sensor);
    if (is_new) continue;
    throw InputError(
        sensor, {FaultKind::kRepeated, fmt::format("its files would have the same names as those "
                                                   "of {}, '{}_...'; rename one of the two folders",
                                                   other->second, other->first)});
  }
}

}  // namespace tera
