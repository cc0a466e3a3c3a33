#include "sim/scenario/random_site.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/config/config_peek.h"
#include "core/random.h"
#include "core/units.h"
#include "sim/scenario/driven_ground.h"
#include "sim/scenario/footprint.h"
#include "sim/scenario/haul_road.h"
#include "sim/scenario/standing_things.h"
#include "sim/scenario/yaml_text.h"
#include "soil/columns/old_ruts.h"

namespace tera {
namespace {

constexpr std::uint32_t kMostTries = 1000;  ///< tries to find a free place
constexpr double kMostOfAKind = 100;
/// Length over height of a heap's slope. The smallest angle of repose of the provided soils is
/// about 30 deg.
constexpr double kFootOverHeight = 1.8;

constexpr double kFurthest_m = 1e5;
constexpr double kGauge_m = 2, kRut_m = 0.35;  ///< default track dimensions

/// Draws one kind after the other and keeps track of occupied places.
class SitePlanner {
 public:
  SitePlanner(const ConfigMap& entry, const SiteDraw& draw);

  void Patches();
  void Road();
  void Tracks();
  void Trenches();
  void Berms();
  void Stockpiles();
  void Fences();
  void Things(const char* kind);
  std::vector<std::pair<std::string, std::string>> Take();

 private:
  using List = std::vector<std::string>;
  struct Spread {
    double lower = 0, upper = 0;
    double At(double share) const { return lower + share * (upper - lower); }
  };

  Stream StreamOf(const std::string& of) const { return {draw_.seed, "randomise/site/" + of}; }
  double Share(const Stream& stream, std::uint32_t what) const {
    return stream.Uniform(draw_.episode, what);
  }
  Spread SpreadAt(const ConfigMap& config, const char* key, const Range& range) const;
  int Count(const ConfigMap& config, const std::string& kind) const;
  /// Draws an entry of the list at `key`. An empty list is a fault and gives an empty text.
  std::string OneOf(const ConfigMap& config, const char* key, const Stream& stream);
  /// Reserves a rectangle at a free place. If there is none, reports a fault and returns nothing.
  std::optional<Footprint> Place(const ConfigMap& config, const std::string& kind,
                                 const Stream& stream, const Vec2& half_m, bool follows_road);
  bool IsWithin(const Vec2& p_W_m) const;
  bool IsFree(const Footprint& wanted) const;
  double DressRoad(const ConfigMap& config, const HaulRoad& road, const std::string& soil);
  /// Draws `count` objects of a kind, each by draw_one(config, stream, number).
  template <typename DrawOne>
  void ForEach(const char* kind, const DrawOne& draw_one);

  static constexpr std::uint32_t kYaw = 0, kSize = 1, kOther = 2, kChoice = 3, kPlaces = 8;

  const ConfigMap& entry_;
  const SiteDraw& draw_;
  Spread x_m_, y_m_;
  double gap_m_ = 0;
  bool reads_only_ = false;
  std::optional<double> road_yaw_rad_;
  std::vector<Footprint> taken_;
  List regions_, pits_, ruts_, piles_, obstacles_;
};

SitePlanner::SitePlanner(const ConfigMap& entry, const SiteDraw& draw)
    : entry_(entry), draw_(draw) {
  x_m_ = SpreadAt(entry, "x_m", Between(-kFurthest_m, kFurthest_m, "m"));
  y_m_ = SpreadAt(entry, "y_m", Between(-kFurthest_m, kFurthest_m, "m"));
  gap_m_ = entry.Number("gap_m", AtLeast(0, "m"), 0.8);
  const double clear_m = entry.Number("clear_m", AtLeast(0, "m"), 7);
  taken_ = StandingThings(*draw.scenario, *draw.drawn, clear_m);
}

SitePlanner::Spread SitePlanner::SpreadAt(const ConfigMap& config, const char* key,
                                          const Range& range) const {
  const std::vector<double> ends = config.Numbers(key, range, 2, 2);
  if (ends.size() != 2) return {};
  if (ends[1] < ends[0]) config.Fault(key, "the ends are swapped, need [least, most]");
  return {ends[0], std::max(ends[0], ends[1])};
}

int SitePlanner::Count(const ConfigMap& config, const std::string& kind) const {
  const Spread of = SpreadAt(config, "count", Between(0, kMostOfAKind, ""));
  if (of.lower != std::floor(of.lower) || of.upper != std::floor(of.upper)) {
    config.Fault("count", {FaultKind::kMistyped, "need whole numbers"});
  }
  const double share = Share(StreamOf(kind), 0);
  return static_cast<int>(of.lower + std::floor(share * (of.upper - of.lower + 1)));
}

std::string SitePlanner::OneOf(const ConfigMap& config, const char* key, const Stream& stream) {
  const std::vector<std::string> all = config.Texts(key);
  if (all.empty()) {
    config.Fault(key, {FaultKind::kMissing, "nothing to choose from, need a list of one or more"});
    reads_only_ = true;
    return "";
  }
  const double count = static_cast<double>(all.size());
  return all[static_cast<std::size_t>(Share(stream, kChoice) * count)];
}

bool SitePlanner::IsWithin(const Vec2& p_W_m) const {
  return p_W_m.x() >= x_m_.lower && p_W_m.x() <= x_m_.upper && p_W_m.y() >= y_m_.lower &&
         p_W_m.y() <= y_m_.upper;
}

bool SitePlanner::IsFree(const Footprint& wanted) const {
  for (const Vec2& corner : wanted.Corners_W_m()) {
    if (!IsWithin(corner)) return false;
  }
  return std::none_of(taken_.begin(), taken_.end(),
                      [&](const Footprint& other) { return Meet(wanted, other, gap_m_); });
}

std::optional<Footprint> SitePlanner::Place(const ConfigMap& config, const std::string& kind,
                                            const Stream& stream, const Vec2& half_m,
                                            bool follows_road) {
  if (reads_only_) return std::nullopt;
  constexpr double kStray_rad = 4 * kDeg, kAcross = 0.25;  // probability of a place across the road
  for (std::uint32_t k = 0; k < kMostTries; ++k) {
    const auto draw = [&](std::uint32_t what) { return Share(stream, kPlaces + 4 * k + what); };
    Footprint wanted{.middle_W_m = Vec2(x_m_.At(draw(0)), y_m_.At(draw(1))),
                     .yaw_rad = (2 * draw(2) - 1) * kPi,
                     .half_m = half_m};
    if (follows_road && road_yaw_rad_) {
      wanted.yaw_rad =
          *road_yaw_rad_ + kStray_rad * (2 * draw(2) - 1) + (draw(3) < kAcross ? 0.5 * kPi : 0);
    }
    if (!IsFree(wanted)) continue;
    taken_.push_back(wanted);
    return wanted;
  }
  config.Fault("", fmt::format("no free place found for one of {} in {} tries; widen x_m and y_m, "
                               "or lessen count, gap_m or clear_m",
                               kind, kMostTries));
  return std::nullopt;
}

template <typename DrawOne>
void SitePlanner::ForEach(const char* kind, const DrawOne& draw_one) {
  const auto config = entry_.OptionalMap(kind);
  if (!config) return;
  const int count = Count(*config, kind);
  // Keys are read even if the count is zero, so that every episode reports typing errors.
  reads_only_ = count == 0;
  for (int n = 1; n <= std::max(count, 1); ++n) {
    draw_one(*config, StreamOf(fmt::format("{}/{}", kind, n)), n);
  }
}

double Degrees(double yaw_rad) { return std::remainder(yaw_rad, 2 * kPi) / kDeg; }

/// A road from one side of the area to the other, with one bend in the middle.
void SitePlanner::Road() {
  const auto config = entry_.OptionalMap("haul_road");
  if (!config) return;
  reads_only_ = false;
  const Stream stream = StreamOf("haul_road");
  const double width_m = SpreadAt(*config, "width_m", Between(1, 30, "m")).At(Share(stream, kSize));
  const std::string soil = NameText(OneOf(*config, "soils", stream));
  if (reads_only_) return;
  const bool along_x = Share(stream, kYaw) < 0.5;
  const Spread& from = along_x ? x_m_ : y_m_;
  const Spread& side = along_x ? y_m_ : x_m_;
  const auto at = [&](double way, std::uint32_t what) {
    const double aside_m = side.At(0.15 + 0.7 * Share(stream, kPlaces + what));
    return along_x ? Vec2(from.At(way), aside_m) : Vec2(aside_m, from.At(way));
  };
  const Vec2 begin = at(0, 0), bend = at(0.3 + 0.4 * Share(stream, kOther), 1), end = at(1, 2);
  road_yaw_rad_ = std::atan2((end - begin).y(), (end - begin).x());
  const HaulRoad road{begin, bend, end, width_m};
  const double foot_m = DressRoad(*config, road, soil);
  for (const auto& [a, b] : {std::pair(begin, bend), std::pair(bend, end)}) {
    const Vec2 way = b - a;
    taken_.push_back({.middle_W_m = 0.5 * (a + b),
                      .yaw_rad = std::atan2(way.y(), way.x()),
                      .half_m = Vec2(0.5 * way.norm(), 0.5 * width_m + foot_m)});
  }
}

/// Patches of spilled or spread soil. Later objects may cover them.
void SitePlanner::Patches() {
  ForEach("patches", [&](const ConfigMap& config, const Stream& stream, int) {
    const double size_m =
        SpreadAt(config, "size_m", Between(0.3, 50, "m")).At(Share(stream, kSize));
    const std::string soil = NameText(OneOf(config, "soils", stream));
    if (reads_only_) return;
    const Vec2 middle_m(x_m_.At(Share(stream, kOther)), y_m_.At(Share(stream, kYaw)));
    const auto shares = [&](std::uint32_t k) { return Share(stream, kPlaces + k); };
    regions_.push_back(fmt::format("{{outline_m: {}, soil: {}}}",
                                   OutlineText(PatchOutline(middle_m, 0.5 * size_m, shares)),
                                   soil));
  });
}

/// Ruts of machines that entered the area from one side and drove along a random path.
void SitePlanner::Tracks() {
  ForEach("tracks", [&](const ConfigMap& config, const Stream& stream, int) {
    const auto [gauge_m, rut_m] = ReadRutSize(config, kGauge_m, kRut_m);
    const double depth_m =
        SpreadAt(config, "depth_m", Between(0, kDeepestRut_m, "m")).At(Share(stream, kSize));
    if (reads_only_) return;
    constexpr double kTightest_m = 7, kMostAskew_rad = 50 * kDeg;
    constexpr int kMost = 150;
    const Vec2 least_m(x_m_.lower, y_m_.lower), most_m(x_m_.upper, y_m_.upper);
    const int side = std::min(static_cast<int>(4 * Share(stream, kChoice)), 3);
    const Vec2 out = side % 2 == 0 ? Vec2(side - 1, 0) : Vec2(0, side - 2);
    const Vec2 aside(std::abs(out.y()), std::abs(out.x()));
    const Vec2 start_m =
        0.5 * (least_m + most_m) +
        0.5 * (most_m - least_m).cwiseProduct(out + (2 * Share(stream, kOther) - 1) * aside);
    const double heading_rad =
        std::atan2(-out.y(), -out.x()) + kMostAskew_rad * (2 * Share(stream, kYaw) - 1);
    const auto shares = [&](std::uint32_t k) { return Share(stream, kPlaces + k); };
    ruts_.push_back(fmt::format(
        "{{path_m: {}, gauge_m: {}, width_m: {}, depth_m: {:.4f}}}",
        OutlineText(DrivenPath(start_m, heading_rad, kTightest_m, least_m, most_m, kMost, shares)),
        gauge_m, rut_m, depth_m));
  });
}

/// Adds the road's soil, ruts and windrows, as far as requested. Returns their extent beyond the
/// road's edges.
double SitePlanner::DressRoad(const ConfigMap& config, const HaulRoad& road,
                              const std::string& soil) {
  const auto shares = [&](const std::string& of) -> ShareRow {
    return
        [this, stream = StreamOf("haul_road/" + of)](std::uint32_t k) { return Share(stream, k); };
  };
  const double stray_m = config.Number("stray_m", Between(0, 5, "m"), 0);
  regions_.push_back(fmt::format("{{outline_m: {}, soil: {}}}",
                                 OutlineText(RoadOutline(road, stray_m, shares("edge"))), soil));
  if (const auto ruts = config.OptionalMap("ruts")) {
    const int count = Count(*ruts, "haul_road/ruts");
    const auto [gauge_m, rut_m] = ReadRutSize(*ruts, kGauge_m, kRut_m);
    const Spread depth_m = SpreadAt(*ruts, "depth_m", Between(0, kDeepestRut_m, "m"));
    const double aside_m = std::max(0.5 * (road.width_m - gauge_m - rut_m), 0.0);
    for (int n = 1; n <= count; ++n) {
      const ShareRow share = shares(fmt::format("ruts/{}", n));
      // Index of the random number for the depth, beyond those of the path.
      constexpr std::uint32_t kDepth = 5000;
      ruts_.push_back(fmt::format("{{path_m: {}, gauge_m: {}, width_m: {}, depth_m: {:.4f}}}",
                                  OutlineText(PathAlong(road, aside_m, share)), gauge_m, rut_m,
                                  depth_m.At(share(kDepth))));
    }
  }
  if (!config.Has("windrow_m")) return 0;
  const Spread height_m = SpreadAt(config, "windrow_m", Between(0.02, 2, "m"));
  for (const Windrow& row : WindrowsOf(road, height_m.lower, height_m.upper, shares("windrow"))) {
    if (!IsWithin(row.from_m) || !IsWithin(row.to_m)) continue;
    piles_.push_back(fmt::format("{{xy_m: {}, to_m: {}, height_m: {:.3f}, soil: {}}}",
                                 PointText(row.from_m), PointText(row.to_m), row.height_m, soil));
  }
  return kFootOverHeight * height_m.upper;
}

void SitePlanner::Trenches() {
  ForEach("trenches", [&](const ConfigMap& config, const Stream& stream, int) {
    const double length_m =
        SpreadAt(config, "length_m", Between(0.5, 200, "m")).At(Share(stream, kSize));
    const double width_m =
        SpreadAt(config, "width_m", Between(0.3, 20, "m")).At(Share(stream, kSize + 3));
    const double depth_m =
        SpreadAt(config, "depth_m", Between(0.05, 10, "m")).At(Share(stream, kSize + 4));
    const Vec2 half_m(0.5 * length_m, 0.5 * width_m);
    const auto at = Place(config, "trenches", stream, half_m, true);
    if (!at) return;
    const std::array<Vec2, 4> corners = at->Corners_W_m();
    pits_.push_back(fmt::format("{{outline_m: {}, depth_m: {:.3f}}}",
                                OutlineText({corners.begin(), corners.end()}), depth_m));
  });
}

void SitePlanner::Berms() {
  ForEach("berms", [&](const ConfigMap& config, const Stream& stream, int) {
    const double length_m =
        SpreadAt(config, "length_m", Between(0.5, 200, "m")).At(Share(stream, kSize));
    const double height_m =
        SpreadAt(config, "height_m", Between(0.1, 10, "m")).At(Share(stream, kSize + 3));
    const std::string soil = NameText(OneOf(config, "soils", stream));
    const double foot_m = kFootOverHeight * height_m;
    const auto at = Place(config, "berms", stream, Vec2(0.5 * length_m + foot_m, foot_m), true);
    if (!at) return;
    const Vec2 half = 0.5 * length_m * at->Along();
    piles_.push_back(fmt::format("{{xy_m: {}, to_m: {}, height_m: {:.3f}, soil: {}}}",
                                 PointText(at->middle_W_m - half), PointText(at->middle_W_m + half),
                                 height_m, soil));
  });
}

void SitePlanner::Stockpiles() {
  ForEach("stockpiles", [&](const ConfigMap& config, const Stream& stream, int) {
    const double height_m =
        SpreadAt(config, "height_m", Between(0.1, 10, "m")).At(Share(stream, kSize));
    const std::string soil = NameText(OneOf(config, "soils", stream));
    const auto at =
        Place(config, "stockpiles", stream, Vec2::Constant(kFootOverHeight * height_m), false);
    if (!at) return;
    piles_.push_back(fmt::format("{{xy_m: {}, height_m: {:.3f}, soil: {}}}",
                                 PointText(at->middle_W_m), height_m, soil));
  });
}

/// Fence panels. A run of panels in a row occupies one rectangle.
void SitePlanner::Fences() {
  ForEach("fences", [&](const ConfigMap& config, const Stream& stream, int number) {
    const double panel_m = config.Number("panel_m", Between(0.5, 20, "m"), 3.5);
    const Spread of = SpreadAt(config, "panels", Between(1, 50, ""));
    if (std::floor(of.lower) != of.lower || std::floor(of.upper) != of.upper) {
      config.Fault("panels", {FaultKind::kMistyped, fmt::format("from {} to {}; need whole numbers",
                                                                of.lower, of.upper)});
      return;
    }
    const auto panels =
        static_cast<int>(of.lower + std::floor(Share(stream, kSize) * (of.upper - of.lower + 1)));
    const std::string file = QuotedText(OneOf(config, "of", stream));
    constexpr double kHalfDepth_m = 0.4;
    const auto at =
        Place(config, "fences", stream, Vec2(0.5 * panels * panel_m, kHalfDepth_m), true);
    if (!at) return;
    for (int k = 0; k < panels; ++k) {
      const Vec2 p_m = at->middle_W_m + (k - 0.5 * (panels - 1)) * panel_m * at->Along();
      obstacles_.push_back(
          fmt::format("{{name: fence_{}_{}, preset: {}, xy_m: {}, yaw_deg: {:.2f}}}", number, k + 1,
                      file, PointText(p_m), Degrees(at->yaw_rad)));
    }
  });
}

void SitePlanner::Things(const char* kind) {
  ForEach(kind, [&](const ConfigMap& config, const Stream& stream, int number) {
    const Vec2 size_m = config.Vector2("size_m", Between(0.1, 50, "m"));
    const std::string file = QuotedText(OneOf(config, "of", stream));
    const auto at = Place(config, kind, stream, 0.5 * size_m, false);
    if (!at) return;
    obstacles_.push_back(fmt::format("{{name: {}_{}, preset: {}, xy_m: {}, yaw_deg: {:.2f}}}", kind,
                                     number, file, PointText(at->middle_W_m),
                                     Degrees(at->yaw_rad)));
  });
}

std::vector<std::pair<std::string, std::string>> SitePlanner::Take() {
  std::vector<std::pair<std::string, std::string>> values;
  const auto give = [&](const std::vector<std::string>& path, const List& added) {
    if (added.empty()) return;
    List all = ItemsAt(*draw_.scenario, path);
    all.insert(all.end(), added.begin(), added.end());
    values.emplace_back(fmt::format("{}", fmt::join(path, ".")),
                        fmt::format("[{}]", fmt::join(all, ", ")));
  };
  give({"terrain", "regions"}, regions_);
  give({"terrain", "pits"}, pits_);
  give({"terrain", "ruts"}, ruts_);
  give({"terrain", "piles"}, piles_);
  give({"obstacles"}, obstacles_);
  return values;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> DrawSite(const ConfigMap& entry,
                                                          const SiteDraw& draw) {
  SitePlanner planner(entry, draw);
  planner.Patches();
  planner.Road();
  planner.Tracks();
  planner.Trenches();
  planner.Stockpiles();
  planner.Things("parked");
  planner.Berms();
  planner.Fences();
  planner.Things("people");
  planner.Things("things");
  planner.Things("plants");
  return planner.Take();
}

}  // namespace tera
