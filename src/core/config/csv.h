#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tera {

/// Column names from the first line of a CSV file. Throws InputError if the file has no such line.
std::vector<std::string> ReadCsvHeader(const std::filesystem::path& file);

/// The named columns of a CSV file with a header: one vector per name, in the order of `names`.
/// Other columns are ignored. Throws InputError with file and line if a column is absent or a row
/// has a wrong number of fields. Also throws if a field of a named column is not a finite number.
std::vector<std::vector<double>> ReadCsvColumns(const std::filesystem::path& file,
                                                const std::vector<std::string>& names);

}  // namespace tera
