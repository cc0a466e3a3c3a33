#include "render/meshes/weld.h"

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace tera {
namespace {

using PlaceBits = std::array<std::uint32_t, 3>;
using Triangle = std::array<std::uint32_t, 3>;

PlaceBits BitsOf(const Eigen::Vector3f& p) {
  return {std::bit_cast<std::uint32_t>(p.x()), std::bit_cast<std::uint32_t>(p.y()),
          std::bit_cast<std::uint32_t>(p.z())};
}

struct HashOfBits {
  std::size_t operator()(const PlaceBits& bits) const {
    std::size_t hash = 0;
    for (const std::uint32_t word : bits) hash = (hash ^ word) * 1099511628211ull;  // FNV prime
    return hash;
  }
};

std::vector<Triangle> TrianglesOf(const std::vector<const MeshPart*>& parts,
                                  std::vector<Eigen::Vector3f>* positions_m) {
  std::unordered_map<PlaceBits, std::uint32_t, HashOfBits> known;
  std::vector<Triangle> triangles;
  for (const MeshPart* part : parts) {
    std::vector<std::uint32_t> place_of;
    for (const Eigen::Vector3f& p_m : part->positions_m) {
      const auto next = static_cast<std::uint32_t>(positions_m->size());
      const auto [entry, is_new] = known.try_emplace(BitsOf(p_m), next);
      if (is_new) positions_m->push_back(p_m);
      place_of.push_back(entry->second);
    }
    for (std::size_t k = 0; k + 2 < part->indices.size(); k += 3) {
      const Triangle t = {place_of[part->indices[k]], place_of[part->indices[k + 1]],
                          place_of[part->indices[k + 2]]};
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) triangles.push_back(t);
    }
  }
  return triangles;
}

/// Disjoint sets of connected corners (union-find). Each surface is named by one of its corners.
class Surfaces {
 public:
  explicit Surfaces(std::size_t corners) : next_(corners) {
    std::iota(next_.begin(), next_.end(), 0u);
  }
  std::uint32_t Of(std::uint32_t corner) {
    while (next_[corner] != corner) corner = next_[corner] = next_[next_[corner]];
    return corner;
  }
  void Join(std::uint32_t a, std::uint32_t b) { next_[Of(a)] = Of(b); }

 private:
  std::vector<std::uint32_t> next_;
};

/// For each corner that names a surface: whether that surface is closed.
std::vector<bool> AreClosed(const std::vector<Triangle>& triangles,
                            const std::vector<Eigen::Vector3f>& positions_m, Surfaces* surfaces) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int>
      balance;  // traversals from the lower corner minus those from the higher one
  std::vector<double> volume_m3(positions_m.size(), 0);
  for (const Triangle& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      balance[std::minmax(a, b)] += a < b ? 1 : -1;
    }
    const Vec3 a = positions_m[t[0]].cast<double>(), b = positions_m[t[1]].cast<double>(),
               c = positions_m[t[2]].cast<double>();
    volume_m3[surfaces->Of(t[0])] += a.dot(b.cross(c)) / 6;
  }
  std::vector<bool> closed(positions_m.size());
  for (std::size_t i = 0; i < closed.size(); ++i) closed[i] = volume_m3[i] > 0;
  for (const auto& [edge, passes] : balance) {
    if (passes != 0) closed[surfaces->Of(edge.first)] = false;
  }
  return closed;
}

}  // namespace

Welded Weld(const std::vector<const MeshPart*>& parts) {
  Welded welded;
  const std::vector<Triangle> triangles = TrianglesOf(parts, &welded.positions_m);
  Surfaces surfaces(welded.positions_m.size());
  for (const Triangle& t : triangles) {
    surfaces.Join(t[0], t[1]);
    surfaces.Join(t[1], t[2]);
  }
  const std::vector<bool> closed = AreClosed(triangles, welded.positions_m, &surfaces);
  for (const bool wanted : {true, false}) {
    for (const Triangle& t : triangles) {
      if (closed[surfaces.Of(t[0])] != wanted) continue;
      welded.indices.insert(welded.indices.end(), t.begin(), t.end());
    }
    if (wanted) welded.closed = welded.indices.size();
  }
  return welded;
}

}  // namespace tera
