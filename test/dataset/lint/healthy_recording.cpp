#include "dataset/lint/healthy_recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "dataset/format/events_table.h"

namespace tera {
namespace {

constexpr double kDuration_s = 2, kTurn_radps = 0.4, kPitch_rad = 0.1, kSpeed_mps = 0.5;
constexpr double kWall_m = 5, kFocal_px = 16;
constexpr double kGravity_mps2 = 9.81;

// Mounts in the chassis: place, yaw.
const Vec3 kImuPlace_m(0.3, -0.2, 0.8), kGnssPlace_m(-0.5, 0.4, 1.6), kCameraPlace_m(1, 0, 1.2),
    kLidarPlace_m(0.9, 0.1, 1.5);
constexpr double kImuYaw_rad = kPi / 2, kCameraYaw_rad = 0.3;

std::string Sheet(const std::string& type, const Vec3& p_m, double yaw_rad, double rate_hz,
                  const std::string& model = "") {
  return fmt::format(
      "type: {}\nparent_link: chassis\nX_parent_sensor:\n  xyz_m: [{}, {}, {}]\n"
      "  quaternion_wxyz: [{}, 0, 0, {}]\nrate_hz: {}\nlatency_s: 0\n{}",
      type, p_m.x(), p_m.y(), p_m.z(), std::cos(yaw_rad / 2), std::sin(yaw_rad / 2), rate_hz,
      model);
}

Pose ChassisAt(double t_s) {
  return MakePose(Vec3(2 + kSpeed_mps * t_s, 1, 0.3), 0, kPitch_rad, 0.5 + kTurn_radps * t_s);
}

/// Constant over time: the axis of rotation is fixed in the chassis.
Vec3 TurnInChassis() { return ChassisAt(0).linear().transpose() * Vec3(0, 0, kTurn_radps); }

/// In steady motion, only the centripetal acceleration of a turn remains.
ImuSample ImuAt(TimeNs t_ns) {
  const Mat3 R_BS = RotationFromRpy(0, 0, kImuYaw_rad);
  const Vec3 w_B = TurnInChassis(),
             g_B = ChassisAt(0).linear().transpose() * Vec3(0, 0, kGravity_mps2);
  const Vec3 f_B = g_B + w_B.cross(w_B.cross(kImuPlace_m));
  return {t_ns, t_ns, R_BS.transpose() * w_B, R_BS.transpose() * f_B};
}

/// Latitude and longitude by the radii of curvature at the origin, which hold to a tenth of a
/// millimetre over a few metres.
GnssSample GnssAt(TimeNs t_ns, const DatasetInfo& info) {
  const Vec3 p_m = ChassisAt(ToSeconds(t_ns)) * kGnssPlace_m;
  const double a_m = 6378137, f = 1 / 298.257223563, e2 = f * (2 - f);
  const double s = std::sin(info.origin_lat_deg * kDeg), c = std::cos(info.origin_lat_deg * kDeg);
  const double w2 = 1 - e2 * s * s, n_m = a_m / std::sqrt(w2), m_m = n_m * (1 - e2) / w2;
  GnssSample sample;
  sample.t_ns = sample.t_available_ns = t_ns;
  sample.lat_deg = info.origin_lat_deg + p_m.y() / (m_m + info.origin_height_m) / kDeg;
  sample.lon_deg = info.origin_lon_deg + p_m.x() / ((n_m + info.origin_height_m) * c) / kDeg;
  sample.alt_m = info.origin_height_m + p_m.z();
  sample.enu_m = p_m;
  sample.fix = GnssFix::kRtkFixed;
  sample.variance_enu_m2 = Vec3(1e-4, 1e-4, 4e-4);
  return sample;
}

/// A box of pixels, inclusive.
struct Patch {
  std::uint16_t instance;
  std::uint8_t label;
  int x0, y0, x1, y1;
};
constexpr Patch kTruck{1, 10, 2, 5, 6, 9}, kBoom{2, 4, 14, 4, 17, 12};

ObjectBox BoxOf(const Patch& patch, const char* name, SemanticClass label, std::uint16_t id,
                std::uint16_t parent) {
  ObjectBox box;
  box.instance = id;
  box.parent = parent;
  box.label = label;
  box.name = name;
  box.x_min_px = patch.x0;
  box.y_min_px = patch.y0;
  box.x_max_px = patch.x1;
  box.y_max_px = patch.y1;
  box.visible_px = (patch.x1 - patch.x0 + 1) * (patch.y1 - patch.y0 + 1);
  box.visibility = 1;
  box.X_CO = MakePose(Vec3(0.5, -0.25, 7), 0.1, -0.4, 2.5);
  box.size_O_m = Vec3(0.5, 0.6, 1.75);
  return box;
}

void Paint(const Patch& patch, CameraFrame* frame) {
  for (int y = patch.y0; y <= patch.y1; ++y) {
    for (int x = patch.x0; x <= patch.x1; ++x) {
      frame->instance.at(x, y) = patch.instance;
      frame->semantic.at(x, y) = patch.label;
    }
  }
}

/// Previous position in the picture of a static point in the camera's frame, by the chassis' two
/// poses and a pinhole. The result is its displacement.
Vec2 FlowAt(TimeNs t_ns, const Vec3& p_C_m) {
  const Pose X_BCam = MakePose(kCameraPlace_m, 0, 0, kCameraYaw_rad);
  const Pose now = ChassisAt(ToSeconds(t_ns)) * X_BCam;
  const Pose before = ChassisAt(ToSeconds(t_ns) - 0.2) * X_BCam;
  const Vec3 p_m = before.inverse() * now * Vec3(p_C_m.z(), -p_C_m.x(), -p_C_m.y());
  return kFocal_px * (Vec2(-p_m.y(), -p_m.z()) / p_m.x() - p_C_m.head<2>() / p_C_m.z());
}

/// A wall across the optical axis; the uppermost two rows are sky.
CameraFrame FrameAt(TimeNs t_ns) {
  const int w = kHealthyWidth_px, h = kHealthyHeight_px;
  CameraFrame frame;
  frame.t_ns = t_ns;
  frame.rgb = Image<std::uint8_t>(w, h, 3);
  frame.depth_m = Image<float>(w, h);
  frame.semantic = Image<std::uint8_t>(w, h);
  frame.instance = Image<std::uint16_t>(w, h);
  frame.distance = Image<std::uint16_t>(w, h);
  frame.normal = Image<std::uint16_t>(w, h, 3);
  frame.flow_to_previous = Image<std::uint16_t>(w, h, 3);
  for (int y = 2; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      const Vec3 ray((x - 0.5 * w) / kFocal_px, (y - 0.5 * h) / kFocal_px, 1);
      frame.depth_m.at(x, y) = static_cast<float>(kWall_m);
      frame.distance.at(x, y) =
          static_cast<std::uint16_t>(std::lround(1000 * kWall_m * ray.norm()));
      frame.semantic.at(x, y) = 1;
      // n = (0, 0, -1), towards the camera: 32767 32767 0.
      frame.normal.at(x, y, 0) = frame.normal.at(x, y, 1) = 32767;
      if (t_ns == 0) continue;
      const Vec2 flow_px = FlowAt(t_ns, kWall_m * ray);
      for (int c = 0; c < 2; ++c) {
        frame.flow_to_previous.at(x, y, c) =
            static_cast<std::uint16_t>(std::lround(64 * flow_px[c] + 32768));
      }
      frame.flow_to_previous.at(x, y, 2) = 1;
    }
  }
  Paint(kTruck, &frame);
  Paint(kBoom, &frame);
  frame.boxes = {BoxOf(kTruck, "truck", SemanticClass::kTruck, 1, 0),
                 BoxOf(kBoom, "digger/boom", SemanticClass::kBoom, 2, 3),
                 BoxOf(kBoom, "digger", SemanticClass::kVehicle, 3, 0)};
  return frame;
}

/// Points on the wall within the picture, the first of them of the truck.
LidarScan ScanAt(TimeNs t_ns) {
  const Pose X_BCam = MakePose(kCameraPlace_m, 0, 0, kCameraYaw_rad);
  const Pose X_BL = MakePose(kLidarPlace_m, 0, 0, 0);
  LidarScan scan;
  scan.t_ns = t_ns;
  for (int i = 0; i < 100; ++i) {
    const double right_m = -2.5 + 0.05 * i, down_m = -1 + 0.2 * (i % 10);
    const Vec3 p_L_m = X_BL.inverse() * X_BCam * Vec3(kWall_m, -right_m, -down_m);
    LidarPoint p;
    p.x_m = static_cast<float>(p_L_m.x());
    p.y_m = static_cast<float>(p_L_m.y());
    p.z_m = static_cast<float>(p_L_m.z());
    p.intensity = 0.25f;
    p.time_offset_ns = static_cast<std::uint32_t>(i * 50'000);
    p.ring = static_cast<std::uint16_t>(i % 10);
    p.label = i < 10 ? 10 : 1;
    p.instance = i < 10 ? 1 : 0;
    scan.points.push_back(p);
  }
  return scan;
}

DatasetInfo HealthyInfo() {
  DatasetInfo info = SampleInfo();
  info.duration_s = kDuration_s;
  info.epoch = RecordingEpoch{1'700'000'000 * kNsPerSecond, ClockScale::kUtc};
  info.resolved_scenario_yaml =
      "machines:\n  - name: digger\n    machine:\n      links: {boom: {}, chassis: {}}\n"
      "      joints: {boom: {parent: chassis, child: boom}}\n";
  info.instances = {{1, "truck", "truck"}, {2, "digger/boom", "boom", 3}, {3, "digger", "vehicle"}};
  return info;
}

/// Calls `write` at the times of a rate.
void Every(double rate_hz, TimeNs first_ns, const std::function<void(TimeNs)>& write) {
  const SampleClock clock{rate_hz};
  for (std::int64_t k = 0; clock.Due(k) <= FromSeconds(kDuration_s); ++k) {
    if (clock.Due(k) >= first_ns) write(clock.Due(k));
  }
}

void WriteRows(DatasetWriter* writer, const DatasetInfo& info) {
  const ChannelId imu =
      writer->AddChannel(ImuChannel("digger/imu", Sheet("imu", kImuPlace_m, kImuYaw_rad, 100)));
  Every(100, 1, [&](TimeNs t) { writer->Write(imu, RowOf(ImuAt(t))); });
  const ChannelId gnss =
      writer->AddChannel(GnssChannel("digger/gnss", Sheet("gnss", kGnssPlace_m, 0, 10)));
  Every(10, 0, [&](TimeNs t) { writer->Write(gnss, RowOf(GnssAt(t, info))); });
  const ChannelId joints = writer->AddChannel(
      EncoderChannel("digger/joints", "type: encoder\nrate_hz: 50\n", {{"boom"}, {"stick", true}}));
  const ChannelId truth = writer->AddChannel(
      TableChannel("truth/digger/joints.csv", {"boom_rad", "boom_radps", "stick_m", "stick_mps"}));
  Every(50, 0, [&](TimeNs t) {
    const double boom_rad = 0.3 + 0.25 * ToSeconds(t), stick_m = 1 - 0.1 * ToSeconds(t);
    writer->Write(joints, RowOf(EncoderSample{t, t, {boom_rad, stick_m}, {0.25, -0.1}}));
    writer->Write(truth, RowSample{t, t, {boom_rad, 0.25, stick_m, -0.1}});
  });
  const ChannelId levers =
      writer->AddChannel(TableChannel("digger/commands.csv", {"boom", "stick"}));
  Every(50, 0, [&](TimeNs t) { writer->Write(levers, RowSample{t, t, {0.5, -1}}); });
  const ChannelId pose = writer->AddChannel(PoseChannel("truth/digger/pose.csv"));
  Every(50, 0, [&](TimeNs t) {
    writer->Write(pose, RowOf(TruthPose{t, ChassisAt(ToSeconds(t)), Vec3(kSpeed_mps, 0, 0),
                                        TurnInChassis()}));
  });
}

}  // namespace

void WriteHealthyRecording(const std::filesystem::path& directory) {
  const DatasetInfo info = HealthyInfo();
  DatasetWriter writer(directory, info, {});
  WriteRows(&writer, info);
  const std::string lens = fmt::format(
      "model: {{width_px: {}, height_px: {}, fx_px: {}, fy_px: {}, cx_px: {}, cy_px: {}}}\n",
      kHealthyWidth_px, kHealthyHeight_px, kFocal_px, kFocal_px, 0.5 * kHealthyWidth_px,
      0.5 * kHealthyHeight_px);
  const ChannelId camera = writer.AddChannel(
      CameraChannel("digger/front", Sheet("camera", kCameraPlace_m, kCameraYaw_rad, 5, lens)));
  Every(5, 0, [&](TimeNs t) { writer.Write(camera, FrameAt(t)); });
  const ChannelId lidar =
      writer.AddChannel(LidarChannel("digger/lidar", Sheet("lidar", kLidarPlace_m, 0, 10)));
  Every(10, 0, [&](TimeNs t) { writer.Write(lidar, ScanAt(t)); });
  WriteWholeFile(writer.PathFor("truth/terrain/height_start.tif"), "heights");
  writer.AddWholeText(EventsChannel(), EventsText({{500'000'000, 700'000'000, EventKind::kContact,
                                                    "digger", "boom", "truck", 812.5}}));
  writer.Finish();
}

std::set<std::string> LintTest::Found() const {
  std::set<std::string> ids;
  for (const LintFinding& finding : Linted().findings) ids.emplace(finding.rule->id);
  return ids;
}

LintFinding LintTest::Only(const std::string& rule, const std::string& channel) const {
  const LintReport report = Linted();
  LintFinding found;
  for (const LintFinding& finding : report.findings) {
    const std::string first = finding.places.front().file + ": " + finding.places.front().message;
    EXPECT_EQ(finding.rule->id, rule) << first;
    EXPECT_EQ(finding.channel, channel) << first;
    if (finding.rule->id == rule) found = finding;
  }
  EXPECT_EQ(report.findings.size(), 1u);
  if (found.rule == nullptr) {
    ADD_FAILURE() << rule << " found nothing";
    return {&kLintRules[0], "", 0, {{}}};
  }
  return found;
}

void LintTest::Edit(const std::string& file, const std::string& from, const std::string& to) const {
  std::string text = ReadWholeFile(run() / file);
  const std::size_t at = text.find(from);
  ASSERT_NE(at, std::string::npos) << from << " is not in " << text;
  WriteWholeFile(run() / file, text.replace(at, from.size(), to));
}

void LintTest::EditRows(const std::string& file,
                        const std::function<void(int, std::vector<std::string>*)>& change) const {
  std::istringstream lines(ReadWholeFile(run() / file));
  std::string text, line;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::vector<std::string> fields;
    std::istringstream row(line);
    for (std::string field; std::getline(row, field, ',');) fields.push_back(field);
    if (number > 1) change(number, &fields);
    if (fields.empty()) continue;  // a row to be removed
    for (std::size_t i = 0; i < fields.size(); ++i) text += (i > 0 ? "," : "") + fields[i];
    text += '\n';
  }
  WriteWholeFile(run() / file, text);
}

void LintTest::Scale(const std::string& file, const std::vector<std::string>& columns,
                     double by) const {
  std::string header = ReadWholeFile(run() / file);
  header.resize(header.find('\n'));
  std::vector<std::string> names;
  std::istringstream row(header);
  for (std::string name; std::getline(row, name, ',');) names.push_back(name);
  EditRows(file, [&](int, std::vector<std::string>* fields) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (std::count(columns.begin(), columns.end(), names[i]) == 0) continue;
      (*fields)[i] = fmt::format("{}", by * std::stod((*fields)[i]));
    }
  });
}

}  // namespace tera
