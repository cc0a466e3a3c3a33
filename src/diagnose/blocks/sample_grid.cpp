#include "diagnose/blocks/sample_grid.h"

#include <cmath>

#include "core/check.h"
#include "diagnose/statistics/robust.h"

namespace tera {

SampleGrid SampleGrid::Under(const std::vector<TimeNs>& t_ns) {
  TERA_CHECK(t_ns.size() >= 2, t_ns.size());
  std::vector<double> step_s;
  for (std::size_t i = 1; i < t_ns.size(); ++i) step_s.push_back(ToSeconds(t_ns[i] - t_ns[i - 1]));
  SampleGrid grid;
  grid.period_s = Median(step_s);
  for (const TimeNs t : t_ns) {
    grid.place.push_back(
        static_cast<std::size_t>(std::llround(ToSeconds(t - t_ns.front()) / grid.period_s)));
  }
  grid.size = grid.place.back() + 1;
  return grid;
}

std::vector<double> SampleGrid::Spread(const std::vector<double>& at_samples) const {
  std::vector<double> values(size, 0.0);
  for (std::size_t i = at_samples.size(); i-- > 0;) values[place[i]] = at_samples[i];
  return values;
}

Series SampleGrid::SpreadSeries(const std::vector<double>& at_samples,
                                const std::vector<bool>& usable) const {
  Series series{period_s, Spread(at_samples), Mask(size, 0)};
  for (std::size_t i = place.size(); i-- > 0;) series.valid[place[i]] = usable[i] ? 1 : 0;
  for (std::size_t k = 0; k < size; ++k) {
    if (!series.valid[k]) series.value[k] = 0;
  }
  return series;
}

}  // namespace tera
