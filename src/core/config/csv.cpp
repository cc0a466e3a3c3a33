#include "core/config/csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <string_view>

#include "core/config/fault_text.h"
#include "core/parse_number.h"
#include "core/split_text.h"

namespace tera {
namespace {

void TrimCarriageReturn(std::string* line) {
  if (!line->empty() && line->back() == '\r') line->pop_back();
}

std::ifstream Open(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) {
    throw InputError(file.string(), fault::CannotBeRead("a CSV file"));
  }
  return stream;
}

std::vector<std::string> HeaderOf(std::istream& stream, const std::filesystem::path& file) {
  std::string line;
  if (!std::getline(stream, line)) {
    throw InputError(file.string() + ":1",
                     {FaultKind::kMalformed, "empty; need a line of column names"});
  }
  TrimCarriageReturn(&line);
  std::vector<std::string> names;
  for (const std::string_view field : PartsOf(line, ',')) names.emplace_back(field);
  return names;
}

double ParseField(std::string_view text, const std::filesystem::path& file, std::size_t line,
                  const std::string& column) {
  const auto value = ParseFinite(text);
  if (!value) {
    throw InputError(fmt::format("{}:{}: {}", file.string(), line, column),
                     {FaultKind::kMistyped,
                      fmt::format("'{}' is not a finite number; correct or remove the row", text)});
  }
  return *value;
}

}  // namespace

std::vector<std::string> ReadCsvHeader(const std::filesystem::path& file) {
  std::ifstream stream = Open(file);
  return HeaderOf(stream, file);
}

std::vector<std::vector<double>> ReadCsvColumns(const std::filesystem::path& file,
                                                const std::vector<std::string>& names) {
  std::ifstream stream = Open(file);
  const std::vector<std::string> header = HeaderOf(stream, file);
  std::vector<std::size_t> places;
  for (const std::string& name : names) {
    const auto found = std::find(header.begin(), header.end(), name);
    if (found == header.end()) {
      throw InputError(file.string() + ":1", fault::NoSuchColumn(name, header));
    }
    places.push_back(found - header.begin());
  }
  std::vector<std::vector<double>> columns(names.size());
  std::string line;
  for (std::size_t number = 2; std::getline(stream, line); ++number) {
    TrimCarriageReturn(&line);
    const auto fields = PartsOf(line, ',');
    if (fields.size() != header.size()) {
      throw InputError(fmt::format("{}:{}", file.string(), number),
                       fault::FieldCount(fields.size(), header.size()));
    }
    for (std::size_t c = 0; c < names.size(); ++c) {
      columns[c].push_back(ParseField(fields[places[c]], file, number, names[c]));
    }
  }
  return columns;
}

}  // namespace tera
