#include "dataset/format/row_scan.h"
#include "dataset/import/csv_file.h"
#include "untrusted_file.h"

// Foreign tables, with and without a header, with every field requested as a number; and TERA's
// own.

namespace {

void AskForAll(const tera::CsvFile& csv) {
  for (std::size_t row = 0; row < csv.row_count(); ++row) {
    for (std::size_t column = 0; column < csv.columns().size(); ++column) {
      csv.NumberIfAny(row, column);
      csv.WholeNanoseconds(row, column, 1'000'000'000);
      csv.IsPresent(row, column);
      if (row > 0) csv.Repeats(row, column);
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  for (const bool has_header : {false, true}) {
    tera::ReadAsFile("log.csv", data, size, [&](const std::filesystem::path& file) {
      tera::LeftOutRows left_out;
      AskForAll(tera::CsvFile(file, tera::CsvForm{.has_header = has_header}, &left_out));
    });
  }
  tera::ReadAsFile("log.csv", data, size, [](const std::filesystem::path& file) {
    tera::RowScan scan(file, {});
    for (tera::ScannedRow row; scan.Next(&row);) {
    }
  });
  return 0;
}
