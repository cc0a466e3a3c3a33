#include "dataset/compare/picture_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/error.h"
#include "dataset/realism/realism_sums.h"

namespace tera {
namespace {

/// Sums over the images of one recording.
class PictureSums {
 public:
  void Add(const std::filesystem::path& folder, const CameraFrame& frame,
           const Image<float>& luminance) {
    realism_.Add(folder, frame);
    RequireOneSize(folder, frame.rgb);
    for (std::size_t p = 0; p < luminance.data.size(); ++p) {
      const std::uint8_t* rgb = &frame.rgb.data[3 * p];
      sum_dn_ += static_cast<double>(luminance.data[p]);
      const auto [least, most] = std::minmax_element(rgb, rgb + 3);
      dark_ += *most == 0 ? 1 : 0;
      bright_ += *least == 255 ? 1 : 0;
    }
    pixels_ += static_cast<double>(luminance.data.size());
  }
  int pictures() const { return realism_.pictures(); }
  int width_px() const { return width_px_; }
  int height_px() const { return height_px_; }
  PictureSide Told() const {
    return {width_px_,         height_px_,      realism_.Told(),
            sum_dn_ / pixels_, dark_ / pixels_, bright_ / pixels_};
  }

 private:
  void RequireOneSize(const std::filesystem::path& folder, const Image<std::uint8_t>& rgb) {
    if (width_px_ == 0) {
      width_px_ = rgb.width_px;
      height_px_ = rgb.height_px;
    }
    if (rgb.width_px == width_px_ && rgb.height_px == height_px_) return;
    throw InputError(folder.string(),
                     {FaultKind::kInconsistent,
                      fmt::format("has pictures of {} x {} px and of {} x {} px; need one size",
                                  width_px_, height_px_, rgb.width_px, rgb.height_px)});
  }

  RealismSums realism_;
  int width_px_ = 0, height_px_ = 0;
  double pixels_ = 0, sum_dn_ = 0, dark_ = 0, bright_ = 0;
};

double MeanDifference_dn(const Image<float>& a, const Image<float>& b) {
  double sum_dn = 0;
  for (std::size_t p = 0; p < a.data.size(); ++p) {
    sum_dn += std::abs(static_cast<double>(b.data[p]) - static_cast<double>(a.data[p]));
  }
  return sum_dn / static_cast<double>(a.data.size());
}

PictureComparison ComparedPictures(const RecordedMachine& a, const RecordedMachine& b,
                                   SensorInBoth sensor) {
  PictureSums sums_a, sums_b;
  PictureComparison comparison;
  double difference_sum_dn = 0;
  for (const FramePair& t : sensor.pairs) {
    const CameraFrame frame_a = a.recording->LoadFrame(sensor.folder_a, t.a_ns);
    const CameraFrame frame_b = b.recording->LoadFrame(sensor.folder_b, t.b_ns);
    if (frame_a.rgb.empty() || frame_b.rgb.empty()) continue;
    const Image<float> luminance_a = Luminance(frame_a.rgb), luminance_b = Luminance(frame_b.rgb);
    sums_a.Add(a.recording->directory() / sensor.folder_a, frame_a, luminance_a);
    sums_b.Add(b.recording->directory() / sensor.folder_b, frame_b, luminance_b);
    if (sums_a.width_px() != sums_b.width_px() || sums_a.height_px() != sums_b.height_px()) {
      continue;
    }
    const double difference_dn = MeanDifference_dn(luminance_a, luminance_b);
    difference_sum_dn += difference_dn;
    comparison.difference_dn = difference_sum_dn / sums_a.pictures();
    KeepWorst({t, difference_dn}, &comparison.worst);
  }
  comparison.sensor = std::move(sensor);
  if (sums_a.pictures() > 0) {
    comparison.a = sums_a.Told();
    comparison.b = sums_b.Told();
  }
  return comparison;
}

/// Statistics of the class with this name; null if absent.
const SurfaceRealism* FindSurface(const Realism& realism, const std::string& name) {
  const auto found = std::find_if(realism.surfaces.begin(), realism.surfaces.end(),
                                  [&](const SurfaceRealism& s) { return s.name == name; });
  return found == realism.surfaces.end() ? nullptr : &*found;
}

std::string FigureText(const std::string& title, double a, double b) {
  return fmt::format("    {:<30}{:>11.2f}{:>11.2f}\n", title, a, b);
}

std::string SurfaceText(const SurfaceRealism& a, const SurfaceRealism& b) {
  const std::string of = a.name == "all" ? "" : a.name + ", ";
  return FigureText(of + "MSCN shape", a.mscn_shape, b.mscn_shape) +
         FigureText(of + "gradient kurtosis", a.gradient_kurtosis, b.gradient_kurtosis) +
         FigureText(of + "chroma C*ab", a.chroma, b.chroma) +
         FigureText(of + "noise DN", a.noise_dn, b.noise_dn);
}

}  // namespace

std::vector<PictureComparison> ComparePictures(const RecordedMachine& a, const RecordedMachine& b,
                                               std::size_t every) {
  std::vector<PictureComparison> comparisons;
  for (SensorInBoth& sensor : SensorsInBoth(a, b, ChannelForm::kPictures, every)) {
    comparisons.push_back(ComparedPictures(a, b, std::move(sensor)));
  }
  return comparisons;
}

std::string PictureTable(const PictureComparison& c) {
  std::string text = fmt::format("  camera {}: {} pairs of pictures, of {} and {}\n", c.sensor.name,
                                 c.sensor.pairs.size(), c.sensor.frames_a, c.sensor.frames_b);
  if (!c.sensor.remark.empty()) text += fmt::format("    {}\n", c.sensor.remark);
  if (!c.a || !c.b) return text;
  const Realism &a = c.a->realism, &b = c.b->realism;
  text += fmt::format("    {:<30}{:>11}{:>11}\n", "", "reference", "compared");
  text += fmt::format("    {:<30}{:>11}{:>11}\n", "size, px",
                      fmt::format("{} x {}", c.a->width_px, c.a->height_px),
                      fmt::format("{} x {}", c.b->width_px, c.b->height_px));
  text += FigureText("mean luminance DN", c.a->mean_dn, c.b->mean_dn);
  text += FigureText("pixels at 0, %", 100 * c.a->dark, 100 * c.b->dark);
  text += FigureText("pixels at 255, %", 100 * c.a->bright, 100 * c.b->bright);
  text += FigureText("amplitude slope", a.slope_mean, b.slope_mean);
  text += FigureText("colourfulness", a.colourfulness, b.colourfulness);
  for (const SurfaceRealism& surface : a.surfaces) {
    const SurfaceRealism* other = FindSurface(b, surface.name);
    if (other != nullptr) text += SurfaceText(surface, *other);
  }
  const auto out = std::back_inserter(text);
  if (c.difference_dn) {
    fmt::format_to(out, "    mean difference of luminance  {:.2f} DN\n", *c.difference_dn);
  } else {
    text += "    pixels are not compared one by one: the sizes differ\n";
  }
  for (const WorstFrame& frame : c.worst) {
    fmt::format_to(out, "    worst at {:.3f} s: {:.2f} DN\n", ToSeconds(frame.t.a_ns),
                   frame.difference);
  }
  return text;
}

}  // namespace tera
