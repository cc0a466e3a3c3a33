#include "dataset/export/gnss/nmea_sentences.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/units.h"
#include "dataset/export/stamp_text.h"

namespace tera {
namespace {

constexpr int kTimeDecimals = 3;
constexpr double kFullTurn_deg = 360;

std::string TimeOfDay(TimeNs utc_ns) {
  const CivilTime t = CivilTimeOf(RoundedTo(utc_ns, kTimeDecimals));
  constexpr TimeNs kNsPerMillisecond = 1'000'000;
  return fmt::format("{:02}{:02}{:02}.{:03}", t.hour, t.minute, t.second,
                     t.nanosecond / kNsPerMillisecond);
}

std::string Date(TimeNs utc_ns) {
  const CivilTime t = CivilTimeOf(RoundedTo(utc_ns, kTimeDecimals));
  return fmt::format("{:02}{:02}{:02}", t.day, t.month, t.year % 100);
}

/// Degrees and minutes with seven decimals (0.2 mm), and the hemisphere. Integer arithmetic
/// prevents minutes that are rounded to 60.
std::string Angle(double angle_deg, int degree_digits, char positive, char negative) {
  constexpr std::int64_t kUnitsPerMinute = 10'000'000, kUnitsPerDegree = 60 * kUnitsPerMinute;
  const std::int64_t units = std::llround(std::abs(angle_deg) * kUnitsPerDegree);
  const std::int64_t minutes = units % kUnitsPerDegree;
  return fmt::format("{:0{}}{:02}.{:07},{}", units / kUnitsPerDegree, degree_digits,
                     minutes / kUnitsPerMinute, minutes % kUnitsPerMinute,
                     angle_deg < 0 ? negative : positive);
}

std::string Position(const GnssSample& s) {
  if (s.fix == GnssFix::kNone) return ",,,";
  return Angle(s.lat_deg, 2, 'N', 'S') + "," + Angle(s.lon_deg, 3, 'E', 'W');
}

char ModeOf(GnssFix fix) {
  switch (fix) {
    case GnssFix::kNone:
      return 'N';
    case GnssFix::kSingle:
      return 'A';
    case GnssFix::kDifferential:
      return 'D';
    case GnssFix::kRtkFixed:
      return 'R';
    case GnssFix::kRtkFloat:
      return 'F';
  }
  return 'N';
}

}  // namespace

std::string NmeaSentence(std::string_view body) {
  unsigned checksum = 0;
  for (const char c : body) checksum ^= static_cast<unsigned char>(c);
  return fmt::format("${}*{:02X}\r\n", body, checksum);
}

std::string Gga(TimeNs utc_ns, const GnssSample& s) {
  const std::string height =
      s.fix == GnssFix::kNone ? ",M,,M" : fmt::format("{:.4f},M,0.0,M", s.alt_m);
  return NmeaSentence(fmt::format("GNGGA,{},{},{},,,{},,", TimeOfDay(utc_ns), Position(s),
                                  static_cast<int>(s.fix), height));
}

std::string Rmc(TimeNs utc_ns, const GnssSample& s) {
  return NmeaSentence(fmt::format("GNRMC,{},{},{},,,{},,,{}", TimeOfDay(utc_ns),
                                  s.fix == GnssFix::kNone ? 'V' : 'A', Position(s), Date(utc_ns),
                                  ModeOf(s.fix)));
}

std::string Gst(TimeNs utc_ns, const GnssSample& s) {
  const Vec3 sigma_m = s.variance_enu_m2.cwiseSqrt();
  const double east_m = sigma_m.x(), north_m = sigma_m.y();
  const double orientation_deg = east_m > north_m ? 90 : 0;  // orientation of the error ellipse's
                                                             // longer axis, from north
  return NmeaSentence(fmt::format("GNGST,{},,{:.4f},{:.4f},{:.1f},{:.4f},{:.4f},{:.4f}",
                                  TimeOfDay(utc_ns), std::max(east_m, north_m),
                                  std::min(east_m, north_m), orientation_deg, north_m, east_m,
                                  sigma_m.z()));
}

std::string Hdt(double heading_rad) {
  double heading_deg = std::fmod(heading_rad / kDeg, kFullTurn_deg);
  if (heading_deg < 0) heading_deg += kFullTurn_deg;
  std::string text = fmt::format("{:.3f}", heading_deg);
  if (text == "360.000") text = "0.000";
  return NmeaSentence(fmt::format("GNHDT,{},T", text));
}

}  // namespace tera
