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
  std::uint32_t last_number = 0;
  PanopticSegment* segment = nullptr;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const std::uint16_t instance = frame.instance.at(x, y);
      const std::uint8_t label = frame.semantic.at(x, y);
      const std::uint32_t number = SegmentNumber(instance, label);
      if (segment == nullptr || number != last_number) {
        segment = &SegmentAt(number, instance, label, table, file, &picture);
        last_number = number;
      }
      segment->bounds.Include(x, y, y);
      ++segment->area_px;
      for (int c = 0; c < 3; ++c) {
        picture.rgb.at(x, y, c) = static_cast<std::uint8_t>(number >> (8 * c));
      }
    }
  }
  return picture;
}

}  // namespace tera
