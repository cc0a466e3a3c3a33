#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tera {

/// Names of the columns in the first line of a CSV file. Throws InputError if there is none.
std::vector<std::string> ReadCsvHeader(const std::filesystem::path& file);

/// The named columns of a CSV file with a header, one vector each, in the order of `names`; other
/// columns may hold anything. Throws InputError with file:line for a missing column, a row with
/// another number of fields, and a field that is not a finite number.
std::vector<std::vector<double>> ReadCsvColumns(const std::filesystem::path& file,
                                                const std::vector<std::string>& names);

}  // namespace tera
