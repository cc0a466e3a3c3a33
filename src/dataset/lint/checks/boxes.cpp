#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "dataset/lint/checks/picture_set.h"

// Compares boxes with the list of instances and with the masks.

namespace tera {
namespace {

const FrameFolder kFolder = {"boxes", "json"};

/// Bounds and size of an instance's mask.
struct Extent {
  int x_min = 0, y_min = 0, x_max = -1, y_max = -1;
  std::int64_t pixels = 0;

  void Add(int x, int y) {
    x_min = pixels == 0 ? x : std::min(x_min, x);
    y_min = pixels == 0 ? y : std::min(y_min, y);
    x_max = std::max(x_max, x);
    y_max = std::max(y_max, y);
    ++pixels;
  }
};

std::string Text(const Extent& e) {
  return fmt::format("{} pixels in {} {} to {} {}", e.pixels, e.x_min, e.y_min, e.x_max, e.y_max);
}

/// Bounds of each instance in the image, and of each object that contains it.
std::map<std::uint16_t, Extent> ExtentsOf(const LintJob& job, const Image<std::uint16_t>& mask) {
  std::map<std::uint16_t, std::uint16_t> wholes;
  std::map<std::uint16_t, Extent> extents;
  for (int y = 0; y < mask.height_px; ++y) {
    for (int x = 0; x < mask.width_px; ++x) {
      const std::uint16_t instance = mask.at(x, y);
      if (instance == 0) continue;
      extents[instance].Add(x, y);
      const auto [whole, is_new] = wholes.try_emplace(instance, 0);
      if (is_new) {
        const DatasetInfo::Instance* listed = job.InstanceOf(instance);
        whole->second = listed == nullptr ? 0 : listed->parent;
      }
      if (whole->second != 0) extents[whole->second].Add(x, y);
    }
  }
  return extents;
}

std::string NameOfBox(const ObjectBox& box) {
  return fmt::format("the box of {} ({})", box.instance, box.name);
}

void CheckInstance(LintJob* job, const PictureSet& set, const ObjectBox& box, bool is_new) {
  const auto find = [&](const std::string& what) {
    job->Find("boxes.instance", set.camera, set.In(kFolder, NameOfBox(box) + " " + what));
  };
  if (!is_new) find("appears twice");
  const DatasetInfo::Instance* listed = job->InstanceOf(box.instance);
  if (listed == nullptr) {
    find("has no instance in dataset.yaml");
    return;
  }
  if (box.name != listed->name) find(fmt::format("should be of '{}'", listed->name));
  if (NameOf(box.label) != listed->label) {
    find(fmt::format("has the class {}, but {} in dataset.yaml", NameOf(box.label), listed->label));
  }
  if (box.parent != listed->parent) {
    find(fmt::format("has the parent {}, but {} in dataset.yaml", box.parent, listed->parent));
  }
}

void CheckBounds(LintJob* job, const PictureSet& set, const ObjectBox& box, int width_px,
                 int height_px) {
  const bool in_picture = box.x_min_px >= 0 && box.x_min_px <= box.x_max_px && box.y_min_px >= 0 &&
                          box.y_min_px <= box.y_max_px &&
                          (width_px == 0 || (box.x_max_px < width_px && box.y_max_px < height_px));
  const auto find = [&](const std::string& what) {
    job->Find("boxes.bounds", set.camera, set.In(kFolder, NameOfBox(box) + " " + what));
  };
  if (!in_picture) {
    find(fmt::format("reaches from {} {} to {} {}", box.x_min_px, box.y_min_px, box.x_max_px,
                     box.y_max_px));
  }
  const auto is_share = [](double value) { return value >= 0 && value <= 1; };
  if (!is_share(box.visibility)) find(fmt::format("has the visibility {}", box.visibility));
  if (!is_share(box.truncation)) find(fmt::format("has the truncation {}", box.truncation));
}

void CheckMasks(LintJob* job, const PictureSet& set) {
  if (set.frame.instance.empty()) return;
  job->Applies("boxes.mask");
  std::map<std::uint16_t, Extent> left = ExtentsOf(*job, set.frame.instance);
  for (const ObjectBox& box : set.frame.boxes) {
    const Extent extent = left[box.instance];
    left.erase(box.instance);
    const bool agrees = extent.pixels == box.visible_px && extent.x_min == box.x_min_px &&
                        extent.y_min == box.y_min_px && extent.x_max == box.x_max_px &&
                        extent.y_max == box.y_max_px;
    if (agrees) continue;
    const Extent said{box.x_min_px, box.y_min_px, box.x_max_px, box.y_max_px, box.visible_px};
    job->Find("boxes.mask", set.camera,
              set.In(kFolder, fmt::format("{} has {}, instance/ has {}", NameOfBox(box), Text(said),
                                          Text(extent))));
  }
  for (const auto& [instance, extent] : left) {
    if (job->InstanceOf(instance) == nullptr) continue;  // reported by pictures.instances
    job->Find(
        "boxes.mask", set.camera,
        set.In(kFolder, fmt::format("instance {} has no box, but {}", instance, Text(extent))));
  }
}

}  // namespace

void CheckBoxes(LintJob* job, const PictureSet& set) {
  if (!set.has_boxes) return;
  job->Applies("boxes.instance");
  job->Applies("boxes.bounds");
  const Image<std::uint16_t>& mask = set.frame.instance;
  std::set<std::uint16_t> seen;
  for (const ObjectBox& box : set.frame.boxes) {
    ++job->statistics().boxes;
    ++job->statistics().classes[std::string(NameOf(box.label))].boxes;
    CheckInstance(job, set, box, seen.insert(box.instance).second);
    CheckBounds(job, set, box, mask.width_px, mask.height_px);
  }
  CheckMasks(job, set);
}

}  // namespace tera
