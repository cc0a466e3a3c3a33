#include "dataset/import/scans/lidar_source.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/config/listed_folder.h"
#include "core/error.h"
#include "core/units.h"
#include "dataset/import/bag/topic_table.h"
#include "dataset/import/csv_mapping.h"
#include "dataset/import/scans/capture_file.h"
#include "dataset/import/scans/ouster_decoder.h"
#include "dataset/import/scans/packet_topic.h"
#include "dataset/import/scans/pandar_decoder.h"
#include "dataset/import/scans/point_topic.h"
#include "dataset/import/scans/scan_file.h"
#include "dataset/import/scans/velodyne_decoder.h"
#include "dataset/import/stamped_files.h"

namespace tera {
namespace {

/// A lidar model for which there is a packet decoder.
struct LidarUnit {
  std::string name, model_yaml;
  int port = 2368;  ///< default UDP port of Velodyne and Hesai
  std::function<std::unique_ptr<PacketDecoder>(const DecodeOptions&, TakeScan)> make;
};

/// YAML of the beam pattern: beams from top to bottom, azimuths counterclockwise seen from above.
std::string PatternYaml(const std::vector<double>& elevation_deg,
                        const std::vector<double>& azimuth_deg, int columns) {
  const std::vector<std::uint16_t> rings = RingsOf(elevation_deg);
  std::vector<double> elevations(rings.size()), azimuths(rings.size());
  for (std::size_t beam = 0; beam < rings.size(); ++beam) {
    elevations[rings[beam]] = elevation_deg[beam];
    azimuths[rings[beam]] = azimuth_deg[beam];
  }
  std::string yaml =
      fmt::format("model:\n  elevation_deg: [{:.6g}]\n  azimuth_offset_deg: [{:.6g}]\n",
                  fmt::join(elevations, ", "), fmt::join(azimuths, ", "));
  if (columns > 0) yaml += fmt::format("  columns: {}\n", columns);
  return yaml + "  clockwise: true\n";
}

std::vector<double> Negated(std::vector<double> values) {
  for (double& value : values) value = 0.0 - value;
  return values;
}

LidarUnit OusterUnit(const std::filesystem::path& metadata) {
  const OusterSheet sheet = ReadOusterSheet(metadata);
  std::vector<double> elevation_deg, azimuth_deg;
  for (const double angle : sheet.altitude_rad) elevation_deg.push_back(angle / kDeg);
  for (const double angle : sheet.azimuth_rad) azimuth_deg.push_back(-angle / kDeg);
  return {sheet.product, PatternYaml(elevation_deg, azimuth_deg, sheet.columns_per_frame),
          sheet.port, [sheet](const DecodeOptions& options, TakeScan take) {
            return MakeOusterDecoder(sheet, options, std::move(take));
          }};
}

LidarUnit VelodyneOf(const VelodyneUnit& unit) {
  return {.name = std::string(unit.name),
          .model_yaml = PatternYaml(unit.elevation_deg, Negated(unit.azimuth_offset_deg), 0),
          .make = [&unit](const DecodeOptions& options, TakeScan take) {
            return MakeVelodyneDecoder(unit, options, std::move(take));
          }};
}

LidarUnit PandarOf(const PandarAngles& angles) {
  return {
      .name = "PandarQT64",
      .model_yaml = PatternYaml({angles.elevation_deg.begin(), angles.elevation_deg.end()},
                                Negated({angles.azimuth_deg.begin(), angles.azimuth_deg.end()}), 0),
      .make = [angles](const DecodeOptions& options, TakeScan take) {
        return MakePandarDecoder(angles, options, std::move(take));
      }};
}

/// Reads the keys of a lidar in the mapping.
class LidarKeys {
 public:
  LidarKeys(const ConfigMap& channel, const ConfigMap& top, UnpackedFiles* unpacked)
      : channel_(channel), top_(top), unpacked_(unpacked) {}

  LidarSource Read() {
    LidarSource source = ReadAny();
    if (source.read) return source;
    // Keys that were not read because of an earlier fault must not be reported as unknown.
    for (const char* key :
         {"topic", "unit", "metadata", "port", "corrections", "returns", "time", "stamp",
          "duration_s", "time_field", "time_unit", "full_intensity", "times"}) {
      channel_.Has(key);
    }
    return source;
  }

 private:
  LidarSource ReadAny() {
    if (channel_.Has("files")) return ReadFolder();
    const auto files = FilesOrList(channel_.Has("file") ? channel_ : top_, "file", kBagMetadata);
    if (files.size() != 1) {
      if (files.size() > 1) channel_.Fault("file", "names several files; need one file of scans");
      return {};
    }
    source_.file = files.front();
    if (channel_.Has("topic")) {
      ReadTopic();
    } else if (LooksLikeBag(source_.file)) {
      channel_.Fault("topic", {FaultKind::kMissing,
                               "is missing; need the topic of the lidar's packets or points"});
    } else {
      ReadPackets();
    }
    return source_;
  }

  /// Reads `unit` or `metadata`. The unit must be of one of the makes. Returns nullopt if both keys
  /// are absent.
  std::optional<LidarUnit> ReadUnit(std::initializer_list<std::string_view> makes) {
    if (std::find(makes.begin(), makes.end(), "ouster") != makes.end() &&
        (channel_.Has("metadata") || makes.size() == 1)) {
      if (channel_.Has("unit")) channel_.Choice("unit", {"ouster"});
      const std::filesystem::path metadata = channel_.File("metadata");
      if (metadata.empty()) return std::nullopt;
      try {
        return OusterUnit(metadata);
      } catch (const InputError& fault) {
        channel_.Fault("metadata", fault.AsFinding());
        return std::nullopt;
      }
    }
    const std::string name = channel_.Choice("unit", makes);
    if (name == "vlp16") return VelodyneOf(Vlp16());
    if (name == "vlp32c") return VelodyneOf(Vlp32c());
    if (name != "qt64") return std::nullopt;
    if (!channel_.Has("corrections")) return PandarOf(Qt64DesignAngles());
    const std::filesystem::path corrections = channel_.File("corrections");
    if (corrections.empty()) return std::nullopt;
    try {
      return PandarOf(ReadPandarAngles(corrections));
    } catch (const InputError& fault) {
      channel_.Fault("corrections", fault.AsFinding());
      return std::nullopt;
    }
  }

  /// Reads the clock and the offset in `time`. Returns the name of the time column.
  std::string ReadTime(std::initializer_list<std::string_view> columns,
                       std::string_view otherwise) {
    const auto time = channel_.OptionalMap("time");
    if (!time) return std::string(otherwise);
    source_.offset_s = time->Number("offset", Any("s"), 0);
    return time->Choice("column", columns, otherwise);
  }

  DecodeOptions ReadDecoding(const LidarUnit& unit, std::string_view clock) {
    DecodeOptions options;
    options.by_unit_clock = ReadTime({"unit", "received"}, clock) == "unit";
    source_.keeps_seconds = channel_.Choice("returns", {"strongest", "all"}, "strongest") == "all";
    if (source_.keeps_seconds) options.returns = ReturnsKept::kAll;
    source_.unit = unit.name;
    source_.model_yaml = unit.model_yaml;
    return options;
  }

  /// Passes packets of any container to a decoder.
  using ReadAll = std::function<void(ScanReading*, const TakePacket&)>;
  static std::function<void(ScanReading*)> Decoding(const LidarUnit& unit,
                                                    const DecodeOptions& options, ReadAll all) {
    return [unit, options, all](ScanReading* reading) {
      const auto decoder = unit.make(options, reading->take);
      all(reading, [&](const UnitPacket& packet) {
        ++reading->pieces;
        decoder->Take(packet);
      });
      try {
        decoder->Finish();
      } catch (const InputError& fault) {
        reading->leave_out(fault);
      }
    };
  }

  void ReadPackets() {
    const auto unit = ReadUnit({"ouster", "vlp16", "vlp32c", "qt64"});
    if (!unit) {
      if (channel_.Has("unit") && !channel_.Has("metadata") && channel_.Text("unit") == "ouster") {
        channel_.Fault("metadata",
                       {FaultKind::kMissing, "is missing; need the metadata JSON of the sensor"});
      }
      return;
    }
    constexpr double kMostPort = 65535;
    const int port =
        static_cast<int>(channel_.Integer("port", Between(1, kMostPort, ""), unit->port));
    const DecodeOptions options =
        ReadDecoding(*unit, channel_.Has("metadata") ? "unit" : "received");
    source_.read = Decoding(
        *unit, options, [file = source_.file, port](ScanReading* reading, const TakePacket& take) {
          ReadCapture(file, port, reading->leave_out, take);
        });
  }

  void ReadTopic() {
    const auto topic = ReadNamedTopic(channel_, "topic", source_.file, unpacked_);
    if (!topic) return;
    if (HoldsPoints(topic->type)) {
      ReadPoints(*topic);
      return;
    }
    if (!HoldsPackets(topic->type)) {
      channel_.Fault(
          "topic",
          {FaultKind::kUnsupported,
           fmt::format("has the type {}; need {}, CustomMsg of Livox, {}, {} or {}", topic->type,
                       kPointCloudType, kVelodyneType, kPandarType, kOusterSensorType)});
      return;
    }
    const bool is_velodyne = topic->type == kVelodyneType, is_pandar = topic->type == kPandarType;
    const auto unit = is_velodyne ? ReadUnit({"vlp16", "vlp32c"})
                      : is_pandar ? ReadUnit({"qt64"})
                                  : ReadUnit({"ouster"});
    if (!unit) return;
    const DecodeOptions options =
        ReadDecoding(*unit, is_velodyne || is_pandar ? "received" : "unit");
    source_.read = Decoding(*unit, options,
                            [file = source_.file, topic = *topic, unpacked = unpacked_](
                                ScanReading* reading, const TakePacket& take) {
                              ReadPacketTopic(file, topic, unpacked, reading->skips_bad,
                                              reading->leave_out, take);
                            });
  }

  PointForm ReadForm() {
    PointForm form;
    if (channel_.Has("stamp")) {
      const bool is_last = channel_.Choice("stamp", {"first", "last"}) == "last";
      form.stamp = is_last ? PointForm::Stamp::kLast : PointForm::Stamp::kFirst;
      constexpr double kMostDuration_s = 4;
      if (is_last)
        form.duration_s = channel_.Number("duration_s", Between(0, kMostDuration_s, "s"));
    }
    form.time_field = channel_.Text("time_field", "");
    if (channel_.Has("time_unit")) {
      const std::string unit = channel_.Choice("time_unit", {"s", "ms", "us", "ns"});
      form.time_unit_s = unit == "s" ? 1 : unit == "ms" ? 1e-3 : unit == "us" ? 1e-6 : 1e-9;
    }
    form.full_intensity = channel_.OptionalNumber("full_intensity", Positive(""));
    if (form.stamp != PointForm::Stamp::kUnknown) {
      source_.remark = "points without times take the time of the scan's first ray";
    }
    return form;
  }

  void ReadPoints(const BagTopic& topic) {
    const bool by_log_time = ReadTime({kHeaderStamp, kLogTime}, kHeaderStamp) == kLogTime;
    source_.read = [file = source_.file, topic, unpacked = unpacked_, form = ReadForm(),
                    by_log_time](ScanReading* reading) {
      ReadMessages(file, topic, unpacked, reading->skips_bad, reading->leave_out,
                   [&](const BagMessage& message, const std::string& place) {
                     ++reading->pieces;
                     reading->take(ReadPointMessage(topic, message, place, form, by_log_time));
                   });
    };
  }

  LidarSource ReadFolder() {
    const StampedFiles stamped = ReadStampedFiles(channel_, {".bin", ".pcd", ".ply"}, "scans");
    source_.file = stamped.folder;
    if (source_.file.empty()) return {};
    ReadTime({"stamp"}, "stamp");
    source_.read = [stamped, form = ReadForm()](ScanReading* reading) {
      for (std::size_t k = 0; k < stamped.files.size(); ++k) {
        ++reading->pieces;
        try {
          reading->take(ReadScanFile(stamped.files[k], form, stamped.times_ns[k]));
        } catch (const InputError& fault) {
          reading->leave_out(fault);
        }
      }
    };
    return source_;
  }

  const ConfigMap& channel_;
  const ConfigMap& top_;
  UnpackedFiles* unpacked_;
  LidarSource source_;
};

}  // namespace

LidarSource ReadLidarSource(const ConfigMap& channel, const ConfigMap& top,
                            UnpackedFiles* unpacked) {
  return LidarKeys(channel, top, unpacked).Read();
}

}  // namespace tera
