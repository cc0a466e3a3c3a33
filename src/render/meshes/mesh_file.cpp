#include "render/meshes/mesh_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/config/spelling.h"
#include "core/error.h"

namespace tera {

void ComputeNormals(MeshPart* part) {
  part->normals.assign(part->positions_m.size(), Eigen::Vector3f::Zero());
  for (std::size_t t = 0; t + 2 < part->indices.size(); t += 3) {
    const std::uint32_t* i = &part->indices[t];
    const Eigen::Vector3f a = part->positions_m[i[0]];
    const Eigen::Vector3f normal = (part->positions_m[i[1]] - a).cross(part->positions_m[i[2]] - a);
    for (int k = 0; k < 3; ++k) part->normals[i[k]] += normal;
  }
}

void FinishMesh(const std::filesystem::path& file, Mesh* mesh) {
  std::erase_if(mesh->parts, [](const MeshPart& part) { return part.indices.empty(); });
  if (mesh->parts.empty()) {
    throw InputError(file.string(),
                     {FaultKind::kMalformed, "holds no triangles; need at least one"});
  }
  for (MeshPart& part : mesh->parts) {
    const std::uint32_t last = *std::max_element(part.indices.begin(), part.indices.end());
    if (last >= part.positions_m.size() || part.indices.size() % 3 != 0) {
      throw InputError(
          file.string(),
          {FaultKind::kMalformed, fmt::format("a triangle names vertex {} of {}; export it again",
                                              last, part.positions_m.size())});
    }
    for (const Eigen::Vector3f& p : part.positions_m) {
      if (!p.allFinite()) {
        throw InputError(file.string(), {FaultKind::kMalformed,
                                         "a vertex is not a finite number; export it again"});
      }
    }
    if (part.normals.size() != part.positions_m.size()) ComputeNormals(&part);
    for (Eigen::Vector3f& n : part.normals) {
      const float length = n.norm();
      n = length > 0 && std::isfinite(length) ? Eigen::Vector3f(n / length)
                                              : Eigen::Vector3f::UnitZ();
    }
  }
}

std::string NodeHint(const std::string& wanted, const std::vector<std::string>& names) {
  std::vector<std::string> listed;
  for (const std::string& name : names) {
    if (!name.empty()) listed.push_back(name);
  }
  return fmt::format("{}; it has: {}", DidYouMean(wanted, listed), fmt::join(listed, ", "));
}

}  // namespace tera
