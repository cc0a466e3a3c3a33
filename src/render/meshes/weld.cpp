#include "render/meshes/weld.h"

#include <array>
#include <bit>
#include <cstddef>
#include <unordered_map>

namespace tera {
namespace {

using PlaceBits = std::array<std::uint32_t, 3>;

PlaceBits BitsOf(const Eigen::Vector3f& p) {
  return {std::bit_cast<std::uint32_t>(p.x()), std::bit_cast<std::uint32_t>(p.y()),
          std::bit_cast<std::uint32_t>(p.z())};
}

struct HashOfBits {
  std::size_t operator()(const PlaceBits& bits) const {
    std::size_t hash = 0;
    for (const std::uint32_t word : bits) hash = (hash ^ word) * 1099511628211ull;  // FNV's prime
    return hash;
  }
};

}  // namespace

void Weld(const MeshPart& part, Welded* welded) {
  std::unordered_map<PlaceBits, std::uint32_t, HashOfBits> known;
  std::vector<std::uint32_t> place_of(part.positions_m.size());
  for (std::size_t i = 0; i < place_of.size(); ++i) {
    const auto next = static_cast<std::uint32_t>(welded->positions_m.size());
    const auto [entry, is_new] = known.try_emplace(BitsOf(part.positions_m[i]), next);
    if (is_new) welded->positions_m.push_back(part.positions_m[i]);
    place_of[i] = entry->second;
  }
  for (std::size_t k = 0; k + 2 < part.indices.size(); k += 3) {
    const std::uint32_t a = place_of[part.indices[k]], b = place_of[part.indices[k + 1]],
                        c = place_of[part.indices[k + 2]];
    if (a == b || b == c || c == a) continue;
    welded->indices.insert(welded->indices.end(), {a, b, c});
  }
}

}  // namespace tera
