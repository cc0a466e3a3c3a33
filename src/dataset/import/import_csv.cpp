#include "dataset/import/import_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <set>

#include "core/config/plain_name.h"
#include "core/error.h"
#include "core/types/mounting.h"
#include "core/types/sample_rows.h"
#include "core/units.h"
#include "dataset/format/channel.h"
#include "dataset/format/dataset_description.h"
#include "dataset/format/recorded_inputs.h"
#include "dataset/format/writer.h"
#include "dataset/import/csv_mapping.h"
#include "dataset/import/wgs84.h"

namespace tera {
namespace {

constexpr double kMinQuaternionNorm = 0.9, kMaxQuaternionNorm = 1.1;

/// From the first measurement to the last one.
struct TimeSpan {
  TimeNs first_ns = std::numeric_limits<TimeNs>::max();
  TimeNs last_ns = std::numeric_limits<TimeNs>::min();

  void Cover(const std::vector<MappedRow>& rows) {
    if (rows.empty()) return;
    first_ns = std::min(first_ns, rows.front().t_ns);
    last_ns = std::max(last_ns, rows.back().t_ns);
  }
  double duration_s() const { return last_ns > first_ns ? ToSeconds(last_ns - first_ns) : 0.0; }
};

/// Writes one channel; made while the mapping is read, run when it is known to be sound.
using ImportJob = std::function<void(DatasetWriter*, TimeSpan*)>;

struct Mapping {
  DatasetInfo info;
  std::string machine;
  std::set<std::string> paths;  ///< of channels
  std::vector<ImportJob> jobs;
};

/// The machine's folder or file for the channel that `name` names, with `ending`.
std::string ReadPath(const ConfigMap& config, const std::string& ending, Mapping* mapping) {
  const std::string name = config.Text("name");
  const std::string path = mapping->machine + "/" + name + ending;
  RequirePlainName(config, "name", name);
  if (!mapping->paths.insert(path).second) {
    config.Fault("name", fmt::format("'{}' is taken by another channel; give each its own", name));
  }
  return path;
}

std::vector<ColumnMapping> ReadColumns(const ConfigMap& columns,
                                       const std::vector<const char*>& keys, Dimension dimension,
                                       const Range& allowed = {}) {
  std::vector<ColumnMapping> mappings;
  for (const char* key : keys) {
    mappings.push_back(ReadColumnMapping(columns.Map(key), dimension, allowed));
  }
  return mappings;
}

void Append(const std::vector<ColumnMapping>& more, std::vector<ColumnMapping>* all) {
  all->insert(all->end(), more.begin(), more.end());
}

/// What sensor.yaml can say of a sensor that was not simulated.
struct ImportedSensor {
  std::string type, name;
  std::string link;  ///< empty where the mapping does not say where the sensor was
  Pose X_LS = Pose::Identity();
};

ImportedSensor ReadSensorMount(const ConfigMap& config, const std::string& type) {
  ImportedSensor sensor{type, config.Text("name"), "", Pose::Identity()};
  if (const auto mount = config.OptionalMap("mount")) {
    sensor.link = mount->Text("link");
    sensor.X_LS = mount->PoseXyzRpy();
    if (!sensor.link.empty() && !IsPlainNameWithPoints(sensor.link)) {
      mount->Fault("link", fmt::format("'{}' cannot name a link; need letters, digits, '_', '-'",
                                       sensor.link));
    }
  }
  return sensor;
}

/// The median interval's rate, which gaps do not change; 0 where there is no interval.
double TypicalRate_hz(const std::vector<MappedRow>& rows) {
  std::vector<TimeNs> intervals_ns;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    intervals_ns.push_back(rows[i].t_ns - rows[i - 1].t_ns);
  }
  if (intervals_ns.empty()) return 0;
  const auto middle = intervals_ns.begin() + static_cast<std::ptrdiff_t>(intervals_ns.size() / 2);
  std::nth_element(intervals_ns.begin(), middle, intervals_ns.end());
  return 1.0 / ToSeconds(*middle);
}

std::string SensorText(const ImportedSensor& sensor, const RowSource& source,
                       const std::vector<MappedRow>& rows) {
  std::string text = fmt::format("type: {}\nname: {}\n", sensor.type, sensor.name);
  if (!sensor.link.empty()) text += MountingYaml(sensor.link, sensor.X_LS);
  if (rows.size() > 1) text += fmt::format("rate_hz: {:.6g}\n", TypicalRate_hz(rows));
  return text + fmt::format("imported_from: {}\n", YamlQuoted(source.file.filename().string()));
}

/// Rotation R_SF of the file's axes F in the sensor frame S, from `rpy_deg`.
Mat3 ReadAxes(const ConfigMap& config) {
  const Vec3 rpy_rad = config.Vector3("rpy_deg", Between(-360, 360, "deg"), Vec3::Zero()) * kDeg;
  return RotationFromRpy(rpy_rad.x(), rpy_rad.y(), rpy_rad.z());
}

ImportJob ReadImu(const ConfigMap& config, const ConfigMap& top, Mapping* mapping) {
  const std::string folder = ReadPath(config, "", mapping);
  const ImportedSensor sensor = ReadSensorMount(config, "imu");
  const RowSource source = ReadRowSource(config, top);
  const Mat3 R_SF = ReadAxes(config);
  const ConfigMap keys = config.Map("columns");
  auto columns = ReadColumns(keys, {"wx", "wy", "wz"}, Dimension::kRate);
  Append(ReadColumns(keys, {"ax", "ay", "az"}, Dimension::kAcceleration), &columns);
  return [=](DatasetWriter* writer, TimeSpan* span) {
    const std::vector<MappedRow> rows = ReadRows(source, columns);
    span->Cover(rows);
    const ChannelId imu = writer->AddChannel(ImuChannel(folder, SensorText(sensor, source, rows)));
    for (const MappedRow& row : rows) {
      const std::vector<double>& v = row.values;
      writer->Write(imu, RowOf(ImuSample{row.t_ns, row.t_ns, R_SF * Vec3(v[0], v[1], v[2]),
                                         R_SF * Vec3(v[3], v[4], v[5])}));
    }
  };
}

/// `fix:` as a GGA quality.
ColumnMapping ReadFix(const ConfigMap& config) {
  const ColumnMapping fix = ReadColumnMapping(config, Dimension::kNone);
  if (config.Has("constant") && !FixOfQuality(fix.offset)) {
    config.Fault("constant", fmt::format("{} is no fix; {}", fix.offset, kNeedFix));
  }
  return fix;
}

GnssSample GnssOf(const MappedRow& row, const RowSource& source, const GeodeticPlace& origin) {
  const std::vector<double>& v = row.values;
  const auto fix = FixOfQuality(v[3]);
  if (!fix) {
    throw InputError(fmt::format("{}:{}: the fix is {}; {}, or leave such rows out by valid_if",
                                 source.file.string(), row.line, v[3], kNeedFix));
  }
  GnssSample s;
  s.t_ns = s.t_available_ns = row.t_ns;
  s.fix = *fix;
  if (s.fix == GnssFix::kNone) return s;
  s.lat_deg = v[0] / kDeg;
  s.lon_deg = v[1] / kDeg;
  s.alt_m = v[2];
  s.enu_m = EnuFromGeodetic({v[0], v[1], v[2]}, origin);
  s.variance_enu_m2 = Vec3(v[4], v[5], v[6]);
  return s;
}

ImportJob ReadGnss(const ConfigMap& config, const ConfigMap& top, Mapping* mapping) {
  const std::string folder = ReadPath(config, "", mapping);
  const ImportedSensor sensor = ReadSensorMount(config, "gnss");
  const RowSource source = ReadRowSource(config, top);
  const ConfigMap keys = config.Map("columns");
  auto columns = ReadColumns(keys, {"lat"}, Dimension::kAngle, Between(-kPi / 2, kPi / 2, "rad"));
  Append(ReadColumns(keys, {"lon"}, Dimension::kAngle, Between(-kPi, kPi, "rad")), &columns);
  Append(ReadColumns(keys, {"alt"}, Dimension::kLength), &columns);
  columns.push_back(ReadFix(keys.Map("fix")));
  Append(ReadColumns(keys, {"var_e", "var_n", "var_u"}, Dimension::kVariance, AtLeast(0, "m2")),
         &columns);
  const GeodeticPlace origin{mapping->info.origin_lat_deg * kDeg,
                             mapping->info.origin_lon_deg * kDeg, mapping->info.origin_height_m};
  return [=](DatasetWriter* writer, TimeSpan* span) {
    const std::vector<MappedRow> rows = ReadRows(source, columns);
    span->Cover(rows);
    const ChannelId gnss =
        writer->AddChannel(GnssChannel(folder, SensorText(sensor, source, rows)));
    for (const MappedRow& row : rows) writer->Write(gnss, RowOf(GnssOf(row, source, origin)));
  };
}

/// Where one joint's angle and rate stand among the columns; no angle means the rate's integral, no
/// rate the angle's differences. Of a prismatic joint these are travel and speed.
struct JointColumns {
  EncoderAxis axis;
  int angle = -1;
  int rate = -1;
};

/// Angles over time by the trapezoidal rule, 0 at the first row.
void IntegrateRate(const JointColumns& joint, std::size_t j, const std::vector<MappedRow>& rows,
                   std::vector<EncoderSample>* samples) {
  const auto rate = static_cast<std::size_t>(joint.rate);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double dt_s = ToSeconds(rows[i].t_ns - rows[i - 1].t_ns);
    const double mean_radps = 0.5 * (rows[i].values[rate] + rows[i - 1].values[rate]);
    (*samples)[i].q_rad[j] = (*samples)[i - 1].q_rad[j] + dt_s * mean_radps;
  }
}

/// Rates as central differences, one-sided at both ends; 0 of a single row.
void DifferentiateAngle(std::size_t j, std::vector<EncoderSample>* samples) {
  const std::size_t last = samples->empty() ? 0 : samples->size() - 1;
  for (std::size_t i = 0; i < samples->size() && last > 0; ++i) {
    const EncoderSample& a = (*samples)[i == 0 ? 0 : i - 1];
    const EncoderSample& b = (*samples)[std::min(i + 1, last)];
    (*samples)[i].qd_radps[j] = (b.q_rad[j] - a.q_rad[j]) / ToSeconds(b.t_ns - a.t_ns);
  }
}

std::vector<EncoderSample> EncoderSamples(const std::vector<JointColumns>& joints,
                                          const std::vector<MappedRow>& rows) {
  std::vector<EncoderSample> samples;
  for (const MappedRow& row : rows) {
    EncoderSample sample{row.t_ns, row.t_ns, {}, {}};
    for (const JointColumns& joint : joints) {
      sample.q_rad.push_back(joint.angle < 0 ? 0.0
                                             : row.values[static_cast<std::size_t>(joint.angle)]);
      sample.qd_radps.push_back(joint.rate < 0 ? 0.0
                                               : row.values[static_cast<std::size_t>(joint.rate)]);
    }
    samples.push_back(std::move(sample));
  }
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (joints[j].angle < 0) IntegrateRate(joints[j], j, rows, &samples);
    if (joints[j].rate < 0) DifferentiateAngle(j, &samples);
  }
  return samples;
}

JointColumns ReadJoint(const ConfigMap& config, std::vector<ColumnMapping>* columns) {
  JointColumns joint{{config.Text("name"), config.Has("travel") || config.Has("speed")}};
  RequirePlainName(config, "name", joint.axis.name);
  const bool linear = joint.axis.linear;
  if (const auto position = config.OptionalMap(linear ? "travel" : "angle")) {
    joint.angle = static_cast<int>(columns->size());
    columns->push_back(
        ReadColumnMapping(*position, linear ? Dimension::kLength : Dimension::kAngle));
  }
  const std::string rate = linear ? "speed" : "rate";
  if (joint.angle >= 0 && !config.Has(rate)) return joint;
  joint.rate = static_cast<int>(columns->size());
  columns->push_back(
      ReadColumnMapping(config.Map(rate), linear ? Dimension::kSpeed : Dimension::kRate));
  return joint;
}

ImportJob ReadEncoder(const ConfigMap& config, const ConfigMap& top, Mapping* mapping) {
  const std::string folder = ReadPath(config, "", mapping);
  const ImportedSensor sensor{"encoder", config.Text("name"), "", Pose::Identity()};
  const RowSource source = ReadRowSource(config, top);
  std::vector<ColumnMapping> columns;
  std::vector<JointColumns> joints;
  std::vector<EncoderAxis> axes;
  std::set<std::string> names;
  for (const ConfigMap& item : config.List("joints")) {
    joints.push_back(ReadJoint(item, &columns));
    axes.push_back(joints.back().axis);
    if (!names.insert(axes.back().name).second) {
      item.Fault("name", fmt::format("'{}' is named twice; keep one", axes.back().name));
    }
  }
  if (joints.empty()) config.Fault("joints", "need at least one joint with name and rate");
  return [=](DatasetWriter* writer, TimeSpan* span) {
    const std::vector<MappedRow> rows = ReadRows(source, columns);
    span->Cover(rows);
    const ChannelId encoder =
        writer->AddChannel(EncoderChannel(folder, SensorText(sensor, source, rows), axes));
    for (const EncoderSample& sample : EncoderSamples(joints, rows)) {
      writer->Write(encoder, RowOf(sample));
    }
  };
}

/// The frames around a recorded pose: X_WB = X_WR * X_RF * X_FB with the file's X_RF.
ImportJob ReadPose(const ConfigMap& config, const ConfigMap& top, const Mapping& mapping) {
  const RowSource source = ReadRowSource(config, top);
  const auto world = config.OptionalMap("world");
  const auto body = config.OptionalMap("body");
  const Pose X_WR = world ? world->PoseXyzRpy() : Pose::Identity();
  const Pose X_FB = body ? body->PoseXyzRpy() : Pose::Identity();
  const ConfigMap keys = config.Map("columns");
  auto columns = ReadColumns(keys, {"x", "y", "z"}, Dimension::kLength);
  Append(ReadColumns(keys, {"qw", "qx", "qy", "qz"}, Dimension::kNone), &columns);
  return [=, file = "truth/" + mapping.machine + "/pose.csv"](DatasetWriter* writer,
                                                              TimeSpan* span) {
    const std::vector<MappedRow> rows = ReadRows(source, columns);
    span->Cover(rows);
    const ChannelId pose = writer->AddChannel(PoseChannel(file, /*with_velocity=*/false));
    for (const MappedRow& row : rows) {
      const std::vector<double>& v = row.values;
      const Quat q(v[3], v[4], v[5], v[6]);
      if (q.norm() < kMinQuaternionNorm || q.norm() > kMaxQuaternionNorm) {
        throw InputError(
            fmt::format("{}:{}: the quaternion has norm {}, need 1; leave such rows out by "
                        "valid_if",
                        source.file.string(), row.line, q.norm()));
      }
      const Pose X_RF = MakePose(Vec3(v[0], v[1], v[2]), q.normalized().toRotationMatrix());
      writer->Write(pose, RowOf(TruthPose{row.t_ns, X_WR * X_RF * X_FB}, /*with_velocity=*/false));
    }
  };
}

ImportJob ReadTable(const ConfigMap& config, const ConfigMap& top, Mapping* mapping) {
  const std::string file = ReadPath(config, ".csv", mapping);
  const RowSource source = ReadRowSource(config, top);
  std::vector<ColumnMapping> columns;
  std::vector<std::string> names;
  for (const auto& [name, column] : config.NamedMaps("columns")) {
    RequirePlainName(column, "", name);
    if (name == "t_ns") column.Fault("", "is the first column of every table; need another name");
    names.push_back(name);
    columns.push_back(ReadColumnMapping(column, Dimension::kAny));
  }
  if (columns.empty()) config.Fault("columns", "need at least one column");
  return [=](DatasetWriter* writer, TimeSpan* span) {
    const std::vector<MappedRow> rows = ReadRows(source, columns);
    span->Cover(rows);
    const ChannelId table = writer->AddChannel(TableChannel(file, names));
    for (const MappedRow& row : rows)
      writer->Write(table, RowSample{row.t_ns, row.t_ns, row.values});
  };
}

Mapping ReadMapping(const ConfigMap& top) {
  Mapping mapping;
  mapping.info.scenario_name = top.Text("name");
  mapping.info.simulated = top.Boolean("simulated", false);
  mapping.machine = top.Text("machine");
  RequirePlainName(top, "machine", mapping.machine);
  if (mapping.machine == "truth") {
    top.Fault("machine", "'truth' is a folder that every recording has; choose another");
  }
  for (const char* shared : {"file", "time"}) top.Has(shared);  // even if each channel has its own
  if (const auto origin = top.OptionalMap("origin")) {
    mapping.info.origin_lat_deg = origin->Number("lat_deg", Between(-90, 90, "deg"));
    mapping.info.origin_lon_deg = origin->Number("lon_deg", Between(-180, 180, "deg"));
    mapping.info.origin_height_m = origin->Number("height_m", Any("m"));
  }
  for (const ConfigMap& item : top.List("imus")) {
    mapping.jobs.push_back(ReadImu(item, top, &mapping));
  }
  for (const ConfigMap& item : top.List("gnss")) {
    if (!top.Has("origin")) item.Fault("", "need the mapping's origin for east, north and up");
    mapping.jobs.push_back(ReadGnss(item, top, &mapping));
  }
  for (const ConfigMap& item : top.List("encoders")) {
    mapping.jobs.push_back(ReadEncoder(item, top, &mapping));
  }
  for (const ConfigMap& item : top.List("tables")) {
    mapping.jobs.push_back(ReadTable(item, top, &mapping));
  }
  if (const auto pose = top.OptionalMap("pose")) {
    mapping.jobs.push_back(ReadPose(*pose, top, mapping));
  }
  if (mapping.jobs.empty()) {
    top.Fault("", "imports nothing, need at least one of imus, gnss, encoders, tables and pose");
  }
  return mapping;
}

}  // namespace

void ImportCsv(const std::filesystem::path& mapping_file, const std::filesystem::path& out,
               const std::vector<std::string>& overrides) {
  const Config config = Config::FromFile(mapping_file, overrides);
  Mapping mapping = ReadMapping(config.root());
  config.Finish();
  mapping.info.resolved_scenario_yaml = config.ResolvedYaml();
  mapping.info.inputs = DigestsOf(config.root().Inputs());
  DatasetWriter writer(out, mapping.info,
                       {.kind = "import", .remedy = "delete it and import it again"});
  try {
    TimeSpan span;
    for (const ImportJob& job : mapping.jobs) job(&writer, &span);
    writer.SetDuration(span.duration_s());
    writer.Finish();
  } catch (...) {
    writer.Discard();
    throw;
  }
}

}  // namespace tera
