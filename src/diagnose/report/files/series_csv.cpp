#include "diagnose/report/files/series_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace tera {
namespace {

/// "_radps" of "excavator1/encoders/boom_radps"; nothing where the name has no unit.
std::string UnitOf(const std::string& channel) {
  const std::size_t at = channel.rfind('_');
  return at == std::string::npos || channel.find('/', at) != std::string::npos ? ""
                                                                               : channel.substr(at);
}

}  // namespace

std::string SeriesFileName(const std::string& channel) {
  std::string name = "series_" + channel + ".csv";
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
}

bool HasSeries(const DiagnosedBlock& diagnosed) {
  const std::size_t channels = diagnosed.block.channels.size();
  const SearchResult& search = diagnosed.diagnosis.search;
  return search.nothing.misfit.residual.size() == channels &&
         search.found.misfit.residual.size() == channels;
}

std::string SeriesCsv(const DiagnosedBlock& diagnosed, std::size_t channel) {
  const ReplayBlock& block = diagnosed.block;
  const Series& measured = block.channels[channel].measured;
  const Series& before = diagnosed.diagnosis.search.nothing.misfit.residual[channel];
  const Series& after = diagnosed.diagnosis.search.found.misfit.residual[channel];
  const std::string unit = UnitOf(block.channels[channel].name);
  std::string csv = fmt::format(
      "t_ns,measured{0},simulated_before{0},simulated_after{0},error_before{0},error_after{0}\n",
      unit);
  for (std::size_t k = 0; k < measured.size(); ++k) {
    if (!measured.valid[k] || !before.valid[k] || !after.valid[k]) continue;
    const double m = measured.value[k], b = before.value[k], a = after.value[k];
    fmt::format_to(std::back_inserter(csv), "{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}\n",
                   std::llround(1e9 * block.time_s(k)), m, m - b, m - a, b, a);
  }
  return csv;
}

}  // namespace tera
