#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tera {

/// Column names in the first line of a CSV file. Throws InputError if the line is absent.
std::vector<std::string> ReadCsvHeader(const std::filesystem::path& file);

/// The named columns of a CSV file with a header, one vector each, in the order of `names`. Other
/// columns may hold any text. Throws InputError with file:line for an absent column, a row of
/// another length, or a field that is not a finite number.
std::vector<std::vector<double>> ReadCsvColumns(const std::filesystem::path& file,
                                                const std::vector<std::string>& names);

}  // namespace tera
