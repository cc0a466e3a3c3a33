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
/// Model   A clod falls freely; one of a bank that fails first slides down with it as one block,
///         and swells on that way. At the ground it loses its velocity into the
///         surface and, by Coulomb friction, as much of that along it; it slides on while the
///         surface is steeper than friction holds. A wall stops its travel: it is not lifted over
///         an edge. Loose soil takes in poured soil where they meet. Soil that lies too steep then
///         flows as in Avalanche. Pieces of a bank slide on over it. Where soil comes to lie under
///         one that slides, it pays with its motion for being lifted, or is buried. Otherwise, at
///         rest, or when it has slid for kLongestSlide_s, it becomes loose soil of the columns
///         around, or of the bed over which it is. There are never more than kMostClods: clods are
///         larger while many are under way. Further poured soil lies in the column below at once.
///         Clods neither touch each other nor machines: they exert no force.
/// Omits   collisions between clods, bouncing, drag of the air, the push that a clod gives the soil
///         that takes it in.
class Grains {
 public:
  static constexpr std::size_t kMostClods = 20000;

  /// `seed` scatters clods along the line that they leave from.
  Grains(const std::vector<SoilType>& soils, std::uint64_t seed);

  /// Volume of the clods that are made now.
  double clod_m3() const;
  /// Volume of each clod so that soil of a volume finds room as clods.
  double RoomyClod_m3(double volume_m3) const;
  /// Lets soil go with a velocity, from places on the line between two points.
  void Pour(const SpoilMix& spoil, const Vec3& from_W_m, const Vec3& to_W_m, const Vec3& v_W_mps,
            Columns* ground);
  /// Lets a part of a bank go from rest, from places on the line between two points, in clods of at
  /// least a volume. It first goes `way_m` with the bank, speeding up by `slide_W_mps2`.
  struct Broken {
    SpoilMix soil;
    Vec3 low_W_m, high_W_m;
    Vec3 slide_W_mps2;
    double way_m;
  };
  void Pour(const Broken& broken, double least_m3, Columns* ground);
  void Step(double dt_s, Columns* ground);

  std::vector<Bed>& beds() { return beds_; }
  const std::vector<Bed>& beds() const { return beds_; }

  std::size_t count() const { return grains_.size(); }
  double mass_kg() const;

 private:
  enum class Kind : std::uint8_t {
    kLoose,  ///< poured
    kFirm    ///< pieces of a bank that fails
  };
  struct Grain {
    Vec3 p_W_m, v_W_mps;
    Spoil spoil;
    std::uint16_t number;
    float radius_m;
    Kind kind;
    double slid_s = 0;
    Eigen::Vector3f slide_W_mps2 = Eigen::Vector3f::Zero();  ///< with the bank that it is of
    float way_m = 0, of_way_m = 0;  ///< way left to go with the bank, and all of it
    bool is_free = true;            ///< no longer goes with it
  };
  /// Lets soil go from between two points, each clod otherwise like `like`.
  void Pour(const SpoilMix& spoil, const Vec3& from_W_m, const Vec3& to_W_m, double each_m3,
            const Grain& like, Columns* ground);
  Spoil Loosened(const Grain& grain) const;
  static bool GoesWithBank(double dt_s, const Columns& ground, Grain* grain);
  static bool RisesWithGround(const Columns& ground, Grain* grain);
  /// Whether it has come to rest on ground in whose frame gravity acts against `up`.
  bool Move(double dt_s, const Vec3& up, const Columns& ground, Grain* grain) const;
  bool MoveInBed(double dt_s, const Bed& bed, Grain* grain) const;
  /// Bed over whose floor a point is, or null.
  Bed* BedAt(const Vec3& p_W_m);
  void LayDown(const Vec3& p_W_m, const Spoil& spoil, Kind kind, Columns* ground);
  void Show(Columns* ground) const;

  std::vector<double> friction_, bank_kgpm3_;  ///< of each soil
  Stream scatter_;
  std::uint64_t poured_ = 0;  ///< clods so far
  std::vector<Grain> grains_;
  std::vector<Bed> beds_;
};

}  // namespace tera
