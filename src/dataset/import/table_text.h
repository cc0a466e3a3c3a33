#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Text of a foreign table: its characters, records, fields and numbers.

namespace tera {

/// A file's text as UTF-8 with '\n' or "\r\n" behind its lines: UTF-16 is known by its byte order
/// mark or by the zero bytes of its first characters; bytes that are no UTF-8 are taken for ISO
/// 8859-1, where 0xb0 is the degree sign. Marks of byte order are left out.
std::string DecodedTable(std::string bytes);

/// Takes the next record off `rest`, without its end, and says in how many lines it stands: more
/// than one where a field in quotes goes on behind the end of a line.
std::string_view TakeRecord(std::string_view* rest, int* lines);

/// Fields of a record, without blanks and quotes around them. Blanks separate in any number; of
/// other separators those within quotes are none.
std::vector<std::string_view> FieldsOfRecord(std::string_view record, char separator);

/// The one of tab, semicolon, bar, comma and blanks that a line has, the first of these.
char SeparatorOfLine(std::string_view line);

/// Without blanks at both ends.
std::string_view TrimmedText(std::string_view text);

/// Whether a record without blanks around it is a remark: it begins with '#' or '%'.
bool IsRemark(std::string_view record);

/// How numbers are written.
struct NumberForm {
  char decimal = '.';
  char thousands = 0;  ///< between digits before the decimal sign; 0: nothing
  bool is_plain() const { return decimal == '.' && thousands == 0; }
};

/// The number as with a decimal point; `room` holds it where it is written in another form.
std::string_view PlainNumberText(std::string_view field, const NumberForm& form, std::string* room);
/// A finite number that makes up the whole field.
std::optional<double> NumberOfField(std::string_view field, const NumberForm& form);

/// Whether a field is empty, or says in the words of some program that there is no number: nan,
/// NULL, N/A, #VALUE!, 1.#QNAN, --.
bool SaysNothing(std::string_view field);

}  // namespace tera
