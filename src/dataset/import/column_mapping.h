#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/config/config.h"
#include "core/time.h"
#include "dataset/import/row_table.h"

/// Conversion of fields of a table or message to numbers in SI units.

namespace tera {

/// Physical dimension that a value must have. kAny is for columns of general tables.
enum class Dimension {
  kAny,
  kTime,
  kLength,
  kAngle,
  kSpeed,
  kRate,
  kAcceleration,
  kVariance,
  kForce,
  kTorque,
  kPressure,
  kNone
};

/// A unit that the key `unit` accepts.
struct Unit {
  const char* name;
  Dimension dimension;
  double factor;  ///< SI units per unit
};

/// The unit with this name; null if unknown.
const Unit* FindUnit(std::string_view name);

/// A unit in other notations ("rad s^-1", "°/s", "psi"), expressed by a unit of the mapping.
struct WrittenUnit {
  const Unit* unit = nullptr;
  double scale = 1.0;  ///< mapping units per written unit
};
/// Parses `text` as a unit of the dimension; nullopt if unknown.
std::optional<WrittenUnit> UnitOfText(std::string_view text, Dimension dimension);

/// Contribution of one column to a value.
struct ColumnTerm {
  std::string column;
  double factor = 1.0;
  TimeNs factor_ns = 0;     ///< exact factor of an integer unit of time, such as a microsecond
  bool in_minutes = false;  ///< NMEA notation of angles: 4807.5 is 48 degrees and 7.5 minutes
  std::string hemisphere;   ///< column with N, S, E or W; empty if none
};

/// value = field * factor + further terms + offset, or a constant.
struct ColumnMapping {
  std::string column;  ///< empty for the constant `offset`
  double factor = 1.0, offset = 0.0;
  Range allowed;  ///< allowed range of the value
  /// If true, a field without a number becomes NaN and the channel handles it.
  bool may_lack = false;
  std::vector<ColumnTerm> further = {};  ///< further terms of the sum
  bool in_minutes = false;               ///< as in ColumnTerm
  std::string hemisphere = {};

  /// Multiplies the value by a factor, for another unit.
  void MultiplyBy(double scale);
  /// All terms of the sum, including the first; empty for a constant.
  std::vector<ColumnTerm> Terms() const;
};

/// Applies a ColumnMapping to a table.
class MappedColumn {
 public:
  /// Throws InputError for a missing column, even if the table has no rows.
  MappedColumn(const RowTable& table, const ColumnMapping& mapping);

  const std::vector<ColumnTerm>& terms() const { return terms_; }
  /// Throws InputError if the field holds no number or the value is out of range.
  double At(std::size_t row) const;

 private:
  /// The number of the field, before conversion.
  double NumberOf(std::size_t row, std::size_t term) const;

  const RowTable& table_;
  const ColumnMapping& mapping_;
  std::vector<ColumnTerm> terms_;
  std::vector<std::size_t> places_, sides_;  ///< column indices of the terms and of their
                                             ///< hemispheres
};

/// Reads `{column:, unit:, scale:, offset:, hemisphere:}`, `{constant:}`, or `{sum: [...]}` with
/// several of the first. The offset is in SI units. An unknown unit or a unit of another dimension
/// is a fault. Values outside `allowed` are reported when rows are read.
ColumnMapping ReadColumnMapping(const ConfigMap& config, Dimension dimension,
                                const Range& allowed = {});

/// SI units per unit of the key `unit`, which must have the dimension.
double ReadUnitFactor(const ConfigMap& config, Dimension dimension);

}  // namespace tera
