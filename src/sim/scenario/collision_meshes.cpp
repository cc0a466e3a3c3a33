#include "sim/scenario/collision_meshes.h"

#include <limits>

#include "core/error.h"
#include "render/meshes/load_mesh.h"

namespace tera {
namespace {

constexpr double kThinnest_m = 1e-3;

CollisionBox BoxAround(const Mesh& mesh, const CollisionMesh& collision) {
  Vec3 low_m = Vec3::Constant(std::numeric_limits<double>::infinity()), high_m = -low_m;
  for (const MeshPart& part : mesh.parts) {
    for (const Eigen::Vector3f& p : part.positions_m) {
      const Vec3 p_G = collision.scale.cwiseProduct(p.cast<double>());
      low_m = low_m.cwiseMin(p_G);
      high_m = high_m.cwiseMax(p_G);
    }
  }
  return {collision.X_BG * MakePose(0.5 * (low_m + high_m)),
          (high_m - low_m).cwiseMax(kThinnest_m)};
}

}  // namespace

void SetCollisionMeshes(const ConfigMap& config, MachineModel* model) {
  for (Link& link : model->links) {
    for (const CollisionMesh& collision : link.collision_meshes) {
      try {
        link.collision.push_back(BoxAround(LoadMesh(collision.mesh, ""), collision));
      } catch (const InputError& e) {
        config.Fault("urdf", {e.faults().front().kind, e.what(), collision.part + ", collision"});
      }
    }
    link.collision_meshes.clear();
  }
}

}  // namespace tera
