#include "dataset/export/nuscenes/nuscenes_tables.h"

#include <fmt/format.h>

#include <array>
#include <string_view>

#include "dataset/export/record_views.h"
#include "dataset/files/file_digest.h"

namespace tera {
namespace {

constexpr std::array<std::string_view, 14> kNames = {
    "category",          "attribute",         "visibility", "instance", "sensor",
    "calibrated_sensor", "ego_pose",          "log",        "scene",    "sample",
    "sample_data",       "sample_annotation", "map",        "lidarseg"};

constexpr std::size_t kDigitsOfRecording = 14;

}  // namespace

NuTokens::NuTokens(const Recording& recording)
    : recording_(Sha256Of(ReadWholeFile(recording.directory() / "dataset.yaml"))
                     .substr(0, kDigitsOfRecording)) {}

std::string NuTokens::Of(NuTable table, std::size_t list, std::int64_t entry) const {
  return fmt::format("{}{:02x}{:04x}{:012x}", recording_, static_cast<int>(table), list, entry);
}

std::string NuTokens::IfAny(NuTable table, std::size_t list, std::int64_t entry,
                            std::int64_t count) const {
  return entry >= 0 && entry < count ? Of(table, list, entry) : "";
}

NuTables::NuTables(const std::filesystem::path& folder) {
  MakeFolder(folder);
  for (std::size_t t = 0; t < kNames.size(); ++t) {
    const std::filesystem::path file = folder / (std::string(kNames[t]) + ".json");
    files_.try_emplace(static_cast<NuTable>(t), file);
  }
}

void NuTables::Add(NuTable table, const OrderedJson& row) {
  files_.at(table).Append((begun_.insert(table).second ? "[\n" : ",\n") + row.dump());
}

void NuTables::Commit() {
  for (auto& [table, file] : files_) {
    file.Append(begun_.contains(table) ? "\n]\n" : "[]\n");
    file.Commit();
  }
}

OrderedJson TranslationJson(const Pose& pose) {
  const Vec3& p = pose.translation();
  return {p.x(), p.y(), p.z()};
}

OrderedJson RotationJson(const Pose& pose) {
  const Quat q = UnitQuaternion(pose);
  return {q.w(), q.x(), q.y(), q.z()};
}

}  // namespace tera
