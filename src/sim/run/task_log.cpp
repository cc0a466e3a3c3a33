#include "sim/run/task_log.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/types/sample_rows.h"
#include "core/units.h"
#include "soil/site/map_raster.h"

namespace tera {
namespace {

constexpr TimeNs kTaskPeriod_ns = 100'000'000;
/// Share of the floor that must be within the tolerance, and for how long. The time shows whether
/// soil slides back.
constexpr double kDoneShare = 0.95;
constexpr TimeNs kDoneFor_ns = 5'000'000'000;

}  // namespace

ChannelInfo TaskChannel() {
  return TableChannel("truth/task.csv", {"to_cut_m3", "cut_beyond_m3", "within_share", "lowest_m",
                                         "highest_m", "rms_m"});
}

TaskLog::TaskLog(const Scenario& scenario, const TerrainSurface& ground, MeasurementSink* sink)
    : scenario_(scenario), ground_(ground), sink_(sink) {
  if (!scenario.task) return;
  columns_.emplace(*scenario.task, scenario.site->surface());
  channel_ = sink->AddChannel(TaskChannel());
  next_ = 0;
  Write(0);
}

void TaskLog::Write(TimeNs t_ns) {
  if (!columns_ || t_ns < next_ * kTaskPeriod_ns) return;
  next_ = t_ns / kTaskPeriod_ns + 1;
  deviation_ = columns_->Compare(ground_);
  const TaskDeviation& now = *deviation_;
  sink_->Write(channel_, RowSample{t_ns,
                                   t_ns,
                                   {now.to_cut_m3, now.cut_beyond_m3, now.within, now.lowest_m,
                                    now.highest_m, now.rms_m}});
  if (now.within < kDoneShare) {
    within_since_ns_.reset();
  } else if (!within_since_ns_) {
    within_since_ns_ = t_ns;
  }
  done_ = within_since_ns_ && t_ns - *within_since_ns_ >= kDoneFor_ns;
}

void TaskLog::WriteMap(const std::filesystem::path& file) const {
  SiteMap map{.low_W_m = ground_.origin_W_m,
              .square_m = ground_.cell_m,
              .nx = 0,
              .ny = 0,
              .values = {},
              .unit = "m",
              .description = "ground minus design"};
  int i0 = ground_.nx, i1 = -1, j0 = ground_.ny, j1 = -1;
  columns_->ForEach([&](int i, int j, double) {
    i0 = std::min(i0, i);
    i1 = std::max(i1, i);
    j0 = std::min(j0, j);
    j1 = std::max(j1, j);
  });
  if (i1 < i0) return;
  map.low_W_m += ground_.cell_m * Vec2(i0 - 0.5, j0 - 0.5);
  map.nx = i1 - i0 + 1;
  map.ny = j1 - j0 + 1;
  map.values.assign(static_cast<std::size_t>(map.nx) * map.ny,
                    std::numeric_limits<float>::quiet_NaN());
  columns_->ForEach([&](int i, int j, double design_m) {
    const std::size_t at = static_cast<std::size_t>(j - j0) * map.nx + (i - i0);
    map.values[at] = static_cast<float>(ground_.height_m(i, j) - design_m);
  });
  WriteSiteMap(file, map, scenario_.origin);
}

}  // namespace tera
