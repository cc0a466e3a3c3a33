#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "dataset/import/scans/revolution.h"

namespace tera {

/// One field of the points of a message or a file.
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

/// What a mapping says of points whose fields do not tell it.
struct PointForm {
  enum class Stamp { kUnknown, kFirst, kLast };
  Stamp stamp = Stamp::kUnknown;         ///< the ray of which the scan's stamp is the time
  std::optional<double> duration_s;      ///< from the first ray to the last
  std::string time_field;                ///< empty: by its name
  std::optional<double> time_unit_s;     ///< of the time field; none: by its type and size
  std::optional<double> full_intensity;  ///< of the file; none: by its type
};

/// Makes a scan of records.
///
/// Frames  that of the file, in metres; TERA's S where the mapping's mount is that of the file's
///         frame.
/// Model   x, y, z; intensity or reflectivity, of 8 bits over 255, others over `full_intensity`,
///         without which they must lie in 0 to 1; ring, line, channel or laser_id; time of t, time,
///         timestamp, time_stamp or offset_time: whole numbers are ns since the stamp, floats of 4
///         bytes s since it, of 8 bytes s since it, or s, us or ns since 1970 by their size. Points
///         that are not finite, or at the origin, are rays without a return.
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
