#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Text of a table: characters, records, fields and numbers.

namespace tera {

/// Converts the content of a file to UTF-8, with '\n' or "\r\n" as line ends. UTF-16 is recognised
/// by its byte order mark or by zero bytes among the first characters. Text that is not valid UTF-8
/// is read as ISO 8859-1, where 0xb0 is the degree sign. Byte order marks are removed.
std::string DecodedTable(std::string bytes);

/// Removes the next record from `rest` and returns it without its line end. `lines` receives its
/// number of lines, which exceeds one if a quoted field contains line ends.
std::string_view TakeRecord(std::string_view* rest, int* lines);

/// Fields of a record, without surrounding blanks and quotes. With a blank as separator, several
/// blanks count as one. Separators within quotes do not count.
std::vector<std::string_view> FieldsOfRecord(std::string_view record, char separator);

/// The first of tab, semicolon, bar, comma and blank that occurs in the line.
char SeparatorOfLine(std::string_view line);

/// The text without blanks at both ends.
std::string_view TrimmedText(std::string_view text);

/// True for a comment: a trimmed record that begins with '#' or '%'.
bool IsRemark(std::string_view record);

struct NumberForm {
  char decimal = '.';
  char thousands = 0;  ///< thousands separator; 0: none
  bool is_plain() const { return decimal == '.' && thousands == 0; }
};

/// The number with a decimal point and without thousands separators. `room` stores the converted
/// text.
std::string_view PlainNumberText(std::string_view field, const NumberForm& form, std::string* room);
/// Parses the whole field as a finite number.
std::optional<double> NumberOfField(std::string_view field, const NumberForm& form);

/// True for an empty field and for words that mean no number: nan, NULL, N/A, #VALUE!, 1.#QNAN, --.
bool SaysNothing(std::string_view field);

}  // namespace tera
