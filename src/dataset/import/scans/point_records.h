#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "dataset/import/scans/revolution.h"

namespace tera {

struct RecordField {
  std::string name;
  char type = 'F';  ///< F floating, U unsigned, I signed
  std::size_t bytes = 4, at = 0;
};

/// Points as binary records of equal length.
struct PointRecords {
  std::vector<RecordField> fields;
  std::size_t step = 0, count = 0;
  std::string_view bytes;
  bool is_big_endian = false;
  std::string place;  ///< place for error messages
};

/// Facts about points that the record fields do not state; the mapping gives them.
struct PointForm {
  enum class Stamp { kUnknown, kFirst, kLast };
  Stamp stamp = Stamp::kUnknown;      ///< ray at which the scan's stamp is taken
  std::optional<double> duration_s;   ///< time from the first ray to the last
  std::string time_field;             ///< empty: searched by common names
  std::optional<double> time_unit_s;  ///< unit of the time field; if absent, inferred from type and
                                      ///< size
  std::optional<double> full_intensity;  ///< raw intensity that becomes 1; if absent, inferred from
                                         ///< the type
};

/// Converts point records to a scan.
///
/// Frames  Coordinates keep the frame of the file, in metres. If the mapping's mount describes that
///         frame, it becomes the sensor frame S.
/// Model   Position: fields x, y, z. Intensity: field intensity or reflectivity; 8-bit values are
///         divided by 255, others by `full_intensity`. Without `full_intensity`, other values must
///         be in [0, 1]. Ring: field ring, line, channel or laser_id. Time: field t, time,
///         timestamp, time_stamp or offset_time. An integer is in ns since the stamp; a 4-byte
///         float is in s since the stamp. An 8-byte float is in s since the stamp, or in s, us or
///         ns since 1970, depending on its size. A point that is not finite or at the origin is a
///         ray without return.
/// Throws  InputError if a field is missing or the times cannot belong to one scan.
class RecordReader {
 public:
  RecordReader(const PointRecords& records, const PointForm& form);
  UnitScan Read(TimeNs stamp_ns) const;
  bool has_ring() const { return ring_ != nullptr; }
  bool has_time() const { return time_ != nullptr; }
  bool has_intensity() const { return intensity_ != nullptr; }

 private:
  const RecordField* Find(std::initializer_list<std::string_view> names) const;
  const RecordField& Require(std::string_view name) const;
  double Number(const RecordField& field, std::size_t record) const;
  std::vector<TimeNs> Times(TimeNs stamp_ns) const;
  std::vector<TimeNs> TimesWithout(TimeNs stamp_ns) const;
  std::vector<float> Intensities() const;
  double TimeUnit_s(double largest) const;
  [[noreturn]] void Fail(const InputFault& fault) const;

  const PointRecords& records_;
  const PointForm& form_;
  const RecordField *x_, *y_, *z_, *intensity_, *ring_, *time_;
};

}  // namespace tera
