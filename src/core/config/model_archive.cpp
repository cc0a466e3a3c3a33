#include "core/config/model_archive.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace tera {
namespace {

/// Writes `value / unit`. A division makes the last digits inexact, so the text has only 12 digits.
std::string InUnit(double value, double unit) {
  return unit == 1 ? fmt::format("{}", value) : fmt::format("{:.12g}", value / unit);
}

std::string ListInUnit(const std::vector<double>& values, double unit) {
  std::vector<std::string> texts;
  for (const double value : values) texts.push_back(InUnit(value, unit));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

std::vector<double> Times(std::vector<double> values, double unit) {
  for (double& value : values) value *= unit;
  return values;
}

}  // namespace

void ModelArchive::Visit(std::string_view key, double* value, const Range& range, double unit) {
  if (!reads()) return Write(key, InUnit(*value, unit));
  *value = source().Number(key, range, *value / unit) * unit;
}

void ModelArchive::Visit(std::string_view key, int* value, const Range& range) {
  if (!reads()) return Write(key, fmt::format("{}", *value));
  *value = static_cast<int>(source().Integer(key, range, *value));
}

void ModelArchive::Visit(std::string_view key, bool* value) {
  if (!reads()) return Write(key, *value ? "true" : "false");
  *value = source().Boolean(key, *value);
}

void ModelArchive::Visit(std::string_view key, Vec3* value, const Range& each, double unit) {
  if (!reads()) return Write(key, ListInUnit({value->begin(), value->end()}, unit));
  *value = source().Vector3(key, each, Vec3(*value / unit)) * unit;
}

void ModelArchive::Visit(std::string_view key, std::vector<double>* values, const Range& each,
                         double unit) {
  if (!reads()) return Write(key, ListInUnit(*values, unit));
  if (!source().Has(key)) return;
  *values = Times(source().Numbers(key, each, values->size(), values->size()), unit);
}

void ModelArchive::Visit(std::string_view key, std::vector<std::string>* names) {
  if (!reads()) return Write(key, fmt::format("[{}]", fmt::join(*names, ", ")));
  *names = source().Texts(key);
}

void ModelArchive::Visit(std::string_view key, std::string* choice,
                         std::initializer_list<std::string_view> allowed) {
  if (!reads()) return Write(key, *choice);
  *choice = source().Choice(key, allowed, *choice);
}

void ModelArchive::Visit(std::string_view key, std::optional<std::filesystem::path>* file) {
  if (reads()) {
    *file = source().OptionalFile(key);
  } else if (*file) {
    Write(key, "'" + (*file)->string() + "'");
  }
}

void ModelArchive::Visit(std::string_view key, std::optional<double>* value, const Range& range) {
  if (reads()) {
    *value = source().OptionalNumber(key, range);
  } else if (*value) {
    Write(key, InUnit(**value, 1));
  }
}

void ModelArchive::Need(std::string_view key, double* value, const Range& range) {
  if (!reads()) return Write(key, InUnit(*value, 1));
  *value = source().Number(key, range);
}

void ModelArchive::Need(std::string_view key, int* value, const Range& range) {
  if (!reads()) return Write(key, fmt::format("{}", *value));
  *value = static_cast<int>(source().Integer(key, range));
}

void ModelArchive::Need(std::string_view key, std::vector<double>* values, const Range& each,
                        std::size_t most, double unit) {
  if (!reads()) return Write(key, ListInUnit(*values, unit));
  *values = Times(source().Numbers(key, each, 1, most), unit);
}

void ModelArchive::Check(bool holds, std::string_view key, const InputFault& fault) const {
  if (reads() && !holds) source().Fault(key, fault);
}

void ModelArchive::Write(std::string_view key, std::string_view value) {
  yaml_ += fmt::format("{:{}}{}: {}\n", "", blanks_, key, value);
}

bool ModelArchive::Enter(std::string_view key, bool is_written) {
  if (reads()) {
    const auto part = source().OptionalMap(key);
    if (part) sources_.push_back(*part);
    return part.has_value();
  }
  if (is_written) yaml_ += fmt::format("{:{}}{}:\n", "", blanks_, key);
  blanks_ += is_written ? 2 : 0;
  return is_written;
}

void ModelArchive::Leave() {
  if (reads()) return sources_.pop_back();
  blanks_ -= 2;
}

}  // namespace tera
