#include "sensors/camera/optics/soiling.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/units.h"
#include "render/ground/lattice_noise.h"

namespace tera {
namespace {

// standard deviation of the logarithm of sizes
constexpr double kSpeckSpread = 0.6, kDropSpread = 0.45;
constexpr double kSlopeAtRim = 0.8;  // radius of a drop over the radius of its sphere
constexpr double kMostDisc_px = 400;

cv::Mat View(const Image<float>& picture) {
  return {picture.height_px, picture.width_px, CV_32FC(picture.channels),
          const_cast<float*>(picture.data.data())};
}

/// Calls `visit(x, y, from_middle_px)` for the pixels of a square around a spot.
template <typename Visit>
void ForPixelsAbout(const Image<float>& picture, const Vec2& middle_px, double reach_px,
                    const Visit& visit) {
  const int x0 = std::max(static_cast<int>(std::floor(middle_px.x() - reach_px)), 0);
  const int y0 = std::max(static_cast<int>(std::floor(middle_px.y() - reach_px)), 0);
  const int x1 =
      std::min(static_cast<int>(std::ceil(middle_px.x() + reach_px)), picture.width_px - 1);
  const int y1 =
      std::min(static_cast<int>(std::ceil(middle_px.y() + reach_px)), picture.height_px - 1);
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) visit(x, y, Vec2(Vec2(x, y) - middle_px));
  }
}

}  // namespace

Soiling::Soiling(const SoilingModel& model, const CameraIntrinsics& camera, double pupil_mm,
                 const Stream& draw, const std::string& stream_name)
    : camera_(camera),
      px_per_mm_(camera.fx_px / model.distance_mm),
      disc_px_(std::min(pupil_mm * px_per_mm_, kMostDisc_px)),
      film_(camera.width_px, camera.height_px) {
  std::fill(film_.data.begin(), film_.data.end(), 1.0f);
  specks_ = film_;
  if (model.film > 0) AddFilm(model.film, stream_name);
  std::uint64_t number = 0;
  for (int k = 0; k < model.specks; ++k) {
    AddSpeck(SpotOf(number++, model.speck_mm, kSpeckSpread, draw), draw);
  }
  Spread(&film_);
  Spread(&specks_);
  transmitted_ = film_;
  for (std::size_t i = 0; i < film_.data.size(); ++i) transmitted_.data[i] *= specks_.data[i];
  if (model.drops == 0) return;
  drops_ = Image<float>(camera.width_px, camera.height_px);
  source_px_ = Image<float>(camera.width_px, camera.height_px, 2);
  for (int k = 0; k < model.drops; ++k) {
    AddDrop(SpotOf(number++, model.drop_mm, kDropSpread, draw), draw);
  }
  Image<float> spread = drops_;
  Spread(&spread);
  for (std::size_t i = 0; i < spread.data.size(); ++i) transmitted_.data[i] *= 1 - spread.data[i];
}

Soiling::Spot Soiling::SpotOf(std::uint64_t number, double median_mm, double spread,
                              const Stream& draw) const {
  const double diameter_mm = median_mm * std::exp(spread * draw.Gaussian(number, 0));
  return {.middle_px = {draw.Uniform(number, 2) * camera_.width_px - 0.5,
                        draw.Uniform(number, 3) * camera_.height_px - 0.5},
          .radius_px = 0.5 * diameter_mm * px_per_mm_,
          .number = number};
}

void Soiling::AddFilm(double film, const std::string& stream_name) {
  constexpr int kPeriod = 6, kOctaves = 6;
  const LatticeNoise noise(stream_name + "/film", kPeriod, kOctaves);
  const double over_px = 1.0 / std::max(camera_.width_px, camera_.height_px);
  for (int y = 0; y < film_.height_px; ++y) {
    for (int x = 0; x < film_.width_px; ++x) {
      const double density = 2 * double(noise.At(x * over_px, y * over_px));  // mean about 1
      film_.at(x, y) *= static_cast<float>(std::clamp(1 - film * density, 0.0, 1.0));
    }
  }
}

void Soiling::AddSpeck(const Spot& spot, const Stream& draw) {
  const double opacity = 0.5 + 0.48 * draw.Uniform(spot.number, 4);
  const auto phase = [&](std::uint32_t k) { return 2 * kPi * draw.Uniform(spot.number, 5 + k); };
  const double a = phase(0), b = phase(1), c = phase(2);
  ForPixelsAbout(specks_, spot.middle_px, 1.5 * spot.radius_px + 1,
                 [&](int x, int y, const Vec2& from_px) {
                   const double t = std::atan2(from_px.y(), from_px.x());
                   const double rim_px =
                       spot.radius_px * (1 + 0.2 * std::sin(2 * t + a) +
                                         0.13 * std::sin(3 * t + b) + 0.09 * std::sin(7 * t + c));
                   const double cover = std::clamp(rim_px - from_px.norm() + 0.5, 0.0, 1.0);
                   specks_.at(x, y) *= static_cast<float>(1 - opacity * cover);
                 });
}

Vec2 Soiling::Turned_px(const Vec2& from_middle_px, double px_per_mm, double focal_px,
                        double sphere_mm) {
  const Vec2 from_mm = from_middle_px / px_per_mm;
  const double height_mm = std::sqrt(sphere_mm * sphere_mm - from_mm.squaredNorm());
  return from_middle_px - focal_px * (kWater - 1) / height_mm * from_mm;
}

void Soiling::AddDrop(const Spot& spot, const Stream& draw) {
  const double squash = 1 + 0.25 * draw.Uniform(spot.number, 4);  // taller than wide
  const double sphere_mm = spot.radius_px / px_per_mm_ / kSlopeAtRim;
  ForPixelsAbout(
      drops_, spot.middle_px, squash * spot.radius_px + 1, [&](int x, int y, const Vec2& from_px) {
        const Vec2 round_px(from_px.x(), from_px.y() / squash);
        const double cover = std::clamp(spot.radius_px - round_px.norm() + 0.5, 0.0, 1.0);
        if (cover == 0) return;
        const Vec2 within_px =
            round_px * std::min(1.0, spot.radius_px / std::max(round_px.norm(), 1e-9));
        const Vec2 at_px =
            spot.middle_px + Turned_px(within_px, px_per_mm_, camera_.fx_px, sphere_mm);
        drops_.at(x, y) = std::max(drops_.at(x, y), static_cast<float>(cover));
        source_px_.at(x, y, 0) = static_cast<float>(at_px.x());
        source_px_.at(x, y, 1) = static_cast<float>(at_px.y());
      });
}

void Soiling::Spread(Image<float>* picture) const {
  if (disc_px_ < 1) return;
  const int side = 2 * static_cast<int>(std::ceil(0.5 * disc_px_)) + 1;
  cv::Mat disc = cv::Mat::zeros(side, side, CV_32FC1);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const double from_px = Vec2(x - side / 2, y - side / 2).norm();
      disc.at<float>(y, x) =
          static_cast<float>(std::clamp(0.5 * disc_px_ - from_px + 0.5, 0.0, 1.0));
    }
  }
  disc /= cv::sum(disc)[0];
  cv::Mat view = View(*picture), spread;
  cv::filter2D(view, spread, CV_32F, disc, cv::Point(-1, -1), 0, cv::BORDER_REFLECT);
  spread.copyTo(view);
  for (float& value : picture->data) value = std::max(value, 0.0f);
}

void Soiling::Apply(const Vec3& sun_lx, Image<float>* picture) const {
  Image<float> through(picture->width_px, picture->height_px, 3), covered = drops_;
  if (!drops_.empty()) {
    // The image shown by the drops, blurred together with their coverage.
    cv::Mat shown = View(through);
    cv::remap(View(*picture), shown, View(source_px_), cv::noArray(), cv::INTER_LINEAR,
              cv::BORDER_REFLECT);
    for (std::size_t i = 0; i < through.data.size(); ++i) through.data[i] *= drops_.data[i / 3];
    Spread(&through);
    Spread(&covered);
  }
  const cv::Scalar mean = cv::mean(View(*picture));
  for (std::size_t i = 0; i < picture->data.size(); ++i) {
    const std::size_t pixel = i / 3;
    const float drop = covered.empty() ? 0 : covered.data[pixel];
    const float film = film_.data[pixel], specks = specks_.data[pixel];
    const double veil_cdpm2 = mean[static_cast<int>(i % 3)] + sun_lx[i % 3] / kPi;
    const double scattered =
        kScattered * double(specks * (1 - film)) + kSpeckScattered * double(1 - specks);
    picture->data[i] = film * specks * ((1 - drop) * picture->data[i] + through.data[i]) +
                       static_cast<float>(scattered * veil_cdpm2);
  }
}

}  // namespace tera
