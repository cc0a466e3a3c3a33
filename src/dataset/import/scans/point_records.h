#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "dataset/import/scans/revolution.h"

namespace tera {

/// One field of the points in a message or file.
struct RecordField {
  std::string name;
  char type = 'F';  ///< F floating, U unsigned, I signed
  std::size_t bytes = 4, at = 0;
};

/// Points as records of equal length.
struct PointRecords {
  std::vector<RecordField> fields;
  std::size_t step = 0, count = 0;
  std::string_view bytes;
  bool is_big_endian = false;
  std::string place;  ///< for faults
};

/// Properties of points that the mapping adds to their fields.
struct PointForm {
  enum class Stamp { kUnknown, kFirst, kLast };
  Stamp stamp = Stamp::kUnknown;         ///< ray that the scan's stamp refers to
  std::optional<double> duration_s;      ///< from the first ray to the last
  std::string time_field;                ///< empty: found by name
  std::optional<double> time_unit_s;     ///< unit of the time field; none: by type and size
  std::optional<double> full_intensity;  ///< intensity of full scale; none: by type
};

/// Converts records to a scan.
///
/// Frames  that of the file, in metres. It is TERA's S if the mapping's mount refers to the file's
///         frame.
/// Model   position: x, y, z.
///         intensity or reflectivity: over 255 if of 8 bits, else over `full_intensity`. Without
///         that key the values must lie in 0 to 1.
///         ring, line, channel or laser_id.
///         time: t, time, timestamp, time_stamp or offset_time. Integers are ns since the stamp.
///         Floats of 4 bytes are s since it. Floats of 8 bytes are s since it, or s, us or ns since
///         1970 by their size.
///         Points that are not finite, or at the origin, are rays without a return.
/// Throws  InputError where a field is missing, or where the times cannot be those of a scan.
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
