#include "dataset/compare/comparison_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "dataset/files/checked_file.h"
#include "dataset/format/png.h"
#include "dataset/format/recording.h"
#include "dataset/overview/scan_picture.h"
#include "dataset/realism/realism.h"

namespace tera {
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
namespace {

constexpr int kTileWidth_px = 800, kTileHeight_px = 600;

Json StatisticsJson(const ErrorStatistics& e) {
  return {{"rmse", e.rmse}, {"mean", e.mean}, {"median", e.median}, {"max", e.max}};
}

Json ErrorJson(const TrajectoryError& e, bool tells_rotation) {
  Json json = {{"translation_m", StatisticsJson(e.ape_translation_m)}};
  if (tells_rotation) json["rotation_rad"] = StatisticsJson(e.ape_rotation_rad);
  return json;
}

Json TrackJson(const TrackComparison& track) {
  const bool is_turned = track.rotation != TrackComparison::Rotation::kNone;
  const TrajectoryError& e = track.unaligned;
  return {
      {"of", track.of},
      {"ape", ErrorJson(e, is_turned)},
      {"ape_se2", ErrorJson(track.aligned_se2, is_turned)},
      {"ape_se3", ErrorJson(track.aligned_se3, track.rotation == TrackComparison::Rotation::kAll)},
      {"rpe_1s_translation_m", StatisticsJson(e.rpe_translation_m)},
      {"path_reference_m", e.path_length_a_m},
      {"path_compared_m", e.path_length_b_m},
      {"final_drift_m", e.final_drift_m},
      {"hints", track.doubts}};
}

Json SideJson(const ScanSide& side) {
  Json json = {{"points", side.points},
               {"second_returns", side.second_returns},
               {"range_share", side.range_share},
               {"plane_deviation_m", Json::array()},
               {"reflectivity_quantiles", side.reflectivity}};
  if (side.without_return) json["without_return"] = *side.without_return;
  for (const auto& deviation_m : side.plane_deviation_m) {
    json["plane_deviation_m"].push_back(deviation_m ? Json(*deviation_m) : Json());
  }
  return json;
}

Json DistanceJson(const DistanceFigures& d) {
  return {{"count", d.count}, {"mean_m", d.mean_m}, {"median_m", d.median_m}, {"p95_m", d.most_m}};
}

Json ScanJson(const ScanComparison& c) {
  Json json = {{"lidar", c.sensor.name},
               {"pairs", c.sensor.pairs.size()},
               {"remark", c.sensor.remark},
               {"range_limits_m", kRangeLimits_m},
               {"reflectivity_shares", kReflectivityShares},
               {"reference", SideJson(c.a)},
               {"compared", SideJson(c.b)},
               {"rays",
                {{"both", c.rays_both},
                 {"only_reference", c.rays_only_a},
                 {"only_compared", c.rays_only_b}}},
               {"range_difference_m",
                {{"mean", c.range_mean_m}, {"median", c.range_median_m}, {"rms", c.range_rms_m}}},
               {"reflectivity_ratio", c.reflectivity_ratio},
               {"compared_to_nearest", DistanceJson(c.b_to_a)},
               {"reference_to_nearest", DistanceJson(c.a_to_b)},
               {"compared_to_surface", DistanceJson(c.b_to_surface)},
               {"reference_to_surface", DistanceJson(c.a_to_surface)},
               {"chamfer_m", c.chamfer_m},
               {"classes", Json::array()},
               {"worst", Json::array()}};
  for (const ClassDropOut& one : c.classes) {
    json["classes"].push_back({{"class", one.name},
                               {"of", one.is_of_b ? "compared" : "reference"},
                               {"rays", one.rays},
                               {"lost", one.lost}});
  }
  for (const WorstFrame& frame : c.worst) {
    json["worst"].push_back({{"t_ns", frame.t.a_ns}, {"chamfer_m", frame.difference}});
  }
  return json;
}

Json PictureSideJson(const PictureSide& side) {
  return {{"width_px", side.width_px},   {"height_px", side.height_px},
          {"mean_dn", side.mean_dn},     {"dark_share", side.dark},
          {"bright_share", side.bright}, {"realism", Json::parse(RealismJson(side.realism))}};
}

Json PictureJson(const PictureComparison& c) {
  Json json = {
      {"camera", c.sensor.name}, {"pairs", c.sensor.pairs.size()}, {"remark", c.sensor.remark}};
  if (c.a) json["reference"] = PictureSideJson(*c.a);
  if (c.b) json["compared"] = PictureSideJson(*c.b);
  if (c.difference_dn) json["difference_dn"] = *c.difference_dn;
  json["worst"] = Json::array();
  for (const WorstFrame& frame : c.worst) {
    json["worst"].push_back({{"t_ns", frame.t.a_ns}, {"difference_dn", frame.difference}});
  }
  return json;
}

Json MachineJson(const MachineComparison& machine) {
  Json json = {{"reference", machine.name_a}, {"compared", machine.name_b},
               {"remarks", machine.remarks},  {"tracks", Json::array()},
               {"channels", Json::array()},   {"scans", Json::array()},
               {"pictures", Json::array()}};
  for (const TrackComparison& track : machine.tracks) json["tracks"].push_back(TrackJson(track));
  for (const ChannelDifference& d : machine.channels) {
    json["channels"].push_back({{"channel", d.channel},
                                {"column", d.column},
                                {"rmse", d.rmse},
                                {"mean", d.mean},
                                {"samples", d.count}});
  }
  for (const ScanComparison& scans : machine.scans) json["scans"].push_back(ScanJson(scans));
  for (const PictureComparison& one : machine.pictures) {
    json["pictures"].push_back(PictureJson(one));
  }
  return json;
}

Picture SideBySide(const Picture& a, const Picture& b) {
  Picture both(a.width_px + b.width_px, std::max(a.height_px, b.height_px), 3);
  Paste(a, 0, 0, &both);
  Paste(b, a.width_px, 0, &both);
  return both;
}

class WorstFrames {
 public:
  WorstFrames(const Recording& a, const Recording& b, const MachineComparison& machine,
              fs::path folder)
      : a_(a), b_(b), machine_(machine), folder_(std::move(folder)) {}

  int Write() {
    for (const ScanComparison& scans : machine_.scans) {
      for (std::size_t k = 0; k < scans.worst.size(); ++k) WriteScans(scans, k);
    }
    for (const PictureComparison& pictures : machine_.pictures) {
      for (std::size_t k = 0; k < pictures.worst.size(); ++k) WritePictures(pictures, k);
    }
    return count_;
  }

 private:
  void WriteScans(const ScanComparison& scans, std::size_t k) {
    const WorstFrame& worst = scans.worst[k];
    const LidarScan scan_a = a_.LoadScan(scans.sensor.folder_a, worst.t.a_ns);
    const LidarScan scan_b = b_.LoadScan(scans.sensor.folder_b, worst.t.b_ns);
    const double radius_m = ShownRadius_m(scan_a.points);
    const auto tile = [&](const LidarScan& scan, const char* side) {
      return FitTile(DrawScanFromAbove(scan.points, kTileWidth_px, kTileHeight_px, radius_m),
                     kTileWidth_px, kTileHeight_px,
                     Caption(side, worst, fmt::format("Chamfer {:.3f} m", worst.difference)));
    };
    Save(scans.sensor, k, worst, SideBySide(tile(scan_a, "reference"), tile(scan_b, "compared")));
  }

  void WritePictures(const PictureComparison& pictures, std::size_t k) {
    const WorstFrame& worst = pictures.worst[k];
    const auto tile = [&](const Picture& picture, const char* side) {
      return FitTile(picture, kTileWidth_px, kTileHeight_px,
                     Caption(side, worst, fmt::format("{:.1f} DN", worst.difference)));
    };
    Save(pictures.sensor, k, worst,
         SideBySide(tile(a_.LoadFrame(pictures.sensor.folder_a, worst.t.a_ns).rgb, "reference"),
                    tile(b_.LoadFrame(pictures.sensor.folder_b, worst.t.b_ns).rgb, "compared")));
  }

  static std::string Caption(const char* side, const WorstFrame& worst,
                             const std::string& difference) {
    return fmt::format("{}, {:.3f} s, {}", side, ToSeconds(worst.t.a_ns), difference);
  }

  void Save(const SensorInBoth& sensor, std::size_t k, const WorstFrame& worst,
            const Picture& picture) {
    const std::string name =
        fmt::format("{}_{}_{}_{}.png", machine_.name_a, sensor.name, k + 1, worst.t.a_ns);
    WriteWholeFile(folder_ / name, EncodeRgbPng(picture));
    ++count_;
  }

  const Recording &a_, &b_;
  const MachineComparison& machine_;
  fs::path folder_;
  int count_ = 0;
};

}  // namespace

std::string ComparisonJson(const Comparison& comparison) {
  Json json = {{"reference", comparison.name_a},
               {"compared", comparison.name_b},
               {"times", comparison.times},
               {"machines", Json::array()}};
  for (const MachineComparison& machine : comparison.machines) {
    json["machines"].push_back(MachineJson(machine));
  }
  return json.dump(2) + "\n";
}

int WriteWorstFrames(const Comparison& comparison, const fs::path& a, const fs::path& b,
                     const fs::path& folder) {
  std::error_code fault;
  fs::create_directories(folder, fault);
  if (fault || !fs::is_directory(folder) || !fs::is_empty(folder)) {
    throw InputError(folder.string(), {fault ? FaultKind::kUnwritable : FaultKind::kInconsistent,
                                       "is not an empty, writable folder; name a new one"});
  }
  const Recording recording_a(a), recording_b(b);
  int count = 0;
  for (const MachineComparison& machine : comparison.machines) {
    count += WorstFrames(recording_a, recording_b, machine, folder).Write();
  }
  return count;
}

}  // namespace tera
