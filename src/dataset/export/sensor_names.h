#pragma once

#include <string>
#include <vector>

namespace tera {

/// "machine_sensor" for "machine/sensor", for file names.
std::string FlatName(std::string sensor);

/// Throws InputError if two sensors have the same FlatName.
void RequireFlatNamesApart(const std::vector<std::string>& sensors);

}  // namespace tera
