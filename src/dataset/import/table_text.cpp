#include "dataset/import/table_text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>

#include "core/config/spelling.h"
#include "core/parse_number.h"

namespace tera {
namespace {

constexpr std::string_view kBlanksOfTables = " \t";
constexpr std::string_view kSeparatorsOfTables = "\t;|,";

void AppendUtf8(char32_t c, std::string* text) {
  const auto add = [&](char32_t byte) { text->push_back(static_cast<char>(byte)); };
  const auto rest = [&](int shift) { add(0x80 | (c >> shift & 0x3f)); };
  if (c < 0x80) return add(c);
  if (c < 0x800) {
    add(0xc0 | c >> 6);
  } else if (c < 0x10000) {
    add(0xe0 | c >> 12);
    rest(6);
  } else {
    add(0xf0 | c >> 18);
    rest(12);
    rest(6);
  }
  rest(0);
}

unsigned ByteAt(std::string_view bytes, std::size_t at) {
  return static_cast<unsigned char>(bytes[at]);
}

std::string OfUtf16(std::string_view bytes, bool big_endian) {
  std::string text;
  text.reserve(bytes.size() / 2);
  const auto unit = [&](std::size_t at) {
    return static_cast<char32_t>(big_endian ? ByteAt(bytes, at) << 8 | ByteAt(bytes, at + 1)
                                            : ByteAt(bytes, at + 1) << 8 | ByteAt(bytes, at));
  };
  constexpr char32_t kHigh = 0xd800, kLow = 0xdc00, kBeyond = 0xe000, kMark = 0xfeff;
  for (std::size_t at = 0; at + 1 < bytes.size(); at += 2) {
    char32_t c = unit(at);
    if (c >= kHigh && c < kLow && at + 3 < bytes.size() && unit(at + 2) >= kLow &&
        unit(at + 2) < kBeyond) {
      c = 0x10000 + ((c - kHigh) << 10) + (unit(at + 2) - kLow);
      at += 2;
    }
    if (c != kMark) AppendUtf8(c, &text);
  }
  return text;
}

/// True if all bytes outside ASCII form valid UTF-8 characters.
bool IsUtf8(std::string_view bytes) {
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    const unsigned first = ByteAt(bytes, at);
    if (first < 0x80) continue;
    const std::size_t more = first >= 0xf0 ? 3 : first >= 0xe0 ? 2 : first >= 0xc2 ? 1 : 0;
    if (more == 0 || first > 0xf4 || at + more >= bytes.size()) return false;
    for (std::size_t k = 1; k <= more; ++k) {
      if ((ByteAt(bytes, at + k) & 0xc0) != 0x80) return false;
    }
    at += more;
  }
  return true;
}

/// End of a record that contains quotes; nullopt if a quote is not closed within the limit.
std::optional<std::size_t> EndOfQuotedRecord(std::string_view rest, int* lines) {
  constexpr int kMostLines = 20;  // lines; a longer quote is an inch sign or a mistake
  bool quoted = false, at_start = true;
  *lines = 1;
  for (std::size_t k = 0; k < rest.size(); ++k) {
    const char c = rest[k];
    if (c == '\n' && (!quoted || ++*lines > kMostLines)) {
      return quoted ? std::nullopt : std::optional(k);
    }
    if (quoted) {
      quoted = c != '"';
    } else if (c == '"') {
      // Two quotes in a row stand for a literal quote.
      quoted = at_start || (k > 0 && rest[k - 1] == '"');
    }
    at_start = kSeparatorsOfTables.find(c) != kSeparatorsOfTables.npos || c == '\n' ||
               (at_start && c == ' ');
  }
  return quoted ? std::nullopt : std::optional(rest.size());
}

std::string_view WithoutQuotes(std::string_view field) {
  field = TrimmedText(field);
  if (field.size() >= 2 && field.front() == '"' && field.back() == '"') {
    field = TrimmedText(field.substr(1, field.size() - 2));
  }
  return field;
}

}  // namespace

std::string DecodedTable(std::string bytes) {
  constexpr std::string_view kMark = "\xef\xbb\xbf";
  if (bytes.starts_with(kMark)) {
    bytes.erase(0, kMark.size());
  } else if (bytes.size() >= 4) {
    // A table begins with ASCII characters. In UTF-16 each of them contains a zero byte.
    const bool is_little = bytes.starts_with("\xff\xfe") || (bytes[1] == 0 && bytes[3] == 0);
    const bool is_big = bytes.starts_with("\xfe\xff") || (bytes[0] == 0 && bytes[2] == 0);
    if (is_little != is_big) bytes = OfUtf16(bytes, is_big);
  }
  if (!IsUtf8(bytes)) {
    std::string text;
    text.reserve(bytes.size() + bytes.size() / 8);
    for (const char c : bytes) AppendUtf8(static_cast<unsigned char>(c), &text);
    bytes = std::move(text);
  }
  if (bytes.find('\n') == std::string::npos) std::replace(bytes.begin(), bytes.end(), '\r', '\n');
  return bytes;
}

std::string_view TakeRecord(std::string_view* rest, int* lines) {
  std::size_t end = std::min(rest->find('\n'), rest->size());
  *lines = 1;
  if (rest->substr(0, end).find('"') != std::string_view::npos) {
    int quoted_lines = 1;
    if (const auto quoted_end = EndOfQuotedRecord(*rest, &quoted_lines)) {
      end = *quoted_end;
      *lines = quoted_lines;
    }
  }
  std::string_view record = rest->substr(0, end);
  rest->remove_prefix(std::min(end + 1, rest->size()));
  if (record.ends_with('\r')) record.remove_suffix(1);
  return record;
}

std::vector<std::string_view> FieldsOfRecord(std::string_view record, char separator) {
  const bool by_blanks = separator == ' ';
  if (by_blanks) record = TrimmedText(record);
  std::vector<std::string_view> fields;
  std::size_t begin = 0;
  bool quoted = false, at_start = true;
  for (std::size_t k = 0; k <= record.size(); ++k) {
    const bool at_end = k == record.size();
    if (!at_end && record[k] == '"') {
      const bool opens = at_start || (k > begin && record[k - 1] == '"');
      quoted = !quoted && opens;
      at_start = false;
      continue;
    }
    const bool ends =
        at_end || (!quoted && (record[k] == separator || (by_blanks && record[k] == '\t')));
    if (!ends) {
      at_start = at_start && record[k] == ' ';
      continue;
    }
    if (!by_blanks || k > begin) fields.push_back(WithoutQuotes(record.substr(begin, k - begin)));
    begin = k + 1;
    at_start = true;
  }
  return fields;
}

char SeparatorOfLine(std::string_view line) {
  for (const char separator : kSeparatorsOfTables) {
    if (line.find(separator) != std::string_view::npos) return separator;
  }
  return ' ';
}

std::string_view TrimmedText(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanksOfTables);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanksOfTables) - first + 1);
}

bool IsRemark(std::string_view record) {
  return record.starts_with('#') || record.starts_with('%');
}

std::string_view PlainNumberText(std::string_view field, const NumberForm& form,
                                 std::string* room) {
  if (field.starts_with('+')) field.remove_prefix(1);
  if (form.is_plain()) return field;
  // The thousands separator may be a no-break space, which has two or three bytes in UTF-8.
  constexpr std::string_view kNoBreak = "\xc2\xa0", kNarrow = "\xe2\x80\xaf";
  room->clear();
  bool before_decimal = true, is_grouped = false;
  int group = 0;  // number of digits since the last thousands separator
  const auto group_is_whole = [&] { return !is_grouped || group == 3; };
  for (std::size_t k = 0; k < field.size(); ++k) {
    const std::string_view here = field.substr(k);
    std::size_t gap = 0;  // bytes of a thousands separator at this place
    if (before_decimal && form.thousands != 0) {
      gap = field[k] == form.thousands                            ? 1
            : form.thousands == ' ' && here.starts_with(kNoBreak) ? kNoBreak.size()
            : form.thousands == ' ' && here.starts_with(kNarrow)  ? kNarrow.size()
                                                                  : 0;
    }
    if (gap > 0) {
      if (group == 0 || !group_is_whole()) return {};  // not a number
      is_grouped = true;
      group = 0;
      k += gap - 1;
    } else if (field[k] == form.decimal) {
      if (!group_is_whole()) return {};
      before_decimal = false;
      room->push_back('.');
    } else if (field[k] == '.') {
      return {};
    } else {
      if (before_decimal && std::isdigit(static_cast<unsigned char>(field[k])) != 0) ++group;
      room->push_back(field[k]);
    }
  }
  return before_decimal && !group_is_whole() ? std::string_view{} : std::string_view(*room);
}

std::optional<double> NumberOfField(std::string_view field, const NumberForm& form) {
  std::string room;
  return ParseFinite(PlainNumberText(field, form, &room));
}

bool SaysNothing(std::string_view field) {
  constexpr std::array<std::string_view, 20> kWords = {
      "nan",     "null",    "n/a",    "na",      "#n/a",     "#num!",     "#value!",
      "#div/0!", "1.#qnan", "1.#ind", "1.#snan", "nan(ind)", "nan(snan)", "none",
      "nil",     "-",       "--",     "---",     "?",        "missing"};
  if (field.empty()) return true;
  constexpr std::size_t kLongest = 9;
  if (field.size() > 1 && (field.front() == '-' || field.front() == '+') &&
      std::isalnum(static_cast<unsigned char>(field[1])) != 0) {
    field.remove_prefix(1);
  }
  if (field.size() > kLongest || std::isdigit(static_cast<unsigned char>(field.back())) != 0) {
    return false;
  }
  const std::string lower = LowerCase(std::string(field));
  return std::find(kWords.begin(), kWords.end(), lower) != kWords.end();
}

}  // namespace tera
