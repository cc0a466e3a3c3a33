#pragma once

#include <string>
#include <vector>

#include "core/error.h"

/// The wording of faults that many readers find. `found` is a value as it stands in the file,
/// `need` what should stand there.

namespace tera::fault {

InputFault Missing(const std::string& need);
/// A key that is none of `known`.
InputFault UnknownKey(const std::string& key, const std::vector<std::string>& known);
InputFault RepeatedKey();
/// A choice that is none of `allowed`.
InputFault NotKnown(const std::string& found, const std::vector<std::string>& allowed);
InputFault NotANumber(const std::string& found, const std::string& need);
InputFault NotAWholeNumber(double found);
InputFault NotABoolean(const std::string& found);
InputFault NotAText(const std::string& found);
/// A value of another type or shape than needed.
InputFault Mistyped(const std::string& found, const std::string& need);
InputFault OutOfRange(const std::string& found, const std::string& need);

/// A CSV file's row of another length than its header.
InputFault FieldCount(std::size_t found, std::size_t need);
InputFault NoSuchColumn(const std::string& name, const std::vector<std::string>& header);

/// `base` is the file that a relative path is relative to.
InputFault NoSuchFile(const std::string& path, const std::string& base);
InputFault CannotBeRead(const std::string& need);
InputFault NotValidYaml(const std::string& reason);
/// A document that is no mapping at its top.
InputFault NotAMapping(const std::string& where = "");
/// A folder for results that has something in it.
InputFault NotAnEmptyFolder();

}  // namespace tera::fault
