#include "dataset/overview/overview.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <string_view>
#include <utility>

#include "core/types/label_channels.h"
#include "core/units.h"
#include "dataset/files/checked_file.h"
#include "dataset/files/child_process.h"
#include "dataset/format/png.h"
#include "dataset/format/recording.h"
#include "dataset/format/series_tables.h"
#include "dataset/overview/gnuplot.h"
#include "dataset/overview/picture.h"
#include "dataset/overview/scan_picture.h"

namespace tera {
namespace {

constexpr int kFilmTileWidth_px = 480, kFilmTileHeight_px = 360;
constexpr int kQuality = 21;  ///< constant rate factor of x264; smaller values give higher quality

struct CameraTrack {
  std::string folder;
  std::vector<TimeNs> times;
};

std::vector<CameraTrack> Cameras(const Recording& recording) {
  std::vector<CameraTrack> cameras;
  for (const std::string& folder : recording.SensorsOf(ChannelForm::kPictures)) {
    auto times = recording.FrameTimes(folder);
    if (!times.empty()) cameras.push_back({folder, std::move(times)});
  }
  return cameras;
}

/// Time of the latest frame at or before `t_ns`, or else of the first frame.
TimeNs Latest(const CameraTrack& camera, TimeNs t_ns) {
  const auto after = std::upper_bound(camera.times.begin(), camera.times.end(), t_ns);
  return after == camera.times.begin() ? camera.times.front() : *(after - 1);
}

double FrameRate(const std::vector<TimeNs>& times) {
  if (times.size() < 2) return 1.0;
  return static_cast<double>(times.size() - 1) / ToSeconds(times.back() - times.front());
}

Picture FilmFrame(const Recording& recording, const std::vector<CameraTrack>& cameras,
                  TimeNs t_ns) {
  Picture sheet(kFilmTileWidth_px * static_cast<int>(cameras.size()), 2 * kFilmTileHeight_px, 3);
  int x_px = 0;
  for (const CameraTrack& camera : cameras) {
    const CameraFrame frame = recording.LoadFrame(camera.folder, Latest(camera, t_ns));
    const std::string caption = fmt::format("{} {:.1f} s", camera.folder, ToSeconds(frame.t_ns));
    if (!frame.rgb.empty()) {
      Paste(FitTile(frame.rgb, kFilmTileWidth_px, kFilmTileHeight_px, caption), x_px, 0, &sheet);
    }
    bool has_labels = false;
    ForEachLabel(frame, [&](const LabelChannel& channel, const auto& picture) {
      if (picture.empty() || std::exchange(has_labels, true)) return;
      Paste(FitTile(ColourLabels(channel.colours, picture), kFilmTileWidth_px, kFilmTileHeight_px,
                    std::string(channel.caption)),
            x_px, kFilmTileHeight_px, &sheet);
    });
    x_px += kFilmTileWidth_px;
  }
  return sheet;
}

/// Writes a video (H.264, yuv420p) of all cameras side by side, with the program ffmpeg. Colour is
/// in the upper row, the first label channel (usually classes) in the lower. The frame rate is that
/// of the first camera; other cameras show their latest frame. Writes nothing if no camera has
/// frames. Throws InputError if ffmpeg is not installed.
void WriteFilm(const Recording& recording, const std::filesystem::path& mp4) {
  const std::vector<CameraTrack> cameras = Cameras(recording);
  if (cameras.empty()) return;
  CheckedFile film(mp4);
  const std::string arguments = fmt::format(
      "-y -loglevel quiet -f rawvideo -pix_fmt rgb24 -s {}x{} -r {:.6g} -i - -c:v libx264 "
      "-preset veryfast -crf {} -pix_fmt yuv420p -movflags +faststart -f mp4 {}",
      kFilmTileWidth_px * cameras.size(), 2 * kFilmTileHeight_px, FrameRate(cameras.front().times),
      kQuality, ShellWord(film.temporary().string()));
  ChildProcess ffmpeg("ffmpeg", arguments,
                      fmt::format("need ffmpeg with libx264 (Debian package ffmpeg), and space "
                                  "on the disk for {}",
                                  mp4.string()));
  for (const TimeNs t_ns : cameras.front().times) {
    const Picture frame = FilmFrame(recording, cameras, t_ns);
    ffmpeg.Write({reinterpret_cast<const char*>(frame.data.data()), frame.data.size()});
  }
  ffmpeg.Close();
  film.Commit();
}

constexpr int kColumns = 4, kTileWidth_px = 400, kTileHeight_px = 300;
constexpr int kSheetWidth_px = kColumns * kTileWidth_px;
constexpr double kStill_m = 0.05;  ///< shorter motions are not drawn
constexpr int kScanWidth_px = kSheetWidth_px / 2, kScanHeight_px = 600;

/// The middle frame, in which machines probably work.
TimeNs Middle(const std::vector<TimeNs>& times) { return times[times.size() / 2]; }

/// Colour, depth and labels of one camera, in as many rows as needed.
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

/// Trajectories of machines and GNSS receivers. Stationary ones are left out.
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
    if (std::filesystem::path(file).filename() != "pose.csv")
      continue;  // skips poses of links and sensors
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

/// A unit, recognised by the ending of a column name, and how charts show it.
struct ShownUnit {
  std::string_view ending;
  std::string_view shown;
  double unit;
};
constexpr std::array<ShownUnit, 5> kShownUnits = {{
    {"rad", "deg", kDeg},
    {"radps", "rad/s", 1},
    {"m", "m", 1},
    {"mps", "m/s", 1},
    {"mps2", "m/s2", 1},
}};

/// Parts of a column name before and after the last underscore.
std::pair<std::string, std::string> NameAndUnit(const std::string& column) {
  const std::size_t at = column.rfind('_');
  if (at == std::string::npos) return {column, ""};
  return {column.substr(0, at), column.substr(at + 1)};
}

/// Units of the columns: first those in kShownUnits, in that order, then others.
std::vector<ShownUnit> UnitsOf(const std::vector<std::string>& columns) {
  std::vector<ShownUnit> units;
  const auto any = [&](std::string_view ending) {
    return std::any_of(columns.begin(), columns.end(),
                       [&](const std::string& c) { return NameAndUnit(c).second == ending; });
  };
  std::copy_if(kShownUnits.begin(), kShownUnits.end(), std::back_inserter(units),
               [&](const ShownUnit& unit) { return any(unit.ending); });
  for (const std::string& column : columns) {
    const std::string_view ending =
        std::string_view(column).substr(column.size() - NameAndUnit(column).second.size());
    const bool is_there = std::any_of(units.begin(), units.end(),
                                      [&](const ShownUnit& unit) { return unit.ending == ending; });
    if (!is_there) units.push_back({ending, ending, 1});
  }
  return units;
}

/// Adds charts of a sensor's values over time, one per unit.
void AddSeries(const std::string& folder, const TableRecording& series,
               std::vector<Chart>* charts) {
  for (const ShownUnit& unit : UnitsOf(series.columns)) {
    Chart chart{folder, "time in s", std::string(unit.shown), false, {}};
    for (std::size_t c = 0; c < series.columns.size(); ++c) {
      const auto [name, ending] = NameAndUnit(series.columns[c]);
      if (ending != unit.ending) continue;
      Curve curve{name, {}, {}};
      for (std::size_t row = 0; row < series.rows.size(); ++row) {
        curve.x.push_back(ToSeconds(series.t_ns[row]));
        curve.y.push_back(series.rows[row][c] / unit.unit);
      }
      chart.curves.push_back(std::move(curve));
    }
    charts->push_back(std::move(chart));
  }
}

std::vector<Chart> AllCharts(const Recording& recording) {
  std::vector<Chart> charts = {TrajectoryChart(recording)};
  for (const std::string& folder : recording.SeriesChannels()) {
    AddSeries(folder, recording.LoadRows(folder), &charts);
  }
  for (const std::string& table : SeriesTables(recording)) {
    AddSeries(table, recording.LoadTable(table), &charts);
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
  for (const std::string& folder : recording.SensorsOf(ChannelForm::kPictures)) {
    rows.push_back(CameraRow(recording, folder));
  }
  for (const std::string& folder : recording.SensorsOf(ChannelForm::kScans)) {
    rows.push_back(LidarRow(recording, folder));
  }
  rows.push_back(ChartRows(recording, png));
  WriteWholeFile(png, EncodeRgbPng(Stack(rows)));
  WriteFilm(recording, mp4);
}

}  // namespace tera
