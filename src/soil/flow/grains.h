#pragma once

#include <cstdint>
#include <vector>

#include "core/random.h"
#include "soil/columns/bed.h"
#include "soil/columns/columns.h"
#include "soil/columns/spoil.h"

namespace tera {

/// Soil in the air and on its way down slopes, as clods that each stand for a small volume, and the
/// beds that it may fall into.
///
/// Frames  W.
/// Model   A clod falls freely. Where it meets the ground it loses its velocity into the surface
///         and, by Coulomb friction, as much of that along it; it slides on while the surface is
///         steeper than friction holds. A wall stops its travel: it is not lifted over an edge.
///         Loose soil takes in what was poured where it meets it: what lies too steep then flows as
///         Avalanche says; pieces of a bank slide on over it. Otherwise, at rest, or when it has
///         slid for kLongestSlide_s, it becomes loose soil of the columns around, or of the bed
///         over which it is. There are never more than kMostClods: clods are larger while many are
///         under way, and what more is poured lies in the column below at once. Clods neither touch
///         each other nor machines: they exert no force.
/// Omits   collisions between clods, bouncing, drag of the air, the push that a clod gives the soil
///         that takes it in.
class Grains {
 public:
  static constexpr std::size_t kMostClods = 20000;

  enum class Kind : std::uint8_t {
    kLoose,  ///< poured
    kFirm    ///< pieces of a bank that fails
  };

  /// `seed` scatters clods along the line that they leave from.
  Grains(const std::vector<SoilType>& soils, std::uint64_t seed);

  /// Volume of the clods that are made now.
  double clod_m3() const;
  /// Lets soil go with a velocity, from places on the line between two points.
  void Pour(const SpoilMix& spoil, const Vec3& from_W_m, const Vec3& to_W_m, const Vec3& v_W_mps,
            Columns* ground, Kind kind = Kind::kLoose);
  void Step(double dt_s, Columns* ground);

  std::vector<Bed>& beds() { return beds_; }
  const std::vector<Bed>& beds() const { return beds_; }

  std::size_t count() const { return grains_.size(); }
  /// Whether what can wait should not be poured now.
  bool is_crowded() const { return count() > kMostClods / 10 * 9; }
  double mass_kg() const;

 private:
  struct Grain {
    Vec3 p_W_m, v_W_mps;
    Spoil spoil;
    std::uint16_t number;
    float radius_m;
    Kind kind;
    double slid_s = 0;
  };
  /// Whether it has come to rest.
  bool Move(double dt_s, const Columns& ground, Grain* grain) const;
  bool MoveInBed(double dt_s, const Bed& bed, Grain* grain) const;
  /// Bed over whose floor a point is, or null.
  Bed* BedAt(const Vec3& p_W_m);
  void LayDown(const Vec3& p_W_m, const Spoil& spoil, Kind kind, Columns* ground);
  void Show(Columns* ground) const;

  std::vector<double> friction_;  ///< of each soil
  Stream scatter_;
  std::uint64_t poured_ = 0;  ///< clods so far
  std::vector<Grain> grains_;
  std::vector<Bed> beds_;
};

}  // namespace tera
