#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

#include "core/config/plain_name.h"
#include "core/error.h"
#include "core/types/sample_rows.h"
#include "core/units.h"
#include "dataset/format/channel.h"
#include "dataset/import/angle_wrap.h"
#include "dataset/import/bag/standard_topics.h"
#include "dataset/import/import_run.h"

// Imports encoders.

namespace tera {
namespace {

/// Column indices of a joint's angle and rate. Without an angle, it is integrated from the rate.
/// Without a rate, it is a difference quotient of the angle. For a prismatic joint, they are travel
/// and speed.
struct JointColumns {
  EncoderAxis axis;
  int angle = -1;
  int rate = -1;
  std::optional<CylinderStroke> cylinder =
      std::nullopt;        ///< set if the angle column holds the stroke of the joint's cylinder
  bool is_rolled = false;  ///< the angle is computed from travel over the ground
  double wrap_rad = 0;     ///< period of the angle column; 0: it does not wrap, or the period is
                           ///< unknown
};

/// Integrates the rate by the trapezoidal rule. The angle is 0 at the first row.
void IntegrateRate(const JointColumns& joint, std::size_t j, const std::vector<MappedRow>& rows,
                   std::vector<EncoderSample>* samples) {
  const auto rate = static_cast<std::size_t>(joint.rate);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double dt_s = ToSeconds(rows[i].t_ns - rows[i - 1].t_ns);
    const double mean_radps = 0.5 * (rows[i].values[rate] + rows[i - 1].values[rate]);
    (*samples)[i].q_rad[j] = (*samples)[i - 1].q_rad[j] + dt_s * mean_radps;
  }
}

/// Rates as central differences, one-sided at both ends; 0 for a single row.
void DifferentiateAngle(std::size_t j, std::vector<EncoderSample>* samples) {
  const std::size_t last = samples->empty() ? 0 : samples->size() - 1;
  for (std::size_t i = 0; i < samples->size() && last > 0; ++i) {
    const EncoderSample& a = (*samples)[i == 0 ? 0 : i - 1];
    const EncoderSample& b = (*samples)[std::min(i + 1, last)];
    (*samples)[i].qd_radps[j] = (b.q_rad[j] - a.q_rad[j]) / ToSeconds(b.t_ns - a.t_ns);
  }
}

std::vector<double> AnglesOf(std::size_t j, const std::vector<EncoderSample>& samples) {
  std::vector<double> angles;
  for (const EncoderSample& sample : samples) angles.push_back(sample.q_rad[j]);
  return angles;
}

/// Unwraps a joint's angle if the mapping gives its period.
void UnwrapAngle(const JointColumns& joint, std::size_t j, std::vector<EncoderSample>* samples,
                 ImportedChannel* channel) {
  std::vector<double> angles = AnglesOf(j, *samples);
  const std::size_t changes = Unwrap(joint.wrap_rad, &angles);
  for (std::size_t i = 0; i < angles.size(); ++i) (*samples)[i].q_rad[j] = angles[i];
  channel->remarks.push_back(
      fmt::format("{} is unwrapped where its column wraps after {:.6g} deg, {} time{}",
                  joint.axis.name, joint.wrap_rad / kDeg, changes, changes == 1 ? "" : "s"));
}

std::vector<EncoderSample> EncoderSamples(const std::vector<JointColumns>& joints,
                                          const std::vector<MappedRow>& rows,
                                          ImportedChannel* channel) {
  std::vector<EncoderSample> samples;
  for (const MappedRow& row : rows) {
    EncoderSample sample{row.t_ns, row.t_ns, {}, {}};
    for (const JointColumns& joint : joints) {
      const double position =
          joint.angle < 0 ? 0.0 : row.values[static_cast<std::size_t>(joint.angle)];
      sample.q_rad.push_back(joint.cylinder ? joint.cylinder->position(position) : position);
      sample.qd_radps.push_back(joint.rate < 0 ? 0.0
                                               : row.values[static_cast<std::size_t>(joint.rate)]);
    }
    samples.push_back(std::move(sample));
  }
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (joints[j].angle < 0) IntegrateRate(joints[j], j, rows, &samples);
    if (joints[j].wrap_rad > 0 && joints[j].angle >= 0)
      UnwrapAngle(joints[j], j, &samples, channel);
    if (joints[j].rate < 0) DifferentiateAngle(j, &samples);
  }
  return samples;
}

/// Rows at which a joint's angle jumps, as wrapping sensors do. Empty if the mapping gives the
/// period or the angle is computed from a rate.
std::vector<std::size_t> JointJumps(const JointColumns& joint, std::size_t j,
                                    const std::vector<EncoderSample>& samples) {
  const bool has_angle = joint.angle >= 0 && !joint.cylinder && !joint.is_rolled;
  if (joint.axis.linear || !has_angle || joint.wrap_rad > 0) return {};
  return JumpsOf(AnglesOf(j, samples), 2 * kPi);
}

/// Adds remarks on joints whose angle jumps.
void CountJumps(const std::vector<JointColumns>& joints, const std::vector<EncoderSample>& samples,
                const RowSource& source, const std::vector<MappedRow>& rows,
                ImportedChannel* channel) {
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const std::vector<std::size_t> jumps = JointJumps(joints[j], j, samples);
    if (jumps.empty()) continue;
    const std::size_t first = jumps.front();
    channel->remarks.push_back(
        fmt::format("{} jump{} of {} by more than half a turn, the first at {} from {:.4g} to "
                    "{:.4g} deg: {}give the joint wrap_deg: 360 if its sensor wraps after a turn",
                    jumps.size(), jumps.size() == 1 ? "" : "s", joints[j].axis.name,
                    PlaceOf(source, rows[first].line), samples[first - 1].q_rad[j] / kDeg,
                    samples[first].q_rad[j] / kDeg,
                    joints[j].rate < 0 ? "its rates there are wrong too; " : ""));
  }
}

/// Counts strokes outside the joint limits.
void CountStrokesBeyond(const std::vector<JointColumns>& joints, const std::vector<MappedRow>& rows,
                        ImportedChannel* channel) {
  constexpr double kSlack_m = 1e-3;  // allows for buffers, pins and errors of stroke sensors
  for (const JointColumns& joint : joints) {
    if (!joint.cylinder) continue;
    for (const MappedRow& row : rows) {
      const double stroke_m = row.values[static_cast<std::size_t>(joint.angle)];
      const double beyond_m =
          std::max(joint.cylinder->least_m - stroke_m, stroke_m - joint.cylinder->most_m);
      if (beyond_m <= kSlack_m) continue;
      ++channel->strokes_beyond;
      channel->furthest_beyond_m = std::max(channel->furthest_beyond_m, beyond_m);
    }
  }
}

/// Counts rates faster than any machine.
void CountTooFast(const std::vector<JointColumns>& joints,
                  const std::vector<EncoderSample>& samples, ImportedChannel* channel) {
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (joints[j].axis.linear) continue;
    const std::vector<std::size_t> jumps = JointJumps(joints[j], j, samples);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const double rate_radps = std::abs(samples[i].qd_radps[j]);
      if (rate_radps <= kFastestJoint_radps) continue;
      // A difference quotient across a jump is not a rate.
      const bool is_of_jump =
          joints[j].rate < 0 && std::any_of(jumps.begin(), jumps.end(), [&](std::size_t jump) {
            return i <= jump + 1 && jump <= i + 1;
          });
      if (is_of_jump) continue;
      ++channel->too_fast;
      if (rate_radps <= channel->fastest_radps) continue;
      channel->fastest_radps = rate_radps;
      channel->fastest_joint = joints[j].axis.name;
    }
  }
}

/// An angle from the travel of a wheel or track.
ColumnMapping ReadRolled(const ConfigMap& config) {
  ColumnMapping rolled = ReadColumnMapping(config.Map("rolled"), Dimension::kLength);
  const double radius_m = config.Number("radius_m", Positive("m"));
  rolled.MultiplyBy(1 / radius_m);
  return rolled;
}

/// Reads a joint whose position follows from the travel of a wheel or the stroke of a cylinder.
/// Returns false for any other joint.
bool ReadIndirect(const ConfigMap& config, const ConfigMap& top, const Mapping& mapping,
                  JointColumns* joint, std::vector<ColumnMapping>* columns) {
  if (!config.Has("rolled") && !config.Has("stroke")) return false;
  for (const char* key : {"angle", "rate", "travel", "speed", "wrap_deg"}) {
    if (config.Has(key)) config.Fault(key, "given beside rolled or stroke, which determine it");
  }
  if (config.Has("rolled") && config.Has("stroke")) {
    config.Fault("stroke", "given beside rolled; keep one");
  }
  joint->axis.linear = false;
  joint->angle = static_cast<int>(columns->size());
  if (config.Has("rolled")) {
    joint->is_rolled = true;
    columns->push_back(ReadRolled(config));
    return true;
  }
  columns->push_back(ReadColumnMapping(config.Map("stroke"), Dimension::kLength));
  if (!top.Has("machine_model")) {
    config.Fault("stroke",
                 "needs the machine's geometry; give the mapping a machine_model, for "
                 "instance tera:config/machines/tb235.yaml");
  } else if (mapping.options.cylinder_stroke) {
    joint->cylinder = mapping.options.cylinder_stroke(top.MapOrFile("machine_model"), config);
  } else {
    config.Fault("stroke", "cannot be read here; need the angle");
  }
  return true;
}

/// A joint selected by its name in a JointState. Its position or its velocity may be absent.
JointColumns StandardJoint(const EncoderAxis& axis, std::vector<ColumnMapping>* columns) {
  const int first = static_cast<int>(columns->size());
  columns->push_back({.column = "position[" + axis.name + "]", .may_lack = true});
  columns->push_back({.column = "velocity[" + axis.name + "]", .may_lack = true});
  return {axis, first, first + 1};
}

/// True if joints of the topic can be selected by name alone.
bool IsStandard(const RowSource& source) {
  return source.topic && source.topic->type == kJointType;
}

bool SaysNoColumn(const ConfigMap& joint) {
  constexpr std::array<const char*, 6> kKeys = {"angle", "rate",   "travel",
                                                "speed", "stroke", "rolled"};
  return std::none_of(kKeys.begin(), kKeys.end(), [&](const char* key) { return joint.Has(key); });
}

/// All joints of a topic, for a mapping that lists none.
std::vector<JointColumns> AllJoints(const ConfigMap& config, const RowSource& source,
                                    std::vector<ColumnMapping>* columns) {
  std::vector<JointColumns> joints;
  for (const std::string& name : JointNames(source.file, *source.topic, source.unpacked)) {
    RequirePlainName(config, "topic", name);
    joints.push_back(StandardJoint({name, false}, columns));
  }
  if (joints.empty()) config.Fault("topic", "its first message names no joint; need joints");
  return joints;
}

/// True if a column has no number in any row. Throws if only some rows have numbers.
bool IsMissing(const RowSource& source, const std::vector<MappedRow>& rows, int column,
               const std::string& field) {
  const auto lacks = [&](const MappedRow& row) {
    return std::isnan(row.values[static_cast<std::size_t>(column)]);
  };
  const auto first = std::find_if(rows.begin(), rows.end(), lacks);
  if (first == rows.end()) return false;
  if (std::all_of(rows.begin(), rows.end(), lacks)) return true;
  throw InputError(
      fmt::format("{}: has no {}, but other messages have; exclude such rows with valid_if: "
                  "[{{column: \"{}\", present: true}}]",
                  PlaceOf(source, first->line), field, field));
}

/// Replaces missing velocities by difference quotients of the angle, and missing positions by the
/// integral of the velocity.
void DropMissing(const RowSource& source, const std::vector<MappedRow>& rows,
                 std::vector<JointColumns>* joints) {
  if (!IsStandard(source) || rows.empty()) return;
  for (JointColumns& joint : *joints) {
    const auto drop = [&](int* column, const std::string& kind) {
      const std::string field = kind + "[" + joint.axis.name + "]";
      if (*column >= 0 && IsMissing(source, rows, *column, field)) *column = -1;
    };
    drop(&joint.rate, "velocity");
    drop(&joint.angle, "position");
    if (joint.angle < 0 && joint.rate < 0) {
      throw InputError(
          fmt::format("{}: '{}' has neither position nor velocity; remove it from joints",
                      PlaceOf(source, rows.front().line), joint.axis.name));
    }
  }
}

/// Period of an angle column; 0 if the mapping gives none.
double ReadWrap(const ConfigMap& config, const JointColumns& joint) {
  const auto wrap_deg = config.OptionalNumber("wrap_deg", Positive("deg"));
  if (!wrap_deg) return 0;
  if (joint.axis.linear || joint.angle < 0) {
    config.Fault("wrap_deg", "belongs to a joint that already has an angle; remove it");
  }
  return *wrap_deg * kDeg;
}

JointColumns ReadJoint(const ConfigMap& config, const ConfigMap& top, const Mapping& mapping,
                       const RowSource& source, std::vector<ColumnMapping>* columns) {
  JointColumns joint{{config.Text("name"), config.Has("travel") || config.Has("speed")}};
  RequirePlainName(config, "name", joint.axis.name);
  if (IsStandard(source) && SaysNoColumn(config)) {
    joint = StandardJoint({joint.axis.name, config.Boolean("prismatic", false)}, columns);
    joint.wrap_rad = ReadWrap(config, joint);
    return joint;
  }
  if (ReadIndirect(config, top, mapping, &joint, columns)) return joint;
  const bool linear = joint.axis.linear;
  if (const auto position = config.OptionalMap(linear ? "travel" : "angle")) {
    joint.angle = static_cast<int>(columns->size());
    columns->push_back(
        ReadColumnMapping(*position, linear ? Dimension::kLength : Dimension::kAngle));
  }
  joint.wrap_rad = ReadWrap(config, joint);
  const std::string rate = linear ? "speed" : "rate";
  if (joint.angle >= 0 && !config.Has(rate)) return joint;
  joint.rate = static_cast<int>(columns->size());
  columns->push_back(
      ReadColumnMapping(config.Map(rate), linear ? Dimension::kSpeed : Dimension::kRate));
  return joint;
}

}  // namespace

ImportJob ReadEncoder(const ConfigMap& config, const ConfigMap& top, Mapping* mapping) {
  const std::string folder = ReadPath(config, "", mapping);
  const ImportedSensor sensor{"encoder", config.Text("name"), "", Pose::Identity()};
  const RowSource source = ReadRowSource(config, top, mapping->unpacked);
  std::vector<ColumnMapping> columns;
  std::vector<JointColumns> joints;
  std::vector<EncoderAxis> axes;
  std::set<std::string> names;
  for (const ConfigMap& item : config.List("joints")) {
    joints.push_back(ReadJoint(item, top, *mapping, source, &columns));
    axes.push_back(joints.back().axis);
    if (!names.insert(axes.back().name).second) {
      item.Fault("name", fmt::format("'{}' is named twice; keep one", axes.back().name));
    }
  }
  if (joints.empty() && IsStandard(source)) {
    joints = AllJoints(config, source, &columns);
    for (const JointColumns& joint : joints) axes.push_back(joint.axis);
  } else if (joints.empty()) {
    config.Fault("joints", "need at least one joint with name and rate");
  }
  return [=](ImportRun* run) {
    const std::vector<MappedRow> rows = run->Read(folder, source, columns);
    CountStrokesBeyond(joints, rows, run->last());
    std::vector<JointColumns> found = joints;
    DropMissing(source, rows, &found);
    const std::vector<EncoderSample> samples = EncoderSamples(found, rows, run->last());
    CountJumps(found, samples, source, rows, run->last());
    CountTooFast(found, samples, run->last());
    run->AddMotion(source, MotionOf(axes, samples));
    DatasetWriter* writer = run->writer();
    if (writer == nullptr) return;
    const ChannelId encoder =
        writer->AddChannel(EncoderChannel(folder, SensorText(sensor, source, rows), axes));
    for (const EncoderSample& sample : samples) writer->Write(encoder, RowOf(sample));
  };
}

}  // namespace tera
