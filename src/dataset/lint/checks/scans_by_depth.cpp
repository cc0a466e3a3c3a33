#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "core/error.h"
#include "dataset/format/pcd.h"
#include "dataset/format/png.h"
#include "dataset/lint/checks/frames.h"
#include "dataset/lint/checks/lens_projection.h"
#include "dataset/lint/checks/sensor_poses.h"
#include "dataset/lint/lint_job.h"

// Compares lidar points with a depth image of the same machine at the same time.

namespace tera {
namespace fs = std::filesystem;
namespace {

/// Longest time between a point and an image: half a revolution at the usual 10 Hz. The poses at
/// the point's own time are used. Without poses, a link that turns at 1 rad/s displaces points by
/// at most kDepthToleranceShare.
constexpr TimeNs kSameTime_ns = 50'000'000;
/// Number of images compared per camera and lidar, spread over the recording. A wrong mount or unit
/// affects every image.
constexpr std::size_t kMostDepthPictures = 20;
/// Covers noise and object edges. Parallax and time differences displace some points more, but not
/// most of them.
constexpr double kTolerance_m = 0.15, kDepthToleranceShare = 0.05, kLeastAgreeingPoints = 0.5;
constexpr int kFewestPoints = 50;

struct Pair {
  std::string camera, lidar;
  CameraLens lens;
  FrameFolder folder;  ///< distance/, which has no noise, or else depth/
  std::optional<SensorPoses> camera_poses, lidar_poses;
  std::optional<Pose> X_CamLidar;  ///< set if both are fixed to one link

  /// Pose of the lidar at `point_ns` in the camera's sensor frame at `picture_ns`.
  std::optional<Pose> PoseOfLidar(TimeNs picture_ns, TimeNs point_ns) const {
    if (X_CamLidar) return X_CamLidar;
    const auto X_WCam = PoseAt(camera_poses->poses, picture_ns);
    const auto X_WL = PoseAt(lidar_poses->poses, point_ns);
    if (!X_WCam || !X_WL) return std::nullopt;
    return X_WCam->inverse() * *X_WL;
  }
};

struct Agreement {
  int compared = 0, agreeing = 0, pictures = 0;
};

/// True for returns from airborne particles, which depth images do not show.
bool IsOfAir(const LidarPoint& point) {
  const auto label = static_cast<SemanticClass>(point.label);
  return label == SemanticClass::kDust || label == SemanticClass::kRain;
}

/// Pixel of a point in the optical frame.
std::optional<Eigen::Vector2i> PixelOf(const Vec3& p_C_m, const CameraLens& lens) {
  const std::optional<Vec2> place_px = Project(p_C_m, lens);
  if (!place_px) return std::nullopt;
  const Eigen::Vector2i pixel(static_cast<int>(std::lround(place_px->x())),
                              static_cast<int>(std::lround(place_px->y())));
  const bool inside =
      pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() < lens.width_px && pixel.y() < lens.height_px;
  return inside ? std::optional(pixel) : std::nullopt;
}

void Compare(const Pair& pair, const Image<std::uint16_t>& picture, TimeNs picture_ns,
             TimeNs scan_ns, const std::vector<LidarPoint>& points, Agreement* agreement) {
  for (const LidarPoint& point : points) {
    const TimeNs point_ns = scan_ns + point.time_offset_ns;
    if (IsOfAir(point)) continue;
    if (std::abs(point_ns - picture_ns) > kSameTime_ns) continue;
    const auto X_CamLidar = pair.PoseOfLidar(picture_ns, point_ns);
    if (!X_CamLidar) continue;
    const Vec3 p_C_m = OpticalOf(*X_CamLidar * Vec3(point.x_m, point.y_m, point.z_m));
    const auto pixel = PixelOf(p_C_m, pair.lens);
    if (!pixel) continue;
    const int mm = picture.at(pixel->x(), pixel->y());
    if (mm == 0) continue;
    const double expected_m = pair.folder.name == "depth" ? p_C_m.z() : p_C_m.norm();
    ++agreement->compared;
    if (std::abs(1e-3 * mm - expected_m) <= kTolerance_m + kDepthToleranceShare * expected_m) {
      ++agreement->agreeing;
    }
  }
}

/// Returns false for a damaged file. Other rules report it.
template <typename Read>
bool CanRead(const Read& read) {
  try {
    read();
    return true;
  } catch (const InputError&) {
    return false;
  }
}

/// Scans with rays within kSameTime_ns of an image.
std::vector<FrameRow> ScansAt(const std::vector<FrameRow>& scans, TimeNs picture_ns) {
  std::vector<FrameRow> found;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const TimeNs end_ns =
        i + 1 < scans.size() ? scans[i + 1].t_ns : scans[i].t_ns + kNsPerSecond / 10;
    if (scans[i].t_ns <= picture_ns + kSameTime_ns && end_ns >= picture_ns - kSameTime_ns) {
      found.push_back(scans[i]);
    }
  }
  return found;
}

void ComparePair(LintJob* job, const Pair& pair) {
  const std::vector<FrameRow> pictures = FramesOf(*job, pair.camera);
  const std::vector<FrameRow> scans = FramesOf(*job, pair.lidar);
  const std::size_t step = pictures.size() / kMostDepthPictures + 1;
  Agreement agreement;
  for (std::size_t i = 0; i < pictures.size(); i += step) {
    Image<std::uint16_t> picture;
    const fs::path file = job->Path(FrameFile(pair.camera, pair.folder, pictures[i].t_ns));
    if (!CanRead([&] { picture = ReadGrey16Png(file); })) continue;
    if (picture.width_px != pair.lens.width_px || picture.height_px != pair.lens.height_px)
      continue;
    for (const FrameRow& scan : ScansAt(scans, pictures[i].t_ns)) {
      std::vector<LidarPoint> points;
      const fs::path pcd = job->Path(FrameFile(pair.lidar, kScanFolder, scan.t_ns));
      if (!CanRead([&] { points = ReadPcd(pcd); })) continue;
      Compare(pair, picture, pictures[i].t_ns, scan.t_ns, points, &agreement);
    }
    ++agreement.pictures;
  }
  if (agreement.compared < kFewestPoints) return;
  job->Applies("scans.depth");
  if (agreement.agreeing >= kLeastAgreeingPoints * agreement.compared) return;
  job->Find("scans.depth", pair.lidar,
            {fmt::format("{}/{}", pair.camera, pair.folder.name), 0,
             fmt::format("{} of {} points in {} pictures have the depth of their pixel",
                         agreement.agreeing, agreement.compared, agreement.pictures)});
}

/// Returns nullopt if the lens is not supported or poses are unknown.
std::optional<Pair> MakePair(const LintJob& job, const std::string& camera,
                             const std::string& lidar) {
  const auto camera_sheet = job.SheetOf(camera), lidar_sheet = job.SheetOf(lidar);
  if (!camera_sheet || !camera_sheet->lens || !lidar_sheet) return std::nullopt;
  if (!IsProjectable(*camera_sheet->lens)) return std::nullopt;
  Pair pair{camera, lidar, *camera_sheet->lens, {}, {}, {}, {}};
  for (const FrameFolder& folder : UsedPictureFolders(job, camera)) {
    const bool better =
        folder.name == "distance" || (folder.name == "depth" && pair.folder.name.empty());
    if (better) pair.folder = folder;
  }
  if (pair.folder.name.empty()) return std::nullopt;
  pair.camera_poses = FindSensorPoses(job, camera);
  pair.lidar_poses = FindSensorPoses(job, lidar);
  if (pair.camera_poses && pair.lidar_poses && !pair.camera_poses->of_root &&
      !pair.lidar_poses->of_root) {
    return pair;
  }
  const bool same_link =
      !camera_sheet->parent_link.empty() && camera_sheet->parent_link == lidar_sheet->parent_link;
  if (!same_link || !camera_sheet->X_PS || !lidar_sheet->X_PS) return std::nullopt;
  pair.X_CamLidar = camera_sheet->X_PS->inverse() * *lidar_sheet->X_PS;
  return pair;
}

}  // namespace

void CheckScansByDepth(LintJob* job) {
  const Recording& recording = job->recording();
  for (const std::string& lidar : recording.SensorsOf(ChannelForm::kScans)) {
    for (const std::string& camera : recording.SensorsOf(ChannelForm::kPictures)) {
      if (MachineOfChannel(lidar) != MachineOfChannel(camera) || job->IsLeftOut(camera)) continue;
      job->Try(lidar, [&] {
        if (const auto pair = MakePair(*job, camera, lidar)) ComparePair(job, *pair);
      });
    }
  }
}

}  // namespace tera
