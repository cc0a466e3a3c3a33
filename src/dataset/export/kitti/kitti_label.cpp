#include "dataset/export/kitti/kitti_label.h"

#include <fmt/format.h>

#include <cmath>

#include "core/units.h"

namespace tera {
namespace {

/// KITTI defines its levels of occlusion and truncation only in words. These bounds are used: up to
/// 10 % hidden is "fully visible", up to 50 % is "partly occluded". The truncation bounds 15 % and
/// 50 % are those of the difficulties "easy" and "hard" of the object benchmark.
constexpr double kFullyVisible = 0.9, kPartlyVisible = 0.5;
constexpr double kWithin = 0.15, kPartlyWithin = 0.5;

std::string TypeOf(SemanticClass label) {
  if (label == SemanticClass::kPerson) return "Pedestrian";
  if (label == SemanticClass::kTruck) return "Truck";
  return std::string(NameOf(label));
}

double Wrapped(double angle_rad) { return std::remainder(angle_rad, 2 * kPi); }

/// Estimated from a uniform grid of points in the box.
double TruncatedShare(const ObjectBox& box, const CameraLens& lens) {
  constexpr int kPoints = 16;  // along each edge
  const auto at = [](int k) { return (k + 0.5) / kPoints - 0.5; };
  int outside = 0;
  for (int i = 0; i < kPoints; ++i) {
    for (int j = 0; j < kPoints; ++j) {
      for (int k = 0; k < kPoints; ++k) {
        const Vec3 p = box.X_CO * box.size_O_m.cwiseProduct(Vec3(at(i), at(j), at(k)));
        const double u_px = lens.fx_px * p.x() / p.z() + lens.cx_px;
        const double v_px = lens.fy_px * p.y() / p.z() + lens.cy_px;
        const bool inside = p.z() > 0 && u_px >= -0.5 && u_px < lens.width_px - 0.5 &&
                            v_px >= -0.5 && v_px < lens.height_px - 0.5;
        if (!inside) ++outside;
      }
    }
  }
  return static_cast<double>(outside) / (kPoints * kPoints * kPoints);
}

KittiLabel ObjectLabel(const ObjectBox& box, const PixelBounds& bounds, const CameraLens& lens) {
  KittiLabel label;
  label.instance = box.instance;
  label.type = TypeOf(box.label);
  label.truncated = TruncatedShare(box, lens);
  label.visibility = box.visibility;
  label.bounds = bounds;
  label.length_m = box.size_O_m.x();
  label.width_m = box.size_O_m.y();
  label.height_m = box.size_O_m.z();
  label.location_C_m = box.X_CO * Vec3(0, 0, -0.5 * label.height_m);
  const Vec3 forward_C = box.X_CO.linear().col(0);
  label.rotation_y_rad = std::atan2(0.0 - forward_C.z(), forward_C.x());
  label.alpha_rad =
      Wrapped(label.rotation_y_rad - std::atan2(label.location_C_m.x(), label.location_C_m.z()));
  return label;
}

int Level(double share, double first, double second) {
  return share <= first ? 0 : share <= second ? 1 : 2;
}

int OccludedLevel(const KittiLabel& label) {
  return Level(1 - label.visibility, 1 - kFullyVisible, 1 - kPartlyVisible);
}

std::string BoundsText(const PixelBounds& b) {
  return fmt::format("{:.2f} {:.2f} {:.2f} {:.2f}", static_cast<double>(b.x_min_px),
                     static_cast<double>(b.y_min_px), static_cast<double>(b.x_max_px),
                     static_cast<double>(b.y_max_px));
}

std::string PlaceText(const KittiLabel& label) {
  const Vec3& p = label.location_C_m;
  return fmt::format("{:.4f} {:.4f} {:.4f} {:.4f} {:.4f} {:.4f} {:.6f}", label.height_m,
                     label.width_m, label.length_m, p.x(), p.y(), p.z(), label.rotation_y_rad);
}

/// Values of the development kits for regions: unknown state, size and position.
std::string RegionText(const KittiLabel& label) {
  return fmt::format("DontCare -1 -1 -10 {} -1 -1 -1 -1000 -1000 -1000 -10\n",
                     BoundsText(label.bounds));
}

}  // namespace

std::vector<KittiLabel> KittiLabels(const std::vector<ObjectBox>& boxes,
                                    const std::map<std::uint16_t, ObjectMask>& masks,
                                    const CameraLens& lens, const std::string& own_machine) {
  std::vector<KittiLabel> labels;
  for (const ObjectBox& box : boxes) {
    const auto mask = masks.find(box.instance);
    if (box.parent != 0 || mask == masks.end()) continue;
    if (box.name == own_machine || box.name.starts_with(own_machine + "/")) {
      KittiLabel region;
      region.is_region = true;
      region.bounds = mask->second.bounds;
      labels.push_back(region);
    } else {
      labels.push_back(ObjectLabel(box, mask->second.bounds, lens));
    }
  }
  return labels;
}

std::string ObjectLine(const KittiLabel& label) {
  if (label.is_region) return RegionText(label);
  return fmt::format("{} {:.4f} {} {:.6f} {} {}\n", label.type, label.truncated,
                     OccludedLevel(label), label.alpha_rad, BoundsText(label.bounds),
                     PlaceText(label));
}

std::string TrackLine(int frame, const KittiLabel& label) {
  if (label.is_region) return fmt::format("{} -1 {}", frame, RegionText(label));
  return fmt::format("{} {} {} {} {} {:.6f} {} {}\n", frame, label.instance, label.type,
                     Level(label.truncated, kWithin, kPartlyWithin), OccludedLevel(label),
                     label.alpha_rad, BoundsText(label.bounds), PlaceText(label));
}

}  // namespace tera
