#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "dataset/lint/checks/picture_set.h"

// Checks classes and instances of pixels.

namespace tera {
namespace {

void CheckClasses(LintJob* job, const PictureSet& set) {
  if (set.frame.semantic.empty()) return;
  job->Applies("pictures.classes");
  std::map<int, std::int64_t> counts;
  for (const std::uint8_t label : set.frame.semantic.data) ++counts[label];
  for (const auto& [label, count] : counts) {
    if (job->HasClass(label)) {
      job->statistics().classes[job->ClassName(label)].pixels += count;
      continue;
    }
    job->Find("pictures.classes", set.camera,
              set.In("semantic", fmt::format("{} pixels of class {}", count, label)));
  }
}

void CheckInstances(LintJob* job, const PictureSet& set) {
  if (set.frame.instance.empty()) return;
  job->Applies("pictures.instances");
  std::map<std::uint16_t, std::int64_t> counts;
  for (const std::uint16_t instance : set.frame.instance.data) ++counts[instance];
  for (const auto& [instance, count] : counts) {
    if (instance == 0 || job->InstanceOf(instance) != nullptr) continue;
    job->Find("pictures.instances", set.camera,
              set.In("instance", fmt::format("{} pixels of instance {}", count, instance)));
  }
}

/// Compares the panoptic image with the class and instance images.
void CheckPanoptic(LintJob* job, const PictureSet& set) {
  const CameraFrame& frame = set.frame;
  if (frame.panoptic.empty()) return;
  job->Applies("pictures.agree");
  const auto count = [&](std::size_t component, const auto& picture, int shift) {
    std::int64_t differing = 0;
    for (std::size_t p = 0; p < picture.data.size(); ++p) {
      const auto value = static_cast<std::uint8_t>(picture.data[p] >> shift);
      differing += frame.panoptic.data[3 * p + component] == value ? 0 : 1;
    }
    return differing;
  };
  const std::int64_t classes = count(0, frame.semantic, 0);
  const std::int64_t instances = std::max(count(1, frame.instance, 0), count(2, frame.instance, 8));
  const auto find = [&](std::int64_t differing, std::string_view of) {
    if (differing == 0) return;
    job->Find("pictures.agree", set.camera,
              set.In("panoptic", fmt::format("{} pixels differ from {}/", differing, of)));
  };
  find(classes, "semantic");
  find(instances, "instance");
}

void CheckAgreement(LintJob* job, const PictureSet& set) {
  const Image<std::uint8_t>& semantic = set.frame.semantic;
  const Image<std::uint16_t>& instance = set.frame.instance;
  if (semantic.empty() || instance.empty()) return;
  job->Applies("pictures.agree");
  std::map<std::pair<std::uint16_t, int>, std::int64_t> counts;
  for (std::size_t i = 0; i < instance.data.size(); ++i) {
    ++counts[{instance.data[i], semantic.data[i]}];
  }
  for (const auto& [pair, count] : counts) {
    const DatasetInfo::Instance* listed = job->InstanceOf(pair.first);
    if (listed == nullptr || !job->HasClass(pair.second)) continue;  // reported by other rules
    const std::string name = job->ClassName(pair.second);
    if (name == listed->label) continue;
    job->Find(
        "pictures.agree", set.camera,
        set.In("semantic", fmt::format("{} pixels have class {} but instance {} ({}) of class {}",
                                       count, name, listed->id, listed->name, listed->label)));
  }
}

}  // namespace

void CheckLabels(LintJob* job, const PictureSet& set) {
  CheckClasses(job, set);
  CheckInstances(job, set);
  CheckAgreement(job, set);
  CheckPanoptic(job, set);
}

}  // namespace tera
