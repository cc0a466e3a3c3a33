#pragma once

#include <stdexcept>
#include <string>

/// The three kinds of error, and no fourth: InputError (bad input from outside), InternalError (our
/// own bug, see check.h), and "no measurement", which is data and never an exception.

namespace tera {

/// Bad input from outside: scenario, asset, recording, driver, disk. The message is complete: where
/// (file:line:column and key path), what was found, what is needed, and the remedy. Caught once, in
/// main, which prints it and exits with status 2.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message) : std::runtime_error(message) {}
};

/// A broken invariant of TERA itself.
class InternalError : public std::logic_error {
 public:
  explicit InternalError(const std::string& message) : std::logic_error(message) {}
};

}  // namespace tera
