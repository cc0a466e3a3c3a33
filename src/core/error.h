#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

/// Kinds of errors. InputError reports bad external input. InternalError reports a bug in TERA
/// (check.h). A sensor without a measurement is a normal value, never an exception.

namespace tera {

enum class FaultKind {
  kMissing,       ///< a required key, column, part of a file or option is absent
  kUnknown,       ///< a key, column or option that is not defined here
  kNoSuchName,    ///< the named object or choice does not exist
  kRepeated,      ///< a key, name or value occurs twice
  kMistyped,      ///< the value has the wrong type or shape
  kOutOfRange,    ///< a number exceeds its bounds
  kInconsistent,  ///< a value contradicts another value or another file
  kMalformed,     ///< a file or text violates its format: truncated, damaged or another format
  kUnreadable,    ///< a file or folder is absent or unreadable
  kUnwritable,    ///< a place that cannot be written
  kUnsupported,   ///< well-formed, but unsupported by this program, build or computer
};

/// One fault of the input. Programs evaluate kind and place; people read the finding.
struct InputFault {
  FaultKind kind = FaultKind::kInconsistent;
  std::string finding;  ///< the found value, the required value and the remedy
  std::string place;    ///< file:line:column and key path, a file or an option; may be empty

  InputFault(FaultKind kind, std::string finding, std::string place = "")
      : kind(kind), finding(std::move(finding)), place(std::move(place)) {}
  // A finding without a place, about values that contradict each other.
  InputFault(std::string finding) : finding(std::move(finding)) {}  // NOLINT(*-explicit-*)
  InputFault(const char* finding) : finding(finding) {}             // NOLINT(*-explicit-*)

  /// "place: finding", the text that people read.
  std::string Message() const;
  bool operator==(const InputFault&) const = default;
};

/// Bad external input: a scenario, asset, recording, driver or disk. The message has one line per
/// fault, with place, found value, required value and remedy. Only main catches this error; it
/// prints the message and exits with status 2.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message) : InputError(std::vector<InputFault>{message}) {}
  InputError(std::string place, InputFault fault);
  /// `faults` must not be empty.
  explicit InputError(std::vector<InputFault> faults);

  const std::vector<InputFault>& faults() const { return faults_; }
  /// Joins all faults into one finding without a place. The caller adds the place of the faulty
  /// object.
  InputFault AsFinding() const { return {faults_.front().kind, what()}; }

 private:
  std::vector<InputFault> faults_;
};

/// A violated invariant, which is a bug in TERA.
class InternalError : public std::logic_error {
 public:
  explicit InternalError(const std::string& message) : std::logic_error(message) {}
};

}  // namespace tera
