#include "sensors/camera/read_lens.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "core/units.h"
#include "render/gl/angular_lens.h"

namespace tera {
namespace {

constexpr double kMaxSide_px = 16384;
constexpr double kWidestField_deg = 200, kUsualField_deg = 180;

struct Coefficient {
  std::string_view key;
  double CameraIntrinsics::*value;
};

constexpr std::array<Coefficient, 8> kCoefficients = {{{"k1", &CameraIntrinsics::k1},
                                                       {"k2", &CameraIntrinsics::k2},
                                                       {"p1", &CameraIntrinsics::p1},
                                                       {"p2", &CameraIntrinsics::p2},
                                                       {"k3", &CameraIntrinsics::k3},
                                                       {"k4", &CameraIntrinsics::k4},
                                                       {"k5", &CameraIntrinsics::k5},
                                                       {"k6", &CameraIntrinsics::k6}}};

/// A projection law with its coefficients.
struct Law {
  std::string_view name;
  LensKind kind;
  std::vector<std::string_view> keys;
};

const std::array<Law, 4>& Laws() {
  static const std::array<Law, 4> laws = {
      {{"brown_conrady", LensKind::kBrownConrady, {"k1", "k2", "p1", "p2", "k3"}},
       {"rational", LensKind::kRational, {"k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"}},
       {"kannala_brandt", LensKind::kKannalaBrandt, {"k1", "k2", "k3", "k4"}},
       {"f_theta", LensKind::kFTheta, {"k1", "k2", "k3", "k4"}}}};
  return laws;
}

const Law& LawOf(LensKind kind) {
  return *std::find_if(Laws().begin(), Laws().end(),
                       [&](const Law& law) { return law.kind == kind; });
}

void ReadCoefficients(const ConfigMap& config, CameraIntrinsics* lens) {
  const std::string name = config.Choice(
      "lens", {"brown_conrady", "rational", "kannala_brandt", "f_theta"}, "brown_conrady");
  const auto law =
      std::find_if(Laws().begin(), Laws().end(), [&](const Law& l) { return l.name == name; });
  if (law == Laws().end()) return;
  lens->kind = law->kind;
  for (const Coefficient& c : kCoefficients) {
    if (std::ranges::count(law->keys, c.key) == 0) continue;
    lens->*c.value = config.Number(c.key, Any("1"), 0);
  }
}

void ReadFocalLength(const ConfigMap& config, CameraIntrinsics* lens) {
  const double widest_deg = lens->IsAngular() ? kWidestField_deg : 179;
  const Range open_angle = {.min = 0, .max = widest_deg, .min_excluded = true, .unit = "deg"};
  if (const auto fov_deg = config.OptionalNumber("horizontal_fov_deg", open_angle)) {
    if (config.Has("fx_px") || config.Has("fy_px")) {
      config.Fault("horizontal_fov_deg", "given beside fx_px or fy_px; keep one of the two");
    }
    const double half_rad = 0.5 * *fov_deg * kDeg;
    const double rho = lens->IsAngular() ? RadiusAt(*lens, half_rad).rho : std::tan(half_rad);
    if (!(rho > 0)) {
      config.Fault("horizontal_fov_deg",
                   "the lens folds over before it sees that far; need other "
                   "coefficients, or a narrower field");
      return;
    }
    lens->fx_px = 0.5 * lens->width_px / rho;
    lens->fy_px = lens->fx_px;
  } else {
    lens->fx_px = config.Number("fx_px", Positive("px"));
    lens->fy_px = config.Number("fy_px", Positive("px"), lens->fx_px);
  }
}

void CheckFolding(const ConfigMap& config, const CameraIntrinsics& lens) {
  if (!lens.Distorted() || !(lens.fx_px > 0 && lens.fy_px > 0)) return;
  const auto pixel = lens.PixelWithoutRay();
  if (!pixel) return;
  std::string_view key = lens.IsAngular() ? "lens" : "";  // key of the first given coefficient
  for (auto c = kCoefficients.rbegin(); c != kCoefficients.rend(); ++c) {
    if (config.Has(c->key)) key = c->key;
  }
  config.Fault(key, fmt::format("under this distortion pixel ({}, {}) has no ray of its own; need "
                                "coefficients under which every pixel of the {} x {} picture sees "
                                "its own direction{}",
                                pixel->x(), pixel->y(), lens.width_px, lens.height_px,
                                lens.IsAngular() ? ", or a narrower field_of_view_deg" : ""));
}

}  // namespace

CameraIntrinsics ReadLens(const ConfigMap& config) {
  CameraIntrinsics c;
  c.width_px = static_cast<int>(config.Integer("width_px", Between(1, kMaxSide_px, "px")));
  c.height_px = static_cast<int>(config.Integer("height_px", Between(1, kMaxSide_px, "px")));
  ReadCoefficients(config, &c);
  ReadFocalLength(config, &c);
  c.cx_px = config.Number("cx_px", Any("px"), 0.5 * (c.width_px - 1));
  c.cy_px = config.Number("cy_px", Any("px"), 0.5 * (c.height_px - 1));
  if (c.IsAngular()) {
    const Range field = {.min = 0, .max = kWidestField_deg, .min_excluded = true, .unit = "deg"};
    c.field_rad = config.Number("field_of_view_deg", field, kUsualField_deg) * kDeg;
  }
  c.near_m = config.Number("near_m", Positive("m"), c.near_m);
  c.far_m = config.Number("far_m", Positive("m"), c.far_m);
  if (c.far_m <= c.near_m) config.Fault("far_m", "not beyond near_m; need near_m < far_m");
  CheckFolding(config, c);
  if (c.IsAngular() && c.fx_px > 0 && c.fy_px > 0) c.field_rad = FieldInPicture_rad(c);
  return c;
}

std::string_view NameOf(LensKind kind) { return LawOf(kind).name; }

std::string LensYaml(const CameraIntrinsics& c) {
  std::string text = fmt::format(
      "  width_px: {}\n  height_px: {}\n  fx_px: {}\n  fy_px: {}\n  cx_px: {}\n"
      "  cy_px: {}\n",
      c.width_px, c.height_px, c.fx_px, c.fy_px, c.cx_px, c.cy_px);
  const Law& law = LawOf(c.kind);
  if (c.kind != LensKind::kBrownConrady) text += fmt::format("  lens: {}\n", law.name);
  for (const Coefficient& k : kCoefficients) {
    if (std::ranges::count(law.keys, k.key) > 0)
      text += fmt::format("  {}: {}\n", k.key, c.*k.value);
  }
  if (c.IsAngular()) text += fmt::format("  field_of_view_deg: {}\n", c.field_rad / kDeg);
  return text + fmt::format("  near_m: {}\n  far_m: {}\n", c.near_m, c.far_m);
}

}  // namespace tera
