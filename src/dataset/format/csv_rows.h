#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/types/measurement.h"

/// Headers and rows of a dataset's CSV files. Numbers are the shortest decimals that read back as
/// the same double, so files are exact and equal on every computer.

namespace tera {

inline constexpr std::string_view kFrameHeader = "t_ns,filename";

/// t_ns and the columns of a table, which may have none.
std::string TableHeader(const std::vector<std::string>& columns);

// Rows with their line ends. Every number must be finite.
std::string RowText(const RowSample& row);
std::string FrameRowText(TimeNs t_ns, std::string_view filename);

}  // namespace tera
