#pragma once

#include <string>
#include <vector>

namespace tera {

/// "machine_sensor" of "machine/sensor": a name of a file.
std::string FlatName(std::string sensor);

/// Throws InputError where two sensors would have the same FlatName.
void RequireFlatNamesApart(const std::vector<std::string>& sensors);

}  // namespace tera
