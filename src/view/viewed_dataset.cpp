#include <nlohmann/json.hpp>
#include <set>

#include "core/error.h"
#include "core/types/label_channels.h"
#include "core/types/labels.h"
#include "dataset/format/events_table.h"
#include "dataset/format/recording.h"
#include "dataset/format/sensor_sheet.h"
#include "view/viewed_index.h"

namespace tera {
namespace {

using Json = nlohmann::ordered_json;

std::string_view FormOf(const ChannelDescription& channel) {
  if (channel.type == kCameraChannel) return "pictures";
  if (channel.type == kLidarChannel) return "scans";
  return "rows";
}

bool IsFolderWithFiles(const std::filesystem::path& folder) {
  std::error_code error;
  return std::filesystem::directory_iterator(folder, error) !=
         std::filesystem::directory_iterator();
}

/// Image kinds of a camera, colour first.
Json PicturesOf(const std::filesystem::path& camera) {
  Json kinds = Json::array();
  const auto add = [&](std::string_view kind) {
    if (IsFolderWithFiles(camera / kind)) kinds.push_back(kind);
  };
  add("rgb");
  add("depth");
  for (const LabelChannel& label : kLabelChannels) add(label.name);
  return kinds;
}

Json LensJson(const CameraLens& lens) {
  return {{"law", lens.law},
          {"width_px", lens.width_px},
          {"height_px", lens.height_px},
          {"fx_px", lens.fx_px},
          {"fy_px", lens.fy_px},
          {"cx_px", lens.cx_px},
          {"cy_px", lens.cy_px},
          {"k1", lens.k1},
          {"k2", lens.k2},
          {"p1", lens.p1},
          {"p2", lens.p2},
          {"k3", lens.k3},
          {"k4", lens.k4},
          {"k5", lens.k5},
          {"k6", lens.k6}};
}

Json SheetJson(const std::filesystem::path& sensor) {
  if (!std::filesystem::exists(sensor / "sensor.yaml")) return nullptr;
  const SensorSheet sheet = ReadSensorSheet(sensor);
  Json json = {{"parent_link", sheet.parent_link}, {"rate_hz", sheet.rate_hz}};
  if (sheet.X_PS) {
    const Quat q(sheet.X_PS->linear());
    const Vec3 p = sheet.X_PS->translation();
    json["X_PS"] = {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()};
  }
  if (sheet.lens) json["lens"] = LensJson(*sheet.lens);
  return json;
}

Json ChannelJson(const std::filesystem::path& dataset, const ChannelDescription& channel) {
  const bool is_file = channel.path.ends_with(".csv");
  const std::string file = is_file ? channel.path : channel.path + "/data.csv";
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(dataset / file, error);
  Json json = {{"path", channel.path},
               {"type", channel.type},
               {"form", FormOf(channel)},
               {"file", file},
               {"bytes", error ? 0 : bytes}};
  if (!is_file) json["sheet"] = SheetJson(dataset / channel.path);
  if (channel.type == kCameraChannel) json["pictures"] = PicturesOf(dataset / channel.path);
  return json;
}

/// Ground rasters (GeoTIFF) by name.
Json TerrainJson(const std::filesystem::path& dataset) {
  std::set<std::string> names;
  std::error_code error;
  for (const auto& entry :
       std::filesystem::directory_iterator(dataset / "truth" / "terrain", error)) {
    if (entry.path().extension() == ".tif") names.insert(entry.path().filename().string());
  }
  return names;
}

Json ClassesJson() {
  Json list = Json::array();
  for (const SemanticClassInfo& info : kSemanticClasses) {
    list.push_back({{"name", info.name}, {"rgb", info.rgb}});
  }
  return list;
}

Json InstancesJson(const DatasetInfo& info) {
  Json list = Json::array();
  for (const DatasetInfo::Instance& one : info.instances) {
    list.push_back(
        {{"id", one.id}, {"name", one.name}, {"class", one.label}, {"parent", one.parent}});
  }
  return list;
}

/// Events in order of their beginning.
Json EventsJson(const Recording& recording) {
  Json list = Json::array();
  for (const std::string& file : recording.ChannelsOf(kEventsChannel)) {
    for (const RecordedEvent& event : ReadEvents(recording.directory() / file)) {
      const EventKindInfo& kind = kEventKinds[static_cast<std::size_t>(event.kind)];
      list.push_back({{"kind", kind.name},
                      {"from_s", ToSeconds(event.begin_ns)},
                      {"to_s", ToSeconds(event.end_ns)},
                      {"machine", event.machine},
                      {"part", event.part},
                      {"other", event.other},
                      {"value", event.value},
                      {"unit", kind.unit}});
    }
  }
  return list;
}

}  // namespace

std::string DatasetIndexJson(const std::filesystem::path& dataset) {
  const Recording recording(dataset);
  const DatasetInfo& info = recording.info();
  Json json = {{"kind", "dataset"},
               {"title", info.scenario_name},
               {"simulated", info.simulated},
               {"seed", info.seed},
               {"duration_s", info.duration_s},
               {"origin",
                {{"lat_deg", info.origin_lat_deg},
                 {"lon_deg", info.origin_lon_deg},
                 {"height_m", info.origin_height_m}}},
               {"machines", recording.Machines()},
               {"classes", ClassesJson()},
               {"instances", InstancesJson(info)},
               {"terrain", TerrainJson(dataset)},
               {"events", EventsJson(recording)},
               {"channels", Json::array()}};
  for (const ChannelDescription& channel : recording.channels()) {
    if (channel.type == kEventsChannel) continue;
    json["channels"].push_back(ChannelJson(dataset, channel));
  }
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace tera
