#include "soil/site/voxel_file.h"

#include <fmt/format.h>

#include <bit>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>

#include "soil/site/file_in_place.h"

namespace tera {
namespace {

static_assert(std::endian::native == std::endian::little, "the file says that it is little-endian");

/// A list of numbers in the file: name, VTK type and bytes.
struct Field {
  std::string name, type, bytes;
};

template <typename T>
std::string BytesOf(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

std::vector<Field> FieldsOf(const SoilVoxels& voxels) {
  const double volume_m3 = voxels.edge_m * voxels.edge_m * voxels.edge_m;
  std::vector<float> mass_kg, density_kgpm3;
  for (std::size_t n = 0; n < voxels.size(); ++n) {
    mass_kg.push_back(static_cast<float>(voxels.mass_kg[n]));
    const double soil_m3 = voxels.fill[n] * volume_m3;
    density_kgpm3.push_back(soil_m3 > 0 ? static_cast<float>(voxels.mass_kg[n] / soil_m3) : 0.0f);
  }
  return {{"density_kgpm3", "Float32", BytesOf(density_kgpm3)},
          {"mass_kg", "Float32", BytesOf(mass_kg)},
          {"fill", "Float32", BytesOf(voxels.fill)},
          {"compaction", "Float32", BytesOf(voxels.compaction)},
          {"moisture", "Float32", BytesOf(voxels.moisture)},
          {"loose", "Float32", BytesOf(voxels.loose)},
          {"soil", "UInt8", BytesOf(voxels.soil)}};
}

/// Names of the soils as VTK stores texts: character codes, each text terminated by zero.
std::string NamesOf(const std::vector<SoilType>& soils) {
  std::string codes;
  for (const SoilType& soil : soils) {
    for (const char c : soil.name) codes += fmt::format("{} ", static_cast<unsigned char>(c));
    codes += "0 ";
  }
  return fmt::format(
      "<FieldData>\n<DataArray type=\"String\" Name=\"soil_names\" NumberOfTuples=\"{}\" "
      "format=\"ascii\">{}</DataArray>\n</FieldData>\n",
      soils.size(), codes);
}

std::string HeadOf(const SoilVoxels& v, const std::vector<SoilType>& soils,
                   const std::vector<Field>& fields) {
  const std::string extent = fmt::format("0 {} 0 {} 0 {}", v.nx, v.ny, v.nz);
  std::string head = fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n"
      "<ImageData WholeExtent=\"{}\" Origin=\"{} {} {}\" Spacing=\"{} {} {}\">\n{}"
      "<Piece Extent=\"{}\">\n<CellData Scalars=\"density_kgpm3\">\n",
      extent, v.low_W_m.x(), v.low_W_m.y(), v.low_W_m.z(), v.edge_m, v.edge_m, v.edge_m,
      NamesOf(soils), extent);
  std::size_t offset = 0;
  for (const Field& field : fields) {
    head += fmt::format("<DataArray type=\"{}\" Name=\"{}\" format=\"appended\" offset=\"{}\"/>\n",
                        field.type, field.name, offset);
    offset += sizeof(std::uint64_t) + field.bytes.size();
  }
  return head + "</CellData>\n</Piece>\n</ImageData>\n<AppendedData encoding=\"raw\">\n_";
}

bool WriteAll(const std::filesystem::path& file, const SoilVoxels& voxels,
              const std::vector<SoilType>& soils) {
  std::ofstream out(file, std::ios::binary);
  const std::vector<Field> fields = FieldsOf(voxels);
  out << HeadOf(voxels, soils, fields);
  for (const Field& field : fields) {
    const std::uint64_t size = field.bytes.size();
    out.write(reinterpret_cast<const char*>(&size), sizeof(size));
    out.write(field.bytes.data(), static_cast<std::streamsize>(size));
  }
  out << "\n</AppendedData>\n</VTKFile>\n";
  out.close();
  return !out.fail();
}

}  // namespace

void WriteVoxels(const std::filesystem::path& file, const SoilVoxels& voxels,
                 const std::vector<SoilType>& soils) {
  PutInPlace(file, [&](const std::filesystem::path& part) -> std::optional<std::string> {
    errno = 0;
    if (WriteAll(part, voxels, soils)) return std::nullopt;
    return std::strerror(errno);
  });
}

}  // namespace tera
