#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "dataset/export/coco/categories.h"
#include "dataset/export/coco/keypoint_categories.h"
#include "dataset/export/export_job.h"
#include "dataset/export/json_lists.h"
#include "dataset/export/picture/labelled_frame.h"
#include "dataset/export/picture/object_masks.h"
#include "dataset/export/record_views.h"
#include "dataset/export/sensor_names.h"
#include "dataset/export/stamp_text.h"
#include "dataset/files/in_order.h"
#include "dataset/format/png.h"

namespace tera {
namespace {

/// A segment of a panoptic image. Each pixel belongs to exactly one segment.
struct PanopticSegment {
  SemanticClass label = SemanticClass::kSky;
  std::uint16_t instance = 0;  ///< 0 for the pixels of a class that belong to no object
  PixelBounds bounds;
  std::int64_t area_px = 0;
};

/// Segments of an image by number, and the image that encodes the numbers as red + 256 green +
/// 65536 blue.
///
/// Model   An object or machine part is a segment with the number of its instance. Pixels without
///         an instance form one segment per class, with the number 65536 (class + 1). No pixel is
///         void.
/// Source  COCO, "Panoptic segmentation" of its data format.
struct PanopticPicture {
  Image<std::uint8_t> rgb;
  std::map<std::uint32_t, PanopticSegment> segments;
};

std::uint32_t SegmentNumber(std::uint16_t instance, std::uint8_t label) {
  return instance != 0 ? instance : (label + 1u) << 16;
}

/// The segment with this number. It is created at its first pixel.
PanopticSegment& SegmentAt(std::uint32_t number, std::uint16_t instance, std::uint8_t label,
                           const InstanceTable& table, const std::filesystem::path& file,
                           PanopticPicture* picture) {
  const auto [place, is_new] = picture->segments.try_emplace(number);
  if (is_new) {
    place->second.instance = instance;
    place->second.label =
        instance != 0 ? table.Of(instance, file).label : static_cast<SemanticClass>(label);
  }
  return place->second;
}

/// Throws InputError that names `file`, the instance image, if an object is not in the table.
PanopticPicture PanopticOf(const LabelledFrame& frame, const InstanceTable& table,
                           const std::filesystem::path& file) {
  PanopticPicture picture;
  const int width = frame.instance.width_px, height = frame.instance.height_px;
  picture.rgb = Image<std::uint8_t>(width, height, 3);
  auto rgb = picture.rgb.data.begin();
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width;) {
      const std::uint16_t instance = frame.instance.at(x, y);
      const std::uint8_t label = frame.semantic.at(x, y);
      const std::uint32_t number = SegmentNumber(instance, label);
      const int first = x;
      while (x < width && frame.instance.at(x, y) == instance && frame.semantic.at(x, y) == label) {
        *rgb++ = static_cast<std::uint8_t>(number);
        *rgb++ = static_cast<std::uint8_t>(number >> 8);
        *rgb++ = static_cast<std::uint8_t>(number >> 16);
        ++x;
      }
      PanopticSegment& segment = SegmentAt(number, instance, label, table, file, &picture);
      segment.bounds.Include(first, y, y);
      segment.bounds.Include(x - 1, y, y);
      segment.area_px += x - first;
    }
  }
  return picture;
}

}  // namespace
namespace fs = std::filesystem;
namespace {

std::string PictureName(const std::string& camera, TimeNs t_ns) {
  return fmt::format("{}_{}.png", FlatName(camera), t_ns);
}

fs::path PanopticFile(const ExportJob& job, const std::string& name) {
  return job.folder / "annotations/panoptic" / name;
}

fs::path ImageFile(const ExportJob& job, const std::string& name) {
  return job.folder / "images" / name;
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

/// Adds the 3D data of a recorded box to an annotation.
void AddBox(const ObjectBox& box, OrderedJson* annotation) {
  const Vec3 &p = box.X_CO.translation(), &size = box.size_O_m;
  const Quat q = UnitQuaternion(box.X_CO);
  (*annotation)["visibility"] = box.visibility;
  (*annotation)["box_3d"] = {{"p_CO_m", {p.x(), p.y(), p.z()}},
                             {"q_CO_wxyz", {q.w(), q.x(), q.y(), q.z()}},
                             {"size_O_m", {size.x(), size.y(), size.z()}}};
}

/// Annotation of an object. Its number and its key point category are assigned when it is written.
struct ObjectAnnotation {
  OrderedJson json;
  std::optional<ObjectBox> box;  ///< set if it has key points
};

/// Entries of one image in the annotation files.
struct ImageAnnotations {
  TimeNs t_ns = 0;
  std::string camera;
  bool was_written = false;  ///< its image files already exist
  std::vector<ObjectAnnotation> objects;
  OrderedJson segments;
};

/// The annotation files; assigns numbers to their entries.
class CocoFiles {
 public:
  explicit CocoFiles(ExportJob* job)
      : job_(job),
        table_(job->recording),
        instances_(job->folder / "annotations/instances.json"),
        panoptic_(job->folder / "annotations/panoptic.json"),
        keypoints_(job->folder / "annotations/keypoints.json") {
    instances_.Put("info", InfoJson(*job_));
    instances_.Put("licenses", OrderedJson::array());
    instances_.Put("categories", ThingCategories());
    panoptic_.Put("info", InfoJson(*job_));
    panoptic_.Put("licenses", OrderedJson::array());
    panoptic_.Put("categories", PanopticCategories());
    keypoints_.Put("info", InfoJson(*job_));
    keypoints_.Put("licenses", OrderedJson::array());
  }

  void AddImages(RecordStream* stream) {
    instances_.BeginList("images");
    panoptic_.BeginList("images");
    keypoints_.BeginList("images");
    std::int64_t id = 0;
    for (Record record; stream->Next(&record);) {
      const OrderedJson image = ImageJson(++id, *job_, stream->path(record.channel), record.t_ns);
      instances_.Add(image);
      panoptic_.Add(image);
      keypoints_.Add(image);
    }
    instances_.BeginList("annotations");
    panoptic_.BeginList("annotations");
    keypoints_.BeginList("annotations");
  }

  /// Writes the files of an image unless they exist. Thread-safe.
  ImageAnnotations WritePictures(const std::string& camera, TimeNs t_ns, bool was_written) const {
    const LabelledFrame frame = LoadLabels(job_->recording, camera, t_ns);
    const fs::path rgb = FrameFile(job_->recording, camera, "rgb", t_ns);
    RequireSizeOfImage(frame, rgb);
    const fs::path instances = FrameFile(job_->recording, camera, "instance", t_ns);
    const PanopticPicture picture = PanopticOf(frame, table_, instances);
    if (!was_written) {
      const std::string name = PictureName(camera, t_ns);
      WriteWholeFile(PanopticFile(*job_, name), EncodeRgbPng(picture.rgb));
      WriteWholeFile(ImageFile(*job_, name), ReadWholePng(rgb));
    }
    return {t_ns, camera, was_written, Objects(frame, instances), Segments(picture)};
  }

  void Add(ImageAnnotations image) {
    ++image_;
    for (ObjectAnnotation& object : image.objects) {
      object.json["id"] = ++annotation_;
      object.json["image_id"] = image_;
      instances_.Add(object.json);
      if (!object.box) continue;
      keypoint_categories_.Annotate(*object.box, &object.json);
      keypoints_.Add(object.json);
    }
    const std::string name = PictureName(image.camera, image.t_ns);
    panoptic_.Add({{"image_id", image_}, {"file_name", name}, {"segments_info", image.segments}});
    if (image.was_written) return;
    job_->Written(image.camera, image.t_ns, {ImageFile(*job_, name), PanopticFile(*job_, name)});
  }

  void Commit() {
    instances_.Commit();
    panoptic_.Commit();
    if (keypoint_categories_.empty()) return;
    keypoints_.Put("categories", keypoint_categories_.Json());
    keypoints_.Commit();
  }

 private:
  static void RequireSizeOfImage(const LabelledFrame& frame, const fs::path& rgb) {
    const PictureSize size = SizeOfPng(rgb);
    if (size.width_px == frame.instance.width_px && size.height_px == frame.instance.height_px) {
      return;
    }
    throw InputError(rgb.string(),
                     "has another size than the picture of instances; need one size for a frame");
  }

  std::vector<ObjectAnnotation> Objects(const LabelledFrame& frame, const fs::path& file) const {
    const int width = frame.instance.width_px, height = frame.instance.height_px;
    std::vector<ObjectAnnotation> objects;
    for (const auto& [instance, mask] : ObjectMasks(frame.instance, table_, file)) {
      const InstanceTable::Entry& entry = table_.Of(instance, file);
      ObjectAnnotation object;
      object.json = {
          {"id", 0},
          {"image_id", 0},
          {"category_id", CategoryOf(entry.label)},
          {"iscrowd", 0},
          {"area", mask.runs.area_px()},
          {"bbox", BoundsJson(mask.bounds)},
          {"segmentation",
           {{"size", {height, width}},
            {"counts", mask.runs.Compressed(static_cast<std::int64_t>(width) * height)}}},
          {"instance_id", instance},
          {"name", entry.name},
          {"parent_instance_id", entry.parent}};
      const auto box =
          std::find_if(frame.boxes.begin(), frame.boxes.end(),
                       [id = instance](const ObjectBox& b) { return b.instance == id; });
      if (box != frame.boxes.end()) {
        AddBox(*box, &object.json);
        if (!box->keypoints.empty()) object.box = *box;
      }
      objects.push_back(std::move(object));
    }
    return objects;
  }

  static OrderedJson Segments(const PanopticPicture& picture) {
    OrderedJson segments = OrderedJson::array();
    for (const auto& [number, segment] : picture.segments) {
      segments.push_back({{"id", number},
                          {"category_id", CategoryOf(segment.label)},
                          {"area", segment.area_px},
                          {"bbox", BoundsJson(segment.bounds)},
                          {"iscrowd", 0},
                          {"instance_id", segment.instance}});
    }
    return segments;
  }

  ExportJob* job_;
  InstanceTable table_;
  JsonLists instances_, panoptic_, keypoints_;
  KeypointCategories keypoint_categories_;
  std::int64_t image_ = 0, annotation_ = 0;
};

}  // namespace

/// Exports all cameras that have colour, class and instance images. Writes
/// images/CAMERA_<t_ns>.png, annotations/instances.json with the mask of each object, and
/// annotations/keypoints.json if objects have key points. Also writes annotations/panoptic.json
/// with the images annotations/panoptic/CAMERA_<t_ns>.png.
///
/// Source  COCO, "Data format": object and keypoint detection and panoptic segmentation; Lin et al.
///         2014, "Microsoft COCO: Common objects in context"; Kirillov et al. 2019, "Panoptic
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
  InOrder<ImageAnnotations> pictures(job->options.threads,
                                     [&](ImageAnnotations image) { files.Add(std::move(image)); });
  RecordStream stream(job->recording, cameras);
  for (Record record; job->Next(&stream, &record);) {
    const std::string& camera = cameras[record.channel];
    const bool was_written = job->IsWritten(camera, record.t_ns);
    pictures.Give([&files, &camera, was_written, t_ns = record.t_ns] {
      return files.WritePictures(camera, t_ns, was_written);
    });
  }
  pictures.Finish();
  files.Commit();
}

}  // namespace tera
