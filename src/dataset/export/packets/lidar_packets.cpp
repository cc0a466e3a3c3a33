#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "core/error.h"
#include "dataset/export/export_job.h"
#include "dataset/export/kitti/kitti_rig.h"
#include "dataset/export/packets/lidar_pattern.h"
#include "dataset/export/packets/ouster_packets.h"
#include "dataset/export/packets/packet_writer.h"
#include "dataset/export/packets/velodyne_packets.h"
#include "dataset/files/checked_file.h"
#include "dataset/files/in_order.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

/// The writer of the unit that has the lidar's pattern. `number` counts lidars from 1.
std::unique_ptr<PacketWriter> WriterOf(const LidarPattern& pattern, std::size_t number,
                                       const fs::path& file) {
  const std::string not_vlp16 = WhyNotVelodyne(pattern, Vlp16());
  const std::string not_vlp32c = WhyNotVelodyne(pattern, Vlp32c());
  const std::string not_ouster = WhyNotOuster(pattern);
  if (not_vlp16.empty()) return MakeVelodyneWriter(Vlp16(), pattern, file);
  if (not_vlp32c.empty()) return MakeVelodyneWriter(Vlp32c(), pattern, file);
  if (not_ouster.empty()) return MakeOusterWriter(pattern, number, file);
  throw InputError(
      pattern.place,
      {FaultKind::kUnsupported,
       fmt::format("is the pattern of no unit whose packets are known. VLP-16: {}; VLP-32C: {}; "
                   "Ouster: {}. Use a preset of config/sensors as it is (vlp16, vlp32c, os0_128, "
                   "os1_32, ...), or choose another lidar by --lidar",
                   not_vlp16, not_vlp32c, not_ouster)});
}

struct LoadedScan {
  std::size_t lidar = 0;
  LidarScan scan;
};

}  // namespace

/// Writes MACHINE/LIDAR.pcap with the packets of each lidar, and MACHINE/LIDAR.json with the
/// metadata of an Ouster. `--lidar` chooses one.
void ExportPackets(ExportJob* job) {
  std::vector<std::string> lidars = job->recording.SensorsOf(ChannelForm::kScans);
  if (lidars.empty() || !job->options.lidar.empty()) lidars = {ChosenLidar(*job)};
  std::vector<std::unique_ptr<PacketWriter>> writers;
  for (const std::string& lidar : lidars) {
    const LidarPattern pattern = ReadLidarPattern(job->recording.directory() / lidar);
    const fs::path file = job->folder / lidar;
    MakeFolder(file.parent_path());
    writers.push_back(WriterOf(pattern, writers.size() + 1, file));
  }
  InOrder<LoadedScan> scans(job->options.threads, [&](const LoadedScan& loaded) {
    const std::string& lidar = lidars[loaded.lidar];
    const fs::path file =
        job->recording.directory() / lidar / "scans" / fmt::format("{}.pcd", loaded.scan.t_ns);
    writers[loaded.lidar]->Take(loaded.scan, job->Stamp(loaded.scan.t_ns, kDefaultStart_ns),
                                file.string());
  });
  RecordStream stream(job->recording, lidars);
  for (Record record; job->Next(&stream, &record);) {
    scans.Give([job, &lidars, record] {
      return LoadedScan{record.channel,
                        job->recording.LoadScan(lidars[record.channel], record.t_ns)};
    });
  }
  scans.Finish();
  for (const auto& writer : writers) writer->Finish();
}

}  // namespace tera
