#include "render/gl/passes/sky.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "render/ground/ground_cover.h"
#include "render/ground/lattice_noise.h"

namespace tera {
namespace {

constexpr double kMinSunHeight_rad = 2.0 * kDeg;
constexpr double kGroundAlbedo = 0.22;  // albedo of the ground that lights surfaces from below
// Haze in the sky. Its density falls exponentially with this scale height. Its extinction is a
// fraction of the fog's, because fog lies lower. kHazeHorizon keeps the path along the horizon
// finite.
constexpr double kHazeScaleHeight_m = 1200.0;
constexpr double kHazeShare = 0.02;
constexpr double kHazeHorizon = 0.004;
// Thin clouds: noise on a horizontal plane above the viewer.
constexpr float kCloudCover = 0.5f;     // noise above this value is cloud
constexpr float kCloudEdge = 0.25f;     // noise range from clear to full opacity
constexpr float kCloudOpacity = 0.75f;  // opacity of the densest cloud
constexpr double kCloudScale = 0.16;    // noise periods per tangent of the zenith angle
// Added to the sine of elevation: limits the compression of the noise near the horizon.
constexpr double kCloudHorizon = 0.12;
constexpr double kCloudStretch = 0.6;  // along y
constexpr double kCloudFade = 6;  // clouds fade in over the sine of elevation from 0 to 1 / this
const Vec2 kCloudOffset(0.31, 0.67);  // selects a suitable part of the noise
constexpr float kCloudSun = 0.22f;    // radiance of clouds: this fraction of the sun's illuminance
// Radiance of clouds: plus this fraction of the zenith's radiance.
constexpr float kCloudZenith = 0.5f;
// Clouds of a given cover:
constexpr float kGivenEdge = 0.08f;           // noise range from clear to full opacity
constexpr float kGivenContrast = 0.5f;        // contrast of luminance by the noise
constexpr float kOvercastHorizon = 1 / 3.0f;  // fraction of the zenith's luminance

/// Perez's sky pattern with five coefficients, which are linear in turbidity.
struct Perez {
  double a, b, c, d, e;

  double operator()(double cos_theta, double gamma_rad) const {
    const double cos_gamma = std::cos(gamma_rad);
    return (1 + a * std::exp(b / cos_theta)) *
           (1 + c * std::exp(d * gamma_rad) + e * cos_gamma * cos_gamma);
  }
};

Perez LuminanceShape(double t) {
  return {0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251, 0.1206 * t - 2.5771,
          -0.0670 * t + 0.3703};
}
Perez ChromaXShape(double t) {
  return {-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125, -0.0641 * t - 0.8989,
          -0.0033 * t + 0.0452};
}
Perez ChromaYShape(double t) {
  return {-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102, -0.0441 * t - 1.6537,
          -0.0109 * t + 0.0529};
}

/// Luminance (kcd/m2) and chromaticity at the zenith.
Vec3 ZenithYxy(double t, double sun_zenith_rad) {
  const double s = sun_zenith_rad;
  const double chi = (4.0 / 9.0 - t / 120.0) * (kPi - 2 * s);
  const Eigen::Vector4d powers(s * s * s, s * s, s, 1);
  Eigen::Matrix<double, 3, 4> mx, my;
  mx << 0.00166, -0.00375, 0.00209, 0, -0.02903, 0.06377, -0.03202, 0.00394, 0.11693, -0.21196,
      0.06052, 0.25886;
  my << 0.00275, -0.00610, 0.00317, 0, -0.04214, 0.08970, -0.04153, 0.00516, 0.15346, -0.26756,
      0.06670, 0.26688;
  const Vec3 turbidity(t * t, t, 1);
  return {(4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192, turbidity.dot(mx * powers),
          turbidity.dot(my * powers)};
}

/// Linear sRGB (Rec. 709 primaries, D65) from luminance and chromaticity.
Eigen::Vector3f RgbFromYxy(double luminance, double x, double y) {
  const Vec3 xyz(luminance * x / y, luminance, luminance * (1 - x - y) / y);
  Mat3 m;
  m << 3.2406, -1.5372, -0.4986, -0.9689, 1.8758, 0.0415, 0.0557, -0.2040, 1.0570;
  return (m * xyz).cwiseMax(0.0).cast<float>();
}

double Luminance(const Vec3& rgb) { return rgb.dot(Vec3(0.2126, 0.7152, 0.0722)); }

/// Colour of sunlight at the ground, with luminance 1.
Vec3 SunColour(double turbidity, double height_rad) {
  const double height_deg = height_rad / kDeg;
  const double air_mass =
      1.0 / (std::sin(height_rad) + 0.50572 * std::pow(height_deg + 6.07995, -1.6364));
  const Vec3 wavelength_um(0.610, 0.550, 0.465);
  const double beta = std::max(0.04608 * turbidity - 0.04586, 0.0);
  Vec3 colour;
  for (int k = 0; k < 3; ++k) {
    const double rayleigh = 0.008735 * std::pow(wavelength_um[k], -4.08);
    const double aerosol = beta * std::pow(wavelength_um[k], -1.3);
    colour[k] = std::exp(-(rayleigh + aerosol) * air_mass);
  }
  return colour / Luminance(colour);
}

Vec3 TexelDirection(int column, int row) {
  const double azimuth_rad = (column + 0.5) / Sky::kWidth * 2 * kPi;
  const double v = (row + 0.5) / Sky::kHeight;
  const double z = v * v, horizontal = std::sqrt(1 - z * z);
  return {horizontal * std::cos(azimuth_rad), horizontal * std::sin(azimuth_rad), z};
}

/// Cloud noise in a direction. It is the same for all skies.
float CloudNoise(const Vec3& d) {
  static const LatticeNoise noise("render/clouds", 8, 6);
  const double reach = kCloudScale / (d.z() + kCloudHorizon);
  return noise.At(kCloudOffset.x() + d.x() * reach,
                  kCloudOffset.y() + d.y() * reach * kCloudStretch);
}

/// Direction and cloud noise of each texel, row by row.
struct TexelNoise {
  Vec3 direction_W;
  float noise;
};
const std::vector<TexelNoise>& TexelNoises() {
  static const std::vector<TexelNoise> noises = [] {
    std::vector<TexelNoise> all;
    all.reserve(static_cast<std::size_t>(Sky::kWidth) * Sky::kHeight);
    for (int row = 0; row < Sky::kHeight; ++row) {
      for (int column = 0; column < Sky::kWidth; ++column) {
        const Vec3 d = TexelDirection(column, row);
        all.push_back({d, CloudNoise(d)});
      }
    }
    return all;
  }();
  return noises;
}

/// Illuminance of level ground by the sky: the integral of radiance times the sine of elevation
/// over the upper hemisphere.
template <typename RadianceOf>
Eigen::Vector3f LevelSum(const RadianceOf& radiance_of) {
  constexpr int kAzimuths = 64, kHeights = 32;
  const float solid = static_cast<float>(2 * kPi / kAzimuths / kHeights);
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (int h = 0; h < kHeights; ++h) {
    const double z = (h + 0.5) / kHeights, r = std::sqrt(1 - z * z);
    for (int a = 0; a < kAzimuths; ++a) {
      const double azimuth_rad = (a + 0.5) * 2 * kPi / kAzimuths;
      const Vec3 d(r * std::cos(azimuth_rad), r * std::sin(azimuth_rad), z);
      sum += radiance_of(d) * (solid * static_cast<float>(z));
    }
  }
  return sum;
}

}  // namespace

Sky::Sky(const Environment& environment)
    : turbidity_(environment.turbidity),
      cloud_cover_(environment.cloud_cover),
      snow_share_(static_cast<float>(SnowShare(environment.weather, TerrainSurface::Cover(), 1))) {
  Vec3 s = environment.to_sun_W.normalized();
  if (s.z() < std::sin(kMinSunHeight_rad)) {
    const double level = s.head<2>().norm();
    const Vec2 side = level > 0 ? Vec2(s.head<2>() / level) : Vec2(1, 0);
    s << side * std::cos(kMinSunHeight_rad), std::sin(kMinSunHeight_rad);
  }
  to_sun_W_ = s.normalized();
  const Vec3 colour = SunColour(turbidity_, std::asin(to_sun_W_.z()));
  sun_lx_ = (colour * environment.sun_illuminance_klx * 1000.0).cast<float>();
  if (environment.sky_illuminance_lx) SetIlluminance(*environment.sky_illuminance_lx);
  if (cloud_cover_) FitClouds(*cloud_cover_);
  const Vec3 near_zenith = Vec3(0.1, 0.1, 1).normalized();
  zenith_ = cloud_cover_ ? CloudySky(near_zenith) : ClearSky(near_zenith);
  FitAirlight();
  Paint(environment.fog_visibility_m);
  ProjectDiffuse();
}

Eigen::Vector3f Sky::ClearSky(const Vec3& direction_W) const {
  constexpr double kLowest = 0.02;  // the model diverges at the horizon
  const double sun_zenith_rad = std::acos(std::clamp(to_sun_W_.z(), -1.0, 1.0));
  const double gamma_rad = std::acos(std::clamp(direction_W.dot(to_sun_W_), -1.0, 1.0));
  const double cos_theta = std::max(direction_W.z(), kLowest);
  const Vec3 zenith = ZenithYxy(turbidity_, sun_zenith_rad);
  const Perez shapes[3] = {LuminanceShape(turbidity_), ChromaXShape(turbidity_),
                           ChromaYShape(turbidity_)};
  Vec3 value;
  for (int k = 0; k < 3; ++k) {
    value[k] = zenith[k] * shapes[k](cos_theta, gamma_rad) / shapes[k](1.0, sun_zenith_rad);
  }
  return sky_scale_ * RgbFromYxy(std::max(value[0], 0.0) * 1000.0, value[1], value[2]);
}

void Sky::SetIlluminance(double level_lx) {
  const auto now_lx = LevelSum([&](const Vec3& d) { return ClearSky(d); });
  sky_scale_ = static_cast<float>(level_lx / Luminance(now_lx.cast<double>()));
}

/// Finds the noise threshold that the fraction `cover` of the sky exceeds, and the luminance of the
/// clouds.
void Sky::FitClouds(double cover) {
  std::vector<float> noise;
  LevelSum([&](const Vec3& d) {
    noise.push_back(CloudNoise(d));
    return Eigen::Vector3f(0, 0, 0);
  });
  std::sort(noise.begin(), noise.end());
  const auto place = static_cast<std::size_t>((1 - cover) * static_cast<double>(noise.size()));
  cloud_threshold_ = cover >= 1   ? noise.front() - 2 * kGivenEdge
                     : cover <= 0 ? noise.back() + 2 * kGivenEdge
                                  : noise[std::min(place, noise.size() - 1)];
  const auto level = [&](const auto& radiance_of) {
    return Luminance(LevelSum(radiance_of).template cast<double>());
  };
  const double clear_lx = level([&](const Vec3& d) { return ClearSky(d); });
  const double gaps_lx =
      level([&](const Vec3& d) -> Eigen::Vector3f { return (1 - CloudShare(d)) * ClearSky(d); });
  cloud_zenith_cdpm2_ = 1;
  const double clouds_lx =
      level([&](const Vec3& d) -> Eigen::Vector3f { return CloudShare(d) * CloudRadiance(d); });
  const double sun_lx = Luminance(sun_lx_.cast<double>()) * to_sun_W_.z();
  const double left = 1 - 0.75 * std::pow(cover, 3.4);
  const double wanted_lx = left * (sun_lx + clear_lx) - (1 - cover) * sun_lx - gaps_lx;
  cloud_zenith_cdpm2_ =
      clouds_lx > 0 ? static_cast<float>(std::max(wanted_lx, 0.0) / clouds_lx) : 0;
  sun_lx_ *= static_cast<float>(1 - cover);
}

float Sky::CloudShare(const Vec3& direction_W) const {
  const float s =
      std::clamp((CloudNoise(direction_W) - cloud_threshold_) / kGivenEdge + 0.5f, 0.0f, 1.0f);
  return s * s * (3 - 2 * s);
}

Eigen::Vector3f Sky::CloudRadiance(const Vec3& direction_W) const {
  const float height = static_cast<float>(std::max(direction_W.z(), 0.0));
  const float pattern = kOvercastHorizon + (1 - kOvercastHorizon) * height;
  const float relief = 1 - kGivenContrast * (CloudNoise(direction_W) - 0.5f);
  return Eigen::Vector3f::Constant(cloud_zenith_cdpm2_ * pattern * relief);
}

Eigen::Vector3f Sky::CloudySky(const Vec3& direction_W) const {
  const float share = CloudShare(direction_W);
  return (1 - share) * ClearSky(direction_W) + share * CloudRadiance(direction_W);
}

/// Fits the airlight by least squares to the clear sky slightly above the horizon. With a cloud
/// cover, blends it with the clouds' luminance there.
void Sky::FitAirlight() {
  constexpr int kSamples = 64;
  constexpr double kHeightAboveHorizon = 0.06;
  const Vec2 sun = to_sun_W_.head<2>().normalized();
  Eigen::Matrix<double, kSamples, 3> basis;
  Eigen::Matrix<double, kSamples, 3> radiance;
  for (int i = 0; i < kSamples; ++i) {
    const double azimuth_rad = 2 * kPi * i / kSamples;
    const Vec2 h(std::cos(azimuth_rad), std::sin(azimuth_rad));
    const double c = to_sun_W_.head<2>().norm() > 0 ? h.dot(sun) : 0.0;
    basis.row(i) << 1, c, c * c;
    radiance.row(i) =
        ClearSky(Vec3(h.x(), h.y(), kHeightAboveHorizon).normalized()).cast<double>().transpose();
  }
  const Mat3 normal = basis.transpose() * basis + 1e-9 * Mat3::Identity();
  const Mat3 fit = normal.ldlt().solve(basis.transpose() * radiance);
  for (int k = 0; k < 3; ++k) airlight_[k] = fit.row(k).transpose().cast<float>();
  if (!cloud_cover_) return;
  const auto cover = static_cast<float>(*cloud_cover_);
  for (Eigen::Vector3f& term : airlight_) term *= 1 - cover;
  airlight_[0] += Eigen::Vector3f::Constant(cover * cloud_zenith_cdpm2_ * kOvercastHorizon);
}

Eigen::Vector3f Sky::Airlight(const Vec3& direction_W) const {
  const Vec2 h = direction_W.head<2>(), sun = to_sun_W_.head<2>();
  const double norm = h.norm() * sun.norm();
  const auto c = static_cast<float>(norm > 0 ? h.dot(sun) / norm : 0.0);
  return (airlight_[0] + airlight_[1] * c + airlight_[2] * c * c).cwiseMax(0.0f);
}

/// The clear sky with thin clouds.
Eigen::Vector3f Sky::ThinClouds(const Vec3& d, float n) const {
  Eigen::Vector3f radiance = ClearSky(d);
  const float cover = std::clamp((n - kCloudCover) / kCloudEdge, 0.0f, 1.0f) * kCloudOpacity;
  const Eigen::Vector3f white = sun_lx_ * kCloudSun + kCloudZenith * zenith_;
  radiance += cover * (white - radiance) * static_cast<float>(std::min(1.0, d.z() * kCloudFade));
  return radiance;
}

void Sky::Paint(double fog_visibility_m) {
  const double extinction_1pm = -std::log(kVisibleContrast) / fog_visibility_m;
  texels_.reserve(TexelNoises().size());
  for (const auto& [d, noise] : TexelNoises()) {
    Eigen::Vector3f radiance = cloud_cover_ ? CloudySky(d) : ThinClouds(d, noise);
    // Optical depth of haze with exponential density: depth at the zenith times the air mass.
    const double haze =
        1 - std::exp(-extinction_1pm * kHazeScaleHeight_m * kHazeShare / (d.z() + kHazeHorizon));
    radiance += static_cast<float>(haze) * (Airlight(d) - radiance);
    texels_.push_back(radiance);
  }
}

Eigen::Vector3f Sky::Radiance(const Vec3& direction_W) const {
  if (direction_W.z() <= 0) return ground_;
  const double azimuth = std::atan2(direction_W.y(), direction_W.x()) / (2 * kPi);
  const int column = static_cast<int>((azimuth - std::floor(azimuth)) * kWidth) % kWidth;
  const int row = std::min(static_cast<int>(std::sqrt(direction_W.z()) * kHeight), kHeight - 1);
  return texels_[static_cast<std::size_t>(row) * kWidth + column];
}

void Sky::ProjectDiffuse() {
  constexpr int kAzimuths = 64, kHeights = 64;
  // The ground reflects the sun and the sky's illuminance of level ground.
  Eigen::Vector3f level = Eigen::Vector3f::Zero();
  const float solid = static_cast<float>(2 * kPi / kAzimuths * 2.0 / kHeights);
  for (int pass = 0; pass < 2; ++pass) {
    for (auto& c : diffuse_) c.setZero();
    if (pass == 1) {
      ground_ = (level + sun_lx_ * static_cast<float>(to_sun_W_.z())) *
                static_cast<float>(kGroundAlbedo / kPi);
      // The ground has the colour of soil, blended with snow.
      ground_ = ground_.cwiseProduct(Eigen::Vector3f(1.2f, 0.98f, 0.78f));
      if (snow_share_ > 0) {
        const Eigen::Vector3f white = (level + sun_lx_ * static_cast<float>(to_sun_W_.z()))
                                          .cwiseProduct((kSnowAlbedo / kPi).cast<float>());
        ground_ += snow_share_ * (white - ground_);
      }
    }
    for (int h = 0; h < kHeights; ++h) {
      const double z = -1 + (h + 0.5) * 2.0 / kHeights;
      for (int a = 0; a < kAzimuths; ++a) {
        const double azimuth_rad = (a + 0.5) * 2 * kPi / kAzimuths, r = std::sqrt(1 - z * z);
        const Vec3 d(r * std::cos(azimuth_rad), r * std::sin(azimuth_rad), z);
        if (pass == 0) {
          if (z > 0) level += Radiance(d) * (solid * static_cast<float>(z));
          continue;
        }
        const Eigen::Vector3f weighted = Radiance(d) * solid;
        const double basis[9] = {0.282095,
                                 0.488603 * d.y(),
                                 0.488603 * d.z(),
                                 0.488603 * d.x(),
                                 1.092548 * d.x() * d.y(),
                                 1.092548 * d.y() * d.z(),
                                 0.315392 * (3 * d.z() * d.z() - 1),
                                 1.092548 * d.x() * d.z(),
                                 0.546274 * (d.x() * d.x() - d.y() * d.y())};
        for (int k = 0; k < 9; ++k) diffuse_[k] += weighted * static_cast<float>(basis[k]);
      }
    }
  }
  // Convolution with the cosine lobe over pi: factors 1, 2/3, 1/4 for bands 0, 1, 2. The scale
  // includes the constants of the basis, so that the shader evaluates plain polynomials.
  const float scale[9] = {0.282095f,         0.488603f * 2 / 3, 0.488603f * 2 / 3,
                          0.488603f * 2 / 3, 1.092548f / 4,     1.092548f / 4,
                          0.315392f / 4,     1.092548f / 4,     0.546274f / 4};
  for (int k = 0; k < 9; ++k) diffuse_[k] *= scale[k];
}

}  // namespace tera
