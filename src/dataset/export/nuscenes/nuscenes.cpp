#include <fmt/format.h>

#include <array>
#include <string>
#include <vector>

#include "dataset/export/nuscenes/nuscenes_categories.h"
#include "dataset/export/nuscenes/nuscenes_rig.h"
#include "dataset/export/nuscenes/nuscenes_tables.h"
#include "dataset/export/nuscenes/scene.h"
#include "dataset/files/checked_file.h"
#include "dataset/format/png.h"

namespace tera {
namespace {

/// Names of all dataset classes that belong to a category.
std::string ClassesOf(std::size_t category) {
  if (category == kNuScenesEgo) return "the machine that carries the sensors, and its load";
  std::string classes;
  for (const SemanticClassInfo& info : kSemanticClasses) {
    if (NuScenesCategoryOf(info.label) != category) continue;
    classes += (classes.empty() ? "" : ", ") + std::string(info.name);
  }
  return classes.empty() ? "not in this dataset" : classes;
}

void WriteCategories(const NuTokens& tokens, NuTables* tables) {
  for (std::size_t index = 0; index < kNuScenesCategories.size(); ++index) {
    tables->Add(NuTable::kCategory,
                {{"token", tokens.Of(NuTable::kCategory, 0, static_cast<std::int64_t>(index))},
                 {"name", std::string(kNuScenesCategories[index])},
                 {"description", ClassesOf(index)},
                 {"index", index}});
  }
}

void WriteVisibilities(NuTables* tables) {
  constexpr std::array<int, 5> kPercent = {0, 40, 60, 80, 100};
  for (std::size_t level = 1; level < kPercent.size(); ++level) {
    const int from = kPercent[level - 1], to = kPercent[level];
    tables->Add(NuTable::kVisibility,
                {{"token", fmt::format("{}", level)},
                 {"level", fmt::format("v{}-{}", from, to)},
                 {"description", fmt::format("{} to {} % of the object is visible", from, to)}});
  }
}

/// The nuScenes tools require a map of the drivable area, which a recording lacks. A map of a
/// single pixel marks no area as drivable.
void WriteMap(const ExportJob& job, const NuTokens& tokens, std::size_t logs, NuTables* tables) {
  const std::string token = tokens.Of(NuTable::kMap, 0, 0), file = "maps/" + token + ".png";
  MakeFolder(job.folder / "maps");
  WriteWholeFile(job.folder / file, EncodeGreyPng(Image<std::uint8_t>(1, 1)));
  OrderedJson of_logs = OrderedJson::array();
  for (std::size_t log = 0; log < logs; ++log) of_logs.push_back(tokens.Of(NuTable::kLog, log, 0));
  tables->Add(NuTable::kMap, {{"token", token},
                              {"log_tokens", of_logs},
                              {"category", "semantic_prior"},
                              {"filename", file}});
}

}  // namespace

/// Writes one log with one scene for each machine with cameras or lidars. v1.0-tera/ holds the
/// tables; samples/ and sweeps/ hold images and points; lidarseg/ and maps/ hold labels and maps.
///
/// Source  Caesar et al. 2020, "nuScenes: a multimodal dataset for autonomous driving", and the
///         development kit's `schema_nuscenes.md`.
void ExportNuscenes(ExportJob* job) {
  const std::vector<NuScenesRig> rigs = ReadNuScenesRigs(job);
  std::vector<std::string> machines;
  for (const NuScenesRig& rig : rigs) machines.push_back(rig.machine);
  RequireAny(machines, *job, "lidar, and no camera with `rgb: true` and a pinhole equivalent");
  const NuTokens tokens(job->recording);
  NuTables tables(job->folder / kNuScenesVersion);
  MakeFolder(job->folder / "lidarseg" / kNuScenesVersion);
  WriteCategories(tokens, &tables);
  WriteVisibilities(&tables);
  WriteMap(*job, tokens, rigs.size(), &tables);
  std::size_t sensors = 0;
  for (std::size_t scene = 0; scene < rigs.size(); ++scene) {
    NuScenesScene(job, rigs[scene], scene, sensors, tokens, &tables).Write();
    sensors += rigs[scene].sensors.size();
  }
  tables.Commit();
}

}  // namespace tera
