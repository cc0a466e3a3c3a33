#include "layout/sight/mount_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/units.h"

namespace tera {
namespace {

constexpr int kTriedDirections = 100;
constexpr double kFarthestPart_m = 30;  ///< largest distance between a machine's parts

bool IsSolidPart(SemanticClass label) { return label != SemanticClass::kSoilInBucket; }

/// Uniform over the sphere: a spiral with equal steps in height, turned by the golden angle.
std::vector<Vec3> Directions() {
  const double golden_rad = kPi * (3 - std::sqrt(5.0));
  std::vector<Vec3> directions;
  for (int i = 0; i < kTriedDirections; ++i) {
    const double up = 1 - 2 * (i + 0.5) / kTriedDirections, out = std::sqrt(1 - up * up);
    directions.emplace_back(out * std::cos(i * golden_rad), out * std::sin(i * golden_rad), up);
  }
  return directions;
}

/// Visibility of one part by the rays from a mount.
struct Evidence {
  int inside = 0;  ///< number of rays whose exits and entries differ
  double nearest_m = kFarthestPart_m;
};

/// Adds the crossings of one ray to the evidence.
void Count(const std::vector<Sighting::Crossing>& crossings, const std::vector<bool>& is_part,
           std::map<std::uint16_t, Evidence>* of_parts) {
  std::map<std::uint16_t, int> out;  // exits minus entries of the line
  for (const Sighting::Crossing& crossing : crossings) {
    if (!is_part[crossing.instance]) continue;
    out[crossing.instance] += crossing.leaves ? 1 : -1;
    Evidence& part = (*of_parts)[crossing.instance];
    part.nearest_m = std::min(part.nearest_m, crossing.at_m);
  }
  for (const auto& [instance, net] : out) (*of_parts)[instance].inside += net != 0;
}

}  // namespace

void MountCheck::Add(std::size_t machine, std::span<const Viewer> viewers,
                     const Sighting& sighting) {
  const std::vector<bool> is_part = sighting.InstancesOf(machine, IsSolidPart);
  const std::vector<Vec3> directions = Directions();
  for (const Viewer& viewer : viewers) {
    const Vec3 from_W_m = viewer.X_WS.translation();
    std::vector<Sighting::Line> lines;
    for (const Vec3& d_W : directions)
      lines.push_back({from_W_m, from_W_m + kFarthestPart_m * d_W});
    std::map<std::uint16_t, Evidence> of_parts;
    for (const auto& crossings : sighting.CrossingsOf(lines)) Count(crossings, is_part, &of_parts);
    for (const auto& [instance, part] : of_parts) {
      if (part.inside <= kTriedDirections / 2 || part.nearest_m < kLeastDepth_m) continue;
      Keep({viewer.name, sighting.NameOf({instance}), part.nearest_m});
    }
  }
}

void MountCheck::Keep(const BuriedMount& found) {
  for (BuriedMount& known : buried_) {
    if (known.viewer != found.viewer || known.part != found.part) continue;
    known.depth_m = std::max(known.depth_m, found.depth_m);
    return;
  }
  buried_.push_back(found);
}

std::vector<std::string> MountCheck::Warnings() const {
  std::vector<std::string> warnings;
  for (const BuriedMount& mount : buried_) {
    warnings.push_back(
        fmt::format("{}: its mount lies {:.2f} m inside {}, and it sees nothing else; move its "
                    "xyz_m into free air, or correct the mesh",
                    mount.viewer, mount.depth_m, mount.part));
  }
  return warnings;
}

}  // namespace tera
