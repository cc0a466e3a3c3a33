#include "view/stage_file.h"

#include <cstring>
#include <nlohmann/json.hpp>

namespace tera {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kAlignment = 8;

/// The arrays that follow the header.
class Arrays {
 public:
  template <typename T>
  Json Add(const std::vector<T>& values) {
    const std::size_t begin = bytes_.size();
    bytes_.resize(begin + (values.size() * sizeof(T) + kAlignment - 1) / kAlignment * kAlignment);
    if (!values.empty()) std::memcpy(&bytes_[begin], values.data(), values.size() * sizeof(T));
    return {begin, values.size()};
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

Json JsonOf(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

Json JsonOf(const Pose& X) {
  const Quat q(X.linear());
  const Vec3 p = X.translation();
  return {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()};
}

Json JsonOf(const StageMesh& mesh, Arrays* arrays) {
  Json parts = Json::array();
  for (const StagePart& part : mesh.parts) {
    parts.push_back({{"positions", arrays->Add(part.positions_m)},
                     {"normals", arrays->Add(part.normals)},
                     {"indices", arrays->Add(part.indices)},
                     {"colour", JsonOf(part.colour)},
                     {"opacity", part.opacity}});
    if (!part.colours.empty()) parts.back()["colours"] = arrays->Add(part.colours);
  }
  return {{"parts", std::move(parts)}};
}

Json JointsJson(const StageMachine& machine) {
  Json list = Json::array();
  for (const StageMachine::Joint& joint : machine.joints) {
    list.push_back({{"name", joint.name},
                    {"type", joint.type},
                    {"parent", joint.parent},
                    {"child", joint.child},
                    {"X_PJ", JsonOf(joint.X_PJ)},
                    {"axis", JsonOf(joint.axis_J)},
                    {"initial", joint.initial}});
  }
  return list;
}

Json RunningGearJson(const StageMachine& machine) {
  Json gears = Json::array(), wheels = Json::array(), tracks = Json::array();
  for (const StageMachine::Gear& gear : machine.gears) {
    gears.push_back({{"name", gear.name}, {"link", gear.link}, {"radius_m", gear.radius_m}});
  }
  for (const StageMachine::Wheel& wheel : machine.wheels) {
    wheels.push_back({{"gear", wheel.gear}, {"axle_m", JsonOf(wheel.axle_B_m)}});
  }
  for (const StageMachine::Track& track : machine.tracks) {
    Json path = Json::array();
    for (const Vec3& p : track.path_B_m) path.push_back(JsonOf(p));
    tracks.push_back({{"gear", track.gear}, {"shoes", track.shoes}, {"path_m", std::move(path)}});
  }
  return {
      {"gears", std::move(gears)}, {"wheels", std::move(wheels)}, {"tracks", std::move(tracks)}};
}

Json LinkagesJson(const StageMachine& machine) {
  Json linkages = Json::array(), cylinders = Json::array();
  for (const StageMachine::Linkage& one : machine.linkages) {
    linkages.push_back({{"joint", one.joint},
                        {"rocker_pin_m", JsonOf(one.rocker_pin_P_m)},
                        {"coupler_pin_m", JsonOf(one.coupler_pin_B_m)},
                        {"rocker_m", one.rocker_m},
                        {"coupler_m", one.coupler_m},
                        {"branch", one.branch}});
  }
  for (const StageMachine::Cylinder& one : machine.cylinders) {
    cylinders.push_back({{"joint", one.joint},
                         {"barrel_link", one.barrel_link},
                         {"rod_link", one.rod_link},
                         {"linkage", one.linkage},
                         {"count", one.count},
                         {"spacing_m", one.spacing_m},
                         {"barrel_pin_m", JsonOf(one.barrel_pin_m)},
                         {"rod_pin_m", JsonOf(one.rod_pin_m)}});
  }
  return {{"linkages", std::move(linkages)}, {"cylinders", std::move(cylinders)}};
}

Json JsonOf(const StageMachine& machine) {
  Json json = {{"name", machine.name},
               {"first_body", machine.first_body},
               {"links", machine.links},
               {"joints", JointsJson(machine)},
               {"loads", machine.loads}};
  json.update(RunningGearJson(machine));
  json.update(LinkagesJson(machine));
  return json;
}

Json JsonOf(const StageObstacle& obstacle) {
  Json poses = Json::array();
  for (const auto& [t_s, X_WB] : obstacle.X_WB_at_s) poses.push_back({t_s, JsonOf(X_WB)});
  return {{"name", obstacle.name}, {"body", obstacle.body}, {"poses", std::move(poses)}};
}

Json HeaderOf(const Stage& stage, Arrays* arrays) {
  Json header = {{"bodies", stage.bodies},
                 {"machines", Json::array()},
                 {"obstacles", Json::array()},
                 {"nodes", Json::array()},
                 {"meshes", Json::array()}};
  for (const StageMachine& machine : stage.machines) header["machines"].push_back(JsonOf(machine));
  for (const StageObstacle& one : stage.obstacles) header["obstacles"].push_back(JsonOf(one));
  for (const StageNode& node : stage.nodes) {
    header["nodes"].push_back({{"mesh", node.mesh},
                               {"body", node.body},
                               {"X_BG", JsonOf(node.X_BG)},
                               {"scale", node.scale},
                               {"instance", node.instance}});
  }
  for (const StageMesh& mesh : stage.meshes) header["meshes"].push_back(JsonOf(mesh, arrays));
  return header;
}

}  // namespace

std::string StageFile(const Stage& stage) {
  Arrays arrays;
  std::string header = HeaderOf(stage, &arrays).dump();
  header.resize((header.size() + kAlignment - 1) / kAlignment * kAlignment, ' ');
  const auto length = static_cast<std::uint32_t>(header.size());
  std::string file = "TSTG";
  file.append(reinterpret_cast<const char*>(&length), sizeof length);
  return file + header + arrays.bytes();
}

}  // namespace tera
