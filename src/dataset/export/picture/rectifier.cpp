#include "dataset/export/picture/rectifier.h"

#include <opencv2/imgproc.hpp>

#include "core/check.h"
#include "core/motion.h"

namespace tera {
namespace {

Vec2 Distorted(const CameraLens& c, const Vec2& pinhole) {
  const double x = pinhole.x(), y = pinhole.y(), r2 = pinhole.squaredNorm();
  const double above = 1 + r2 * (c.k1 + r2 * (c.k2 + r2 * c.k3));
  const double below = 1 + r2 * (c.k4 + r2 * (c.k5 + r2 * c.k6));
  const double radial = above / below;
  return {x * radial + 2 * c.p1 * x * y + c.p2 * (r2 + 2 * x * x),
          y * radial + c.p1 * (r2 + 2 * y * y) + 2 * c.p2 * x * y};
}

bool IsPinhole(const CameraLens& c) {
  for (const double k : {c.k1, c.k2, c.p1, c.p2, c.k3, c.k4, c.k5, c.k6}) {
    if (k != 0) return false;
  }
  return true;
}

template <typename T>
Image<T> Mapped(const Image<T>& picture, const std::vector<float>& source_px, int depth,
                int interpolation) {
  const int type = CV_MAKETYPE(depth, picture.channels);
  Image<T> mapped(picture.width_px, picture.height_px, picture.channels);
  const cv::Mat from(picture.height_px, picture.width_px, type,
                     const_cast<T*>(picture.data.data()));
  const cv::Mat map(picture.height_px, picture.width_px, CV_32FC2,
                    const_cast<float*>(source_px.data()));
  cv::Mat to(picture.height_px, picture.width_px, type, mapped.data.data());
  cv::remap(from, to, map, cv::noArray(), interpolation, cv::BORDER_CONSTANT);
  TERA_CHECK(to.data == reinterpret_cast<unsigned char*>(mapped.data.data()));
  return mapped;
}

}  // namespace

bool Rectifier::Takes(const CameraLens& lens) {
  return lens.law == "brown_conrady" || lens.law == "rational";
}

Rectifier::Rectifier(const CameraLens& lens)
    : width_px_(lens.width_px), height_px_(lens.height_px) {
  TERA_CHECK(Takes(lens), lens.law);
  if (IsPinhole(lens)) return;
  for (int v = 0; v < height_px_; ++v) {
    for (int u = 0; u < width_px_; ++u) {
      const Vec2 p =
          Distorted(lens, {(u - lens.cx_px) / lens.fx_px, (v - lens.cy_px) / lens.fy_px});
      source_px_.push_back(static_cast<float>(lens.fx_px * p.x() + lens.cx_px));
      source_px_.push_back(static_cast<float>(lens.fy_px * p.y() + lens.cy_px));
    }
  }
}

Image<std::uint8_t> Rectifier::Blended(const Image<std::uint8_t>& picture) const {
  TERA_CHECK(picture.width_px == width_px_ && picture.height_px == height_px_, picture.width_px);
  if (!changes_pictures()) return picture;
  return Mapped(picture, source_px_, CV_8U, cv::INTER_LINEAR);
}

Image<std::uint16_t> Rectifier::Nearest(const Image<std::uint16_t>& picture) const {
  TERA_CHECK(picture.width_px == width_px_ && picture.height_px == height_px_, picture.width_px);
  if (!changes_pictures()) return picture;
  return Mapped(picture, source_px_, CV_16U, cv::INTER_NEAREST);
}

}  // namespace tera
