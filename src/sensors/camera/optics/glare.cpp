#include "sensors/camera/optics/glare.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "core/units.h"

namespace tera {
namespace {

cv::Mat View(const std::vector<float>& values, int width, int height) {
  return {height, width, CV_32FC1, const_cast<float*>(values.data())};
}

/// Scattered share on a pixel at an offset. Near the centre it is a mean over parts of the pixel.
double SharePerPixel(const ScatterLaw& law, int dx, int dy, const Vec2& step_rad) {
  const int parts = std::max(std::abs(dx), std::abs(dy)) <= 3 ? 8 : 1;
  double sum = 0;
  for (int k = 0; k < parts * parts; ++k) {
    const Vec2 part((k % parts + 0.5) / parts - 0.5, (k / parts + 0.5) / parts - 0.5);
    sum += law.At((Vec2(dx, dy) + part).cwiseProduct(step_rad).norm());
  }
  return sum / (parts * parts) * step_rad.x() * step_rad.y();
}

}  // namespace

ScatterLaw::ScatterLaw(const GlareModel& model)
    : core_rad_(model.core_deg * kDeg), power_(0.5 * model.slope) {
  // Integral of 2 pi t (1 + (t / core)^2)^-power from 0 to 1 rad.
  const double widest = 1 + 1 / (core_rad_ * core_rad_);
  const double sum = std::abs(power_ - 1) < 1e-9
                         ? std::log(widest)
                         : (std::pow(widest, 1 - power_) - 1) / (1 - power_);
  scale_ = 1 / (kPi * core_rad_ * core_rad_ * sum);
}

double ScatterLaw::At(double angle_rad) const {
  if (angle_rad > 1) return 0;
  const double t = angle_rad / core_rad_;
  return scale_ * std::pow(1 + t * t, -power_);
}

PictureGlare::PictureGlare(const GlareModel& model, const CameraIntrinsics& camera)
    : model_(model) {
  coarser_ = std::clamp(static_cast<int>(model.core_deg * kDeg * camera.fx_px), 1, 16);
  width_ = (camera.width_px + coarser_ - 1) / coarser_;
  height_ = (camera.height_px + coarser_ - 1) / coarser_;
  padded_width_ = cv::getOptimalDFTSize(2 * width_ - 1);
  padded_height_ = cv::getOptimalDFTSize(2 * height_ - 1);
  const ScatterLaw law(model);
  const Vec2 step_rad(coarser_ / camera.fx_px, coarser_ / camera.fy_px);
  std::vector<float> kernel(static_cast<std::size_t>(padded_width_) * padded_height_, 0);
  for (int dy = 1 - height_; dy < height_; ++dy) {
    for (int dx = 1 - width_; dx < width_; ++dx) {
      const auto x = static_cast<std::size_t>((dx + padded_width_) % padded_width_);
      const auto y = static_cast<std::size_t>((dy + padded_height_) % padded_height_);
      kernel[y * padded_width_ + x] = static_cast<float>(SharePerPixel(law, dx, dy, step_rad));
    }
  }
  spectrum_.resize(kernel.size());
  cv::Mat spectrum = View(spectrum_, padded_width_, padded_height_);
  cv::dft(View(kernel, padded_width_, padded_height_), spectrum, 0);
  cv::Mat ones = cv::Mat::zeros(padded_height_, padded_width_, CV_32FC1);
  ones(cv::Rect(0, 0, width_, height_)).setTo(1);
  cv::Mat covered;
  cv::dft(ones, covered, 0, height_);
  cv::mulSpectrums(covered, spectrum, covered, 0);
  cv::dft(covered, covered, cv::DFT_INVERSE | cv::DFT_SCALE | cv::DFT_REAL_OUTPUT, height_);
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) covered_.push_back(std::min(covered.at<float>(y, x), 1.0f));
  }
}

void PictureGlare::Apply(const Image<float>& sources, Image<float>* picture) const {
  const cv::Mat all(sources.height_px, sources.width_px, CV_32FC3,
                    const_cast<float*>(sources.data.data()));
  cv::Mat coarse, scattered;
  cv::resize(all, coarse, cv::Size(width_, height_), 0, 0, cv::INTER_AREA);
  const cv::Scalar mean = cv::mean(coarse);
  std::vector<cv::Mat> colours;
  cv::split(coarse, colours);
  for (int c = 0; c < 3; ++c) {
    cv::Mat field = cv::Mat::zeros(padded_height_, padded_width_, CV_32FC1);
    colours[c].copyTo(field(cv::Rect(0, 0, width_, height_)));
    cv::dft(field, field, 0, height_);
    cv::mulSpectrums(field, View(spectrum_, padded_width_, padded_height_), field, 0);
    cv::dft(field, field, cv::DFT_INVERSE | cv::DFT_SCALE | cv::DFT_REAL_OUTPUT, height_);
    const cv::Mat beyond = mean[c] * (1 - View(covered_, width_, height_));
    colours[c] = field(cv::Rect(0, 0, width_, height_)) + beyond;
  }
  cv::merge(colours, scattered);
  cv::resize(scattered, scattered, all.size(), 0, 0, cv::INTER_LINEAR);
  const auto share = static_cast<float>(model_.scattered);
  for (std::size_t i = 0; i < picture->data.size(); ++i) {
    const float more = share * scattered.ptr<float>()[i];
    picture->data[i] = (1 - share) * picture->data[i] + std::max(more, 0.0f);
  }
}

void AddSourceGlare(const GlareModel& model, const std::vector<Vec3>& rays_C,
                    const Vec3& to_source_C, const Vec3& illuminance_lx, Image<float>* picture) {
  if (to_source_C.z() <= 0) return;
  const ScatterLaw law(model);
  const Vec3 scattered_lx = model.scattered * to_source_C.z() * illuminance_lx;
  for (std::size_t i = 0; i < rays_C.size(); ++i) {
    if (rays_C[i].isZero()) continue;
    const Vec3 ray_C = rays_C[i].normalized();
    const double angle_rad = std::atan2(ray_C.cross(to_source_C).norm(), ray_C.dot(to_source_C));
    const double per_sr = law.At(angle_rad);
    for (int c = 0; c < 3; ++c) {
      picture->data[3 * i + c] += static_cast<float>(per_sr * scattered_lx[c]);
    }
  }
}

}  // namespace tera
