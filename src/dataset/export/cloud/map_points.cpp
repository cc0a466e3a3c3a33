#include "dataset/export/cloud/map_points.h"

#include <optional>
#include <string>
#include <vector>

#include "dataset/export/sensor_track.h"
#include "dataset/files/in_order.h"

namespace tera {
namespace {

/// Encoded points of one scan.
struct MapPart {
  std::string bytes;
  MapExtent extent;
};

MapPart PartOf(const ExportJob& job, const std::string& lidar, const PoseTrack& track,
               const Record& record, const PlaceOnMap& place, AppendMapPoint append) {
  MapPart part;
  const LidarScan scan = job.recording.LoadScan(lidar, record.t_ns);
  Pose X_WS = Pose::Identity();
  std::optional<TimeNs> posed_ns;  // time of the last computed pose; consecutive rays often have
                                   // equal times
  for (const LidarPoint& point : scan.points) {
    const TimeNs t_ns = scan.t_ns + point.time_offset_ns;
    if (posed_ns != t_ns) X_WS = track.At(t_ns);
    posed_ns = t_ns;
    const Vec3 p_m = place(X_WS * Vec3(point.x_m, point.y_m, point.z_m));
    part.extent.Include({1, p_m, p_m});
    append({p_m, point.intensity, job.Stamp(t_ns), static_cast<std::uint16_t>(record.channel),
            point.ring, point.instance, point.label},
           &part.bytes);
  }
  return part;
}

}  // namespace

void MapExtent::Include(const MapExtent& part) {
  if (part.points == 0) return;
  least_m = points == 0 ? part.least_m : least_m.cwiseMin(part.least_m);
  most_m = points == 0 ? part.most_m : most_m.cwiseMax(part.most_m);
  points += part.points;
}

MapExtent WriteMapPoints(ExportJob* job, const PlaceOnMap& place, AppendMapPoint append,
                         CountedFile* file) {
  const std::vector<std::string> lidars = job->recording.SensorsOf(ChannelForm::kScans);
  RequireAny(lidars, *job, "lidar");
  std::vector<PoseTrack> tracks;
  for (const std::string& lidar : lidars) tracks.push_back(SensorTrack(job, lidar).X_WS);
  MapExtent extent;
  InOrder<MapPart> parts(job->options.threads, [&](const MapPart& part) {
    file->Append(part.bytes);
    extent.Include(part.extent);
  });
  RecordStream stream(job->recording, lidars);
  for (Record record; job->Next(&stream, &record);) {
    parts.Give([&, record] {
      return PartOf(*job, lidars[record.channel], tracks[record.channel], record, place, append);
    });
  }
  parts.Finish();
  return extent;
}

}  // namespace tera
