#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

/// The three kinds of error, and no fourth: InputError (bad input from outside), InternalError (our
/// own bug, see check.h), and "no measurement", which is data and never an exception.

namespace tera {

enum class FaultKind {
  kMissing,       ///< a key, column, file's part or option that must be there
  kUnknown,       ///< a key, column or option that means nothing there
  kNoSuchName,    ///< a value that names a thing, or one of a choice, that does not exist
  kRepeated,      ///< a key, a name or a value that stands twice
  kMistyped,      ///< a value of another type or shape than needed
  kOutOfRange,    ///< a number beyond its bounds
  kInconsistent,  ///< contradicts another value, or the other file
  kMalformed,    ///< a file or a text that is not as its format says: cut off, damaged, another one
  kUnreadable,   ///< a file or folder that is not there or cannot be read
  kUnwritable,   ///< a place that nothing can be written to
  kUnsupported,  ///< well formed, but not for this program, its build, or this computer
};

/// One fault of the input. Its kind and place tell programs what is wrong; the finding is
/// for people.
struct InputFault {
  FaultKind kind = FaultKind::kInconsistent;
  std::string finding;  ///< what was found, what is needed, and the remedy
  std::string place;    ///< file:line:column and key path, or a file, or an option; may be empty

  InputFault(FaultKind kind, std::string finding, std::string place = "")
      : kind(kind), finding(std::move(finding)), place(std::move(place)) {}
  // A finding alone, of values that contradict each other.
  InputFault(std::string finding) : finding(std::move(finding)) {}  // NOLINT(*-explicit-*)
  InputFault(const char* finding) : finding(finding) {}             // NOLINT(*-explicit-*)

  /// "place: finding", as people read it.
  std::string Message() const;
  bool operator==(const InputFault&) const = default;
};

/// Bad input from outside: scenario, asset, recording, driver, disk. The message is complete, a
/// line for each fault: where, what was found, what is needed, and the remedy. Caught once, in
/// main, which prints it and exits with status 2.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message) : InputError(std::vector<InputFault>{message}) {}
  InputError(std::string place, InputFault fault);
  /// At least one fault.
  explicit InputError(std::vector<InputFault> faults);

  const std::vector<InputFault>& faults() const { return faults_; }
  /// All of it as one finding, to be told at the place that names the faulty thing.
  InputFault AsFinding() const { return {faults_.front().kind, what()}; }

 private:
  std::vector<InputFault> faults_;
};

/// A broken invariant of TERA itself.
class InternalError : public std::logic_error {
 public:
  explicit InternalError(const std::string& message) : std::logic_error(message) {}
};

}  // namespace tera
