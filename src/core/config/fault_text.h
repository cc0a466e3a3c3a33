#pragma once

#include <string>
#include <vector>

#include "core/error.h"

/// Faults that many readers report, with uniform wording. `found` is the value in the file; `need`
/// describes the required value.

namespace tera::fault {

InputFault Missing(const std::string& need);
/// The key is not in `known`.
InputFault UnknownKey(const std::string& key, const std::vector<std::string>& known);
InputFault RepeatedKey();
/// The value is not in `allowed`.
InputFault NotKnown(const std::string& found, const std::vector<std::string>& allowed);
InputFault NotANumber(const std::string& found, const std::string& need);
InputFault NotAWholeNumber(double found);
InputFault NotABoolean(const std::string& found);
InputFault NotAText(const std::string& found);
/// The value has the wrong type or shape.
InputFault Mistyped(const std::string& found, const std::string& need);
InputFault OutOfRange(const std::string& found, const std::string& need);

/// A CSV row with another number of fields than the header.
InputFault FieldCount(std::size_t found, std::size_t need);
InputFault NoSuchColumn(const std::string& name, const std::vector<std::string>& header);

/// `base` is the file in which the relative path is written.
InputFault NoSuchFile(const std::string& path, const std::string& base);
InputFault CannotBeRead(const std::string& need);
InputFault NotValidYaml(const std::string& reason);
/// A document whose top level is not a mapping.
InputFault NotAMapping(const std::string& where = "");
/// A folder for results that already contains files.
InputFault NotAnEmptyFolder();

}  // namespace tera::fault
