#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "core/error.h"
#include "core/time.h"

namespace tera {

/// Where a row stands.
struct RowPlace {
  int line = 0;          ///< in its file, from 1; of a topic, the message's number
  std::size_t file = 0;  ///< of several that were joined
};

/// Rows of named columns: a text file's lines or a bag's messages. Every fault is an InputError
/// that says where, what was found and what is needed.
class RowTable {
 public:
  virtual ~RowTable() = default;

  virtual std::size_t row_count() const = 0;
  /// Index of a column. Throws for a missing one.
  virtual std::size_t Column(const std::string& name) const = 0;
  /// Number of a row in its file: a line, or a message of its topic, from 1.
  virtual int Line(std::size_t row) const = 0;
  virtual RowPlace Place(std::size_t row) const { return {Line(row), 0}; }
  /// Its number among all rows of the file, those that were left out too, from 0.
  virtual std::size_t Ordinal(std::size_t row) const { return row; }
  /// A finite number, or nothing where the field is none.
  virtual std::optional<double> NumberIfAny(std::size_t row, std::size_t column) const = 0;
  /// A finite number.
  virtual double Number(std::size_t row, std::size_t column) const = 0;
  /// Of a column that holds times, the time; of others none.
  virtual std::optional<TimeNs> Stamp(std::size_t row, std::size_t column) const = 0;
  /// Of a field that digits make up, with a sign and a point at most, the time in units of so many
  /// nanoseconds exactly, cut off at a nanosecond; nothing of others and of tables without texts.
  virtual std::optional<TimeNs> WholeNanoseconds(std::size_t, std::size_t, TimeNs) const {
    return std::nullopt;
  }
  /// The field as text, of a table that is made of texts.
  virtual std::optional<std::string_view> Text(std::size_t, std::size_t) const {
    return std::nullopt;
  }
  /// Whether a field holds anything: neither nothing nor a word for "no number".
  virtual bool IsPresent(std::size_t row, std::size_t column) const = 0;
  /// Whether a field is that of the row before, which there must be.
  virtual bool Repeats(std::size_t row, std::size_t column) const = 0;
  [[noreturn]] virtual void Fail(std::size_t row, std::size_t column,
                                 const InputFault& fault) const = 0;
};

}  // namespace tera
