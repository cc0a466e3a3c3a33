#include "dataset/import/scans/scan_file.h"

#include <fmt/format.h>
#include <liblzf/lzf.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <sstream>

#include "core/config/spelling.h"
#include "core/error.h"
#include "core/parse_number.h"
#include "dataset/files/checked_file.h"
#include "dataset/import/cloud/ply_header.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void RefuseScan(const fs::path& file, FaultKind kind, const std::string& finding) {
  throw InputError(file.string(), {kind, finding});
}

std::string EndingOf(const fs::path& file) { return LowerCase(file.extension().string()); }

/// Header of a PCD or PLY file.
struct PcdHead {
  std::vector<RecordField> fields;
  std::size_t step = 0, points = 0, columns = 0, body = 0;
  std::string data;
};

PcdHead ReadPcdHead(const fs::path& file, const std::string& bytes) {
  constexpr std::size_t kLongestHead = 1 << 16, kMostField = 1 << 16;
  std::map<std::string, std::vector<std::string>> entries;
  PcdHead head;
  while (!entries.contains("DATA")) {
    const std::size_t end = bytes.find('\n', head.body);
    if (end == bytes.npos || head.body > kLongestHead) {
      RefuseScan(file, FaultKind::kMalformed, "has no header of a PCD file that ends in DATA");
    }
    std::istringstream line(bytes.substr(head.body, end - head.body));
    head.body = end + 1;
    std::string key;
    line >> key;
    for (std::string word; line >> word;) entries[key].push_back(word);
  }
  auto& names = entries["FIELDS"];
  auto& counts = entries["COUNT"];
  if (counts.empty()) counts.assign(names.size(), "1");
  const auto whole = [&](const char* key, std::size_t k, std::size_t most) {
    const auto& words = entries[key];
    const auto value = k < words.size() ? ParseNumber<std::uint64_t>(words[k]) : std::nullopt;
    if (!value || *value > most) {
      RefuseScan(file, FaultKind::kMalformed,
                 fmt::format("its header's {} is not a whole number of at most {}", key, most));
    }
    return static_cast<std::size_t>(*value);
  };
  for (std::size_t f = 0; f < names.size(); ++f) {
    const auto& types = entries["TYPE"];
    const std::size_t size = whole("SIZE", f, 8), count = whole("COUNT", f, kMostField);
    head.fields.push_back({names[f], f < types.size() ? types[f][0] : '?', size, head.step});
    head.step += size * count;
    head.columns += count;
  }
  constexpr std::size_t kMostPoints = 100'000'000;
  head.points = whole("POINTS", 0, kMostPoints);
  head.data = entries["DATA"].empty() ? "" : entries["DATA"][0];
  return head;
}

void RequireBody(const fs::path& file, std::size_t found, std::size_t need) {
  if (found >= need) return;
  RefuseScan(file, FaultKind::kMalformed,
             fmt::format("cut off: its points need {} bytes, {} are there; copy the file again",
                         need, found));
}

/// Decompresses the data and converts it from field-major to point-major order.
std::string Unpacked(const fs::path& file, const PcdHead& head, std::string_view body) {
  std::uint32_t sizes[2] = {};
  RequireBody(file, body.size(), sizeof sizes);
  std::memcpy(sizes, body.data(), sizeof sizes);
  body.remove_prefix(sizeof sizes);
  RequireBody(file, body.size(), sizes[0]);
  std::string columns(head.points * head.step, '\0');
  constexpr std::size_t kMostExpanded = 512;  // largest expansion of LZF
  const bool fits = sizes[1] == columns.size() && columns.size() <= kMostExpanded * sizes[0];
  if (!columns.empty() &&
      (!fits || lzf_decompress(body.data(), sizes[0], columns.data(), sizes[1]) != sizes[1])) {
    RefuseScan(file, FaultKind::kMalformed, "its packed data are damaged; copy the file again");
  }
  std::string records(columns.size(), '\0');
  for (std::size_t f = 0; f < head.fields.size(); ++f) {
    const std::size_t begin = head.fields[f].at;
    const std::size_t end = f + 1 < head.fields.size() ? head.fields[f + 1].at : head.step;
    for (std::size_t k = 0; k < head.points; ++k) {
      std::memcpy(records.data() + k * head.step + begin,
                  columns.data() + head.points * begin + k * (end - begin), end - begin);
    }
  }
  return records;
}

/// Converts text to binary records of doubles, and changes the fields accordingly.
std::string FromText(const fs::path& file, PcdHead* head, const std::string& body) {
  std::istringstream words(body);
  std::string records;
  for (std::size_t k = 0; k < head->points * head->columns; ++k) {
    std::string word;
    words >> word;
    const auto value =
        word == "nan" || word == "NaN" ? std::optional(std::nan("")) : ParseNumber<double>(word);
    if (!value) {
      RefuseScan(file, FaultKind::kMalformed,
                 fmt::format("point {} has '{}' where a number is needed; copy the file again",
                             k / head->columns + 1, word));
    }
    records.append(reinterpret_cast<const char*>(&*value), sizeof(double));
  }
  std::size_t at = 0;
  for (RecordField& field : head->fields) {
    field = {field.name, 'F', sizeof(double), at};
    at += sizeof(double);
  }
  head->step = at;
  return records;
}

UnitScan ReadPcdScan(const fs::path& file, const PointForm& form, TimeNs stamp_ns) {
  const std::string bytes = ReadWholeFile(file);
  PcdHead head = ReadPcdHead(file, bytes);
  std::string records = bytes.substr(head.body);
  if (head.data == "binary_compressed") {
    records = Unpacked(file, head, records);
  } else if (head.data == "ascii") {
    if (head.columns != head.fields.size()) {
      RefuseScan(file, FaultKind::kUnsupported, "has fields of several numbers in text");
    }
    records = FromText(file, &head, records);
  } else if (head.data != "binary") {
    RefuseScan(file, FaultKind::kMalformed,
               fmt::format("DATA is '{}', need ascii, binary or binary_compressed", head.data));
  }
  RequireBody(file, records.size(), head.points * head.step);
  const PointRecords points{.fields = head.fields,
                            .step = head.step,
                            .count = head.points,
                            .bytes = records,
                            .place = file.string()};
  return RecordReader(points, form).Read(stamp_ns);
}

UnitScan ReadKittiScan(const fs::path& file, const PointForm& form, TimeNs stamp_ns) {
  constexpr std::size_t kPoint = 16;
  const std::string bytes = ReadWholeFile(file);
  if (bytes.size() % kPoint != 0) {
    RefuseScan(file, FaultKind::kMalformed,
               fmt::format("has {} bytes, need a multiple of the {} of a point (x, y, z and "
                           "reflectance as floats)",
                           bytes.size(), kPoint));
  }
  const PointRecords points{
      .fields = {{"x", 'F', 4, 0}, {"y", 'F', 4, 4}, {"z", 'F', 4, 8}, {"intensity", 'F', 4, 12}},
      .step = kPoint,
      .count = bytes.size() / kPoint,
      .bytes = bytes,
      .place = file.string()};
  return RecordReader(points, form).Read(stamp_ns);
}

UnitScan ReadPlyScan(const fs::path& file, const PointForm& form, TimeNs stamp_ns) {
  const std::string bytes = ReadWholeFile(file);
  const PlyVertices vertices = ReadPlyHeader(file, bytes);
  PcdHead head{.step = vertices.record_bytes,
               .points = vertices.count,
               .columns = vertices.properties.size(),
               .body = vertices.body,
               .data = vertices.form};
  for (const PlyProperty& one : vertices.properties) {
    head.fields.push_back({one.name, one.type, one.bytes, one.at});
  }
  std::string records = bytes.substr(head.body);
  if (head.data == "ascii") records = FromText(file, &head, records);
  RequireBody(file, records.size(), head.points * head.step);
  const PointRecords points{.fields = head.fields,
                            .step = head.step,
                            .count = head.points,
                            .bytes = records,
                            .is_big_endian = vertices.form == "binary_big_endian",
                            .place = file.string()};
  return RecordReader(points, form).Read(stamp_ns);
}

}  // namespace

UnitScan ReadScanFile(const fs::path& file, const PointForm& form, TimeNs stamp_ns) {
  const std::string ending = EndingOf(file);
  return ending == ".bin"   ? ReadKittiScan(file, form, stamp_ns)
         : ending == ".ply" ? ReadPlyScan(file, form, stamp_ns)
                            : ReadPcdScan(file, form, stamp_ns);
}

}  // namespace tera
