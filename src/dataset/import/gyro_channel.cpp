#include <array>
#include <string>
#include <vector>

#include "dataset/format/channel.h"
#include "dataset/import/bag/standard_topics.h"
#include "dataset/import/import_run.h"

// Imports gyroscopes with one, two or three axes.

namespace tera {
namespace {

constexpr const char* kGyroType = "gyro";
constexpr std::array<const char*, 3> kAxes = {"wx", "wy", "wz"};

std::vector<MotionSeries> MotionOf(const std::vector<MappedRow>& rows,
                                   const std::vector<std::string>& axes) {
  const MotionGrid grid(rows.size(), [&](std::size_t i) { return rows[i].t_ns; });
  std::vector<MotionSeries> series;
  for (std::size_t a = 0; a < axes.size() && !grid.empty(); ++a) {
    series.push_back(
        grid.Series(axes[a], MotionKind::kTurn, [&](std::size_t i) { return rows[i].values[a]; }));
  }
  return series;
}

}  // namespace

ImportJob ReadGyro(const ConfigMap& config, const ConfigMap& top, Mapping* mapping) {
  const std::string folder = ReadPath(config, "", mapping);
  const ImportedSensor sensor = ReadSensorMount(config, kGyroType);
  const RowSource source = ReadRowSource(config, top, mapping->unpacked);
  const ConfigMap given = config.Map("columns");
  std::vector<std::string> axes, names;
  std::vector<ColumnMapping> columns;
  for (const char* axis : kAxes) {
    const auto column = given.OptionalMap(axis);
    if (!column) continue;
    axes.push_back(axis);
    names.push_back(std::string(axis) + "_radps");
    columns.push_back(ReadColumnMapping(*column, Dimension::kRate));
  }
  if (axes.empty()) config.Fault("columns", "need at least one of wx, wy and wz");
  return [=](ImportRun* run) {
    const std::vector<MappedRow> rows = run->Read(folder, source, columns);
    run->AddMotion(source, MotionOf(rows, axes));
    DatasetWriter* writer = run->writer();
    if (writer == nullptr) return;
    const ChannelId gyro = writer->AddChannel({.path = folder,
                                               .type = kGyroType,
                                               .form = ChannelForm::kRows,
                                               .sensor_yaml = SensorText(sensor, source, rows),
                                               .columns = names});
    for (const MappedRow& row : rows) {
      writer->Write(gyro, RowSample{row.t_ns, row.t_ns, row.values});
    }
  };
}

}  // namespace tera
