#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "core/error.h"
#include "core/time.h"

namespace tera {

/// Position of a row.
struct RowPlace {
  int line = 0;          ///< in its file, from 1; for a topic, the message's number
  std::size_t file = 0;  ///< index of the joined file
};

/// Rows of named columns: a text file's lines or a bag's messages. Every fault is an InputError
/// with the place, the finding and the need.
class RowTable {
 public:
  virtual ~RowTable() = default;

  virtual std::size_t row_count() const = 0;
  /// Index of a column. Throws for a missing one.
  virtual std::size_t Column(const std::string& name) const = 0;
  /// Number of a row in its file, from 1: a line, or a message of its topic.
  virtual int Line(std::size_t row) const = 0;
  virtual RowPlace Place(std::size_t row) const { return {Line(row), 0}; }
  /// Its index among all rows of the file, including left out ones, from 0.
  virtual std::size_t Ordinal(std::size_t row) const { return row; }
  /// A finite number, or nothing.
  virtual std::optional<double> NumberIfAny(std::size_t row, std::size_t column) const = 0;
  /// A finite number.
  virtual double Number(std::size_t row, std::size_t column) const = 0;
  /// The time in a column of times; nothing in other columns.
  virtual std::optional<TimeNs> Stamp(std::size_t row, std::size_t column) const = 0;
  /// The exact time in a field of digits, with an optional sign and point, in units of this many
  /// nanoseconds, truncated to a nanosecond. Nothing for other fields and for tables without text.
  virtual std::optional<TimeNs> WholeNanoseconds(std::size_t, std::size_t, TimeNs) const {
    return std::nullopt;
  }
  /// The field as text, in a text table.
  virtual std::optional<std::string_view> Text(std::size_t, std::size_t) const {
    return std::nullopt;
  }
  /// Whether a field has a value: neither empty nor a word for "no number".
  virtual bool IsPresent(std::size_t row, std::size_t column) const = 0;
  /// Whether a field equals that of the previous row, which must exist.
  virtual bool Repeats(std::size_t row, std::size_t column) const = 0;
  [[noreturn]] virtual void Fail(std::size_t row, std::size_t column,
                                 const InputFault& fault) const = 0;
};

}  // namespace tera
