#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "dataset/import/csv_file.h"

// Concatenates the tables of several files.

namespace tera {
namespace {

class JoinedTables final : public RowTable {
 public:
  JoinedTables(const std::vector<std::filesystem::path>& files, const CsvForm& form,
               LeftOutRows* left_out) {
    for (const std::filesystem::path& file : files) {
      tables_.emplace_back(file, form, left_out);
      RequireSameColumns(tables_.back());
      firsts_.push_back(rows_);
      rows_ += tables_.back().row_count();
    }
  }

  std::size_t row_count() const override { return rows_; }
  std::size_t Column(const std::string& name) const override {
    return tables_.front().Column(name);
  }
  int Line(std::size_t row) const override { return Place(row).line; }
  RowPlace Place(std::size_t row) const override {
    const std::size_t file = FileOf(row);
    return {tables_[file].Line(row - firsts_[file]), file};
  }
  std::size_t Ordinal(std::size_t row) const override {
    std::size_t before = 0;
    const std::size_t file = FileOf(row);
    for (std::size_t k = 0; k < file; ++k) before += tables_[k].ordinal_count();
    return before + tables_[file].Ordinal(row - firsts_[file]);
  }
  std::optional<double> NumberIfAny(std::size_t row, std::size_t column) const override {
    return TableOf(&row).NumberIfAny(row, column);
  }
  double Number(std::size_t row, std::size_t column) const override {
    return TableOf(&row).Number(row, column);
  }
  std::optional<TimeNs> Stamp(std::size_t, std::size_t) const override { return std::nullopt; }
  std::optional<TimeNs> WholeNanoseconds(std::size_t row, std::size_t column,
                                         TimeNs unit_ns) const override {
    return TableOf(&row).WholeNanoseconds(row, column, unit_ns);
  }
  std::optional<std::string_view> Text(std::size_t row, std::size_t column) const override {
    return TableOf(&row).Text(row, column);
  }
  bool IsPresent(std::size_t row, std::size_t column) const override {
    return TableOf(&row).IsPresent(row, column);
  }
  bool Repeats(std::size_t row, std::size_t column) const override {
    return Text(row, column) == Text(row - 1, column);
  }
  [[noreturn]] void Fail(std::size_t row, std::size_t column,
                         const InputFault& fault) const override {
    TableOf(&row).Fail(row, column, fault);
  }

 private:
  std::size_t FileOf(std::size_t row) const {
    const auto next = std::upper_bound(firsts_.begin(), firsts_.end(), row);
    return static_cast<std::size_t>(next - firsts_.begin()) - 1;
  }
  /// The table that contains the row; `row` becomes the index within that table.
  const CsvFile& TableOf(std::size_t* row) const {
    const std::size_t file = FileOf(*row);
    *row -= firsts_[file];
    return tables_[file];
  }
  void RequireSameColumns(const CsvFile& table) const {
    const std::vector<std::string>&first = tables_.front().columns(), &here = table.columns();
    const auto [a, b] = std::mismatch(first.begin(), first.end(), here.begin(), here.end());
    if (a == first.end() && b == here.end()) return;
    const auto shown = [](const auto& at, const auto& end) {
      return at == end ? std::string("no column") : fmt::format("column '{}'", *at);
    };
    throw InputError(
        table.path().string(),
        {FaultKind::kInconsistent,
         fmt::format("has {} where {} has {}; need files with the same columns in the same order",
                     shown(b, here.end()), tables_.front().path().string(),
                     shown(a, first.end()))});
  }

  std::vector<CsvFile> tables_;
  std::vector<std::size_t> firsts_;  ///< first row of each table
  std::size_t rows_ = 0;
};

}  // namespace

std::unique_ptr<const RowTable> ReadTextTables(const std::vector<std::filesystem::path>& files,
                                               const CsvForm& form, LeftOutRows* left_out) {
  std::unique_ptr<const RowTable> table;
  if (files.size() == 1) {
    table = std::make_unique<CsvFile>(files.front(), form, left_out);
  } else {
    table = std::make_unique<JoinedTables>(files, form, left_out);
  }
  if (table->row_count() == 0 && (left_out == nullptr || left_out->count == 0)) {
    throw InputError(files.front().string(),
                     {FaultKind::kMissing, "has names of columns and no row; need rows"});
  }
  return table;
}

}  // namespace tera
