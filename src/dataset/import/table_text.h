#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Text of a foreign table: its characters, records, fields and numbers.

namespace tera {

/// A file's text as UTF-8 with '\n' or "\r\n" line ends. UTF-16 is identified by its byte order
/// mark or by the zero bytes of its first characters. Other bytes than UTF-8 are ISO 8859-1, where
/// 0xb0 is the degree sign. Byte order marks are removed.
std::string DecodedTable(std::string bytes);

/// Takes the next record off `rest`, without its end, and counts its lines: more than one if a
/// quoted field contains line ends.
std::string_view TakeRecord(std::string_view* rest, int* lines);

/// Fields of a record, without surrounding blanks and quotes. Any number of blanks is one
/// separator; other separators do not count within quotes.
std::vector<std::string_view> FieldsOfRecord(std::string_view record, char separator);

/// The first of tab, semicolon, bar, comma and blanks that occurs in a line.
char SeparatorOfLine(std::string_view line);

/// The text without blanks at both ends.
std::string_view TrimmedText(std::string_view text);

/// Whether a trimmed record is a remark: it begins with '#' or '%'.
bool IsRemark(std::string_view record);

/// Notation of numbers.
struct NumberForm {
  char decimal = '.';
  char thousands = 0;  ///< thousands separator; 0: none
  bool is_plain() const { return decimal == '.' && thousands == 0; }
};

/// The number with a decimal point; `room` is storage for a converted notation.
std::string_view PlainNumberText(std::string_view field, const NumberForm& form, std::string* room);
/// The finite number of a whole field.
std::optional<double> NumberOfField(std::string_view field, const NumberForm& form);

/// Whether a field is empty, or is a program's word for no number: nan, NULL, N/A, #VALUE!,
/// 1.#QNAN, --.
bool SaysNothing(std::string_view field);

}  // namespace tera
