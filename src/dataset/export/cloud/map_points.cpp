#include "dataset/export/cloud/map_points.h"

#include <optional>
#include <string>
#include <vector>

#include "dataset/export/sensor_track.h"

namespace tera {

void ForEachMapPoint(ExportJob* job, const std::function<void(const MapPoint&)>& take) {
  const std::vector<std::string> lidars = job->recording.SensorsOf(ChannelForm::kScans);
  RequireAny(lidars, *job, "lidar");
  std::vector<PoseTrack> tracks;
  for (const std::string& lidar : lidars) tracks.push_back(SensorTrack(job, lidar).X_WS);
  RecordStream stream(job->recording, lidars);
  for (Record record; job->Next(&stream, &record);) {
    const LidarScan scan = job->recording.LoadScan(lidars[record.channel], record.t_ns);
    Pose X_WS = Pose::Identity();
    std::optional<TimeNs> posed_ns;  // rays that leave together come together
    for (const LidarPoint& point : scan.points) {
      const TimeNs t_ns = scan.t_ns + point.time_offset_ns;
      if (posed_ns != t_ns) X_WS = tracks[record.channel].At(t_ns);
      posed_ns = t_ns;
      take({X_WS * Vec3(point.x_m, point.y_m, point.z_m), point.intensity, job->Stamp(t_ns),
            static_cast<std::uint16_t>(record.channel), point.ring, point.instance, point.label});
    }
  }
}

}  // namespace tera
