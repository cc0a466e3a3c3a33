#include "dataset/export/picture/object_masks.h"

#include <algorithm>

namespace tera {

void PixelBounds::Include(int x_px, int y_first_px, int y_last_px) {
  if (empty()) {
    *this = {x_px, y_first_px, x_px, y_last_px};
    return;
  }
  x_min_px = std::min(x_min_px, x_px);
  x_max_px = std::max(x_max_px, x_px);
  y_min_px = std::min(y_min_px, y_first_px);
  y_max_px = std::max(y_max_px, y_last_px);
}

std::map<std::uint16_t, ObjectMask> ObjectMasks(const Image<std::uint16_t>& instances,
                                                const InstanceTable& table,
                                                const std::filesystem::path& file) {
  std::map<std::uint16_t, ObjectMask> masks;
  const int height = instances.height_px;
  for (int x = 0; x < instances.width_px; ++x) {
    for (int y = 0; y < height;) {
      const std::uint16_t instance = instances.at(x, y);
      const int first = y;
      while (y < height && instances.at(x, y) == instance) ++y;
      if (instance == 0) continue;
      for (const std::uint16_t object : table.WithWholes(instance, file)) {
        ObjectMask& mask = masks[object];
        mask.runs.Add(static_cast<std::int64_t>(x) * height + first, y - first);
        mask.bounds.Include(x, first, y - 1);
      }
    }
  }
  return masks;
}

}  // namespace tera
