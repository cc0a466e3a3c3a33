#include <fmt/format.h>

#include <memory>
#include <vector>

#include "dataset/export/export_job.h"
#include "dataset/export/record_views.h"
#include "dataset/files/checked_file.h"

namespace tera {
namespace {

/// Columns of EuRoC's ground truth that a recording can fill. Sensor biases are left out;
/// velocities too if the recording has none.
constexpr char kPoseHeader[] =
    "#timestamp [ns],p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m],q_RS_w [],q_RS_x [],q_RS_y [],q_RS_z "
    "[]";
constexpr char kVelocityHeader[] = ",v_RS_R_x [m s^-1],v_RS_R_y [m s^-1],v_RS_R_z [m s^-1]";
constexpr char kImuHeader[] =
    "#timestamp [ns],w_RS_S_x [rad s^-1],w_RS_S_y [rad s^-1],w_RS_S_z [rad s^-1],a_RS_S_x [m "
    "s^-2],a_RS_S_y [m s^-2],a_RS_S_z [m s^-2]\n";

std::string PoseRow(TimeNs stamp_ns, const TruthPose& pose, bool with_velocity) {
  const Vec3& p_m = pose.X_WB.translation();
  const Quat q = UnitQuaternion(pose.X_WB);
  std::string row = fmt::format("{},{},{},{},{},{},{},{}", stamp_ns, p_m.x(), p_m.y(), p_m.z(),
                                q.w(), q.x(), q.y(), q.z());
  if (with_velocity) {
    row += fmt::format(",{},{},{}", pose.v_WB_mps.x(), pose.v_WB_mps.y(), pose.v_WB_mps.z());
  }
  return row + "\n";
}

std::string ImuRow(TimeNs stamp_ns, const ImuSample& imu) {
  const Vec3 &w = imu.w_WS_S_radps, &f = imu.f_S_mps2;
  return fmt::format("{},{},{},{},{},{},{}\n", stamp_ns, w.x(), w.y(), w.z(), f.x(), f.y(), f.z());
}

}  // namespace

/// Writes NAME/state_groundtruth_estimate0/data.csv for each body with recorded poses, and
/// MACHINE/IMU/data.csv for each IMU.
///
/// Source  Burri et al. 2016, "The EuRoC micro aerial vehicle datasets"; the ASL dataset format.
void ExportEuroc(ExportJob* job) {
  std::vector<std::string> paths = job->recording.ChannelsOf(kPoseChannel);
  RequireAny(paths, *job, "poses");
  const std::size_t poses = paths.size();
  for (const std::string& imu : job->recording.ChannelsOf(kImuChannel)) paths.push_back(imu);
  RecordStream stream(job->recording, paths);
  std::vector<std::unique_ptr<CheckedFile>> files;
  for (std::size_t c = 0; c < paths.size(); ++c) {
    const bool is_pose = c < poses;
    const std::filesystem::path folder =
        job->folder / (is_pose ? NameOfBody(paths[c]) + "/state_groundtruth_estimate0" : paths[c]);
    MakeFolder(folder);
    files.push_back(std::make_unique<CheckedFile>(folder / "data.csv"));
    files[c]->Append(is_pose ? kPoseHeader : kImuHeader);
    if (is_pose) files[c]->Append(HasVelocity(stream, c) ? kVelocityHeader : "");
    if (is_pose) files[c]->Append("\n");
  }
  for (Record record; job->Next(&stream, &record);) {
    const TimeNs stamp_ns = job->Stamp(record.t_ns);
    files[record.channel]->Append(
        record.channel < poses
            ? PoseRow(stamp_ns, PoseOf(stream, record), HasVelocity(stream, record.channel))
            : ImuRow(stamp_ns, ImuOf(stream, record)));
  }
  for (const auto& file : files) file->Commit();
}

}  // namespace tera
