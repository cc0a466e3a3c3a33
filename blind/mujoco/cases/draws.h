#pragma once

#include <algorithm>
#include <vector>

#include "core/random.h"

namespace tera::blind::mujoco {

/// Consecutive draws from a stream.
class Draws {
 public:
  explicit Draws(Stream stream) : stream_(stream) {}
  double Between(double low, double high) { return low + (high - low) * stream_.Uniform(next_++); }
  /// Uniform in -size to size.
  double Within(double size) { return Between(-size, size); }
  bool Chance(double share) { return Between(0, 1) < share; }
  double Sign() { return Chance(0.5) ? -1 : 1; }
  std::size_t Below(std::size_t n) {
    return std::min(n - 1, static_cast<std::size_t>(Between(0, static_cast<double>(n))));
  }
  Vec3 Vector(double size) {
    const double x = Within(size), y = Within(size), z = Within(size);
    return {x, y, z};
  }
  template <typename T>
  const T& OneOf(const std::vector<T>& list) {
    return list[Below(list.size())];
  }
  template <typename T>
  void Shuffle(std::vector<T>* list) {
    for (std::size_t k = list->size(); k > 1; --k) std::swap((*list)[k - 1], (*list)[Below(k)]);
  }

 private:
  Stream stream_;
  std::uint64_t next_ = 0;
};

}  // namespace tera::blind::mujoco
