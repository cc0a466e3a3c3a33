#pragma once

#include <string>
#include <vector>

#include "core/error.h"

/// Wording of faults common to many readers. `found` is the value in the file; `need` is the
/// required value.

namespace tera::fault {

InputFault Missing(const std::string& need);
/// A key outside `known`.
InputFault UnknownKey(const std::string& key, const std::vector<std::string>& known);
InputFault RepeatedKey();
/// A choice outside `allowed`.
InputFault NotKnown(const std::string& found, const std::vector<std::string>& allowed);
InputFault NotANumber(const std::string& found, const std::string& need);
InputFault NotAWholeNumber(double found);
InputFault NotABoolean(const std::string& found);
InputFault NotAText(const std::string& found);
/// A value of the wrong type or shape.
InputFault Mistyped(const std::string& found, const std::string& need);
InputFault OutOfRange(const std::string& found, const std::string& need);

/// A CSV row whose length differs from its header's.
InputFault FieldCount(std::size_t found, std::size_t need);
InputFault NoSuchColumn(const std::string& name, const std::vector<std::string>& header);

/// `base` is the file that relative paths refer to.
InputFault NoSuchFile(const std::string& path, const std::string& base);
InputFault CannotBeRead(const std::string& need);
InputFault NotValidYaml(const std::string& reason);
/// A document whose top level is no mapping.
InputFault NotAMapping(const std::string& where = "");
/// A non-empty folder for results.
InputFault NotAnEmptyFolder();

}  // namespace tera::fault
