#pragma once

#include <cstdint>
#include <vector>

namespace tera {

/// Moving soil of one kind: its mass and its volume.
struct Spoil {
  double mass_kg = 0;
  double volume_m3 = 0;
  std::uint8_t soil = 0;  ///< index into the soil kinds of the site
  float moisture = 0;     ///< degree of saturation, 0..1

  /// Adds soil of the same kind.
  void Add(const Spoil& other);
  /// Removes the share `f` in [0, 1] and returns it.
  Spoil Take(double f);
};

/// Moving soil of several kinds, each kind listed once.
class SpoilMix {
 public:
  void Add(const Spoil& spoil);
  void Add(const SpoilMix& other);
  /// Removes the share `f` in [0, 1] of every kind and returns it.
  SpoilMix Take(double f);
  void clear() { parts_.clear(); }
  bool empty() const { return parts_.empty(); }
  double mass_kg() const;
  double volume_m3() const;
  /// Kind with the greatest mass; 0 if empty.
  std::uint8_t main_soil() const;
  /// Sorted by the index of the kind.
  const std::vector<Spoil>& parts() const { return parts_; }

 private:
  std::vector<Spoil> parts_;
};

}  // namespace tera
