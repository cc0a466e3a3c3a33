#include "dataset/export/nuscenes/annotations.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <optional>
#include <utility>

#include "dataset/export/nuscenes/key_frames.h"
#include "dataset/export/nuscenes/nuscenes_categories.h"
#include "dataset/export/picture/labelled_frame.h"
#include "dataset/format/object_boxes.h"

namespace tera {
namespace {

std::vector<ObjectBox> BoxesOf(const Recording& recording, const NuScenesSensor& camera,
                               std::size_t frame) {
  return ReadBoxes(FrameFile(recording, camera.path, "boxes", camera.t_ns[frame]));
}

const ObjectBox* BoxOf(const std::vector<ObjectBox>& boxes, std::uint16_t instance) {
  const auto found = std::find_if(boxes.begin(), boxes.end(),
                                  [&](const ObjectBox& b) { return b.instance == instance; });
  return found != boxes.end() ? &*found : nullptr;
}

/// Index of the frame before `t_ns` if the nearest frame is after it, and vice versa; nullopt if
/// there is none.
std::optional<std::size_t> OtherSide(const std::vector<TimeNs>& t_ns, std::size_t nearest,
                                     TimeNs at_ns) {
  if (t_ns[nearest] < at_ns && nearest + 1 < t_ns.size()) return nearest + 1;
  if (t_ns[nearest] > at_ns && nearest > 0) return nearest - 1;
  return std::nullopt;
}

bool IsOwn(const ObjectBox& box, const std::string& machine) {
  return box.name == machine || box.name.starts_with(machine + "/");
}

/// Boxes that one camera sees at one time.
class CameraView {
 public:
  CameraView(const Recording& recording, const NuScenesSensor& camera, std::size_t nearest,
             TimeNs t_ns)
      : camera_(camera), nearest_(nearest), t_ns_(t_ns) {
    boxes_ = BoxesOf(recording, camera, nearest);
    other_ = OtherSide(camera.t_ns, nearest, t_ns);
    if (other_) other_boxes_ = BoxesOf(recording, camera, *other_);
  }

  TimeNs apart_ns() const { return std::abs(camera_.t_ns[nearest_] - t_ns_); }
  const std::vector<ObjectBox>& boxes() const { return boxes_; }

  /// Interpolated pose of an object in boxes().
  Pose X_WO(const ObjectBox& box) const {
    const TimeNs near_ns = camera_.t_ns[nearest_];
    const Pose near = camera_.X_WF(near_ns) * box.X_CO;
    const ObjectBox* const other = other_ ? BoxOf(other_boxes_, box.instance) : nullptr;
    if (other == nullptr) return near;
    const TimeNs far_ns = camera_.t_ns[*other_];
    return Interpolate(near, camera_.X_WF(far_ns) * other->X_CO,
                       ToSeconds(t_ns_ - near_ns) / ToSeconds(far_ns - near_ns));
  }

 private:
  const NuScenesSensor& camera_;
  std::size_t nearest_;
  TimeNs t_ns_;
  std::optional<std::size_t> other_;
  std::vector<ObjectBox> boxes_, other_boxes_;
};

}  // namespace

std::vector<AnnotatedObject> ObjectsAt(const Recording& recording, const NuScenesRig& rig,
                                       TimeNs t_ns, TimeNs most_apart_ns) {
  struct Seen {
    AnnotatedObject object;
    TimeNs apart_ns = std::numeric_limits<TimeNs>::max();
  };
  std::map<std::uint16_t, Seen> seen;
  for (const NuScenesSensor& camera : rig.sensors) {
    if (!camera.has_boxes) continue;
    const std::size_t nearest = *NearestOf(camera.t_ns, t_ns);
    if (std::abs(camera.t_ns[nearest] - t_ns) > most_apart_ns) continue;
    const CameraView view(recording, camera, nearest, t_ns);
    for (const ObjectBox& box : view.boxes()) {
      if (box.parent != 0 || box.visible_px == 0 || IsOwn(box, rig.machine)) continue;
      auto& [object, apart_ns] = seen[box.instance];
      object.visibility = std::max(object.visibility, box.visibility);
      if (view.apart_ns() >= apart_ns) continue;
      apart_ns = view.apart_ns();
      object.instance = box.instance;
      object.label = box.label;
      object.size_O_m = box.size_O_m;
      object.X_WO = view.X_WO(box);
    }
  }
  std::vector<AnnotatedObject> objects;
  for (auto& [instance, entry] : seen) objects.push_back(entry.object);
  return objects;
}

void CountPoints(const std::vector<Vec3>& points_W_m, std::vector<AnnotatedObject>* objects) {
  for (AnnotatedObject& object : *objects) {
    const Pose X_OW = object.X_WO.inverse();
    const Vec3 half_m = 0.5 * object.size_O_m;
    object.lidar_points +=
        std::count_if(points_W_m.begin(), points_W_m.end(), [&](const Vec3& p_W_m) {
          return ((X_OW * p_W_m).cwiseAbs().array() <= half_m.array()).all();
        });
  }
}

std::string VisibilityToken(double visibility) {
  return visibility <= 0.4 ? "1" : visibility <= 0.6 ? "2" : visibility <= 0.8 ? "3" : "4";
}

void AnnotationWriter::Add(std::int64_t sample, const std::vector<AnnotatedObject>& objects) {
  constexpr std::int64_t kInstances = 65536;
  for (const AnnotatedObject& object : objects) {
    const std::string token =
        tokens_.Of(NuTable::kSampleAnnotation, scene_, sample * kInstances + object.instance);
    Track& track = tracks_[object.instance];
    OrderedJson row = {{"token", token},
                       {"sample_token", tokens_.Of(NuTable::kSample, scene_, sample)},
                       {"instance_token", tokens_.Of(NuTable::kInstance, scene_, object.instance)},
                       {"visibility_token", VisibilityToken(object.visibility)},
                       {"attribute_tokens", OrderedJson::array()},
                       {"translation", TranslationJson(object.X_WO)},
                       {"size", {object.size_O_m.y(), object.size_O_m.x(), object.size_O_m.z()}},
                       {"rotation", RotationJson(object.X_WO)},
                       {"prev", track.last_token},
                       {"next", ""},
                       {"num_lidar_pts", object.lidar_points},
                       {"num_radar_pts", 0}};
    if (track.count++ == 0) {
      track.first_token = token;
      track.label = object.label;
    } else {
      track.last["next"] = token;
      tables_->Add(NuTable::kSampleAnnotation, track.last);
    }
    track.last = std::move(row);
    track.last_token = token;
  }
}

void AnnotationWriter::Finish() {
  for (const auto& [instance, track] : tracks_) {
    tables_->Add(NuTable::kSampleAnnotation, track.last);
    tables_->Add(
        NuTable::kInstance,
        {{"token", tokens_.Of(NuTable::kInstance, scene_, instance)},
         {"category_token", tokens_.Of(NuTable::kCategory, 0, NuScenesCategoryOf(track.label))},
         {"nbr_annotations", track.count},
         {"first_annotation_token", track.first_token},
         {"last_annotation_token", track.last_token}});
  }
}

}  // namespace tera
