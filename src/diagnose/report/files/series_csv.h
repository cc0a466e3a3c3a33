#pragma once

#include <string>

#include "diagnose/diagnosed_block.h"

namespace tera {

/// "series_excavator1_encoders_boom_radps.csv" of the channel of that name.
std::string SeriesFileName(const std::string& channel);

/// A channel of a block as judged: t_ns, the measurement, the simulation before and after, and both
/// residuals, in the channel's unit. One row for each grid sample with all values known.
std::string SeriesCsv(const DiagnosedBlock& diagnosed, std::size_t channel);

/// Whether the block was replayed, so that it has series.
bool HasSeries(const DiagnosedBlock& diagnosed);

}  // namespace tera
