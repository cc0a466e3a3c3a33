#pragma once

#include <cstdint>
#include <vector>

namespace tera {

/// Soil of one kind on the move: a mass, and the volume it takes up.
struct Spoil {
  double mass_kg = 0;
  double volume_m3 = 0;
  std::uint8_t soil = 0;  ///< index into the site's soils
  float moisture = 0;     ///< degree of saturation, 0..1

  /// Takes up more of the same soil.
  void Add(const Spoil& other);
  /// Takes the share `f` in [0, 1] out of this.
  Spoil Take(double f);
};

/// Soils on the move together, each kind once.
class SpoilMix {
 public:
  void Add(const Spoil& spoil);
  void Add(const SpoilMix& other);
  /// Takes the share `f` in [0, 1] out of every kind.
  SpoilMix Take(double f);
  void clear() { parts_.clear(); }
  bool empty() const { return parts_.empty(); }
  double mass_kg() const;
  double volume_m3() const;
  /// The kind with the most mass; the first soil if there is none.
  std::uint8_t main_soil() const;
  /// In the order of the soils' indices.
  const std::vector<Spoil>& parts() const { return parts_; }

 private:
  std::vector<Spoil> parts_;
};

}  // namespace tera
