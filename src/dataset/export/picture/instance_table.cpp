#include "dataset/export/picture/instance_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"

namespace tera {
namespace fs = std::filesystem;

InstanceTable::InstanceTable(const Recording& recording) {
  const fs::path yaml = recording.directory() / "dataset.yaml";
  for (const DatasetInfo::Instance& instance : recording.info().instances) {
    const auto label = SemanticClassFromName(instance.label);
    if (!label) {
      throw InputError(
          yaml.string(),
          {FaultKind::kNoSuchName,
           fmt::format(
               "the instance '{}' is of the class '{}'; need a class of docs/reference/dataset.md",
               instance.name, instance.label)});
    }
    entries_[instance.id] = {instance.name, *label, instance.parent};
  }
  FindWholes(yaml);
}

void InstanceTable::FindWholes(const fs::path& yaml) {
  for (const auto& [instance, entry] : entries_) {
    std::vector<std::uint16_t>& wholes = with_wholes_[instance];
    for (std::uint16_t at = instance; at != 0; at = Of(at, yaml).parent) {
      if (std::find(wholes.begin(), wholes.end(), at) != wholes.end()) {
        throw InputError(
            yaml.string(),
            fmt::format("the instance '{}' is its own ancestor; need parents without a cycle",
                        entry.name));
      }
      wholes.push_back(at);
    }
  }
}

const InstanceTable::Entry& InstanceTable::Of(std::uint16_t instance, const fs::path& file) const {
  const auto found = entries_.find(instance);
  if (found == entries_.end()) {
    throw InputError(
        file.string(),
        {FaultKind::kNoSuchName,
         fmt::format(
             "names the instance {}, which dataset.yaml does not list; need it among `instances`",
             instance)});
  }
  return found->second;
}

const std::vector<std::uint16_t>& InstanceTable::WithWholes(std::uint16_t instance,
                                                            const fs::path& file) const {
  Of(instance, file);
  return with_wholes_.at(instance);
}

}  // namespace tera
