#pragma once

#include <optional>
#include <vector>

#include "core/types/ground_tools.h"

namespace tera {

/// Cross-section of a shovel: the region between its profile and its mouth.
///
/// Frames  B's x-z plane, as in Shovel. mouth_normal_B and the outward normal of each segment point
///         out of the region.
/// Model   Soil is held behind the edge. Between the teeth it falls through. It is heaped at the
///         angle of repose from both lips and, over the mouth, from the tops of the side walls. The
///         struck volume is the capacity.
class ShovelShape {
 public:
  explicit ShovelShape(const Shovel& shovel);

  /// Intersection of a vertical line with the extruded region.
  struct Crossing {
    double low_m = 0, high_m = 0;  ///< z in W
    bool through_mouth = false;    ///< the lower end lies on the mouth
    Vec3 low_normal_B = Vec3::Zero();
  };
  /// A vertical line of W, in B: p_B(z) = o_B + z u_B, with z in W.
  struct Upright {
    Vec3 o_B, u_B;
    double from_m, to_m;  ///< range of z between the side walls
    bool is_beside() const { return to_m < from_m; }
    std::optional<double> Crosses_m(const Vec2& a, const Vec2& d) const;
  };
  /// Makes vertical lines through positions of the ground.
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

  /// Lowest z in W of the shell on a line. The shell has the thickness `behind_B`, a vector in B's
  /// x-z plane. Empty if the line misses the shell.
  std::optional<double> LowestOfShell(const Upright& line, const Vec2& behind_B) const;

  /// Height (z in W) at which the cutting edge crossed the line within the last step. `came_B` is
  /// the displacement of the edge in this step, in B's x-z plane. Empty if the edge did not cross
  /// the line.
  std::optional<double> HeightOfPassedEdge(const Upright& line, const Vec2& came_B) const;

  /// Soil that the shovel holds for a direction `up_B` against gravity.
  struct Hold {
    double volume_m3 = 0;         ///< greatest volume, heaped at `repose_rad`
    Vec3 com_B_m = Vec3::Zero();  ///< centre of the requested volume
  };
  /// Computes the greatest volume that the shovel holds, and the centre of a load of `volume_m3`
  /// (at most the greatest volume). The surface of this load is a plane with the normal
  /// `surface_up_B`.
  Hold HoldFor(const Vec3& up_B, double repose_rad, double volume_m3,
               const Vec3& surface_up_B) const;
  /// The same with a surface perpendicular to `up_B`.
  Hold HoldFor(const Vec3& up_B, double repose_rad, double volume_m3) const {
    return HoldFor(up_B, repose_rad, volume_m3, up_B);
  }

  /// Middle of the lip over which soil leaves when `up_B` is up.
  Vec3 LowerLip_B(const Vec3& up_B) const;
  /// True if that lip is the one at the cutting edge.
  bool IsOverEdge(const Vec3& up_B) const;
  /// Direction in B that is vertical when both lips are level.
  Vec3 LevelUp_B() const;
  const Vec3& mouth_normal_B() const { return mouth_normal_B_; }
  /// Direction from the floor to the edge, in which the edge cuts.
  Vec3 edge_direction_B() const;
  Vec3 edge_B() const;
  /// Outline of the held soil: the profile behind the teeth, closed by the mouth; (x, z) in B.
  const std::vector<Vec2>& held_B() const { return held_; }
  double half_width_m() const { return half_width_m_; }
  Vec3 top_edge_B() const;
  double inside_m2() const { return inside_m2_; }  ///< area of the shell in contact with soil
  double radius_m() const { return radius_m_; }  ///< radius of the bounding sphere about B's origin

  /// Part of the outline, in B's x-z plane.
  struct Segment {
    Vec2 a, b, outward;
  };
  /// The last segment is the mouth.
  const std::vector<Segment>& segments() const { return segments_; }
  /// Extent of the outline along the horizontal direction in B's x-z plane.
  struct LevelExtent {
    Vec2 right, up;  ///< axes of the extent
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
