#include "layout/measures/eye_masking.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <utility>

#include "core/error.h"
#include "core/units.h"
#include "layout/sight/hull.h"

namespace tera {
namespace {

constexpr double kEyeStep_m = 0.05;  ///< distance between the places tested first
constexpr int kHalvings = 6;         ///< bisections that refine each end of a masking
constexpr int kHullSectors = 360;

/// 1 sigma of a masking's width. The error of each end is uniform over the last bisected step.
double WidthError_m() { return std::sqrt(2.0) * EvenSigma(kEyeStep_m / std::exp2(kHalvings)); }

/// A closed line around the machine, parametrised by arc length, counterclockwise.
struct ClosedLine {
  double length_m = 0;
  std::function<Vec2(double s_m)> at_H_m;
  std::function<double(double length_m)> width_m;  ///< width of a masking with this arc length
};

ClosedLine Circle(const Vec2& middle_H_m, double radius_m) {
  return {2 * kPi * radius_m,
          [=](double s_m) {
            const double at_rad = s_m / radius_m;
            return Vec2(middle_H_m + radius_m * Vec2(std::cos(at_rad), std::sin(at_rad)));
          },
          [=](double length_m) {
            return 2 * radius_m * std::sin(std::min(0.5 * length_m / radius_m, 0.5 * kPi));
          }};
}

/// Starts at a corner.
ClosedLine Rectangle(const Vec2& low_H_m, const Vec2& high_H_m) {
  const Vec2 size_m = high_H_m - low_H_m;
  return {2 * size_m.sum(),
          [=](double s_m) {
            if (s_m <= size_m.x()) return Vec2(low_H_m.x() + s_m, low_H_m.y());
            s_m -= size_m.x();
            if (s_m <= size_m.y()) return Vec2(high_H_m.x(), low_H_m.y() + s_m);
            s_m -= size_m.y();
            if (s_m <= size_m.x()) return Vec2(high_H_m.x() - s_m, high_H_m.y());
            return Vec2(low_H_m.x(), high_H_m.y() - (s_m - size_m.x()));
          },
          [](double length_m) { return length_m; }};
}

/// The rectangle at `margin_m` from the machine's sides.
ClosedLine RectangleAround(const std::vector<double>& hull_m, double margin_m) {
  Vec2 low_m = Vec2::Zero(), high_m = Vec2::Zero();
  for (std::size_t sector = 0; sector < hull_m.size(); ++sector) {
    const double at_rad =
        2 * kPi * static_cast<double>(sector) / static_cast<double>(hull_m.size());
    const Vec2 p_m = hull_m[sector] * Vec2(std::cos(at_rad), std::sin(at_rad));
    low_m = low_m.cwiseMin(p_m);
    high_m = high_m.cwiseMax(p_m);
  }
  return Rectangle(low_m - Vec2::Constant(margin_m), high_m + Vec2::Constant(margin_m));
}

/// Inputs of a test of places at one moment.
struct Moment {
  const EyeStudy& eye;
  const Pose& X_WH;
  Vec3 eye_W_m;
  std::vector<bool> is_machine;  ///< one per instance
  const Sighting& sighting;
};

/// The occluding instance before each of the two lights, if both are occluded.
using Before = std::optional<std::pair<std::uint16_t, std::uint16_t>>;

std::optional<std::uint16_t> FirstOfMachine(const std::vector<Sighting::Crossing>& crossings,
                                            const std::vector<bool>& is_machine) {
  for (const Sighting::Crossing& crossing : crossings) {
    if (is_machine[crossing.instance] && !crossing.is_glass) return crossing.instance;
  }
  return std::nullopt;
}

std::vector<Before> LookAtPlaces(const std::vector<Vec2>& places_H_m, const Moment& now) {
  std::vector<Sighting::Line> lines;
  for (const Vec2& p_H_m : places_H_m) {
    const Vec3 p_W_m = now.X_WH * Vec3(p_H_m.x(), p_H_m.y(), now.eye.height_m);
    const Vec2 ahead = (p_W_m - now.eye_W_m).head<2>().normalized();
    const Vec3 aside_W_m = 0.5 * now.eye.spacing_m * Vec3(-ahead.y(), ahead.x(), 0);
    lines.push_back({now.eye_W_m + aside_W_m, p_W_m});
    lines.push_back({now.eye_W_m - aside_W_m, p_W_m});
  }
  const auto crossings = now.sighting.CrossingsOf(lines);
  std::vector<Before> before(places_H_m.size());
  for (std::size_t p = 0; p < before.size(); ++p) {
    const auto left = FirstOfMachine(crossings[2 * p], now.is_machine);
    const auto right = FirstOfMachine(crossings[2 * p + 1], now.is_machine);
    if (left && right) before[p] = {*left, *right};
  }
  return before;
}

/// The start or end of a masking along a line.
struct Edge {
  std::size_t after = 0;  ///< index of the last tested place before it
  bool begins = false;
  double s_m = 0;
};

std::vector<Edge> EdgesOf(const std::vector<Before>& before, double step_m) {
  std::vector<Edge> edges;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const bool begins = before[(i + 1) % before.size()].has_value();
    if (before[i].has_value() == begins) continue;
    edges.push_back({i, begins, (static_cast<double>(i) + 0.5) * step_m});
  }
  // A masking across the line's start is a single masking.
  if (!edges.empty() && !edges.front().begins) {
    std::rotate(edges.begin(), edges.begin() + 1, edges.end());
  }
  return edges;
}

/// Bisects the step that contains each edge.
void Sharpen(const ClosedLine& line, double step_m, const Moment& now, std::vector<Edge>* edges) {
  double half_m = 0.5 * step_m;
  for (int k = 0; k < kHalvings; ++k) {
    std::vector<Vec2> places_H_m;
    for (const Edge& edge : *edges) places_H_m.push_back(line.at_H_m(edge.s_m));
    const std::vector<Before> before = LookAtPlaces(places_H_m, now);
    half_m *= 0.5;
    for (std::size_t e = 0; e < edges->size(); ++e) {
      Edge& edge = (*edges)[e];
      edge.s_m += before[e].has_value() == edge.begins ? -half_m : half_m;
    }
  }
}

/// Parts that occlude the places from `first` to `last`, largest share first.
std::vector<std::string> MaskedBy(const std::vector<Before>& before, std::size_t first,
                                  std::size_t last, const Sighting& sighting) {
  std::map<std::string, int> counts;
  const std::size_t places = (last + before.size() - first) % before.size() + 1;
  for (std::size_t k = 0; k < places; ++k) {
    const Before& both = before[(first + k) % before.size()];
    ++counts[sighting.NameOf({both->first})];
    ++counts[sighting.NameOf({both->second})];
  }
  std::vector<std::string> names;
  for (const auto& [name, count] : counts) names.push_back(name);
  std::stable_sort(names.begin(), names.end(), [&](const std::string& a, const std::string& b) {
    return counts[a] > counts[b];
  });
  return names;
}

struct Found {
  std::vector<Masking> maskings;
  double masked_share = 0, share_error = 0;
};

Found MaskingsOn(const ClosedLine& line, const Moment& now) {
  const auto count = static_cast<std::size_t>(std::ceil(line.length_m / kEyeStep_m));
  const double step_m = line.length_m / static_cast<double>(count);
  std::vector<Vec2> places_H_m;
  for (std::size_t i = 0; i < count; ++i) {
    places_H_m.push_back(line.at_H_m(static_cast<double>(i) * step_m));
  }
  const std::vector<Before> before = LookAtPlaces(places_H_m, now);
  std::vector<Edge> edges = EdgesOf(before, step_m);
  Sharpen(line, step_m, now, &edges);
  if (edges.empty() && before.front()) {
    edges = {{count - 1, true, 0}, {count - 1, false, line.length_m}};
  }
  Found found;
  for (std::size_t e = 0; e < edges.size(); e += 2) {
    const Edge &begin = edges[e], &end = edges[e + 1];
    const double length_m = end.s_m - begin.s_m + (end.s_m > begin.s_m ? 0 : line.length_m);
    const Vec2 middle_H_m = line.at_H_m(std::fmod(begin.s_m + 0.5 * length_m, line.length_m));
    found.maskings.push_back(
        {std::atan2(middle_H_m.y(), middle_H_m.x()), line.width_m(length_m),
         MaskedBy(before, (begin.after + 1) % count, end.after, now.sighting)});
    found.masked_share += length_m / line.length_m;
  }
  found.share_error =
      WidthError_m() * std::sqrt(static_cast<double>(found.maskings.size())) / line.length_m;
  return found;
}

/// The widest masking, or null.
const Masking* WidestOf(const std::vector<Masking>& maskings) {
  const auto widest =
      std::max_element(maskings.begin(), maskings.end(),
                       [](const Masking& a, const Masking& b) { return a.width_m < b.width_m; });
  return widest == maskings.end() ? nullptr : &*widest;
}

double WidthOf(const Masking* masking) { return masking ? masking->width_m : 0; }

std::vector<double> WidestWidths_m(const std::vector<std::vector<Masking>>& maskings) {
  std::vector<double> widths_m;
  for (const std::vector<Masking>& at : maskings) widths_m.push_back(WidthOf(WidestOf(at)));
  return widths_m;
}

}  // namespace

int LinkOfEye(const EyeStudy& eye, const MachineModel& machine) {
  const int link = machine.LinkIndex(eye.link);
  if (link >= 0) return link;
  std::vector<std::string> links;
  for (const Link& l : machine.links) links.push_back(l.name);
  throw InputError(eye.place, {FaultKind::kNoSuchName,
                               fmt::format("the machine has no link '{}'; its links are {}",
                                           eye.link, fmt::join(links, ", "))});
}

void EyeMasking::Add(const Pose& X_WH, const Pose& X_WB, std::size_t machine,
                     const Sighting& sighting) {
  const auto is_part = [](SemanticClass label) { return label != SemanticClass::kSoilInBucket; };
  const Moment now{eye_, X_WH, X_WB * eye_.p_B_m, sighting.InstancesOf(machine, is_part), sighting};
  const auto keep = [&](const ClosedLine& line, Record* record) {
    Found found = MaskingsOn(line, now);
    record->maskings.push_back(std::move(found.maskings));
    record->masked_share.push_back(found.masked_share);
    record->share_error.push_back(found.share_error);
  };
  const Vec3 eye_H_m = X_WH.inverse() * now.eye_W_m;
  keep(Circle(eye_H_m.head<2>(), eye_.circle_m), &circle_);
  const std::vector<double> hull_m = HullRadii_m(X_WH, machine, kHullSectors, sighting);
  keep(RectangleAround(hull_m, eye_.rectangle_m), &rectangle_);
}

std::vector<Figure> EyeMasking::Figures() const {
  std::vector<Figure> figures;
  const auto tell = [&](const char* name, const Record& record) {
    const std::vector<double> widest_m = WidestWidths_m(record.maskings);
    figures.push_back({{Measure::kWidestMasking, name},
                       widest_m,
                       std::vector<double>(widest_m.size(), WidthError_m())});
    figures.push_back({{Measure::kMaskedShare, name}, record.masked_share, record.share_error});
    if (!eye_.most_masking_m) return;
    Figure exceeds{{Measure::kExceedsLimit, name}};
    for (const double width_m : widest_m) exceeds.at.push_back(width_m > *eye_.most_masking_m);
    figures.push_back(std::move(exceeds));
  };
  tell("circle", circle_);
  tell("rectangle", rectangle_);
  return figures;
}

std::vector<std::string> EyeMasking::Warnings() const {
  std::vector<std::string> warnings;
  const auto warn = [&](const char* name, const Record& record) {
    const std::vector<double> widest_m = WidestWidths_m(record.maskings);
    const auto worst = std::max_element(widest_m.begin(), widest_m.end());
    if (!eye_.most_masking_m || worst == widest_m.end() || *worst <= *eye_.most_masking_m) return;
    const Masking& masking = *WidestOf(record.maskings[worst - widest_m.begin()]);
    warnings.push_back(fmt::format(
        "eye: on the {}, {} mask{} {:.2f} m at azimuth {:.0f} deg, more than the study allows "
        "({:g} m, most_masking_m); move the eye or the masking part, or point a sensor there",
        name, fmt::join(masking.by, ", "), masking.by.size() == 1 ? "s" : "", masking.width_m,
        masking.azimuth_rad / kDeg, *eye_.most_masking_m));
  };
  warn("circle", circle_);
  warn("rectangle", rectangle_);
  return warnings;
}

}  // namespace tera
