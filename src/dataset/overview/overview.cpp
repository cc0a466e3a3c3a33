#include "dataset/overview/overview.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/types/label_channels.h"
#include "core/units.h"
#include "dataset/files/checked_file.h"
#include "dataset/format/png.h"
#include "dataset/format/recording.h"
#include "dataset/overview/film.h"
#include "dataset/overview/gnuplot.h"
#include "dataset/overview/picture.h"
#include "dataset/overview/scan_picture.h"

namespace tera {
namespace {

constexpr int kColumns = 4, kTileWidth_px = 400, kTileHeight_px = 300;
constexpr int kSheetWidth_px = kColumns * kTileWidth_px;
constexpr double kStill_m = 0.05;  ///< what moves less is not drawn as a trajectory
constexpr int kScanWidth_px = kSheetWidth_px / 2, kScanHeight_px = 600;

/// The frame in the middle of a recording, where work is going on.
TimeNs Middle(const std::vector<TimeNs>& times) { return times[times.size() / 2]; }

/// Colour, depth and labels of one camera side by side, in as many lines as they need.
Picture CameraRow(const Recording& recording, const std::string& folder) {
  const auto times = recording.FrameTimes(folder);
  if (times.empty()) return Picture(kSheetWidth_px, kTileHeight_px, 3);
  const CameraFrame frame = recording.LoadFrame(folder, Middle(times));
  std::vector<Picture> tiles;
  const auto add = [&](const Picture& picture, std::string_view caption) {
    tiles.push_back(FitTile(picture, kTileWidth_px, kTileHeight_px, std::string(caption)));
  };
  const std::string caption = fmt::format("{} {:.1f} s", folder, ToSeconds(frame.t_ns));
  if (!frame.rgb.empty()) add(frame.rgb, caption);
  if (!frame.depth_m.empty()) add(ColourDepth(frame.depth_m), "depth");
  ForEachLabel(frame, [&](const LabelChannel& channel, const auto& picture) {
    if (!picture.empty()) add(ColourLabels(channel.colours, picture), channel.caption);
  });
  const int lines = std::max(1, (static_cast<int>(tiles.size()) + kColumns - 1) / kColumns);
  Picture row(kSheetWidth_px, lines * kTileHeight_px, 3);
  for (int k = 0; k < static_cast<int>(tiles.size()); ++k) {
    Paste(tiles[static_cast<std::size_t>(k)], k % kColumns * kTileWidth_px,
          k / kColumns * kTileHeight_px, &row);
  }
  return row;
}

Picture LidarRow(const Recording& recording, const std::string& folder) {
  Picture row(kSheetWidth_px, kScanHeight_px, 3);
  const auto times = recording.FrameTimes(folder);
  if (times.empty()) return row;
  const LidarScan scan = recording.LoadScan(folder, Middle(times));
  const std::string caption = fmt::format("{} {:.1f} s, ", folder, ToSeconds(scan.t_ns));
  const auto add = [&](const Picture& drawn, int x_px, const char* how) {
    Paste(FitTile(drawn, kScanWidth_px, kScanHeight_px, caption + how), x_px, 0, &row);
  };
  add(DrawScanFromAbove(scan.points, kScanWidth_px, kScanHeight_px), 0,
      "from above, rings each 10 m");
  add(DrawScanFromBehind(scan.points, kScanWidth_px, kScanHeight_px), kScanWidth_px, "from behind");
  return row;
}

double Extent(const std::vector<double>& values) {
  if (values.empty()) return 0;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high - *low;
}

/// Where machines went and what their GNSS receivers measured, but for what stayed where it was.
Chart TrajectoryChart(const Recording& recording) {
  Chart chart{"trajectories from above", "east in m", "north in m", true, {}};
  const auto add = [&](const std::string& title, const auto& samples, const auto& place_of) {
    Curve curve{title, {}, {}};
    for (const auto& sample : samples) {
      const Vec3 p_m = place_of(sample);
      curve.x.push_back(p_m.x());
      curve.y.push_back(p_m.y());
    }
    if (Extent(curve.x) + Extent(curve.y) > kStill_m) chart.curves.push_back(std::move(curve));
  };
  for (const std::string& file : recording.ChannelsOf(kPoseChannel)) {
    add(std::filesystem::path(file).parent_path().filename(), recording.LoadPose(file).poses,
        [](const TruthPose& pose) -> Vec3 { return pose.X_WB.translation(); });
  }
  for (const std::string& folder : recording.ChannelsOf(kGnssChannel)) {
    std::vector<GnssSample> fixes = recording.LoadGnss(folder);
    std::erase_if(fixes, [](const GnssSample& s) { return s.fix == GnssFix::kNone; });
    add(folder, fixes, [](const GnssSample& s) { return s.enu_m; });
  }
  return chart;
}

/// One curve for each of `count` values of the samples.
template <typename Samples, typename ValueOf>
std::vector<Curve> Curves(const Samples& samples, const std::vector<std::string>& titles,
                          const ValueOf& value_of) {
  std::vector<Curve> curves;
  for (std::size_t i = 0; i < titles.size(); ++i) {
    Curve curve{titles[i], {}, {}};
    for (const auto& sample : samples) {
      curve.x.push_back(ToSeconds(sample.t_ns));
      curve.y.push_back(value_of(sample, i));
    }
    curves.push_back(std::move(curve));
  }
  return curves;
}

std::vector<Chart> AllCharts(const Recording& recording) {
  std::vector<Chart> charts = {TrajectoryChart(recording)};
  const auto time_chart = [&](const std::string& title, const char* y, std::vector<Curve> curves) {
    charts.push_back({title, "time in s", y, false, std::move(curves)});
  };
  for (const std::string& folder : recording.ChannelsOf(kImuChannel)) {
    const auto samples = recording.LoadImu(folder);
    const auto axis = [](std::size_t i) { return static_cast<Eigen::Index>(i); };
    time_chart(folder, "rad/s", Curves(samples, {"wx", "wy", "wz"}, [&](const auto& s, auto i) {
                 return s.w_WS_S_radps[axis(i)];
               }));
    time_chart(folder, "m/s2", Curves(samples, {"ax", "ay", "az"}, [&](const auto& s, auto i) {
                 return s.f_S_mps2[axis(i)];
               }));
  }
  for (const std::string& folder : recording.ChannelsOf(kEncoderChannel)) {
    const EncoderRecording encoder = recording.LoadEncoder(folder);
    for (const bool linear : {false, true}) {
      std::vector<std::string> names;
      std::vector<std::size_t> places;
      for (std::size_t i = 0; i < encoder.axes.size(); ++i) {
        if (encoder.axes[i].linear != linear) continue;
        names.push_back(encoder.axes[i].name);
        places.push_back(i);
      }
      if (names.empty()) continue;
      const double unit = linear ? 1.0 : kDeg;
      time_chart(folder, linear ? "m" : "deg",
                 Curves(encoder.samples, names,
                        [&](const auto& s, std::size_t i) { return s.q_rad[places[i]] / unit; }));
      time_chart(folder, linear ? "m/s" : "rad/s",
                 Curves(encoder.samples, names,
                        [&](const auto& s, std::size_t i) { return s.qd_radps[places[i]]; }));
    }
  }
  return charts;
}

Picture ChartRows(const Recording& recording, const std::filesystem::path& png) {
  const std::vector<Chart> charts = AllCharts(recording);
  const int rows = (static_cast<int>(charts.size()) + kColumns - 1) / kColumns;
  std::filesystem::path drawn = png;
  drawn += ".charts.png";
  DrawCharts(charts, kColumns, kSheetWidth_px, rows * kTileHeight_px, drawn);
  Picture picture = ReadRgbPng(drawn);
  std::filesystem::remove(drawn);
  return picture;
}

Picture Stack(const std::vector<Picture>& rows) {
  int height_px = 0;
  for (const Picture& row : rows) height_px += row.height_px;
  Picture sheet(kSheetWidth_px, height_px, 3);
  int y_px = 0;
  for (const Picture& row : rows) {
    Paste(row, 0, y_px, &sheet);
    y_px += row.height_px;
  }
  return sheet;
}

}  // namespace

void WriteOverview(const std::filesystem::path& dataset, const std::filesystem::path& png,
                   const std::filesystem::path& mp4) {
  const Recording recording(dataset);
  std::vector<Picture> rows;
  for (const std::string& folder : recording.ChannelsOf(kCameraChannel)) {
    rows.push_back(CameraRow(recording, folder));
  }
  for (const std::string& folder : recording.ChannelsOf(kLidarChannel)) {
    rows.push_back(LidarRow(recording, folder));
  }
  rows.push_back(ChartRows(recording, png));
  WriteWholeFile(png, EncodeRgbPng(Stack(rows)));
  WriteFilm(recording, mp4);
}

}  // namespace tera
