#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/config/plain_name.h"
#include "core/error.h"
#include "core/types/sample_rows.h"
#include "core/units.h"
#include "dataset/format/channel.h"
#include "dataset/format/site_frame.h"
#include "dataset/import/bag/standard_topics.h"
#include "dataset/import/import_run.h"
#include "dataset/import/inertial_conventions.h"

// Imports IMUs, receivers, poses and tables.

namespace tera {
namespace {

constexpr double kMinQuaternionNorm = 0.9, kMaxQuaternionNorm = 1.1;
constexpr double kNearlyFull = 1e-4;  ///< excess over full deflection that counts as rounding

std::vector<ColumnMapping> ReadColumns(const ColumnKeys& columns,
                                       const std::vector<const char*>& keys, Dimension dimension,
                                       const Range& allowed = {}) {
  std::vector<ColumnMapping> mappings;
  for (const char* key : keys) mappings.push_back(columns.Read(key, dimension, allowed));
  return mappings;
}

void Append(const std::vector<ColumnMapping>& more, std::vector<ColumnMapping>* all) {
  all->insert(all->end(), more.begin(), more.end());
}

/// Rotation R_SF of the axes F of the file in the sensor frame S, from `rpy_deg`.
Mat3 ReadAxes(const ConfigMap& config) {
  const Vec3 rpy_rad = config.Vector3("rpy_deg", Between(-360, 360, "deg"), Vec3::Zero()) * kDeg;
  return RotationFromRpy(rpy_rad.x(), rpy_rad.y(), rpy_rad.z());
}

/// Reads the key `fix`, a GGA quality.
ColumnMapping ReadFix(const ConfigMap& config) {
  const ColumnMapping fix = ReadColumnMapping(config, Dimension::kNone);
  if (config.Has("constant") && !FixOfQuality(fix.offset)) {
    config.Fault("constant", fmt::format("{} is not a fix; {}", fix.offset, kNeedFix));
  }
  return fix;
}

/// Columns of a receiver, in this order.
enum GnssColumn { kLat, kLon, kAlt, kFix, kVarE, kVarN, kVarU, kCovarianceType };

/// Interpretation of the fix column of a receiver.
struct FixReading {
  bool by_status = false;         ///< as the status of a NavSatFix; otherwise as a GGA quality
  bool needs_covariance = false;  ///< kCovarianceType 0 means that there are no variances
};

/// GGA quality of a NavSatFix. Ground-based augmentation is RTK: fixed if the variance is small
/// enough, otherwise float.
double QualityOfStatus(const std::vector<double>& v) {
  constexpr double kMostOfFixed_m = 0.1;  // one sigma of the horizontal position; RTK fixed is near
                                          // 0.02 m, RTK float near 0.3 m
  const double status = v[kFix];
  if (status != 2) return status < 0 ? 0 : status + 1;
  return v[kVarE] + v[kVarN] <= kMostOfFixed_m * kMostOfFixed_m ? 4 : 5;
}

void RequireNumbers(const MappedRow& row, const RowSource& source, const FixReading& reading) {
  const std::vector<double>& v = row.values;
  if (reading.needs_covariance && v[kCovarianceType] == 0) {
    throw InputError(
        PlaceOf(source, row.line),
        {FaultKind::kMissing,
         "has a fix but position_covariance_type 0, which is unknown; need variances, for instance "
         "columns: {var_e: {constant: 4}, var_n: {constant: 4}, var_u: {constant: 9}}"});
  }
  for (const GnssColumn column : {kLat, kLon, kAlt, kVarE, kVarN, kVarU}) {
    if (!std::isnan(v[column])) continue;
    throw InputError(PlaceOf(source, row.line),
                     {FaultKind::kMissing,
                      "has a fix, but its position or variance is not a number; exclude such rows "
                      "with valid_if, or give the missing values, for instance columns: {var_e: "
                      "{constant: 4}, var_n: {constant: 4}, var_u: {constant: 9}}"});
  }
}

/// ENU coordinates are valid only near the site. Throws InputError for a distant position.
void RequireNear(const GnssSample& sample, const std::string& where) {
  constexpr double kFarthest_m = 100e3;
  if (sample.enu_m.norm() <= kFarthest_m) return;
  throw InputError(
      where,
      {FaultKind::kOutOfRange,
       fmt::format("is {:.0f} km from the mapping's origin, need at most {:.0f} km; this row would "
                   "give the origin {{lat_deg: {:.7f}, lon_deg: {:.7f}, height_m: {:.3f}}}; if the "
                   "row is wrong, exclude it with valid_if or --skip-bad-rows",
                   sample.enu_m.norm() / 1e3, kFarthest_m / 1e3, sample.lat_deg, sample.lon_deg,
                   sample.alt_m)});
}

/// Receivers without a fix write latitude 0, longitude 0, where no machine works.
bool IsAtZero(const MappedRow& row) { return row.values[kLat] == 0 && row.values[kLon] == 0; }

GnssSample GnssOf(const MappedRow& row, const RowSource& source, const FixReading& reading,
                  const SiteFrame& site) {
  const std::vector<double>& v = row.values;
  const double quality = reading.by_status ? QualityOfStatus(v) : v[kFix];
  const auto fix = FixOfQuality(quality);
  if (!fix) {
    throw InputError(
        PlaceOf(source, row.line),
        {FaultKind::kOutOfRange,
         fmt::format("the fix is {}; {}, or exclude such rows with valid_if", v[kFix], kNeedFix)});
  }
  GnssSample s;
  s.t_ns = s.t_available_ns = row.t_ns;
  s.fix = *fix;
  if (s.fix == GnssFix::kNone) return s;
  if (IsAtZero(row)) {
    s.fix = GnssFix::kNone;
    return s;
  }
  RequireNumbers(row, source, reading);
  s.lat_deg = v[kLat] / kDeg;
  s.lon_deg = v[kLon] / kDeg;
  s.alt_m = v[kAlt];
  s.enu_m = site.ToEnu({s.lat_deg, s.lon_deg, s.alt_m});
  RequireNear(s, PlaceOf(source, row.line));
  s.variance_enu_m2 = Vec3(v[kVarE], v[kVarN], v[kVarU]);
  return s;
}

Pose PoseOf(const MappedRow& row, const RowSource& source) {
  const std::vector<double>& v = row.values;
  const Quat q(v[3], v[4], v[5], v[6]);
  if (q.norm() < kMinQuaternionNorm || q.norm() > kMaxQuaternionNorm) {
    throw InputError(
        PlaceOf(source, row.line),
        {FaultKind::kOutOfRange,
         fmt::format("the quaternion has norm {}, need 1; exclude such rows with valid_if",
                     q.norm())});
  }
  return MakePose(Vec3(v[0], v[1], v[2]), q.normalized().toRotationMatrix());
}

/// Clamps levers that exceed full deflection by rounding. Counts those and larger excesses.
void ClampLevers(std::vector<MappedRow>* rows, ImportedChannel* channel) {
  for (MappedRow& row : *rows) {
    for (double& lever : row.values) {
      if (std::abs(lever) <= 1) continue;
      if (std::abs(lever) <= 1 + kNearlyFull) {
        lever = std::copysign(1.0, lever);
        ++channel->clamped_levers;
      } else {
        ++channel->levers_beyond_full;
        channel->largest_lever = std::max(channel->largest_lever, std::abs(lever));
      }
    }
  }
}

}  // namespace

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

ImportJob ReadImu(const ConfigMap& config, const ConfigMap& top, Mapping* mapping) {
  const std::string folder = ReadPath(config, "", mapping);
  const ImportedSensor sensor = ReadSensorMount(config, "imu");
  const RowSource source = ReadRowSource(config, top, mapping->unpacked);
  const Mat3 R_SF = ReadAxes(config);
  const ColumnKeys keys(config, source, kImuType, "wx");
  auto columns = ReadColumns(keys, {"wx", "wy", "wz"}, Dimension::kRate);
  Append(ReadColumns(keys, {"ax", "ay", "az"}, Dimension::kAcceleration), &columns);
  return [=](ImportRun* run) {
    const std::vector<MappedRow> rows = run->Read(folder, source, columns);
    const auto sample = [&](std::size_t row) {
      const std::vector<double>& v = rows[row].values;
      return ImuSample{rows[row].t_ns, rows[row].t_ns, R_SF * Vec3(v[0], v[1], v[2]),
                       R_SF * Vec3(v[3], v[4], v[5])};
    };
    run->AddMotion(source, MotionOf(rows.size(), SampleOfRow<ImuSample>(sample)));
    for (const InertialFinding& one :
         JudgeInertial(rows.size(), sample, sensor.X_LS.linear().transpose() * Vec3::UnitZ())) {
      run->last()->remarks.push_back(one.text);
    }
    for (const InertialFinding& one : JudgeLogged(rows.size(), sample, !sensor.link.empty())) {
      run->last()->remarks.push_back(one.text);
    }
    DatasetWriter* writer = run->writer();
    if (writer == nullptr) return;
    const ChannelId imu = writer->AddChannel(ImuChannel(folder, SensorText(sensor, source, rows)));
    for (std::size_t row = 0; row < rows.size(); ++row) writer->Write(imu, RowOf(sample(row)));
  };
}

ImportJob ReadGnss(const ConfigMap& config, const ConfigMap& top, Mapping* mapping) {
  const std::string folder = ReadPath(config, "", mapping);
  const ImportedSensor sensor = ReadSensorMount(config, "gnss");
  const RowSource source = ReadRowSource(config, top, mapping->unpacked);
  const ColumnKeys keys(config, source, kFixType, "lat");
  auto columns = ReadColumns(keys, {"lat"}, Dimension::kAngle, Between(-kPi / 2, kPi / 2, "rad"));
  Append(ReadColumns(keys, {"lon"}, Dimension::kAngle, Between(-kPi, kPi, "rad")), &columns);
  Append(ReadColumns(keys, {"alt"}, Dimension::kLength), &columns);
  const auto fix = keys.Given("fix");
  columns.push_back(fix ? ReadFix(*fix) : keys.Read("fix", Dimension::kNone));
  Append(ReadColumns(keys, {"var_e", "var_n", "var_u"}, Dimension::kVariance, AtLeast(0, "m2")),
         &columns);
  const bool is_standard = source.topic && source.topic->type == kFixType;
  const FixReading reading{
      is_standard && !fix,
      is_standard && !(keys.Given("var_e") && keys.Given("var_n") && keys.Given("var_u"))};
  if (reading.needs_covariance) columns.push_back({kCovarianceTypePath});
  const SiteFrame site(mapping->info.origin_lat_deg, mapping->info.origin_lon_deg,
                       mapping->info.origin_height_m);
  return [=](ImportRun* run) {
    const std::vector<MappedRow> rows = run->Read(
        folder, source, columns, [&](const MappedRow& row) { GnssOf(row, source, reading, site); });
    std::vector<GnssSample> samples;
    for (const MappedRow& row : rows) samples.push_back(GnssOf(row, source, reading, site));
    const auto at_zero = std::count_if(rows.begin(), rows.end(), IsAtZero);
    if (at_zero > 0) {
      run->last()->remarks.push_back(
          fmt::format("{} row{} at latitude 0, longitude 0: treated as without a fix", at_zero,
                      at_zero == 1 ? "" : "s"));
    }
    run->AddMotion(source, MotionOf(samples));
    DatasetWriter* writer = run->writer();
    if (writer == nullptr) return;
    const ChannelId gnss =
        writer->AddChannel(GnssChannel(folder, SensorText(sensor, source, rows)));
    for (const GnssSample& sample : samples) writer->Write(gnss, RowOf(sample));
  };
}

/// Converts frames of a recorded pose: X_WB = X_WR * X_RF * X_FB, where the file gives X_RF.
ImportJob ReadPose(const ConfigMap& config, const ConfigMap& top, Mapping* mapping) {
  const RowSource source = ReadRowSource(config, top, mapping->unpacked);
  const auto world = config.OptionalMap("world");
  const auto body = config.OptionalMap("body");
  const Pose X_WR = world ? world->PoseXyzRpy() : Pose::Identity();
  const Pose X_FB = body ? body->PoseXyzRpy() : Pose::Identity();
  const ColumnKeys keys(config, source, "nav_msgs/Odometry or geometry_msgs/PoseStamped", "qw");
  auto columns = ReadColumns(keys, {"x", "y", "z"}, Dimension::kLength);
  Append(ReadColumns(keys, {"qw", "qx", "qy", "qz"}, Dimension::kNone), &columns);
  return [=, file = "truth/" + mapping->machine + "/pose.csv"](ImportRun* run) {
    const std::vector<MappedRow> rows =
        run->Read(file, source, columns, [&](const MappedRow& row) { PoseOf(row, source); });
    const auto sample = [&](std::size_t row) {
      return TruthPose{rows[row].t_ns, X_WR * PoseOf(rows[row], source) * X_FB};
    };
    run->AddMotion(source, MotionOf(rows.size(), SampleOfRow<TruthPose>(sample)));
    DatasetWriter* writer = run->writer();
    if (writer == nullptr) return;
    const ChannelId pose = writer->AddChannel(PoseChannel(file, /*with_velocity=*/false));
    for (std::size_t row = 0; row < rows.size(); ++row) {
      writer->Write(pose, RowOf(sample(row), /*with_velocity=*/false));
    }
  };
}

namespace {

/// Columns of a table that come from one topic or file, and their positions in the table.
struct TablePart {
  RowSource source;
  std::vector<ColumnMapping> columns;
  std::vector<std::size_t> places;
};

/// Merges the rows of all parts. There is one row for each time at which any part has a row, with
/// the latest values of the other parts. The first row is at the first time when every part has a
/// value.
std::vector<MappedRow> HeldTogether(const std::vector<TablePart>& parts,
                                    const std::vector<std::vector<MappedRow>>& rows,
                                    std::size_t width) {
  // pairs of part and row, by time
  std::map<TimeNs, std::vector<std::pair<std::size_t, std::size_t>>> said;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    for (std::size_t r = 0; r < rows[p].size(); ++r) said[rows[p][r].t_ns].emplace_back(p, r);
  }
  std::vector<MappedRow> together;
  MappedRow held{.values = std::vector<double>(width)};
  std::set<std::size_t> known;
  for (const auto& [t_ns, places] : said) {
    for (const auto& [p, r] : places) {
      known.insert(p);
      held.line = rows[p][r].line;
      for (std::size_t c = 0; c < parts[p].places.size(); ++c) {
        held.values[parts[p].places[c]] = rows[p][r].values[c];
      }
    }
    held.t_ns = t_ns;
    if (known.size() == parts.size()) together.push_back(held);
  }
  return together;
}

/// Sources of a table's columns: one for the columns from the table's own file or topic, and one
/// for each column that names a topic.
std::vector<TablePart> ReadTableParts(const ConfigMap& config, const ConfigMap& top,
                                      const Mapping& mapping, std::vector<std::string>* names) {
  std::vector<TablePart> parts;
  std::optional<TablePart> own;
  for (const auto& [name, column] : config.NamedMaps("columns")) {
    RequirePlainName(column, "", name);
    if (name == "t_ns") column.Fault("", "is the first column of every table; need another name");
    const ColumnMapping mapped = ReadColumnMapping(column, Dimension::kAny);
    if (column.Has("topic")) {
      const ConfigMap& above = config.Has("file") ? config : top;
      parts.push_back({ReadRowSource(column, above, mapping.unpacked), {mapped}, {names->size()}});
    } else {
      if (!own) own = TablePart{ReadRowSource(config, top, mapping.unpacked), {}, {}};
      own->columns.push_back(mapped);
      own->places.push_back(names->size());
    }
    names->push_back(name);
  }
  if (own) parts.insert(parts.begin(), *own);
  if (names->empty()) config.Fault("columns", "need at least one column");
  return parts;
}

}  // namespace

ImportJob ReadTable(const ConfigMap& config, const ConfigMap& top, Mapping* mapping) {
  const std::string file = ReadPath(config, ".csv", mapping);
  std::vector<std::string> names;
  const std::vector<TablePart> parts = ReadTableParts(config, top, *mapping, &names);
  const bool is_levers = file.ends_with("/commands.csv");
  return [=](ImportRun* run) {
    std::vector<std::vector<MappedRow>> parts_rows;
    for (const TablePart& part : parts) {
      parts_rows.push_back(run->Read(file, part.source, part.columns));
    }
    std::vector<MappedRow> rows = parts.size() == 1 ? std::move(parts_rows.front())
                                                    : HeldTogether(parts, parts_rows, names.size());
    if (is_levers) ClampLevers(&rows, run->last());
    DatasetWriter* writer = run->writer();
    if (writer == nullptr) return;
    const ChannelId table = writer->AddChannel(TableChannel(file, names));
    for (const MappedRow& row : rows)
      writer->Write(table, RowSample{row.t_ns, row.t_ns, row.values});
  };
}

}  // namespace tera
