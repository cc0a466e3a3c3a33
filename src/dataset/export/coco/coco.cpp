#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/beside.h"
#include "core/error.h"
#include "dataset/export/coco/categories.h"
#include "dataset/export/coco/keypoint_categories.h"
#include "dataset/export/coco/panoptic_segments.h"
#include "dataset/export/export_job.h"
#include "dataset/export/json_lists.h"
#include "dataset/export/picture/labelled_frame.h"
#include "dataset/export/picture/object_masks.h"
#include "dataset/export/record_views.h"
#include "dataset/export/sensor_names.h"
#include "dataset/export/stamp_text.h"
#include "dataset/format/png.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

std::string PictureName(const std::string& camera, TimeNs t_ns) {
  return fmt::format("{}_{}.png", FlatName(camera), t_ns);
}

fs::path PanopticFile(const ExportJob& job, const std::string& name) {
  return job.folder / "annotations/panoptic" / name;
}

std::string DateOf(TimeNs unix_ns) {
  const CivilTime t = CivilTimeOf(unix_ns);
  return fmt::format("{:04}-{:02}-{:02} {:02}:{:02}:{:02}", t.year, t.month, t.day, t.hour,
                     t.minute, t.second);
}

OrderedJson InfoJson(const ExportJob& job) {
  return {{"description", job.recording.info().scenario_name},
          {"version", std::string(TeraVersion())},
          {"contributor", "TERA"}};
}

OrderedJson BoundsJson(const PixelBounds& b) {
  return {b.x_min_px, b.y_min_px, b.width_px(), b.height_px()};
}

OrderedJson ImageJson(std::int64_t id, const ExportJob& job, const std::string& camera,
                      TimeNs t_ns) {
  const PictureSize size = SizeOfPng(FrameFile(job.recording, camera, "rgb", t_ns));
  OrderedJson image = {{"id", id},
                       {"file_name", PictureName(camera, t_ns)},
                       {"width", size.width_px},
                       {"height", size.height_px},
                       {"camera", camera},
                       {"t_ns", t_ns}};
  if (job.options.start_utc_ns) image["date_captured"] = DateOf(job.Stamp(t_ns));
  return image;
}

/// What a box of the recording tells of an object beyond its pixels.
void AddBox(const ObjectBox& box, OrderedJson* annotation) {
  const Vec3 &p = box.X_CO.translation(), &size = box.size_O_m;
  const Quat q = UnitQuaternion(box.X_CO);
  (*annotation)["visibility"] = box.visibility;
  (*annotation)["box_3d"] = {{"p_CO_m", {p.x(), p.y(), p.z()}},
                             {"q_CO_wxyz", {q.w(), q.x(), q.y(), q.z()}},
                             {"size_O_m", {size.x(), size.y(), size.z()}}};
}

/// The files of annotations and what numbers their entries.
class CocoFiles {
 public:
  explicit CocoFiles(ExportJob* job)
      : job_(*job),
        table_(job->recording),
        instances_(job->folder / "annotations/instances.json"),
        panoptic_(job->folder / "annotations/panoptic.json"),
        keypoints_(job->folder / "annotations/keypoints.json") {
    instances_.Put("info", InfoJson(job_));
    instances_.Put("licenses", OrderedJson::array());
    instances_.Put("categories", ThingCategories());
    panoptic_.Put("info", InfoJson(job_));
    panoptic_.Put("licenses", OrderedJson::array());
    panoptic_.Put("categories", PanopticCategories());
    keypoints_.Put("info", InfoJson(job_));
    keypoints_.Put("licenses", OrderedJson::array());
  }

  void AddImages(RecordStream* stream) {
    instances_.BeginList("images");
    panoptic_.BeginList("images");
    keypoints_.BeginList("images");
    std::int64_t id = 0;
    for (Record record; stream->Next(&record);) {
      const OrderedJson image = ImageJson(++id, job_, stream->path(record.channel), record.t_ns);
      instances_.Add(image);
      panoptic_.Add(image);
      keypoints_.Add(image);
    }
    instances_.BeginList("annotations");
    panoptic_.BeginList("annotations");
    keypoints_.BeginList("annotations");
  }

  /// Of the image after the one before. Its picture of segments is drawn, unless that is there.
  void AddAnnotations(const std::string& camera, TimeNs t_ns, bool is_drawn) {
    ++image_;
    const LabelledFrame frame = LoadLabels(job_.recording, camera, t_ns);
    RequireSizeOfImage(frame, camera);
    auto segments = Beside([&] { AddSegments(frame, camera, is_drawn); });
    AddObjects(frame, FrameFile(job_.recording, camera, "instance", t_ns));
    segments.get();
  }

  void Commit() {
    instances_.Commit();
    panoptic_.Commit();
    if (keypoint_categories_.empty()) return;
    keypoints_.Put("categories", keypoint_categories_.Json());
    keypoints_.Commit();
  }

 private:
  void RequireSizeOfImage(const LabelledFrame& frame, const std::string& camera) const {
    const fs::path rgb = FrameFile(job_.recording, camera, "rgb", frame.t_ns);
    const PictureSize size = SizeOfPng(rgb);
    if (size.width_px == frame.instance.width_px && size.height_px == frame.instance.height_px) {
      return;
    }
    throw InputError(
        fmt::format("{}: has another size than the picture of instances; need one "
                    "for all of a frame",
                    rgb.string()));
  }

  void AddObjects(const LabelledFrame& frame, const fs::path& file) {
    const int width = frame.instance.width_px, height = frame.instance.height_px;
    for (const auto& [instance, mask] : ObjectMasks(frame.instance, table_, file)) {
      const InstanceTable::Entry& object = table_.Of(instance, file);
      OrderedJson annotation = {
          {"id", ++annotation_},
          {"image_id", image_},
          {"category_id", CategoryOf(object.label)},
          {"iscrowd", 0},
          {"area", mask.runs.area_px()},
          {"bbox", BoundsJson(mask.bounds)},
          {"segmentation",
           {{"size", {height, width}},
            {"counts", mask.runs.Compressed(static_cast<std::int64_t>(width) * height)}}},
          {"instance_id", instance},
          {"name", object.name},
          {"parent_instance_id", object.parent}};
      const auto box =
          std::find_if(frame.boxes.begin(), frame.boxes.end(),
                       [id = instance](const ObjectBox& b) { return b.instance == id; });
      if (box != frame.boxes.end()) AddBox(*box, &annotation);
      instances_.Add(annotation);
      if (box == frame.boxes.end() || box->keypoints.empty()) continue;
      keypoint_categories_.Annotate(*box, &annotation);
      keypoints_.Add(annotation);
    }
  }

  void AddSegments(const LabelledFrame& frame, const std::string& camera, bool is_drawn) {
    const PanopticPicture picture =
        PanopticOf(frame, table_, FrameFile(job_.recording, camera, "instance", frame.t_ns));
    OrderedJson segments = OrderedJson::array();
    for (const auto& [number, segment] : picture.segments) {
      segments.push_back({{"id", number},
                          {"category_id", CategoryOf(segment.label)},
                          {"area", segment.area_px},
                          {"bbox", BoundsJson(segment.bounds)},
                          {"iscrowd", 0},
                          {"instance_id", segment.instance}});
    }
    const std::string name = PictureName(camera, frame.t_ns);
    if (!is_drawn) WriteWholeFile(PanopticFile(job_, name), EncodeRgbPng(picture.rgb));
    panoptic_.Add({{"image_id", image_}, {"file_name", name}, {"segments_info", segments}});
  }

  const ExportJob& job_;
  InstanceTable table_;
  JsonLists instances_, panoptic_, keypoints_;
  KeypointCategories keypoint_categories_;
  std::int64_t image_ = 0, annotation_ = 0;
};

}  // namespace

/// images/CAMERA_<t_ns>.png, annotations/instances.json with a mask of each object,
/// annotations/keypoints.json where objects have key points, and annotations/panoptic.json with the
/// pictures annotations/panoptic/CAMERA_<t_ns>.png, of the cameras that have colour, classes and
/// instances.
///
/// Source  COCO, "Data format": object and keypoint detection and panoptic segmentation; Lin et al.
/// 2014,
///         "Microsoft COCO: Common objects in context"; Kirillov et al. 2019, "Panoptic
///         segmentation".
void ExportCoco(ExportJob* job) {
  const std::vector<std::string> cameras =
      CamerasWith(job->recording, {"rgb", "semantic", "instance"});
  RequireAny(cameras, *job, "camera with `rgb: true` and `labels: true`");
  RequireFlatNamesApart(cameras);
  MakeFolder(job->folder / "images");
  MakeFolder(job->folder / "annotations/panoptic");
  CocoFiles files(job);
  RecordStream images(job->recording, cameras);
  files.AddImages(&images);
  RecordStream stream(job->recording, cameras);
  for (Record record; job->Next(&stream, &record);) {
    const std::string &camera = cameras[record.channel], name = PictureName(camera, record.t_ns);
    const bool is_written = job->IsWritten(camera, record.t_ns);
    const fs::path image = job->folder / "images" / name;
    auto copied = Beside([&] {
      if (is_written) return;
      WriteWholeFile(image, ReadWholePng(FrameFile(job->recording, camera, "rgb", record.t_ns)));
    });
    files.AddAnnotations(camera, record.t_ns, is_written);
    copied.get();
    if (!is_written) job->Written(camera, record.t_ns, {image, PanopticFile(*job, name)});
  }
  files.Commit();
}

}  // namespace tera
