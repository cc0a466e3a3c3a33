#include "dataset/import/scans/point_records.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/error.h"

namespace tera {
namespace {

/// Limits of a scan's duration: one turn of the slowest lidar, and about a thousandth of a turn.
constexpr double kLongestScan_s = 4, kShortestScan_s = 1e-3;
/// Times above this number of seconds count from 1970.
constexpr double kSinceEpoch_s = 1e8;

template <typename T>
double Plain(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return static_cast<double>(value);
}

double NumberOf(char type, std::size_t size, const char* bytes) {
  if (type == 'F') return size == 4 ? Plain<float>(bytes) : Plain<double>(bytes);
  if (type == 'U') {
    return size == 1   ? Plain<std::uint8_t>(bytes)
           : size == 2 ? Plain<std::uint16_t>(bytes)
           : size == 4 ? Plain<std::uint32_t>(bytes)
                       : Plain<std::uint64_t>(bytes);
  }
  return size == 1   ? Plain<std::int8_t>(bytes)
         : size == 2 ? Plain<std::int16_t>(bytes)
         : size == 4 ? Plain<std::int32_t>(bytes)
                     : Plain<std::int64_t>(bytes);
}

bool IsKnownSize(const RecordField& field) {
  if (field.type == 'F') return field.bytes == 4 || field.bytes == 8;
  return field.bytes == 1 || field.bytes == 2 || field.bytes == 4 || field.bytes == 8;
}

}  // namespace

RecordReader::RecordReader(const PointRecords& records, const PointForm& form)
    : records_(records),
      form_(form),
      x_(&Require("x")),
      y_(&Require("y")),
      z_(&Require("z")),
      intensity_(Find({"intensity", "reflectivity", "i"})),
      ring_(Find({"ring", "line", "channel", "laser_id"})),
      time_(form.time_field.empty() ? Find({"t", "time", "timestamp", "time_stamp", "offset_time"})
                                    : &Require(form.time_field)) {
  if (records.bytes.size() / std::max<std::size_t>(records.step, 1) < records.count) {
    Fail({FaultKind::kMalformed,
          fmt::format("{} points of {} bytes are declared, {} bytes are there", records.count,
                      records.step, records.bytes.size())});
  }
  for (const RecordField* field : {x_, y_, z_, intensity_, ring_, time_}) {
    if (field == nullptr) continue;
    if (!IsKnownSize(*field) || field->at + field->bytes > records.step) {
      Fail({FaultKind::kMalformed,
            fmt::format("its field '{}' of {} bytes does not lie in a point of {}", field->name,
                        field->bytes, records.step)});
    }
  }
}

void RecordReader::Fail(const InputFault& fault) const { throw InputError(records_.place, fault); }

const RecordField* RecordReader::Find(std::initializer_list<std::string_view> names) const {
  for (const std::string_view name : names) {
    for (const RecordField& field : records_.fields) {
      if (field.name == name) return &field;
    }
  }
  return nullptr;
}

const RecordField& RecordReader::Require(std::string_view name) const {
  if (const RecordField* field = Find({name})) return *field;
  std::vector<std::string> names;
  for (const RecordField& field : records_.fields) names.push_back(field.name);
  Fail({FaultKind::kMissing,
        fmt::format("its points have no field '{}'; they have {}", name, fmt::join(names, ", "))});
}

double RecordReader::Number(const RecordField& field, std::size_t record) const {
  char copy[8] = {};
  std::memcpy(copy, records_.bytes.data() + record * records_.step + field.at, field.bytes);
  if (records_.is_big_endian) std::reverse(copy, copy + field.bytes);
  return NumberOf(field.type, field.bytes, copy);
}

double RecordReader::TimeUnit_s(double largest) const {
  constexpr double kNs = 1e-9, kUs = 1e-6;
  if (form_.time_unit_s) return *form_.time_unit_s;
  if (time_->type != 'F') return kNs;
  if (time_->bytes == 4 || largest < kSinceEpoch_s) return 1;
  // In seconds since 1970, 1e8 is in the year 1973 and 1e12 far in the future. Larger values thus
  // have a smaller unit.
  constexpr double kMost_s = 1e12, kMost_us = 1e17;
  return largest < kMost_s ? 1 : largest < kMost_us ? kUs : kNs;
}

std::vector<TimeNs> RecordReader::TimesWithout(TimeNs stamp_ns) const {
  if (form_.stamp == PointForm::Stamp::kUnknown) {
    Fail({FaultKind::kMissing,
          "its points have no times; set the lidar's 'stamp' to the ray of the stamp: first, or "
          "last with 'duration_s'"});
  }
  const bool is_last = form_.stamp == PointForm::Stamp::kLast;
  const TimeNs first_ns = stamp_ns - (is_last ? FromSeconds(form_.duration_s.value_or(0)) : 0);
  return std::vector<TimeNs>(records_.count, first_ns);
}

std::vector<TimeNs> RecordReader::Times(TimeNs stamp_ns) const {
  if (time_ == nullptr) return TimesWithout(stamp_ns);
  std::vector<double> numbers;
  for (std::size_t k = 0; k < records_.count; ++k) numbers.push_back(Number(*time_, k));
  if (numbers.empty()) return {};
  const auto [least, most] = std::minmax_element(numbers.begin(), numbers.end());
  if (!std::all_of(numbers.begin(), numbers.end(), [](double t) { return std::isfinite(t); })) {
    Fail({FaultKind::kMalformed,
          fmt::format("times of points in '{}' are not finite", time_->name)});
  }
  const double unit_s = TimeUnit_s(*most);
  const double length_s = (*most - *least) * unit_s;
  // Integers may be in ns or us, so the duration has a lower limit. Floats in another unit than s
  // would make it far too long.
  const double shortest_s = time_->type == 'F' ? 0 : kShortestScan_s;
  if (records_.count > 1 && !(length_s >= shortest_s && length_s <= kLongestScan_s)) {
    Fail({FaultKind::kOutOfRange,
          fmt::format("its scan would last {:.4g} s by '{}' in units of {:.4g} s, need {} to {} s; "
                      "set the lidar's 'time_unit' (s, ms, us, ns)",
                      length_s, time_->name, unit_s, shortest_s, kLongestScan_s)});
  }
  const bool is_absolute = *most * unit_s >= kSinceEpoch_s;
  // The smallest value is subtracted first. A double then represents the difference to the
  // nanosecond.
  const double from = is_absolute ? std::floor(*least) : 0;
  const TimeNs from_ns = is_absolute ? std::llround(from) * std::llround(unit_s * 1e9) : stamp_ns;
  std::vector<TimeNs> times_ns;
  for (const double number : numbers) {
    times_ns.push_back(from_ns + FromSeconds((number - from) * unit_s));
  }
  return times_ns;
}

std::vector<float> RecordReader::Intensities() const {
  std::vector<float> values(records_.count, 0.0F);
  if (intensity_ == nullptr) return values;
  const bool is_byte = intensity_->type == 'U' && intensity_->bytes == 1;
  const double full = form_.full_intensity.value_or(is_byte ? 255 : 1);
  for (std::size_t k = 0; k < records_.count; ++k) {
    const double value = Number(*intensity_, k) / full;
    // A point that is not finite has no position.
    if (!std::isfinite(value)) continue;
    if (value < 0 || value > 1) {
      Fail({FaultKind::kOutOfRange,
            fmt::format("point {} has the {} {:.6g}, need 0 to {}; set the lidar's "
                        "'full_intensity' to the value of full scale (255 for 8 bits)",
                        k + 1, intensity_->name, value * full, full)});
    }
    values[k] = static_cast<float>(value);
  }
  return values;
}

UnitScan RecordReader::Read(TimeNs stamp_ns) const {
  constexpr double kMostRing = 65535;
  UnitScan read;
  Revolution revolution([&](UnitScan scan) { read = std::move(scan); });
  revolution.Begin(records_.place);
  const std::vector<TimeNs> times_ns = Times(stamp_ns);
  const std::vector<float> intensities = Intensities();
  for (std::size_t k = 0; k < records_.count; ++k) {
    revolution.AddRay(times_ns[k]);
    const double x_m = Number(*x_, k), y_m = Number(*y_, k), z_m = Number(*z_, k);
    const bool is_finite = std::isfinite(x_m) && std::isfinite(y_m) && std::isfinite(z_m);
    if (!is_finite || (x_m == 0 && y_m == 0 && z_m == 0)) continue;
    const double ring = ring_ == nullptr ? 0 : Number(*ring_, k);
    if (!(ring >= 0 && ring <= kMostRing)) {
      Fail({FaultKind::kOutOfRange,
            fmt::format("point {} has the {} {}, need 0 to 65535", k + 1, ring_->name, ring)});
    }
    revolution.AddPoint({.x_m = static_cast<float>(x_m),
                         .y_m = static_cast<float>(y_m),
                         .z_m = static_cast<float>(z_m),
                         .intensity = intensities[k],
                         .ring = static_cast<std::uint16_t>(ring)},
                        times_ns[k]);
  }
  if (records_.count == 0) revolution.AddRay(stamp_ns);
  revolution.End(1);
  return read;
}

}  // namespace tera
