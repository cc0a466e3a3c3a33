#include <fmt/format.h>

#include <memory>
#include <vector>

#include "dataset/export/export_job.h"
#include "dataset/export/record_views.h"
#include "dataset/export/stamp_text.h"
#include "dataset/files/checked_file.h"

namespace tera {

/// Writes one text file per body with recorded poses: time in s, position, quaternion x y z w.
///
/// Source  "File Formats" of the RGB-D SLAM dataset and benchmark, TU Munich.
void ExportTum(ExportJob* job) {
  const std::vector<std::string> paths = job->recording.ChannelsOf(kPoseChannel);
  RequireAny(paths, *job, "poses");
  RecordStream stream(job->recording, paths);
  std::vector<std::unique_ptr<CheckedFile>> files;
  for (const std::string& path : paths) {
    const std::filesystem::path file = job->folder / (NameOfBody(path) + ".tum");
    MakeFolder(file.parent_path());
    files.push_back(std::make_unique<CheckedFile>(file));
    files.back()->Append("# timestamp tx ty tz qx qy qz qw\n");
  }
  for (Record record; job->Next(&stream, &record);) {
    const TruthPose pose = PoseOf(stream, record);
    const Vec3& p_m = pose.X_WB.translation();
    const Quat q = UnitQuaternion(pose.X_WB);
    files[record.channel]->Append(fmt::format("{} {} {} {} {} {} {} {}\n",
                                              SecondsText(job->Stamp(record.t_ns)), p_m.x(),
                                              p_m.y(), p_m.z(), q.x(), q.y(), q.z(), q.w()));
  }
  for (const auto& file : files) file->Commit();
}

}  // namespace tera
