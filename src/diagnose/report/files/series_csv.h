#pragma once

#include <string>

#include "diagnose/diagnosed_block.h"

namespace tera {

/// "series_excavator1_encoders_boom_radps.csv" of the channel of that name.
std::string SeriesFileName(const std::string& channel);

/// A channel of a block as it was judged: t_ns, what was measured, what was simulated before and
/// after, and the error that each leaves, in the channel's unit. A row for each sample of the grid
/// at which all are known.
std::string SeriesCsv(const DiagnosedBlock& diagnosed, std::size_t channel);

/// Whether the block was replayed, so that there is something to write.
bool HasSeries(const DiagnosedBlock& diagnosed);

}  // namespace tera
