#pragma once

#include <cstdint>
#include <filesystem>
#include <map>

#include "core/types/measurement.h"
#include "dataset/export/picture/instance_table.h"
#include "dataset/export/picture/run_lengths.h"

namespace tera {

/// Bounding rectangle of a set of pixels; bounds are inclusive.
struct PixelBounds {
  int x_min_px = 0, y_min_px = 0, x_max_px = -1, y_max_px = -1;

  bool empty() const { return x_max_px < x_min_px; }
  int width_px() const { return x_max_px - x_min_px + 1; }
  int height_px() const { return y_max_px - y_min_px + 1; }
  void Include(int x_px, int y_first_px, int y_last_px);
};

struct ObjectMask {
  RunLengths runs;
  PixelBounds bounds;
};

/// Masks of all visible objects of an instance image, by instance. The mask of an object includes
/// the pixels of its parts. Throws InputError that names `file`, the image, if an instance is not
/// in the table.
std::map<std::uint16_t, ObjectMask> ObjectMasks(const Image<std::uint16_t>& instances,
                                                const InstanceTable& table,
                                                const std::filesystem::path& file);

}  // namespace tera
