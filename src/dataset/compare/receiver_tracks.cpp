#include "dataset/compare/receiver_tracks.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "core/quantile.h"
#include "core/units.h"
#include "dataset/format/antenna_pair.h"
#include "dataset/format/sensor_sheet.h"
#include "dataset/format/site_frame.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

constexpr double kOfOneSite_m = 100e3;  ///< largest distance between origins of recordings at one
                                        ///< site
constexpr double kSamePlace_m =
    0.01;  ///< accuracy of a tape measure: antenna mounts closer than this are equal

/// Fixes of a receiver, and its mount if known.
struct Antenna {
  std::string name, link;
  std::optional<Vec3> p_P_m;
  Trajectory fixes;  ///< in W, without rotation
  TimeNs max_gap_ns = kNsPerSecond;
};

SiteFrame::Geodetic OriginOf(const Recording& recording) {
  const DatasetInfo& info = recording.info();
  return {info.origin_lat_deg, info.origin_lon_deg, info.origin_height_m};
}

/// Longest gap for interpolation: a second, or some sample intervals of a slow receiver.
TimeNs LongestGap(const Trajectory& fixes) {
  constexpr double kIntervals = 2.5;
  std::vector<TimeNs> intervals_ns;
  for (std::size_t i = 1; i < fixes.size(); ++i) {
    intervals_ns.push_back(fixes[i].t_ns - fixes[i - 1].t_ns);
  }
  if (intervals_ns.empty()) return kNsPerSecond;
  const TimeNs usual_ns = Median(std::move(intervals_ns));
  return std::max(kNsPerSecond, FromSeconds(kIntervals * ToSeconds(usual_ns)));
}

Antenna LoadAntenna(const RecordedMachine& machine, const std::string& channel,
                    const SiteFrame& site) {
  Antenna antenna{.name = channel.substr(machine.name.size() + 1)};
  const fs::path folder = machine.recording->directory() / channel;
  if (fs::exists(folder / "sensor.yaml")) {
    const SensorSheet sheet = ReadSensorSheet(folder);
    antenna.link = sheet.parent_link;
    if (sheet.X_PS) antenna.p_P_m = sheet.X_PS->translation();
  }
  for (const GnssSample& sample : machine.recording->LoadGnss(channel)) {
    if (sample.fix == GnssFix::kNone) continue;
    const Vec3 p_W_m = site.ToEnu({sample.lat_deg, sample.lon_deg, sample.alt_m});
    antenna.fixes.push_back({sample.t_ns + machine.shift_ns, MakePose(p_W_m)});
  }
  antenna.max_gap_ns = LongestGap(antenna.fixes);
  return antenna;
}

std::vector<Antenna> LoadAntennas(const RecordedMachine& machine, const SiteFrame& site) {
  std::vector<Antenna> antennas;
  for (const std::string& channel : machine.recording->ChannelsOf(kGnssChannel)) {
    if (!channel.starts_with(machine.name + "/")) continue;
    antennas.push_back(LoadAntenna(machine, channel, site));
  }
  return antennas;
}

/// An antenna that both recordings have.
struct Shared {
  Antenna a, b;
};

std::vector<Shared> MatchAntennas(std::vector<Antenna> a, std::vector<Antenna> b,
                                  std::vector<std::string>* remarks) {
  std::vector<Shared> shared;
  for (const Antenna& one : a) {
    const auto same = std::find_if(b.begin(), b.end(),
                                   [&](const Antenna& other) { return other.name == one.name; });
    if (same != b.end()) shared.push_back({one, *same});
  }
  if (shared.empty() && a.size() == 1 && b.size() == 1) shared.push_back({a[0], b[0]});
  if (!shared.empty() || a.empty() || b.empty()) return shared;
  const auto names = [](const std::vector<Antenna>& all) {
    std::vector<std::string> list;
    for (const Antenna& one : all) list.push_back(one.name);
    return list;
  };
  remarks->push_back(fmt::format("receivers [{}] and [{}] share no name, so they cannot be matched",
                                 fmt::join(names(a), ", "), fmt::join(names(b), ", ")));
  return shared;
}

/// Yaw of the link from two antennas of one recording.
class PairHeading {
 public:
  PairHeading(const Antenna& first, const Antenna& second, const AntennaPair& pair)
      : first_(first), second_(second), pair_(pair) {}

  std::optional<double> At(TimeNs t_ns) const {
    const auto first = PoseAt(first_.fixes, t_ns, first_.max_gap_ns);
    const auto second = PoseAt(second_.fixes, t_ns, second_.max_gap_ns);
    if (!first || !second) return std::nullopt;
    return pair_.Yaw_rad(first->translation(), second->translation());
  }

 private:
  const Antenna &first_, &second_;
  AntennaPair pair_;
};

/// Yaw of one link in both recordings, from two antennas whose mounts both recordings know.
struct LinkHeading {
  std::string name;  ///< such as "gnss_left to gnss_right"
  PairHeading a, b;
};

bool IsOnLink(const Shared& one, const std::string& link) {
  return !link.empty() && one.a.link == link && one.b.link == link;
}

bool CanTellHeading(const Shared& one) {
  return one.a.p_P_m && one.b.p_P_m && !one.a.fixes.empty() && !one.b.fixes.empty();
}

/// Uses the first suitable pair of antennas.
std::optional<LinkHeading> HeadingOfLink(const std::string& link,
                                         const std::vector<Shared>& shared) {
  std::vector<const Shared*> on_link;
  for (const Shared& one : shared) {
    if (IsOnLink(one, link) && CanTellHeading(one)) on_link.push_back(&one);
  }
  for (std::size_t i = 0; i < on_link.size(); ++i) {
    for (std::size_t k = i + 1; k < on_link.size(); ++k) {
      const Shared &first = *on_link[i], &second = *on_link[k];
      const auto a = AntennaPair::At(*first.a.p_P_m, *second.a.p_P_m);
      const auto b = AntennaPair::At(*first.b.p_P_m, *second.b.p_P_m);
      if (!a || !b) continue;
      return LinkHeading{
          first.a.name + " to " + second.a.name, {first.a, second.a, *a}, {first.b, second.b, *b}};
    }
  }
  return std::nullopt;
}

/// Fixes that have a heading, each moved by the vector `shift_P_m`, which is fixed in the link.
Trajectory Headed(const Trajectory& fixes, const PairHeading& heading, const Vec3& shift_P_m) {
  Trajectory track;
  for (const TimedPose& fix : fixes) {
    const auto yaw_rad = heading.At(fix.t_ns);
    if (!yaw_rad) continue;
    const Pose turn = MakePose(Vec3::Zero(), 0, 0, *yaw_rad);
    track.push_back({fix.t_ns, MakePose(fix.X_WB.translation() + turn * shift_P_m, turn.linear())});
  }
  return track;
}

std::optional<AntennaTracks> TracksOf(const Shared& one, const std::vector<Shared>& all,
                                      std::vector<std::string>* remarks) {
  const std::string& name = one.a.name;
  if (one.a.fixes.empty() || one.b.fixes.empty()) {
    remarks->push_back(fmt::format("{} has no fix in the {}", name,
                                   one.a.fixes.empty() ? "reference" : "compared dataset"));
    return std::nullopt;
  }
  const bool knows = one.a.p_P_m && one.b.p_P_m;
  if (knows && one.a.link != one.b.link) {
    remarks->push_back(fmt::format("{} is mounted on {} in the reference and on {} in the other",
                                   name, one.a.link, one.b.link));
    return std::nullopt;
  }
  const Vec3 shift_P_m = knows ? Vec3(*one.a.p_P_m - *one.b.p_P_m) : Vec3::Zero();
  AntennaTracks tracks{.antenna = name,
                       .heading = "",
                       .a = one.a.fixes,
                       .b = one.b.fixes,
                       .max_gap_ns = std::max(one.a.max_gap_ns, one.b.max_gap_ns)};
  const bool is_moved = shift_P_m.norm() > kSamePlace_m;
  const std::optional<LinkHeading> heading =
      IsOnLink(one, one.a.link) ? HeadingOfLink(one.a.link, all) : std::nullopt;
  if (is_moved) {
    remarks->push_back(fmt::format(
        "the mounts of {} differ by {:.3f} m, {}", name, shift_P_m.norm(),
        heading ? "and its track is moved to the mount of the reference"
                : "and the heading of its link is unknown: the errors contain this difference"));
  }
  if (heading) {
    tracks.heading = heading->name;
    tracks.a = Headed(one.a.fixes, heading->a, Vec3::Zero());
    tracks.b = Headed(one.b.fixes, heading->b, is_moved ? shift_P_m : Vec3::Zero());
  }
  return tracks;
}

}  // namespace

ReceiverTracks TracksOfReceivers(const RecordedMachine& a, const RecordedMachine& b) {
  ReceiverTracks out;
  const SiteFrame site_a(OriginOf(*a.recording)), site_b(OriginOf(*b.recording));
  const double apart_m = site_a.ToEnu(OriginOf(*b.recording)).norm();
  const bool of_one_site = apart_m <= kOfOneSite_m;
  auto antennas_a = LoadAntennas(a, site_a);
  auto antennas_b = LoadAntennas(b, of_one_site ? site_a : site_b);
  const std::vector<Shared> shared =
      MatchAntennas(std::move(antennas_a), std::move(antennas_b), &out.remarks);
  if (!shared.empty() && !of_one_site) {
    out.remarks.push_back(fmt::format(
        "the origins are {:.0f} km apart: each recording keeps its own east, north and up",
        apart_m / 1e3));
  }
  for (const Shared& one : shared) {
    if (auto tracks = TracksOf(one, shared, &out.remarks)) {
      out.antennas.push_back(std::move(*tracks));
    }
  }
  return out;
}

}  // namespace tera
