#include "dataset/compare/ray_pairs.h"

#include <algorithm>
#include <cmath>

#include "core/quantile.h"
#include "core/units.h"
#include "dataset/compare/nearest_points.h"

namespace tera {
namespace {

constexpr float kReach = 0.75F;  ///< fraction of the ray spacing: more than 1/2, the largest offset
                                 ///< of two patterns with different phase, and less than 1, the
                                 ///< distance to the next ray
constexpr double kLoneSpacing_rad = 0.2 * kDeg;  ///< assumed for a scan with a single ray
constexpr std::size_t kMostLooked = 1000;  ///< number of rays from which the spacing is estimated

/// Largest angle between returns of one ray if times and rings do not identify rays, in rad.
constexpr float kSameRay = 1e-4F;

struct Rays {
  std::vector<std::size_t> first;           ///< indices of first returns
  std::vector<Eigen::Vector3f> directions;  ///< unit vectors
  std::vector<Eigen::Vector3f> places;      ///< positions in the search space of NearestPoints
};

/// True if times and rings of the points identify the rays of a scan. Some drivers omit them.
bool TellsPulses(const LidarScan& scan) {
  const auto differs = [&](auto LidarPoint::*member) {
    return std::any_of(scan.points.begin(), scan.points.end(), [&](const LidarPoint& p) {
      return p.*member != scan.points.front().*member;
    });
  };
  return differs(&LidarPoint::time_offset_ns) && differs(&LidarPoint::ring);
}

Rays RaysOf(const LidarScan& scan) {
  Rays rays;
  const bool tells_pulses = TellsPulses(scan);
  for (std::size_t k = 0; k < scan.points.size(); ++k) {
    const LidarPoint& p = scan.points[k];
    const Eigen::Vector3f direction = Eigen::Vector3f(p.x_m, p.y_m, p.z_m).normalized();
    const bool is_next_return =
        k > 0 && p.time_offset_ns == scan.points[k - 1].time_offset_ns &&
        p.ring == scan.points[k - 1].ring &&
        (tells_pulses || (direction - rays.directions.back()).norm() < kSameRay);
    if (is_next_return) continue;
    rays.first.push_back(k);
    rays.directions.push_back(direction);
  }
  return rays;
}

/// Numbering of the beams of a scan.
struct BeamOrder {
  std::uint16_t last = 0;
  bool is_downward = false;
};

BeamOrder OrderOf(const LidarScan& scan, const Rays& rays) {
  BeamOrder order;
  double n = 0, ring_sum = 0, height_sum = 0, product = 0;
  for (std::size_t k = 0; k < rays.first.size(); ++k) {
    const std::uint16_t ring = scan.points[rays.first[k]].ring;
    const double height = static_cast<double>(rays.directions[k].z());
    order.last = std::max(order.last, ring);
    n += 1, ring_sum += ring, height_sum += height, product += ring * height;
  }
  order.is_downward = n * product < ring_sum * height_sum;
  return order;
}

/// Search space for matching within beams: the azimuth on the unit circle, and the beam number as
/// z. Beams are a distance of 1 apart, which exceeds every search radius.
void PlaceByBeam(const LidarScan& scan, Rays* rays) {
  for (std::size_t k = 0; k < rays->first.size(); ++k) {
    const Eigen::Vector3f& d = rays->directions[k];
    const float level = std::max(std::hypot(d.x(), d.y()), 1e-6F);
    rays->places.emplace_back(d.x() / level, d.y() / level,
                              static_cast<float>(scan.points[rays->first[k]].ring));
  }
}

/// Median distance from a ray to its nearest neighbour.
float Spacing(const Rays& rays, const NearestPoints& nearest) {
  std::vector<float> spacings;
  const std::size_t step = 1 + rays.places.size() / kMostLooked;
  for (std::size_t k = 0; k < rays.places.size(); k += step) {
    const std::vector<FoundPoint> found = nearest.Find(rays.places[k], 2);
    if (found.size() == 2) spacings.push_back(found[1].distance_m);
  }
  return spacings.empty() ? static_cast<float>(kLoneSpacing_rad) : Median(std::move(spacings));
}

}  // namespace

std::vector<std::size_t> FirstReturns(const LidarScan& scan) { return RaysOf(scan).first; }

RayPairs PairRays(const LidarScan& a, const LidarScan& b) {
  Rays rays_a = RaysOf(a), rays_b = RaysOf(b);
  const BeamOrder order_a = OrderOf(a, rays_a), order_b = OrderOf(b, rays_b);
  if (order_a.last > 0 && order_a.last == order_b.last &&
      order_a.is_downward == order_b.is_downward) {
    PlaceByBeam(a, &rays_a);
    PlaceByBeam(b, &rays_b);
  } else {
    rays_a.places = rays_a.directions;
    rays_b.places = rays_b.directions;
  }
  const NearestPoints nearest_a(rays_a.places), nearest_b(rays_b.places);
  const float reach = kReach * std::max(Spacing(rays_a, nearest_a), Spacing(rays_b, nearest_b));
  RayPairs pairs;
  for (std::size_t k = 0; k < rays_a.first.size(); ++k) {
    const std::vector<FoundPoint> found = nearest_b.Find(rays_a.places[k], 1);
    if (found.empty() || found[0].distance_m > reach) {
      pairs.only_a.push_back(rays_a.first[k]);
    } else {
      pairs.both.emplace_back(rays_a.first[k], rays_b.first[found[0].index]);
    }
  }
  for (std::size_t k = 0; k < rays_b.first.size(); ++k) {
    const std::vector<FoundPoint> found = nearest_a.Find(rays_b.places[k], 1);
    if (found.empty() || found[0].distance_m > reach) pairs.only_b.push_back(rays_b.first[k]);
  }
  return pairs;
}

}  // namespace tera
