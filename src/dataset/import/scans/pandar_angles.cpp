#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <fstream>

#include "core/error.h"
#include "dataset/files/checked_file.h"
#include "dataset/import/scans/pandar_decoder.h"

namespace tera {

PandarAngles Qt64DesignAngles() {
  return {{-52.121, -49.785, -47.577, -45.477, -43.465, -41.528, -39.653, -37.831, -36.055, -34.320,
           -32.619, -30.950, -29.308, -27.690, -26.094, -24.517, -22.964, -21.420, -19.889, -18.372,
           -16.865, -15.368, -13.880, -12.399, -10.925, -9.457,  -7.994,  -6.535,  -5.079,  -3.626,
           -2.175,  -0.725,  0.725,   2.175,   3.626,   5.079,   6.534,   7.993,   9.456,   10.923,
           12.397,  13.877,  15.365,  16.861,  18.368,  19.885,  21.415,  22.959,  24.524,  26.101,
           27.697,  29.315,  30.957,  32.627,  34.328,  36.064,  37.840,  39.662,  41.537,  43.475,
           45.487,  47.587,  49.795,  52.133},
          {8.736,  8.314,  7.964,  7.669,  7.417,  7.198,  7.007,  6.838,  6.688,  6.554,  6.434,
           6.326,  6.228,  6.140,  6.059,  5.987,  -5.270, -5.216, -5.167, -5.123, -5.083, -5.047,
           -5.016, -4.988, -4.963, -4.942, -4.924, -4.910, -4.898, -4.889, -4.884, -4.881, 5.493,
           5.496,  5.502,  5.512,  5.525,  5.541,  5.561,  5.584,  5.611,  5.642,  5.676,  5.716,
           5.759,  5.808,  5.862,  5.921,  -5.330, -5.396, -5.469, -5.550, -5.640, -5.740, -5.850,
           -5.974, -6.113, -6.269, -6.447, -6.651, -6.887, -7.163, -7.493, -7.892}};
}

PandarAngles ReadPandarAngles(const std::filesystem::path& file) {
  std::ifstream stream(file);
  PandarAngles angles;
  std::size_t lasers = 0;
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    int laser = 0;
    double elevation_deg = 0, azimuth_deg = 0;
    if (std::sscanf(line.c_str(), "%d , %lf , %lf", &laser, &elevation_deg, &azimuth_deg) != 3) {
      if (number == 1) continue;  // header
      if (line.find_first_not_of(" \t\r") == line.npos) continue;
      throw InputError(fmt::format("{}:{}", file.string(), number),
                       {FaultKind::kMalformed,
                        fmt::format("found '{}', need a laser's number, elevation and azimuth in "
                                    "degrees",
                                    line)});
    }
    if (laser != static_cast<int>(lasers) + 1 || lasers == kQt64Lasers ||
        !(std::abs(elevation_deg) <= 90) || !(std::abs(azimuth_deg) <= 180)) {
      throw InputError(fmt::format("{}:{}", file.string(), number),
                       {FaultKind::kOutOfRange,
                        fmt::format("found '{}', need lasers 1 to {} in order, elevations within "
                                    "90 and azimuths within 180 degrees",
                                    line, kQt64Lasers)});
    }
    angles.elevation_deg[lasers] = elevation_deg;
    angles.azimuth_deg[lasers++] = azimuth_deg;
  }
  if (lasers != kQt64Lasers) {
    throw InputError(file.string(),
                     {FaultKind::kMissing, fmt::format("has {} lasers, need {} of a QT64; copy the "
                                                       "unit's own file again",
                                                       lasers, kQt64Lasers)});
  }
  return angles;
}

}  // namespace tera
