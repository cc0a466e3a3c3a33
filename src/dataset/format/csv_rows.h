#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/types/measurement.h"

/// Headers and rows of a dataset's CSV files. A number is the shortest decimal text that parses to
/// the same double. The files are thus exact and identical on every computer.

namespace tera {

inline constexpr std::string_view kFrameHeader = "t_ns,filename";

/// Header with t_ns and the given columns, which may be empty.
std::string TableHeader(const std::vector<std::string>& columns);

// A row with its line end. Every number must be finite.
std::string RowText(const RowSample& row);
std::string FrameRowText(TimeNs t_ns, std::string_view filename);

}  // namespace tera
