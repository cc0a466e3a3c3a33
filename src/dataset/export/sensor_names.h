#pragma once

#include <string>
#include <vector>

namespace tera {

/// Name of a sensor for files: "machine/sensor" becomes "machine_sensor".
std::string FlatName(std::string sensor);

/// Throws InputError if two sensors have equal FlatNames.
void RequireFlatNamesApart(const std::vector<std::string>& sensors);

}  // namespace tera
