#include "diagnose/blocks/sample_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/check.h"
#include "core/error.h"
#include "diagnose/statistics/series/robust.h"

namespace tera {
namespace {

constexpr double kMostPlacesPerSample = 50;  ///< with more, the grid is mostly empty

double MedianStep_s(const std::vector<TimeNs>& t_ns) {
  std::vector<double> step_s;
  for (std::size_t i = 1; i < t_ns.size(); ++i) step_s.push_back(ToSeconds(t_ns[i] - t_ns[i - 1]));
  return Median(step_s);
}

}  // namespace

bool ComeEvenly(const std::vector<TimeNs>& t_ns) {
  return ToSeconds(t_ns.back() - t_ns.front()) <=
         kMostPlacesPerSample * MedianStep_s(t_ns) * static_cast<double>(t_ns.size());
}

Series WholeSeries(double period_s, std::vector<double> values) {
  Mask all(values.size(), 1);
  return {period_s, std::move(values), std::move(all)};
}

SampleGrid SampleGrid::Under(const std::vector<TimeNs>& t_ns) {
  TERA_CHECK(t_ns.size() >= 2, t_ns.size());
  const double period_s = MedianStep_s(t_ns);
  const double length_s = ToSeconds(t_ns.back() - t_ns.front());
  if (!ComeEvenly(t_ns)) {
    throw InputError(
        fmt::format("{} samples, {:.6f} s apart at the median, reach over {:.0f} s: they come in "
                    "bursts or leave a long gap; need samples that come about evenly (--from and "
                    "--to look at a part)",
                    t_ns.size(), period_s, length_s));
  }
  return Over(t_ns.front(), t_ns.back(), period_s, t_ns);
}

SampleGrid SampleGrid::Over(TimeNs first_ns, TimeNs last_ns, double period_s,
                            const std::vector<TimeNs>& t_ns) {
  const auto place_of = [&](TimeNs t) {
    return static_cast<std::size_t>(std::llround(ToSeconds(t - first_ns) / period_s));
  };
  SampleGrid grid{period_s, place_of(last_ns) + 1, {}};
  for (const TimeNs t : t_ns) grid.place.push_back(place_of(t));
  return grid;
}

SampleGrid SampleGrid::First(std::size_t places) const {
  const auto end = std::lower_bound(place.begin(), place.end(), places);
  return {period_s, places, {place.begin(), end}};
}

std::vector<double> SampleGrid::Spread(const std::vector<double>& at_samples) const {
  std::vector<double> values(size, 0.0);
  for (std::size_t i = at_samples.size(); i-- > 0;) values[place[i]] = at_samples[i];
  for (std::size_t i = 1; i < place.size(); ++i) {
    const std::size_t from = place[i - 1], to = place[i];
    for (std::size_t k = from + 1; k < to; ++k) {
      values[k] = std::lerp(values[from], values[to],
                            static_cast<double>(k - from) / static_cast<double>(to - from));
    }
  }
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
