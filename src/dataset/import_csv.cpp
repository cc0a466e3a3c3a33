#include "dataset/import_csv.h"

#include <cmath>
#include <functional>

#include "core/error.h"
#include "core/units.h"
#include "dataset/checked_file.h"
#include "dataset/csv_mapping.h"
#include "dataset/wgs84.h"
#include "dataset/writer.h"

namespace tera {
namespace {

constexpr double kMinQuaternionNorm = 0.9, kMaxQuaternionNorm = 1.1;

/// Writes one channel; made while the mapping is read, run when it is known to be sound.
using ImportJob = std::function<void(DatasetWriter*)>;

struct Mapping {
  DatasetInfo info;
  std::string machine;
  std::vector<ImportJob> jobs;
};

std::vector<ColumnMapping> ReadColumns(const ConfigMap& columns,
                                       const std::vector<const char*>& keys, Dimension dimension) {
  std::vector<ColumnMapping> mappings;
  for (const char* key : keys) {
    mappings.push_back(ReadColumnMapping(columns.Map(key), dimension));
  }
  return mappings;
}

void Append(const std::vector<ColumnMapping>& more, std::vector<ColumnMapping>* all) {
  all->insert(all->end(), more.begin(), more.end());
}

std::string SensorText(const std::string& type, const RowSource& source) {
  return fmt::format("type: {}\nimported_from: {}\n", type, source.file.filename().string());
}

/// Rotation R_SF of the file's axes F in the sensor frame S, from `rpy_deg`.
Mat3 ReadAxes(const ConfigMap& config) { return config.PoseXyzRpy().linear(); }

ImportJob ReadImu(const ConfigMap& config, const ConfigMap& top, const std::string& machine) {
  const std::string folder = machine + "/" + config.Text("name");
  const RowSource source = ReadRowSource(config, top);
  const Mat3 R_SF = ReadAxes(config);
  const ConfigMap keys = config.Map("columns");
  auto columns = ReadColumns(keys, {"wx", "wy", "wz"}, Dimension::kRate);
  Append(ReadColumns(keys, {"ax", "ay", "az"}, Dimension::kAcceleration), &columns);
  return [=](DatasetWriter* writer) {
    const ChannelId imu = writer->AddImu(folder, SensorText("imu", source));
    for (const MappedRow& row : ReadRows(source, columns)) {
      const std::vector<double>& v = row.values;
      writer->Write(imu, ImuSample{row.t_ns, row.t_ns, R_SF * Vec3(v[0], v[1], v[2]),
                                   R_SF * Vec3(v[3], v[4], v[5])});
    }
  };
}

ImportJob ReadGnss(const ConfigMap& config, const ConfigMap& top, const std::string& machine,
                   const DatasetInfo& info) {
  const std::string folder = machine + "/" + config.Text("name");
  const RowSource source = ReadRowSource(config, top);
  const ConfigMap keys = config.Map("columns");
  auto columns = ReadColumns(keys, {"lat", "lon"}, Dimension::kAngle);
  Append(ReadColumns(keys, {"alt"}, Dimension::kLength), &columns);
  Append(ReadColumns(keys, {"fix"}, Dimension::kNone), &columns);
  Append(ReadColumns(keys, {"var_e", "var_n", "var_u"}, Dimension::kVariance), &columns);
  return [=](DatasetWriter* writer) {
    const ChannelId gnss = writer->AddGnss(folder, SensorText("gnss", source));
    for (const MappedRow& row : ReadRows(source, columns)) {
      const std::vector<double>& v = row.values;
      GnssSample s;
      s.t_ns = s.t_available_ns = row.t_ns;
      s.lat_deg = v[0] / kDeg;
      s.lon_deg = v[1] / kDeg;
      s.alt_m = v[2];
      s.enu_m = EnuFromGeodetic(
          {v[0], v[1], v[2]},
          {info.origin_lat_deg * kDeg, info.origin_lon_deg * kDeg, info.origin_height_m});
      s.fix = static_cast<GnssFix>(std::lround(v[3]));
      s.variance_enu_m2 = Vec3(v[4], v[5], v[6]);
      writer->Write(gnss, s);
    }
  };
}

/// Where one joint's angle and rate stand among the columns; no angle means the rate's integral.
struct JointColumns {
  std::string name;
  int angle = -1;
  int rate = 0;
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

std::vector<EncoderSample> EncoderSamples(const std::vector<JointColumns>& joints,
                                          const std::vector<MappedRow>& rows) {
  std::vector<EncoderSample> samples;
  for (const MappedRow& row : rows) {
    EncoderSample sample{row.t_ns, row.t_ns, {}, {}};
    for (const JointColumns& joint : joints) {
      sample.q_rad.push_back(joint.angle < 0 ? 0.0
                                             : row.values[static_cast<std::size_t>(joint.angle)]);
      sample.qd_radps.push_back(row.values[static_cast<std::size_t>(joint.rate)]);
    }
    samples.push_back(std::move(sample));
  }
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (joints[j].angle < 0) IntegrateRate(joints[j], j, rows, &samples);
  }
  return samples;
}

ImportJob ReadEncoder(const ConfigMap& config, const ConfigMap& top, const std::string& machine) {
  const std::string folder = machine + "/" + config.Text("name");
  const RowSource source = ReadRowSource(config, top);
  std::vector<ColumnMapping> columns;
  std::vector<JointColumns> joints;
  std::vector<std::string> names;
  for (const ConfigMap& item : config.List("joints")) {
    JointColumns joint{item.Text("name")};
    if (const auto angle = item.OptionalMap("angle")) {
      joint.angle = static_cast<int>(columns.size());
      columns.push_back(ReadColumnMapping(*angle, Dimension::kAngle));
    }
    joint.rate = static_cast<int>(columns.size());
    columns.push_back(ReadColumnMapping(item.Map("rate"), Dimension::kRate));
    names.push_back(joint.name);
    joints.push_back(std::move(joint));
  }
  if (joints.empty()) config.Fault("joints", "need at least one joint with name and rate");
  return [=](DatasetWriter* writer) {
    const ChannelId encoder = writer->AddEncoder(folder, SensorText("encoder", source), names);
    for (const EncoderSample& sample : EncoderSamples(joints, ReadRows(source, columns))) {
      writer->Write(encoder, sample);
    }
  };
}

/// The frames around a recorded pose: X_WB = X_WR * X_RF * X_FB with the file's X_RF.
ImportJob ReadPose(const ConfigMap& config, const ConfigMap& top, const std::string& machine) {
  const RowSource source = ReadRowSource(config, top);
  const auto world = config.OptionalMap("world");
  const auto body = config.OptionalMap("body");
  const Pose X_WR = world ? world->PoseXyzRpy() : Pose::Identity();
  const Pose X_FB = body ? body->PoseXyzRpy() : Pose::Identity();
  const ConfigMap keys = config.Map("columns");
  auto columns = ReadColumns(keys, {"x", "y", "z"}, Dimension::kLength);
  Append(ReadColumns(keys, {"qw", "qx", "qy", "qz"}, Dimension::kNone), &columns);
  return [=](DatasetWriter* writer) {
    const ChannelId pose = writer->AddPose("truth/" + machine + "/pose.csv", false);
    for (const MappedRow& row : ReadRows(source, columns)) {
      const std::vector<double>& v = row.values;
      const Quat q(v[3], v[4], v[5], v[6]);
      if (q.norm() < kMinQuaternionNorm || q.norm() > kMaxQuaternionNorm) {
        throw InputError(
            fmt::format("{}: at {} s the quaternion has norm {}, need 1; leave such "
                        "rows out by valid_if",
                        source.file.string(), ToSeconds(row.t_ns), q.norm()));
      }
      const Pose X_RF = MakePose(Vec3(v[0], v[1], v[2]), q.normalized().toRotationMatrix());
      writer->Write(pose, TruthPose{row.t_ns, X_WR * X_RF * X_FB});
    }
  };
}

ImportJob ReadTable(const ConfigMap& config, const ConfigMap& top, const std::string& machine) {
  const std::string file = machine + "/" + config.Text("name") + ".csv";
  const RowSource source = ReadRowSource(config, top);
  std::vector<ColumnMapping> columns;
  std::vector<std::string> names;
  for (const auto& [name, column] : config.NamedMaps("columns")) {
    names.push_back(name);
    columns.push_back(ReadColumnMapping(column, Dimension::kAny));
  }
  if (columns.empty()) config.Fault("columns", "need at least one column");
  return [=](DatasetWriter* writer) {
    const ChannelId table = writer->AddTable(file, names);
    for (const MappedRow& row : ReadRows(source, columns)) {
      writer->WriteRow(table, row.t_ns, row.values);
    }
  };
}

Mapping ReadMapping(const ConfigMap& top) {
  Mapping mapping;
  mapping.info.scenario_name = top.Text("name");
  mapping.info.simulated = top.Boolean("simulated", false);
  mapping.machine = top.Text("machine");
  for (const char* shared : {"file", "time"}) top.Has(shared);  // even if each channel has its own
  if (const auto origin = top.OptionalMap("origin")) {
    mapping.info.origin_lat_deg = origin->Number("lat_deg", Between(-90, 90, "deg"));
    mapping.info.origin_lon_deg = origin->Number("lon_deg", Between(-180, 180, "deg"));
    mapping.info.origin_height_m = origin->Number("height_m", Any("m"));
  }
  for (const ConfigMap& item : top.List("imus")) {
    mapping.jobs.push_back(ReadImu(item, top, mapping.machine));
  }
  for (const ConfigMap& item : top.List("gnss")) {
    if (!top.Has("origin")) item.Fault("", "need the mapping's origin for east, north and up");
    mapping.jobs.push_back(ReadGnss(item, top, mapping.machine, mapping.info));
  }
  for (const ConfigMap& item : top.List("encoders")) {
    mapping.jobs.push_back(ReadEncoder(item, top, mapping.machine));
  }
  for (const ConfigMap& item : top.List("tables")) {
    mapping.jobs.push_back(ReadTable(item, top, mapping.machine));
  }
  if (const auto pose = top.OptionalMap("pose")) {
    mapping.jobs.push_back(ReadPose(*pose, top, mapping.machine));
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
  DatasetWriter writer(out, mapping.info, {});
  try {
    for (const ImportJob& job : mapping.jobs) job(&writer);
    writer.Finish();
  } catch (...) {
    writer.Discard();
    throw;
  }
}

}  // namespace tera
