#pragma once

#include <cstdint>
#include <filesystem>
#include <map>

#include "dataset/export/picture/labelled_frame.h"
#include "dataset/export/picture/object_masks.h"

namespace tera {

/// A segment of a panoptic picture. No two of a picture share a pixel.
struct PanopticSegment {
  SemanticClass label = SemanticClass::kSky;
  std::uint16_t instance = 0;  ///< 0: all pixels of a class that are of no object
  PixelBounds bounds;
  std::int64_t area_px = 0;
};

/// A picture's segments by their numbers, and the picture that has the number of each pixel as red
/// + 256 green + 65536 blue.
///
/// Model   a part of a machine is a segment of its own, of the number of its instance; pixels of no
///         instance are one segment a class, of the number 65536 (class + 1). No pixel is void.
/// Source  COCO, "Panoptic segmentation" of its data format.
struct PanopticPicture {
  Image<std::uint8_t> rgb;
  std::map<std::uint32_t, PanopticSegment> segments;
};

/// Throws InputError about `file`, the picture of instances, where an object is not in the table.
PanopticPicture PanopticOf(const LabelledFrame& frame, const InstanceTable& table,
                           const std::filesystem::path& file);

}  // namespace tera
