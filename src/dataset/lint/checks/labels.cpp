#include <fmt/format.h>

#include <map>

#include "dataset/lint/checks/picture_set.h"

// Classes and instances of pixels.

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
    if (listed == nullptr || !job->HasClass(pair.second)) continue;  // told by other rules
    const std::string name = job->ClassName(pair.second);
    if (name == listed->label) continue;
    job->Find(
        "pictures.agree", set.camera,
        set.In("semantic", fmt::format("{} pixels are {} and of instance {} ({}), which is {}",
                                       count, name, listed->id, listed->name, listed->label)));
  }
}

}  // namespace

void CheckLabels(LintJob* job, const PictureSet& set) {
  CheckClasses(job, set);
  CheckInstances(job, set);
  CheckAgreement(job, set);
}

}  // namespace tera
