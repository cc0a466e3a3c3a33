#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/config/config.h"
#include "core/time.h"
#include "dataset/import/row_table.h"

/// How fields of a table or of a message become numbers in SI units.

namespace tera {

/// Physical dimension that a value must have; kAny for tables, whose columns may be anything.
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
  double factor;  ///< SI units in one of it
};

/// The unit of that name; none where there is none.
const Unit* FindUnit(std::string_view name);

/// A unit as people and programs write it, "rad s^-1", "°/s", "psi", in units that a mapping has.
struct WrittenUnit {
  const Unit* unit = nullptr;
  double scale = 1.0;  ///< of such a unit in one that is written
};
/// The unit of that dimension that `text` means; none where it is no unit that is known.
std::optional<WrittenUnit> UnitOfText(std::string_view text, Dimension dimension);

/// One column's part in a value.
struct ColumnTerm {
  std::string column;
  double factor = 1.0;
  TimeNs factor_ns = 0;     ///< of a time in whole nanoseconds, microseconds, ...: one of its unit
  bool in_minutes = false;  ///< 4807.5 is 48 degrees and 7.5 minutes, as NMEA writes angles
  std::string hemisphere;   ///< the column that says N, S, E or W; empty: none
};

/// value = field * factor + further fields by their factors + offset, or a constant.
struct ColumnMapping {
  std::string column;  ///< empty: the constant `offset`
  double factor = 1.0, offset = 0.0;
  Range allowed;  ///< of the value
  /// A field without a number is taken as it is, as NaN: the channel knows what to make of it.
  bool may_lack = false;
  std::vector<ColumnTerm> further = {};  ///< of a sum
  bool in_minutes = false;               ///< as of ColumnTerm
  std::string hemisphere = {};

  /// The same value in other units.
  void MultiplyBy(double scale);
  /// All terms of the sum, the first one too; none where the value is a constant.
  std::vector<ColumnTerm> Terms() const;
};

/// A mapping's values in one table.
class MappedColumn {
 public:
  /// Throws InputError where a column is missing, also of a table without rows.
  MappedColumn(const RowTable& table, const ColumnMapping& mapping);

  const std::vector<ColumnTerm>& terms() const { return terms_; }
  /// Throws InputError for a field without a number and for a value that is not allowed.
  double At(std::size_t row) const;

 private:
  /// The field's number in its unit.
  double NumberOf(std::size_t row, std::size_t term) const;

  const RowTable& table_;
  const ColumnMapping& mapping_;
  std::vector<ColumnTerm> terms_;
  std::vector<std::size_t> places_, sides_;  ///< of the terms' columns and of their hemispheres
};

/// Reads `{column:, unit:, scale:, offset:, hemisphere:}`, `{constant:}` or `{sum: [...]}` of such.
/// The offset is in SI units. An unknown unit, or one of another dimension, is a fault; so is, when
/// rows are read, a value that is not `allowed`.
ColumnMapping ReadColumnMapping(const ConfigMap& config, Dimension dimension,
                                const Range& allowed = {});

/// SI units in one of the mapping's `unit`, which must have the dimension.
double ReadUnitFactor(const ConfigMap& config, Dimension dimension);

}  // namespace tera
