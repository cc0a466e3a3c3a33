#include "dataset/format/object_boxes.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "dataset/files/checked_file.h"

namespace tera {
namespace {

using Json = nlohmann::ordered_json;

Vec3 Vector3(const Json& list) {
  return {list.at(0).get<double>(), list.at(1).get<double>(), list.at(2).get<double>()};
}

Json ToJson(const Keypoint& point) {
  const Vec3& p = point.p_C_m;
  Json json = {{"name", point.name},
               {"sight", static_cast<int>(point.sight)},
               {"p_C_m", {p.x(), p.y(), p.z()}}};
  if (point.pixel_px) json["pixel_px"] = {point.pixel_px->x(), point.pixel_px->y()};
  return json;
}

Json ToJson(const ObjectLight& light) {
  return {{"blur_px", light.blur_px},
          {"most_blur_px", light.most_blur_px},
          {"luminance_cdpm2", light.luminance_cdpm2},
          {"illuminance_lx", light.illuminance_lx},
          {"shadow", light.shadow}};
}

ObjectLight LightFromJson(const Json& json) {
  ObjectLight light;
  json.at("blur_px").get_to(light.blur_px);
  json.at("most_blur_px").get_to(light.most_blur_px);
  json.at("luminance_cdpm2").get_to(light.luminance_cdpm2);
  json.at("illuminance_lx").get_to(light.illuminance_lx);
  json.at("shadow").get_to(light.shadow);
  return light;
}

Json ToJson(const PictureExposure& exposure) {
  const Vec3& balance = exposure.balance;
  return {{"exposure_s", exposure.exposure_s},
          {"f_number", exposure.f_number},
          {"gain_db", exposure.gain_db},
          {"ev", std::log2(exposure.f_number * exposure.f_number / exposure.exposure_s)},
          {"saturation_cdpm2", exposure.saturation_cdpm2},
          {"balance", {balance.x(), balance.y(), balance.z()}}};
}

PictureExposure ExposureFromJson(const Json& json) {
  PictureExposure exposure;
  json.at("exposure_s").get_to(exposure.exposure_s);
  json.at("f_number").get_to(exposure.f_number);
  json.at("gain_db").get_to(exposure.gain_db);
  json.at("saturation_cdpm2").get_to(exposure.saturation_cdpm2);
  exposure.balance = Vector3(json.at("balance"));
  return exposure;
}

Json ToJson(const CarriedLoad& load) {
  Json json = {{"instance", load.instance},     {"name", load.name},
               {"visible_px", load.visible_px}, {"volume_m3", load.volume_m3},
               {"mass_kg", load.mass_kg},       {"fill", load.fill}};
  if (load.released_kgps) json["released_kgps"] = *load.released_kgps;
  return json;
}

CarriedLoad LoadFromJson(const Json& json) {
  CarriedLoad load;
  json.at("instance").get_to(load.instance);
  json.at("name").get_to(load.name);
  json.at("visible_px").get_to(load.visible_px);
  json.at("volume_m3").get_to(load.volume_m3);
  json.at("mass_kg").get_to(load.mass_kg);
  json.at("fill").get_to(load.fill);
  if (json.contains("released_kgps")) load.released_kgps = json.at("released_kgps").get<double>();
  return load;
}

Json ToJson(const ObjectBox& box) {
  const Vec3& p = box.X_CO.translation();
  Quat q(box.X_CO.linear());
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  const Vec3& size = box.size_O_m;
  Json json = {{"instance", box.instance},
               {"name", box.name},
               {"class", std::string(NameOf(box.label))},
               {"parent", box.parent},
               {"x_min_px", box.x_min_px},
               {"y_min_px", box.y_min_px},
               {"x_max_px", box.x_max_px},
               {"y_max_px", box.y_max_px},
               {"visible_px", box.visible_px},
               {"visibility", box.visibility},
               {"amodal_px",
                {box.amodal_min_px.x(), box.amodal_min_px.y(), box.amodal_max_px.x(),
                 box.amodal_max_px.y()}},
               {"truncation", box.truncation},
               {"p_CO_m", {p.x(), p.y(), p.z()}},
               {"q_CO_wxyz", {q.w(), q.x(), q.y(), q.z()}},
               {"size_O_m", {size.x(), size.y(), size.z()}}};
  if (box.light) json["light"] = ToJson(*box.light);
  if (box.keypoints.empty()) return json;
  json["keypoints"] = Json::array();
  for (const Keypoint& point : box.keypoints) json["keypoints"].push_back(ToJson(point));
  return json;
}

Keypoint KeypointFromJson(const Json& json) {
  Keypoint point;
  json.at("name").get_to(point.name);
  point.sight = static_cast<KeypointSight>(json.at("sight").get<int>());
  point.p_C_m = Vector3(json.at("p_C_m"));
  if (json.contains("pixel_px")) {
    const Json& pixel = json.at("pixel_px");
    point.pixel_px = Vec2(pixel.at(0).get<double>(), pixel.at(1).get<double>());
  }
  return point;
}

ObjectBox FromJson(const Json& json) {
  ObjectBox box;
  json.at("instance").get_to(box.instance);
  json.at("name").get_to(box.name);
  const auto label = SemanticClassFromName(json.at("class").get<std::string>());
  if (!label)
    throw InputError(
        "", {FaultKind::kNoSuchName, fmt::format("unknown class {}", json.at("class").dump())});
  box.label = *label;
  box.parent = json.value("parent", std::uint16_t{0});  // optional in a recording
  json.at("x_min_px").get_to(box.x_min_px);
  json.at("y_min_px").get_to(box.y_min_px);
  json.at("x_max_px").get_to(box.x_max_px);
  json.at("y_max_px").get_to(box.y_max_px);
  json.at("visible_px").get_to(box.visible_px);
  json.at("visibility").get_to(box.visibility);
  const Json& q = json.at("q_CO_wxyz");
  const Quat rotation(q.at(0).get<double>(), q.at(1).get<double>(), q.at(2).get<double>(),
                      q.at(3).get<double>());
  box.X_CO = MakePose(Vector3(json.at("p_CO_m")), rotation.normalized().toRotationMatrix());
  box.size_O_m = Vector3(json.at("size_O_m"));
  if (json.contains("amodal_px")) {  // optional in a recording
    const Json& px = json.at("amodal_px");
    box.amodal_min_px = {px.at(0).get<double>(), px.at(1).get<double>()};
    box.amodal_max_px = {px.at(2).get<double>(), px.at(3).get<double>()};
    json.at("truncation").get_to(box.truncation);
  }
  if (json.contains("light")) box.light = LightFromJson(json.at("light"));
  if (!json.contains("keypoints")) return box;
  for (const Json& point : json.at("keypoints")) box.keypoints.push_back(KeypointFromJson(point));
  return box;
}

}  // namespace

std::string EncodeBoxes(const CameraFrame& frame) {
  Json document = {{"t_ns", frame.t_ns}};
  if (frame.exposure) document["exposure"] = ToJson(*frame.exposure);
  if (!frame.loads.empty()) document["loads"] = Json::array();
  for (const CarriedLoad& load : frame.loads) document["loads"].push_back(ToJson(load));
  document["boxes"] = Json::array();
  for (const ObjectBox& box : frame.boxes) document["boxes"].push_back(ToJson(box));
  return document.dump(1) + '\n';
}

void ReadBoxes(const std::filesystem::path& file, CameraFrame* frame) {
  const std::string text = ReadWholeFile(file);
  try {
    const Json document = Json::parse(text);
    if (document.contains("exposure")) frame->exposure = ExposureFromJson(document.at("exposure"));
    if (document.contains("loads")) {
      for (const Json& load : document.at("loads")) frame->loads.push_back(LoadFromJson(load));
    }
    for (const Json& box : document.at("boxes")) frame->boxes.push_back(FromJson(box));
  } catch (const nlohmann::json::exception& e) {
    throw InputError(
        file.string(),
        {FaultKind::kMalformed, fmt::format("not a file of boxes: {}; write it again", e.what())});
  } catch (const InputError& e) {
    throw InputError(file.string(),
                     {FaultKind::kNoSuchName,
                      fmt::format("{}; need a class of docs/reference/dataset.md", e.what())});
  }
}

std::vector<ObjectBox> ReadBoxes(const std::filesystem::path& file) {
  CameraFrame frame;
  ReadBoxes(file, &frame);
  return frame.boxes;
}

}  // namespace tera
