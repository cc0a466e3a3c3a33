#include "dataset/overview/picture.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "core/check.h"
#include "core/quantile.h"

namespace tera {
namespace {

constexpr double kShownShare = 0.98;  ///< fraction of values that a colour scale covers
constexpr double kFontScale = 0.5;

cv::Mat View(Picture* picture) {
  return cv::Mat(picture->height_px, picture->width_px, CV_8UC3, picture->data.data());
}

cv::Mat View(const Picture& picture) { return View(const_cast<Picture*>(&picture)); }

/// Magnitude below which the fraction kShownShare of the magnitudes lies, at least `least`.
double LargestShown(std::vector<double> sizes, double least) {
  return sizes.empty() ? least : std::max(Quantile(std::move(sizes), kShownShare), least);
}

/// RGB colour of s in [0, 1] on OpenCV's turbo scale, from blue to red.
cv::Vec3b Turbo(double s) {
  static const cv::Mat table = [] {
    cv::Mat ramp(1, 256, CV_8U), colours;
    for (int i = 0; i < 256; ++i) ramp.at<std::uint8_t>(0, i) = static_cast<std::uint8_t>(i);
    cv::applyColorMap(ramp, colours, cv::COLORMAP_TURBO);
    cv::cvtColor(colours, colours, cv::COLOR_BGR2RGB);
    return colours;
  }();
  return table.at<cv::Vec3b>(0, static_cast<int>(std::lround(255 * std::clamp(s, 0.0, 1.0))));
}

cv::Vec3b ClassColour(std::size_t label) {
  if (label >= kSemanticClasses.size()) return {255, 255, 255};
  const auto& rgb = kSemanticClasses[label].rgb;
  return {rgb[0], rgb[1], rgb[2]};
}

/// Hues are a golden-ratio turn apart, so that consecutive numbers differ clearly.
cv::Vec3b InstanceColour(std::uint16_t instance) {
  if (instance == 0) return {30, 30, 30};
  const double turn = std::fmod(0.618034 * instance, 1.0);
  cv::Mat colour(1, 1, CV_8UC3, cv::Scalar(180.0 * turn, 200, 255));
  cv::cvtColor(colour, colour, cv::COLOR_HSV2RGB);
  return colour.at<cv::Vec3b>(0, 0);
}

/// Colours each pixel by its first component.
template <typename T, typename Colour>
Picture Map(const Image<T>& image, const Colour& colour_of) {
  Picture picture(image.width_px, image.height_px, 3);
  const auto step = static_cast<std::size_t>(image.channels);
  for (std::size_t p = 0; step * p < image.data.size(); ++p) {
    const cv::Vec3b colour = colour_of(image.data[step * p]);
    for (int c = 0; c < 3; ++c) picture.data[3 * p + static_cast<std::size_t>(c)] = colour[c];
  }
  return picture;
}

/// Colours each pixel by instance, or by class if it has none.
template <typename T>
Picture Panoptic(const Image<T>& image) {
  TERA_CHECK(image.channels == 3, image.channels);
  Picture picture(image.width_px, image.height_px, 3);
  for (std::size_t i = 0; i < image.data.size(); i += 3) {
    const auto instance = static_cast<std::uint16_t>(image.data[i + 1] + 256 * image.data[i + 2]);
    const cv::Vec3b colour = instance == 0 ? ClassColour(static_cast<std::uint8_t>(image.data[i]))
                                           : InstanceColour(instance);
    for (int c = 0; c < 3; ++c) picture.data[i + static_cast<std::size_t>(c)] = colour[c];
  }
  return picture;
}

/// Shows the upper eight bits of each component.
template <typename T>
Picture Directions(const Image<T>& image) {
  TERA_CHECK(image.channels == 3, image.channels);
  Picture picture(image.width_px, image.height_px, 3);
  for (std::size_t i = 0; i < image.data.size(); ++i) {
    picture.data[i] = static_cast<std::uint8_t>(image.data[i] >> (8 * (sizeof(T) - 1)));
  }
  return picture;
}

/// Hue shows direction; strength shows length. It is full at the length below which kShownShare of
/// the lengths lie.
template <typename T>
Picture Flow(const Image<T>& image) {
  constexpr double kMiddle = 32768;
  std::vector<double> lengths;
  const auto arrow = [&](std::size_t p) {
    return cv::Vec2d(image.data[3 * p] - kMiddle, image.data[3 * p + 1] - kMiddle);
  };
  const std::size_t pixels = image.data.size() / 3;
  for (std::size_t p = 0; p < pixels; ++p) {
    if (image.data[3 * p + 2] != 0) lengths.push_back(cv::norm(arrow(p)));
  }
  const double longest = LargestShown(std::move(lengths), 1.0);
  cv::Mat hsv(image.height_px, image.width_px, CV_8UC3, cv::Scalar(0, 0, 0));
  for (std::size_t p = 0; p < pixels; ++p) {
    if (image.data[3 * p + 2] == 0) continue;
    const cv::Vec2d a = arrow(p);
    const double turn = std::atan2(a[1], a[0]) / (2 * CV_PI);
    hsv.at<cv::Vec3b>(static_cast<int>(p)) = {
        static_cast<std::uint8_t>(179 * (turn - std::floor(turn))),
        static_cast<std::uint8_t>(255 * std::min(1.0, cv::norm(a) / longest)), 255};
  }
  Picture picture(image.width_px, image.height_px, 3);
  cv::Mat out = View(&picture);
  cv::cvtColor(hsv.reshape(0, image.height_px), out, cv::COLOR_HSV2RGB);
  return picture;
}

/// From small (red) to large (blue); black without a value.
template <typename T>
Picture Nearness(const Image<T>& image) {
  std::vector<double> known;
  const T never = std::numeric_limits<T>::max();
  for (const T v : image.data) {
    if (v != 0 && v != never) known.push_back(v);
  }
  const double far = LargestShown(std::move(known), 1.0);
  return Map(image, [&](T v) { return v == 0 ? cv::Vec3b(0, 0, 0) : Turbo(1.0 - v / far); });
}

/// White in the middle, red above, blue below. Colours are full at the deviation below which
/// kShownShare of the deviations lie.
template <typename T>
Picture Rise(const Image<T>& image) {
  constexpr double kMiddle = 32768;
  std::vector<double> departures;
  for (const T v : image.data) {
    if (v != 0 && v != kMiddle) departures.push_back(std::abs(v - kMiddle));
  }
  const double most = LargestShown(std::move(departures), 1.0);
  return Map(image, [&](T v) {
    if (v == 0) return cv::Vec3b(0, 0, 0);
    const double s = std::clamp((v - kMiddle) / most, -1.0, 1.0);
    const auto rest = static_cast<std::uint8_t>(std::lround(255 * (1 - std::abs(s))));
    return s >= 0 ? cv::Vec3b(255, rest, rest) : cv::Vec3b(rest, rest, 255);
  });
}

template <typename T>
Picture ColourAny(LabelColours colours, const Image<T>& picture) {
  switch (colours) {
    case LabelColours::kClasses:
      return Map(picture, [](T label) { return ClassColour(label); });
    case LabelColours::kPanoptic:
      return Panoptic(picture);
    case LabelColours::kNumbers:
      return Map(picture, [](T number) { return InstanceColour(number); });
    case LabelColours::kDirections:
      return Directions(picture);
    case LabelColours::kFlow:
      return Flow(picture);
    case LabelColours::kNearness:
      return Nearness(picture);
    case LabelColours::kRise:
      return Rise(picture);
  }
  return Picture();
}

}  // namespace

Picture ColourDepth(const Image<float>& depth_m) {
  std::vector<double> measured;
  for (const float d : depth_m.data) {
    if (d > 0) measured.push_back(static_cast<double>(d));
  }
  const double far_m = LargestShown(std::move(measured), 1e-3);
  return Map(depth_m, [&](float d) {
    return d > 0 ? Turbo(1.0 - static_cast<double>(d) / far_m) : cv::Vec3b(0, 0, 0);
  });
}

Picture ColourLabels(LabelColours colours, const Image<std::uint8_t>& picture) {
  return ColourAny(colours, picture);
}

Picture ColourLabels(LabelColours colours, const Image<std::uint16_t>& picture) {
  return ColourAny(colours, picture);
}

Picture FitTile(const Picture& picture, int width_px, int height_px, const std::string& caption) {
  Picture tile(width_px, height_px, 3);
  cv::Mat canvas = View(&tile);
  const double scale = std::min(static_cast<double>(width_px) / picture.width_px,
                                static_cast<double>(height_px) / picture.height_px);
  const cv::Size size(
      std::min(width_px, static_cast<int>(std::lround(scale * picture.width_px))),
      std::min(height_px, static_cast<int>(std::lround(scale * picture.height_px))));
  cv::Mat fitted;
  cv::resize(View(picture), fitted, size, 0, 0, scale < 1 ? cv::INTER_AREA : cv::INTER_NEAREST);
  fitted.copyTo(canvas(cv::Rect((width_px - size.width) / 2, (height_px - size.height) / 2,
                                size.width, size.height)));
  WriteText(caption, 6, 16, &tile);
  return tile;
}

void WriteText(const std::string& text, int x_px, int y_px, Picture* picture) {
  cv::Mat canvas = View(picture);
  const cv::Point place(x_px, y_px);
  cv::putText(canvas, text, place, cv::FONT_HERSHEY_SIMPLEX, kFontScale, cv::Scalar(0, 0, 0), 3,
              cv::LINE_AA);
  cv::putText(canvas, text, place, cv::FONT_HERSHEY_SIMPLEX, kFontScale, cv::Scalar(255, 255, 255),
              1, cv::LINE_AA);
}

void Paste(const Picture& tile, int x_px, int y_px, Picture* sheet) {
  TERA_CHECK(x_px >= 0 && y_px >= 0 && x_px + tile.width_px <= sheet->width_px &&
                 y_px + tile.height_px <= sheet->height_px,
             x_px, y_px, tile.width_px, tile.height_px);
  View(tile).copyTo(View(sheet)(cv::Rect(x_px, y_px, tile.width_px, tile.height_px)));
}

}  // namespace tera
