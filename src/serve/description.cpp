#include "serve/description.h"

#include <string>

#include "core/types/labels.h"
#include "sensors/camera/read_lens.h"
#include "serve/geometry_messages.h"
#include "serve/sample_keeper.h"

namespace tera {
namespace {

v1::Joint::Type TypeOf(JointType type) {
  switch (type) {
    case JointType::kFixed:
      return v1::Joint::FIXED;
    case JointType::kRevolute:
      return v1::Joint::REVOLUTE;
    case JointType::kContinuous:
      return v1::Joint::CONTINUOUS;
    case JointType::kPrismatic:
      return v1::Joint::PRISMATIC;
  }
  return v1::Joint::TYPE_UNSPECIFIED;
}

void PutSite(const Scenario& scenario, v1::Site* site) {
  const TerrainSurface& ground = scenario.site->surface();
  site->set_lat_deg(scenario.origin.lat_deg);
  site->set_lon_deg(scenario.origin.lon_deg);
  site->set_height_m(scenario.origin.height_m);
  site->set_x_min_m(ground.origin_W_m.x());
  site->set_y_min_m(ground.origin_W_m.y());
  site->set_x_max_m(ground.origin_W_m.x() + (ground.nx - 1) * ground.cell_m);
  site->set_y_max_m(ground.origin_W_m.y() + (ground.ny - 1) * ground.cell_m);
  site->set_cell_m(ground.cell_m);
}

void PutJoints(const MachineModel& model, v1::Machine* machine) {
  for (const Joint& joint : model.joints) {
    v1::Joint& message = *machine->add_joints();
    message.set_name(joint.name);
    message.set_type(TypeOf(joint.type));
    message.set_lower(joint.lower_rad);
    message.set_upper(joint.upper_rad);
    message.set_max_rate_positive(joint.max_rate_positive_radps);
    message.set_max_rate_negative(joint.max_rate_negative_radps);
    message.set_max_effort(joint.max_effort_nm);
    message.set_parent(model.links[joint.parent].name);
    message.set_child(model.links[joint.child].name);
    Put(joint.X_PJ, message.mutable_x_pj());
    Put(joint.axis_J, message.mutable_axis_j());
  }
  for (const Lever& lever : model.levers) {
    v1::Lever& message = *machine->add_levers();
    message.set_name(lever.name);
    if (lever.joint >= 0) {
      message.set_joint(model.joints[lever.joint].name);
      machine->mutable_joints(lever.joint)->set_lever(lever.name);
    } else {
      message.set_gear(model.ground_tools.gears[lever.gear].name);
    }
  }
}

void PutTools(const MachineModel& model, v1::Machine* machine) {
  for (std::size_t g = 0; g < model.ground_tools.gears.size(); ++g) {
    v1::Gear& message = *machine->add_gears();
    message.set_name(model.ground_tools.gears[g].name);
    message.set_max_rate_radps(model.gear_drives[g].max_rate_radps);
    message.set_radius_m(model.ground_tools.gears[g].drive_radius_m);
  }
  for (const Shovel& shovel : model.ground_tools.shovels) {
    v1::Shovel& message = *machine->add_shovels();
    message.set_name(shovel.name);
    message.set_width_m(shovel.width_m);
    message.set_capacity_m3(shovel.capacity_m3);
  }
  for (const NamedFrame& frame : model.frames) {
    v1::Frame& message = *machine->add_frames();
    message.set_name(frame.name);
    message.set_link(model.links[frame.link].name);
    Put(frame.X_BF, message.mutable_x_bf());
  }
}

void PutCylinders(const MachineModel& model, v1::Machine* machine) {
  for (const Cylinder& cylinder : model.cylinders) {
    v1::Cylinder& message = *machine->add_cylinders();
    message.set_name(cylinder.name);
    message.set_joint(model.joints[cylinder.joint].name);
    message.set_count(static_cast<std::uint32_t>(cylinder.count));
    message.set_bore_m(cylinder.bore_m);
    message.set_rod_diameter_m(cylinder.rod_diameter_m);
    message.set_relief_pa(cylinder.relief_pa);
    message.set_shortest_m(cylinder.shortest_m);
    message.set_longest_m(cylinder.longest_m);
  }
}

void PutPictures(const PictureContent& model, v1::CameraDescription* message) {
  const CameraIntrinsics& lens = model.intrinsics;
  message->set_width_px(lens.width_px);
  message->set_height_px(lens.height_px);
  message->set_fx_px(lens.fx_px);
  message->set_fy_px(lens.fy_px);
  message->set_cx_px(lens.cx_px);
  message->set_cy_px(lens.cy_px);
  message->set_k1(lens.k1);
  message->set_k2(lens.k2);
  message->set_p1(lens.p1);
  message->set_p2(lens.p2);
  message->set_k3(lens.k3);
  message->set_lens(std::string(NameOf(lens.kind)));
  message->set_k4(lens.k4);
  message->set_k5(lens.k5);
  message->set_k6(lens.k6);
  if (lens.IsAngular()) message->set_field_of_view_rad(lens.field_rad);
  message->set_rgb(model.rgb);
  message->set_depth(model.depth);
  message->set_labels(model.labels[kSemanticChannel] && model.labels[kInstanceChannel]);
  for (const LabelChannel& channel : kLabelChannels) {
    if (!model.labels[IndexOf(channel)]) continue;
    v1::LabelChannel& label = *message->add_label_channels();
    label.set_name(std::string(channel.name));
    label.set_components(channel.components);
    label.set_component_bytes(ComponentBytes(channel));
  }
  message->set_depth_min_m(model.depth_min_m);
  message->set_depth_max_m(model.depth_max_m);
}

void PutSensor(const SensorDescription& sensor, const MachineModel& machine, v1::Sensor* message) {
  message->set_name(sensor.name);
  message->set_type(TypeOf(sensor));
  message->set_link(sensor.link);
  Put(sensor.X_BS, message->mutable_x_bs());
  message->set_rate_hz(sensor.clock.rate_hz);
  const SensorKind& kind = KindOf(sensor);
  if (const PictureContent* pictures = PicturesOf(sensor)) {
    PutPictures(*pictures, message->mutable_camera());
  }
  if (kind.scans) {
    const ScanContent scan = kind.scans(sensor);
    message->mutable_lidar()->set_rings(static_cast<std::uint32_t>(scan.rings));
    message->mutable_lidar()->set_columns(static_cast<std::uint32_t>(scan.columns));
  }
  if (kind.axes) {
    for (const EncoderAxis& axis : kind.axes(sensor, machine)) message->add_encoder_axes(axis.name);
  }
  if (HasOwnMessage(kind.name)) return;
  for (const std::string& column : ColumnsOf(sensor, machine)) message->add_columns(column);
}

}  // namespace

v1::Description Describe(const Scenario& scenario) {
  v1::Description description;
  description.set_scenario(scenario.name);
  description.set_seed(scenario.seed);
  description.set_duration_s(scenario.duration_s);
  description.set_physics_rate_hz(scenario.physics_rate_hz);
  PutSite(scenario, description.mutable_site());
  for (const ScenarioMachine& machine : scenario.machines) {
    const MachineModel& model = machine.placement.model;
    v1::Machine& message = *description.add_machines();
    message.set_name(machine.placement.name);
    message.set_kind(model.kind);
    message.set_mass_kg(model.TotalMass_kg());
    PutJoints(model, &message);
    PutTools(model, &message);
    PutCylinders(model, &message);
    for (const SensorDescription& sensor : machine.sensors) {
      PutSensor(sensor, model, message.add_sensors());
    }
  }
  for (const SemanticClassInfo& info : kSemanticClasses) {
    v1::SemanticClass& message = *description.add_semantic_classes();
    message.set_value(static_cast<std::uint32_t>(info.label));
    message.set_name(std::string(info.name));
  }
  return description;
}

}  // namespace tera
