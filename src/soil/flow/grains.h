#pragma once

#include <cstdint>
#include <vector>

#include "core/random.h"
#include "soil/columns/bed.h"
#include "soil/columns/columns.h"
#include "soil/columns/spoil.h"

namespace tera {

/// Soil in the air and on its way down slopes, as clods of a small volume each, with the beds that
/// receive it.
///
/// Frames  W.
/// Model   A clod falls freely. A clod of a failing bank first slides down with the bank as one
///         block and swells on the way. At the ground, a clod loses its velocity into the surface,
///         and Coulomb friction takes a proportional part of its speed along it. It slides on while
///         the surface is steeper than friction holds. A wall stops it; it is not lifted over an
///         edge. Loose soil absorbs poured clods on contact; soil that lies too steep then flows as
///         in Avalanche. Pieces of a bank slide on over loose soil. Soil that rises under such a
///         piece lifts it at the cost of its kinetic energy, or buries it. A clod at rest becomes
///         loose soil of the columns around it, or of the bed below it. The same happens after a
///         slide of kLongestSlide_s. There are at most kMostClods: clods are larger while many
///         exist, and further soil is laid down at once. Clods exert no forces on each other or on
///         machines.
/// Omits   Collisions between clods, bouncing, air drag, the impact on the soil that absorbs a
///         clod.
class Grains {
 public:
  static constexpr std::size_t kMostClods = 20000;

  /// `seed` drives the scatter of clods.
  Grains(const std::vector<SoilType>& soils, std::uint64_t seed);

  /// Volume of the next clods.
  double clod_m3() const;
  /// Clod volume with which `volume_m3` of soil fits into the remaining number of clods.
  double RoomyClod_m3(double volume_m3) const;
  /// Releases soil with a velocity, at random points on the line between two points.
  void Pour(const SpoilMix& spoil, const Vec3& from_W_m, const Vec3& to_W_m, const Vec3& v_W_mps,
            Columns* ground);
  /// Part of a failed bank, released from rest at random points between two points. It first slides
  /// `way_m` with the bank, accelerated by `slide_W_mps2`.
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
    kLoose,  ///< poured soil
    kFirm    ///< pieces of a failed bank
  };
  struct Grain {
    Vec3 p_W_m, v_W_mps;
    Spoil spoil;
    std::uint16_t number;
    float radius_m;
    Kind kind;
    double slid_s = 0;
    /// acceleration while it slides with its bank
    Eigen::Vector3f slide_W_mps2 = Eigen::Vector3f::Zero();
    float way_m = 0, of_way_m = 0;  ///< remaining and total way with the bank
    bool is_free = true;            ///< moves on its own, not with the bank
  };
  /// Releases soil between two points. All other properties of a clod are those of `like`.
  void Pour(const SpoilMix& spoil, const Vec3& from_W_m, const Vec3& to_W_m, double each_m3,
            const Grain& like, Columns* ground);
  Spoil Loosened(const Grain& grain) const;
  static bool GoesWithBank(double dt_s, const Columns& ground, Grain* grain);
  static bool RisesWithGround(const Columns& ground, Grain* grain);
  /// Moves a clod and returns true if it has come to rest. `up` points against gravity in the frame
  /// of the ground.
  bool Move(double dt_s, const Vec3& up, const Columns& ground, Grain* grain) const;
  bool MoveInBed(double dt_s, const Bed& bed, Grain* grain) const;
  /// The bed that contains the point, or null.
  Bed* BedAt(const Vec3& p_W_m);
  void LayDown(const Vec3& p_W_m, const Spoil& spoil, Kind kind, Columns* ground);
  void Show(Columns* ground) const;

  std::vector<double> friction_, bank_kgpm3_;  ///< one for each soil
  Stream scatter_;
  std::uint64_t poured_ = 0;  ///< number of clods so far
  std::vector<Grain> grains_;
  std::vector<Bed> beds_;
};

}  // namespace tera
