#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/units.h"
#include "dataset/export/export_job.h"
#include "dataset/export/kitti/kitti_layout.h"
#include "dataset/export/kitti/steady_scan.h"
#include "dataset/export/picture/labelled_frame.h"
#include "dataset/files/checked_file.h"
#include "dataset/files/in_order.h"
#include "dataset/format/png.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

/// A calibration within this tolerance counts as constant. Link deflection and interpolated poses
/// make a fixed mount vary this much.
constexpr double kSteadyWithin_m = 0.005, kSteadyWithin_rad = 0.1 * kDeg;

/// The requested layouts without duplicates.
std::vector<KittiLayout> LayoutsOf(const ExportOptions& options) {
  const std::vector<KittiLayout>& asked = options.kitti_layouts;
  std::vector<KittiLayout> layouts;
  for (const KittiLayoutName& entry : kKittiLayouts) {
    const bool is_asked =
        asked.empty() || std::find(asked.begin(), asked.end(), entry.layout) != asked.end();
    if (is_asked) layouts.push_back(entry.layout);
  }
  return layouts;
}

std::unique_ptr<KittiLayoutWriter> Made(KittiLayout layout, const ExportJob& job,
                                        const KittiRig& rig) {
  switch (layout) {
    case KittiLayout::kRaw:
      return MakeRawLayout(job, rig);
    case KittiLayout::kObject:
      return MakeObjectLayout(job, rig);
    case KittiLayout::kTracking:
      return MakeTrackingLayout(job, rig);
    case KittiLayout::kOdometry:
      return MakeOdometryLayout(job, rig);
    case KittiLayout::kDepth:
      return MakeDepthLayout(job, rig);
  }
  return nullptr;
}

/// The first of `layouts` that is in `some`; null if none is.
const KittiLayoutName* FirstOf(const std::vector<KittiLayout>& layouts,
                               std::initializer_list<KittiLayout> some) {
  for (const KittiLayoutName& entry : kKittiLayouts) {
    const auto is = [&](KittiLayout layout) { return layout == entry.layout; };
    if (std::any_of(some.begin(), some.end(), is) &&
        std::any_of(layouts.begin(), layouts.end(), is)) {
      return &entry;
    }
  }
  return nullptr;
}

void WriteLinked(const std::vector<fs::path>& places, std::string_view bytes) {
  for (std::size_t k = 0; k < places.size(); ++k) {
    std::error_code failed;
    // Replaces files of an incomplete frame that a stopped export left.
    fs::remove(places[k], failed);
    if (k > 0) fs::create_hard_link(places.front(), places[k], failed);
    if (k == 0 || failed) WriteWholeFile(places[k], bytes);
  }
}

class KittiExport {
 public:
  explicit KittiExport(ExportJob* job)
      : job_(*job),
        log_(job),
        layouts_(LayoutsOf(job->options)),
        rig_(ReadKittiRig(job)),
        rectifier_(rig_.lens),
        table_(job->recording) {
    using enum KittiLayout;
    labelled_ = FirstOf(layouts_, {kObject, kTracking});
    deep_ = FirstOf(layouts_, {kDepth});
    pictured_ = FirstOf(layouts_, {kRaw, kObject, kTracking, kOdometry});
    steady_ = FirstOf(layouts_, {kRaw, kTracking, kOdometry});
    tracked_ = FirstOf(layouts_, {kTracking});
    for (const KittiLayout layout : layouts_) writers_.push_back(Made(layout, job_, rig_));
  }

  const KittiRig& rig() const { return rig_; }

  /// The next frame, with times and poses only.
  KittiFrame Begin(const FramePair& pair) {
    KittiFrame frame;
    frame.number = number_++;
    frame.times = pair;
    frame.is_written = job_.IsWritten(rig_.lidar.path, frame.number);
    frame.X_WC = rig_.X_WC(pair.picture_ns);
    frame.X_WS = rig_.X_WS(pair.picture_ns);
    if (steady_) RequireSteady(frame);
    return frame;
  }

  /// Reads a frame and writes its files. Thread-safe.
  KittiFrame WriteFiles(KittiFrame frame) const {
    // Track labels are needed even for a complete frame: they form one file for all frames, which
    // is always rewritten.
    const bool has_labels = frame.is_written ? tracked_ : labelled_;
    if (has_labels) frame.labels = Labels(frame.times.picture_ns);
    if (frame.is_written) return frame;
    if (pictured_) WritePictureAndPoints(frame);
    if (deep_) frame.depth_mm = Depth(frame.times.picture_ns);
    for (const auto& writer : writers_) writer->WriteFiles(frame);
    frame.depth_mm = {};
    return frame;
  }

  /// Called once per frame, in order.
  void Add(const KittiFrame& frame) {
    for (const auto& writer : writers_) writer->Add(frame);
    if (!frame.is_written) log_->Written(rig_.lidar.path, frame.number, FilesOf(frame.number));
  }

  void Commit() {
    for (const auto& writer : writers_) writer->Commit();
  }

 private:
  /// Path of a file that the layout requires.
  fs::path Needed(std::string_view kind, TimeNs t_ns, const KittiLayoutName& layout) const {
    const fs::path file = FrameFile(job_.recording, rig_.camera, kind, t_ns);
    std::error_code ignored;
    if (fs::is_regular_file(file, ignored)) return file;
    throw InputError(file.string(),
                     {FaultKind::kUnreadable,
                      fmt::format("is missing, but KITTI's layout '{}' needs it; choose a camera "
                                  "that records it with --camera, or other layouts with --layout",
                                  layout.name)});
  }

  void RequireSteady(const KittiFrame& frame) {
    if (frame.number == 0) X_CS_first_ = frame.X_CS();
    const Pose moved = X_CS_first_.inverse() * frame.X_CS();
    const double turned_rad = Eigen::AngleAxisd(moved.linear()).angle();
    if (moved.translation().norm() <= kSteadyWithin_m && turned_rad <= kSteadyWithin_rad) return;
    throw InputError(
        job_.recording.directory().string(),
        {FaultKind::kUnsupported,
         fmt::format("{} and {} move relative to each other, by {:.3f} m and {:.2f} deg until {} "
                     "ns, but KITTI's layout '{}' has one calibration for all frames; choose both "
                     "on one link with --camera and --lidar, or --layout object,depth",
                     rig_.camera, rig_.lidar.path, moved.translation().norm(), turned_rad / kDeg,
                     frame.times.picture_ns, steady_->name)});
  }

  std::vector<fs::path> FilesOf(int number) const {
    std::vector<fs::path> files;
    for (const auto& writer : writers_) {
      if (const auto place = writer->Picture(number)) files.push_back(*place);
      if (const auto place = writer->Points(number)) files.push_back(*place);
      for (const fs::path& own : writer->FilesOf(number)) files.push_back(own);
    }
    return files;
  }

  Image<std::uint16_t> Depth(TimeNs t_ns) const {
    const fs::path file = Needed("depth", t_ns, *deep_);
    return rectifier_.Nearest(Sized(ReadGrey16Png(file), file));
  }

  std::vector<KittiLabel> Labels(TimeNs t_ns) const {
    for (const char* kind : {"semantic", "instance", "boxes"}) Needed(kind, t_ns, *labelled_);
    const LabelledFrame labels = LoadLabels(job_.recording, rig_.camera, t_ns);
    const fs::path file = FrameFile(job_.recording, rig_.camera, "instance", t_ns);
    return KittiLabels(labels.boxes,
                       ObjectMasks(rectifier_.Nearest(Sized(labels.instance, file)), table_, file),
                       rig_.lens, MachineOf(rig_.camera));
  }

  /// Throws InputError unless the image has the size in sensor.yaml.
  template <typename T>
  const Image<T>& Sized(const Image<T>& picture, const fs::path& file) const {
    if (picture.width_px == rig_.lens.width_px && picture.height_px == rig_.lens.height_px) {
      return picture;
    }
    throw InputError(file.string(), fmt::format("has {} x {} pixels; need {} x {} of sensor.yaml",
                                                picture.width_px, picture.height_px,
                                                rig_.lens.width_px, rig_.lens.height_px));
  }

  void WritePictureAndPoints(const KittiFrame& frame) const {
    std::vector<fs::path> pictures, points;
    for (const auto& writer : writers_) {
      if (const auto place = writer->Picture(frame.number)) pictures.push_back(*place);
      if (const auto place = writer->Points(frame.number)) points.push_back(*place);
    }
    const fs::path rgb = Needed("rgb", frame.times.picture_ns, *pictured_);
    const Image<std::uint8_t> picture = ReadRgbPng(rgb);
    WriteLinked(pictures, EncodeRgbPng(rectifier_.Blended(Sized(picture, rgb))));
    const LidarScan scan = job_.recording.LoadScan(rig_.lidar.path, frame.times.scan_ns);
    WriteLinked(points,
                VelodyneBytes(SteadyScan(scan, rig_.lidar.poses.X_WS, frame.times.picture_ns)));
  }

  const ExportJob& job_;
  ExportJob* log_;  ///< the same job as non-const, to log complete frames
  std::vector<KittiLayout> layouts_;
  KittiRig rig_;
  Rectifier rectifier_;
  InstanceTable table_;
  /// A requested layout that needs labels, depth, images, a constant calibration or tracks; null if
  /// none does.
  const KittiLayoutName *labelled_, *deep_, *pictured_, *steady_, *tracked_;
  std::vector<std::unique_ptr<KittiLayoutWriter>> writers_;
  Pose X_CS_first_ = Pose::Identity();
  int number_ = 0;
};

}  // namespace

/// Writes raw/, object/, tracking/, odometry/ and depth/, or only the layouts of --layout. Exports
/// one camera and one lidar. A scan with an image is a frame; its data is converted to the time of
/// the image.
///
/// Source  Geiger et al. 2013, "Vision meets robotics: the KITTI dataset", and the development kits
///         of its raw data and benchmarks; depth: Uhrig et al. 2017, "Sparsity invariant CNNs".
void ExportKitti(ExportJob* job) {
  KittiExport kitti(job);
  const KittiRig& rig = kitti.rig();
  InOrder<KittiFrame> frames(job->options.threads,
                             [&](const KittiFrame& frame) { kitti.Add(frame); });
  FramePairs pairs(job, rig.camera, rig.lidar.path, rig.lidar.period_ns);
  bool any = false;
  for (FramePair pair; pairs.Next(&pair); any = true) {
    frames.Give([&kitti, frame = kitti.Begin(pair)] { return kitti.WriteFiles(frame); });
  }
  frames.Finish();
  if (!any) {
    throw InputError(
        job->recording.directory().string(),
        {FaultKind::kMissing, fmt::format("{} took no picture during a scan of {}; choose two that "
                                          "ran at the same time with --camera and --lidar",
                                          rig.camera, rig.lidar.path)});
  }
  kitti.Commit();
}

}  // namespace tera
