#include "dataset/export/coco/panoptic_segments.h"

namespace tera {
namespace {

std::uint32_t SegmentNumber(std::uint16_t instance, std::uint8_t label) {
  return instance != 0 ? instance : (label + 1u) << 16;
}

/// Makes the segment at its first pixel.
PanopticSegment& SegmentAt(std::uint32_t number, std::uint16_t instance, std::uint8_t label,
                           const InstanceTable& table, const std::filesystem::path& file,
                           PanopticPicture* picture) {
  const auto [place, is_new] = picture->segments.try_emplace(number);
  if (is_new) {
    place->second.instance = instance;
    place->second.label =
        instance != 0 ? table.Of(instance, file).label : static_cast<SemanticClass>(label);
  }
  return place->second;
}

}  // namespace

PanopticPicture PanopticOf(const LabelledFrame& frame, const InstanceTable& table,
                           const std::filesystem::path& file) {
  PanopticPicture picture;
  const int width = frame.instance.width_px, height = frame.instance.height_px;
  picture.rgb = Image<std::uint8_t>(width, height, 3);
  auto rgb = picture.rgb.data.begin();
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width;) {
      const std::uint16_t instance = frame.instance.at(x, y);
      const std::uint8_t label = frame.semantic.at(x, y);
      const std::uint32_t number = SegmentNumber(instance, label);
      const int first = x;
      while (x < width && frame.instance.at(x, y) == instance && frame.semantic.at(x, y) == label) {
        *rgb++ = static_cast<std::uint8_t>(number);
        *rgb++ = static_cast<std::uint8_t>(number >> 8);
        *rgb++ = static_cast<std::uint8_t>(number >> 16);
        ++x;
      }
      PanopticSegment& segment = SegmentAt(number, instance, label, table, file, &picture);
      segment.bounds.Include(first, y, y);
      segment.bounds.Include(x - 1, y, y);
      segment.area_px += x - first;
    }
  }
  return picture;
}

}  // namespace tera
