#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "core/error.h"
#include "core/time.h"

namespace tera {

struct RowPlace {
  int line = 0;          ///< line of its file, or message of its topic, from 1
  std::size_t file = 0;  ///< index of the file among those concatenated
};

/// Rows with named columns: lines of a text file or messages of a bag. A fault throws InputError
/// with place, found content and required content.
class RowTable {
 public:
  virtual ~RowTable() = default;

  virtual std::size_t row_count() const = 0;
  /// Index of a column. Throws if it is missing.
  virtual std::size_t Column(const std::string& name) const = 0;
  /// Number of the row from 1: a line of the file or a message of the topic.
  virtual int Line(std::size_t row) const = 0;
  virtual RowPlace Place(std::size_t row) const { return {Line(row), 0}; }
  /// Index of the row among all rows of the file, including those left out, from 0.
  virtual std::size_t Ordinal(std::size_t row) const { return row; }
  /// The finite number in a field; nullopt if it has none.
  virtual std::optional<double> NumberIfAny(std::size_t row, std::size_t column) const = 0;
  /// The finite number in a field. Throws if it has none.
  virtual double Number(std::size_t row, std::size_t column) const = 0;
  /// The time in a column of times; nullopt in other columns.
  virtual std::optional<TimeNs> Stamp(std::size_t row, std::size_t column) const = 0;
  /// Exact time of a field that consists of digits with an optional sign and point, in units of the
  /// given number of nanoseconds. Truncated to a nanosecond. Returns nullopt for other fields and
  /// for tables without text.
  virtual std::optional<TimeNs> WholeNanoseconds(std::size_t, std::size_t, TimeNs) const {
    return std::nullopt;
  }
  /// Text of a field; nullopt unless the table is a text table.
  virtual std::optional<std::string_view> Text(std::size_t, std::size_t) const {
    return std::nullopt;
  }
  /// True if the field has a value: it is neither empty nor a word that means no number.
  virtual bool IsPresent(std::size_t row, std::size_t column) const = 0;
  /// True if the field equals that of the previous row, which must exist.
  virtual bool Repeats(std::size_t row, std::size_t column) const = 0;
  [[noreturn]] virtual void Fail(std::size_t row, std::size_t column,
                                 const InputFault& fault) const = 0;
};

}  // namespace tera
