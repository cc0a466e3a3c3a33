#pragma once

#include <optional>
#include <vector>

#include "core/types/ground_tools.h"

namespace tera {

/// Cross-section of a shovel: the region between its profile and its mouth.
///
/// Frames  B's x-z plane, as in Shovel; mouth_normal_B and each segment's outward normal point out
///         of the region.
/// Model   It holds soil behind the edge, not on the teeth, between which soil falls. Soil is
///         heaped at the angle of repose from both lips and, over the mouth, from the tops of the
///         side walls. Its struck volume is the capacity.
class ShovelShape {
 public:
  explicit ShovelShape(const Shovel& shovel);

  /// Where the vertical line through a point meets the extruded region.
  struct Crossing {
    double low_m = 0, high_m = 0;  ///< z in W
    bool through_mouth = false;    ///< the lower end lies on the mouth
    Vec3 low_normal_B = Vec3::Zero();
  };
  /// An upright line of W in B: p_B(z) = o_B + z u_B, z in W.
  struct Upright {
    Vec3 o_B, u_B;
    double from_m, to_m;  ///< z between the side walls
    bool is_beside() const { return to_m < from_m; }
    std::optional<double> Crosses_m(const Vec2& a, const Vec2& d) const;
  };
  /// Upright lines through places of the ground.
  class Uprights {
   public:
    Uprights(const ShovelShape& shape, const Pose& X_WB);
    Upright At(double x_m, double y_m) const;

   private:
    Mat3 R_BW_;
    Vec3 p_WB_m_;
    double half_width_m_;
  };
  std::optional<Crossing> VerticalCrossing(const Upright& line) const;

  /// Lowest z in W of the shell over a place, where the shell is as thick as `behind_B`, a vector
  /// in B's x-z plane, reaches from it. Nothing where no shell is.
  std::optional<double> LowestOfShell(const Upright& line, const Vec2& behind_B) const;

  /// z in W of the edge where it has passed over a place, on its way from `came_B` behind it in B's
  /// x-z plane.
  std::optional<double> HeightOfPassedEdge(const Upright& line, const Vec2& came_B) const;

  /// Soil that the shovel holds when gravity's up direction is `up_B`.
  struct Hold {
    double volume_m3 = 0;         ///< at most, heaped at `repose_rad`
    Vec3 com_B_m = Vec3::Zero();  ///< of the volume asked for
  };
  /// Largest volume, and the centre of `volume_m3` (or of the largest, where that is less) below a
  /// plane with this normal.
  Hold HoldFor(const Vec3& up_B, double repose_rad, double volume_m3,
               const Vec3& surface_up_B) const;
  /// The same below a level plane.
  Hold HoldFor(const Vec3& up_B, double repose_rad, double volume_m3) const {
    return HoldFor(up_B, repose_rad, volume_m3, up_B);
  }

  /// Middle of the lip that soil leaves over when `up_B` is up.
  Vec3 LowerLip_B(const Vec3& up_B) const;
  /// Whether that is the lip behind the cutting edge.
  bool IsOverEdge(const Vec3& up_B) const;
  /// The up direction in which the lips that hold soil stand level.
  Vec3 LevelUp_B() const;
  const Vec3& mouth_normal_B() const { return mouth_normal_B_; }
  /// Direction from the floor to the edge, the way the edge cuts.
  Vec3 edge_direction_B() const;
  Vec3 edge_B() const;
  /// Outline of the soil held: the profile behind the teeth, closed by the mouth; (x, z) in B.
  const std::vector<Vec2>& held_B() const { return held_; }
  double half_width_m() const { return half_width_m_; }
  Vec3 top_edge_B() const;
  double inside_m2() const { return inside_m2_; }  ///< of the shell where soil lies
  double radius_m() const { return radius_m_; }    ///< of a sphere about B's origin that holds it

  /// Part of the outline, in B's x-z plane.
  struct Segment {
    Vec2 a, b, outward;
  };
  /// The last one is the mouth.
  const std::vector<Segment>& segments() const { return segments_; }
  /// Extent of the outline along the level direction in B's x-z plane.
  struct LevelExtent {
    Vec2 right, up;  ///< axes
    double from_m, to_m;
  };
  LevelExtent ExtentAcross(const Vec3& up_B) const;

 private:
  struct Heap;
  Heap FullestHeap(const Vec3& up_B, double repose_rad) const;

  std::vector<Vec2> profile_;
  std::vector<Vec2> held_;  ///< behind the teeth
  std::vector<Segment> segments_;
  double half_width_m_ = 0;
  double capacity_m3_ = 0;
  double held_area_m2_ = 0;
  double inside_m2_ = 0;
  double radius_m_ = 0;
  Vec3 mouth_normal_B_ = Vec3::Zero();
};

}  // namespace tera
