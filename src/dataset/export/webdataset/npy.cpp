#include "dataset/export/webdataset/npy.h"

#include <fmt/format.h>

#include <bit>

#include "dataset/export/bag/little_endian.h"

namespace tera {

std::string NpyOf(const std::vector<LidarPoint>& points) {
  constexpr std::size_t kAlignment = 64, kBeforeHeader = 10;
  std::string header = fmt::format(
      "{{'descr': [('x', '<f4'), ('y', '<f4'), ('z', '<f4'), ('intensity', '<f4'), "
      "('time', '<u4'), ('ring', '<u2'), ('instance', '<u2'), ('label', '|u1')], "
      "'fortran_order': False, 'shape': ({},), }}",
      points.size());
  const std::size_t end = kBeforeHeader + header.size() + 1;
  header.append((kAlignment - end % kAlignment) % kAlignment, ' ');
  header += '\n';
  std::string bytes("\x93NUMPY\x01\x00", 8);
  AppendNumber(static_cast<std::uint16_t>(header.size()), &bytes);
  bytes += header;
  for (const LidarPoint& point : points) {
    for (const float value : {point.x_m, point.y_m, point.z_m, point.intensity}) {
      AppendNumber(std::bit_cast<std::uint32_t>(value), &bytes);
    }
    AppendNumber(point.time_offset_ns, &bytes);
    AppendNumber(point.ring, &bytes);
    AppendNumber(point.instance, &bytes);
    AppendNumber(point.label, &bytes);
  }
  return bytes;
}

}  // namespace tera
