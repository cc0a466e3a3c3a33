#include "dataset/overview/film.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "dataset/files/checked_file.h"
#include "dataset/files/child_process.h"
#include "dataset/overview/picture.h"

namespace tera {
namespace {

constexpr int kFilmTileWidth_px = 480, kFilmTileHeight_px = 360;
constexpr int kQuality = 21;  ///< constant rate factor of x264: smaller is better

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

/// The latest frame at or before `t_ns`, else the first.
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

}  // namespace

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

}  // namespace tera
