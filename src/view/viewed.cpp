#include "view/viewed.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "dataset/compare/time_alignment.h"
#include "dataset/format/recording.h"
#include "view/viewed_index.h"

namespace tera {
namespace {

std::string NameOf(const std::filesystem::path& path) {
  const std::filesystem::path plain = path.lexically_normal();
  return plain.has_filename() ? plain.filename().string() : plain.parent_path().filename().string();
}

/// Time alignment of the second dataset with the first; no shift for a single dataset.
TimeAlignment AlignmentOf(const std::vector<Viewed>& viewed) {
  std::vector<std::filesystem::path> datasets;
  for (const Viewed& one : viewed) {
    if (one.kind == Viewed::Kind::kDataset) datasets.push_back(one.folder.root());
  }
  if (datasets.size() != kMostDatasets) return {};
  return AlignTimes(Recording(datasets[0]), Recording(datasets[1]));
}

}  // namespace

Viewed OpenViewed(const std::filesystem::path& path) {
  ServedFolder folder(path);
  if (std::filesystem::exists(folder.root() / "dataset.yaml")) {
    return {.kind = Viewed::Kind::kDataset,
            .name = NameOf(path),
            .folder = folder,
            .index_json = DatasetIndexJson(path)};
  }
  if (std::filesystem::exists(folder.root() / "diagnosis.json")) {
    return {.kind = Viewed::Kind::kDiagnosis,
            .name = NameOf(path),
            .folder = folder,
            .index_json = DiagnosisIndexJson(path)};
  }
  const bool stopped = WasStopped(path);
  throw InputError(
      path.string(),
      {FaultKind::kMalformed,
       stopped
           ? "is of a run that was stopped; finish it by tera generate --resume, then look at it"
           : "holds neither dataset.yaml nor diagnosis.json; need the folder of a dataset or of "
             "a diagnosis"});
}

void RequireFewDatasets(const std::vector<Viewed>& viewed) {
  const auto datasets =
      static_cast<std::size_t>(std::count_if(viewed.begin(), viewed.end(), [](const Viewed& one) {
        return one.kind == Viewed::Kind::kDataset;
      }));
  if (datasets > kMostDatasets) {
    throw InputError("PATH",
                     {FaultKind::kOutOfRange,
                      fmt::format("{} datasets found, need at most {} side by side; leave out some",
                                  datasets, kMostDatasets)});
  }
}

std::string IndexJson(const std::vector<Viewed>& viewed, const std::string& excerpt) {
  nlohmann::ordered_json json = {{"format", 1}, {"viewed", nlohmann::ordered_json::array()}};
  if (!excerpt.empty()) json["excerpt"] = excerpt;
  const TimeAlignment alignment = AlignmentOf(viewed);
  if (!alignment.told.empty()) json["times"] = alignment.told;
  std::size_t datasets = 0;
  for (const Viewed& one : viewed) {
    auto index = nlohmann::ordered_json::parse(one.index_json);
    index["name"] = one.name;
    if (one.kind == Viewed::Kind::kDataset && datasets++ == 1) {
      index["shift_ns"] = alignment.shift_ns;
    }
    index["has_stage"] = static_cast<bool>(one.stage);
    json["viewed"].push_back(std::move(index));
  }
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace tera
