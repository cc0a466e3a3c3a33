#include <benchmark/benchmark.h>
#include <fcntl.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

#include "core/check.h"
#include "core/stopwatch.h"
#include "dataset/format/writer.h"
#include "dig_site.h"
#include "scratch_folder.h"
#include "verdict.h"

// Frames of the quickstart's depth camera to PNG and disk as fast as the writer takes them, beside
// write() of the same files.

namespace tera::bench {
namespace {

constexpr int kFrames = 60;
constexpr double kBytesPerMegabyte = 1e6;

std::vector<CameraFrame> RenderedFrames() {
  const DigSite& site = TheDigSite();
  const std::size_t s = site.IndexOf("camera_front");
  Rasterizer rasterizer(site.model(), {});
  Camera camera(std::get<CameraModel>(site.sensors()[s].model), {10.0}, 0, 1, "bench");
  std::vector<CameraFrame> frames;
  for (std::size_t k = 0; k < site.instants().size(); ++k) {
    frames.push_back(camera.Measure(static_cast<std::int64_t>(k), site.instants()[k].X_WS[s],
                                    site.instants()[k].scene, &rasterizer));
  }
  return frames;
}

/// Writes a whole recording of the frames, over and over, to `folder`; returns its bytes.
double WriteRecording(const std::vector<CameraFrame>& frames, const std::filesystem::path& folder,
                      int threads) {
  DatasetInfo info;
  info.scenario_name = "bench";
  DatasetWriter writer(folder, info, {.threads = threads});
  const ChannelInfo camera{
      "machine/camera", std::string(kCameraChannel), ChannelForm::kPictures, "type: camera\n", {}};
  const ChannelId channel = writer.AddChannel(camera);
  for (int k = 0; k < kFrames; ++k) {
    CameraFrame frame = frames[k % frames.size()];
    frame.t_ns = k;
    frame.t_available_ns = k;
    writer.Write(channel, std::move(frame));
  }
  writer.Finish();
  return static_cast<double>(writer.bytes_written());
}

std::vector<std::string> ContentsOf(const std::filesystem::path& folder) {
  std::vector<std::string> contents;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    std::stringstream bytes;
    bytes << std::ifstream(entry.path(), std::ios::binary).rdbuf();
    contents.push_back(bytes.str());
  }
  return contents;
}

void WriteRaw(const std::vector<std::string>& contents, const std::filesystem::path& folder) {
  for (std::size_t i = 0; i < contents.size(); ++i) {
    const std::string file = folder / std::to_string(i);
    const int descriptor = open(file.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0644);
    TERA_CHECK(descriptor >= 0, file);
    const ssize_t written = write(descriptor, contents[i].data(), contents[i].size());
    TERA_CHECK(written == static_cast<ssize_t>(contents[i].size()), file, written);
    close(descriptor);
  }
}

void DatasetWriting(benchmark::State& state) {
  static const std::vector<CameraFrame> frames = RenderedFrames();
  const ScratchFolder dataset("dataset"), raw("raw");
  double writer_s = 0, raw_s = 0, bytes = 0;
  for (auto _ : state) {
    dataset.Empty();
    raw.Empty();
    {
      const Stopwatch watch(&writer_s);
      bytes += WriteRecording(frames, dataset.path() / "out", static_cast<int>(state.range(0)));
    }
    const std::vector<std::string> contents = ContentsOf(dataset.path());
    const Stopwatch watch(&raw_s);
    WriteRaw(contents, raw.path());
  }
  state.counters["writer_MBps"] = bytes / writer_s / kBytesPerMegabyte;
  state.counters["raw_MBps"] = bytes / raw_s / kBytesPerMegabyte;
  const double frames_written = kFrames * static_cast<double>(state.iterations());
  state.counters["frames_ps"] = frames_written / writer_s;
  state.counters["MB_a_frame"] = bytes / frames_written / kBytesPerMegabyte;
}
BENCHMARK(DatasetWriting)
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond)
    ->Iterations(3);

}  // namespace
}  // namespace tera::bench
