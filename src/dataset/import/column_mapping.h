#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/config/config.h"
#include "core/time.h"
#include "dataset/import/row_table.h"

/// Conversion of fields of a table or a message to numbers in SI units.

namespace tera {

/// Physical dimension that a value must have; kAny for columns of general tables.
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

/// A unit of a mapping's `unit:`.
struct Unit {
  const char* name;
  Dimension dimension;
  double factor;  ///< SI units per unit
};

/// The unit with that name, or null.
const Unit* FindUnit(std::string_view name);

/// A unit in common notations ("rad s^-1", "°/s", "psi"), in terms of a mapping's units.
struct WrittenUnit {
  const Unit* unit = nullptr;
  double scale = 1.0;  ///< mapping units per written unit
};
/// The unit of that dimension for `text`; nothing for an unknown unit.
std::optional<WrittenUnit> UnitOfText(std::string_view text, Dimension dimension);

/// One column's part in a value.
struct ColumnTerm {
  std::string column;
  double factor = 1.0;
  TimeNs factor_ns = 0;  ///< exact factor of an integer time unit (nanoseconds, microseconds, ...)
  bool in_minutes = false;  ///< 4807.5 is 48 degrees and 7.5 minutes, NMEA's form of angles
  std::string hemisphere;   ///< column with N, S, E or W; empty: none
};

/// value = field * factor + further fields by their factors + offset, or a constant.
struct ColumnMapping {
  std::string column;  ///< empty: the constant `offset`
  double factor = 1.0, offset = 0.0;
  Range allowed;  ///< limits of the value
  /// A field without a number is NaN, and the channel handles it.
  bool may_lack = false;
  std::vector<ColumnTerm> further = {};  ///< further terms of a sum
  bool in_minutes = false;               ///< as in ColumnTerm
  std::string hemisphere = {};

  /// Converts the value to another unit.
  void MultiplyBy(double scale);
  /// All terms of the sum with the first one; none for a constant.
  std::vector<ColumnTerm> Terms() const;
};

/// A mapping's values in one table.
class MappedColumn {
 public:
  /// Throws InputError for a missing column, also in a table without rows.
  MappedColumn(const RowTable& table, const ColumnMapping& mapping);

  const std::vector<ColumnTerm>& terms() const { return terms_; }
  /// Throws InputError for a field without a number and for a value outside the limits.
  double At(std::size_t row) const;

 private:
  /// The field's number in its unit.
  double NumberOf(std::size_t row, std::size_t term) const;

  const RowTable& table_;
  const ColumnMapping& mapping_;
  std::vector<ColumnTerm> terms_;
  std::vector<std::size_t> places_, sides_;  ///< columns of the terms and of their hemispheres
};

/// Reads `{column:, unit:, scale:, offset:, hemisphere:}`, `{constant:}` or `{sum: [...]}` of such.
/// The offset is in SI units. An unknown unit, or one of another dimension, is a fault. A value
/// outside `allowed` is a fault when rows are read.
ColumnMapping ReadColumnMapping(const ConfigMap& config, Dimension dimension,
                                const Range& allowed = {});

/// SI units per mapping's `unit`, which must have the dimension.
double ReadUnitFactor(const ConfigMap& config, Dimension dimension);

}  // namespace tera
