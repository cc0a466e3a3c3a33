#include "physics/dynamics/box_distance.h"

#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include <algorithm>

#include "core/check.h"
#include "physics/dynamics/bullet_types.h"

namespace tera {
namespace {

/// Bullet rounds corners by its margin.
constexpr double kMargin_m = 5e-4;

btBoxShape ShapeOf(const CollisionBox& box) {
  btBoxShape shape(ToBullet(Vec3(0.5 * box.size_m)));
  shape.setMargin(kMargin_m);
  return shape;
}

}  // namespace

double BoxDistance_m(const CollisionBox& a, const Pose& X_WA, const CollisionBox& b,
                     const Pose& X_WB) {
  const btBoxShape shape_a = ShapeOf(a), shape_b = ShapeOf(b);
  btVoronoiSimplexSolver simplex;
  btGjkEpaPenetrationDepthSolver depth;
  btGjkPairDetector detector(&shape_a, &shape_b, &simplex, &depth);
  btGjkPairDetector::ClosestPointInput input;
  input.m_transformA = ToBullet(Pose(X_WA * a.X_BG));
  input.m_transformB = ToBullet(Pose(X_WB * b.X_BG));
  btPointCollector closest;
  detector.getClosestPoints(input, closest, nullptr);
  TERA_CHECK(closest.m_hasResult, a.size_m.norm(), b.size_m.norm());
  return std::max(0.0, static_cast<double>(closest.m_distance));
}

}  // namespace tera
