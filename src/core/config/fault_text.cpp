#include "core/config/fault_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/config/spelling.h"

namespace tera::fault {

using enum FaultKind;

InputFault Missing(const std::string& need) {
  return {kMissing, fmt::format("missing, need {}", need)};
}

InputFault UnknownKey(const std::string& key, const std::vector<std::string>& known) {
  const std::string near = DidYouMean(key, known);
  return {kUnknown,
          "unknown key" +
              (near.empty() ? fmt::format("; known here: {}", fmt::join(known, ", ")) : near)};
}

InputFault RepeatedKey() { return {kRepeated, "repeated key; keep one"}; }

InputFault NotKnown(const std::string& found, const std::vector<std::string>& allowed) {
  return {kNoSuchName, fmt::format("'{}' is not known, need one of {}{}", found,
                                   fmt::join(allowed, ", "), DidYouMean(found, allowed))};
}

InputFault NotANumber(const std::string& found, const std::string& need) {
  return {kMistyped, fmt::format("{} is not a number, need {}", found, need)};
}

InputFault NotAWholeNumber(double found) {
  return {kMistyped, fmt::format("{} is not a whole number", found)};
}

InputFault NotABoolean(const std::string& found) {
  return {kMistyped, fmt::format("{} is neither true nor false", found)};
}

InputFault NotAText(const std::string& found) {
  return {kMistyped, fmt::format("{} is not a text", found)};
}

InputFault Mistyped(const std::string& found, const std::string& need) {
  return {kMistyped, fmt::format("{} found, need {}", found, need)};
}

InputFault OutOfRange(const std::string& found, const std::string& need) {
  return {kOutOfRange, fmt::format("{} is out of range, need {}", found, need)};
}

InputFault FieldCount(std::size_t found, std::size_t need) {
  return {kMalformed, fmt::format("{} fields, need {} as in the first line", found, need)};
}

InputFault NoSuchColumn(const std::string& name, const std::vector<std::string>& header) {
  return {kMissing, fmt::format("no column '{}'{}; it has {}", name, DidYouMean(name, header),
                                fmt::join(header, ", "))};
}

InputFault NoSuchFile(const std::string& path, const std::string& base) {
  return {kUnreadable, fmt::format("file '{}' does not exist; correct the path (relative to {}, or "
                                   "'tera:...' for a file that TERA ships)",
                                   path, base)};
}

InputFault CannotBeRead(const std::string& need) {
  return {kUnreadable, fmt::format("cannot be read; need {}", need)};
}

InputFault NotValidYaml(const std::string& reason) {
  return {kMalformed, fmt::format("not valid YAML: {}", reason)};
}

InputFault NotAMapping(const std::string& where) {
  return {kMalformed, "need a mapping of keys" + (where.empty() ? "" : " " + where)};
}

InputFault NotAnEmptyFolder() {
  return {kUnwritable, "is not an empty directory; choose another place or delete it"};
}

}  // namespace tera::fault
