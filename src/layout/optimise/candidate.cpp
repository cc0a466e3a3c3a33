#include "layout/optimise/candidate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/config/portable_name.h"
#include "core/units.h"

namespace tera {
namespace {

constexpr std::size_t kContinuous = 6, kWhole = 2;

/// Integer value of a gene, at most `most`.
std::size_t NumberOf(double gene, std::size_t most) {
  return std::min(static_cast<std::size_t>(std::lround(gene)), most);
}

/// The sensor type, mount and pose that the genes select for a slot.
struct Chosen {
  const TypeChoice* type = nullptr;  ///< null: absent
  const MountBounds* mount = nullptr;
  Vec3 p_B_m = Vec3::Zero(), rpy_rad = Vec3::Zero();
};

Chosen ChosenOf(const LayoutSearch& search, const Genes& genes, std::size_t s) {
  const SensorSlot& slot = search.slots[s];
  const std::size_t whole = TypeGene(search, s);
  const std::size_t type = NumberOf(genes[whole], slot.types.size());
  if (type == 0) return {};
  Chosen chosen{&slot.types[type - 1],
                &slot.mounts[NumberOf(genes[whole + 1], slot.mounts.size() - 1)]};
  const double* share = &genes[FirstGene(s)];
  const Vec3 place(share[0], share[1], share[2]), turn(share[3], share[4], share[5]);
  const MountBounds& mount = *chosen.mount;
  chosen.p_B_m = mount.low_B_m + place.cwiseProduct(mount.high_B_m - mount.low_B_m);
  chosen.rpy_rad = mount.low_rpy_rad + turn.cwiseProduct(mount.high_rpy_rad - mount.low_rpy_rad);
  return chosen;
}

std::string Triple(const Vec3& v) {
  return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", v.x(), v.y(), v.z());
}

/// Rounds like RigYaml, so that the written file describes exactly the evaluated layout.
Vec3 Rounded(const Vec3& v) {
  return v.unaryExpr([](double x) { return std::stod(fmt::format("{:.6g}", x)); });
}

}  // namespace

std::size_t FirstGene(std::size_t slot) { return kContinuous * slot; }

std::size_t TypeGene(const LayoutSearch& search, std::size_t slot) {
  return kContinuous * search.slots.size() + kWhole * slot;
}

GeneBounds BoundsOf(const LayoutSearch& search) {
  GeneBounds bounds;
  bounds.low.assign(kContinuous * search.slots.size(), 0.0);
  bounds.high.assign(kContinuous * search.slots.size(), 1.0);
  for (const SensorSlot& slot : search.slots) {
    const Genes low = {slot.optional ? 0.0 : 1.0, 0.0};
    const Genes high = {static_cast<double>(slot.types.size()),
                        static_cast<double>(slot.mounts.size()) - 1};
    bounds.low.insert(bounds.low.end(), low.begin(), low.end());
    for (std::size_t g = 0; g < kWhole; ++g) {
      bounds.high.push_back(std::max(high[g], low[g] + 1));
    }
  }
  bounds.whole = kWhole * search.slots.size();
  return bounds;
}

std::vector<SensorDescription> SensorsOf(const LayoutSearch& search, const Genes& genes) {
  std::vector<SensorDescription> sensors;
  for (std::size_t s = 0; s < search.slots.size(); ++s) {
    const Chosen chosen = ChosenOf(search, genes, s);
    if (!chosen.type) continue;
    SensorDescription sensor = chosen.type->sensor;
    sensor.name = search.slots[s].name;
    sensor.link = chosen.mount->link;
    const Vec3 rpy_rad = kDeg * Rounded(chosen.rpy_rad / kDeg);
    sensor.X_BS = MakePose(Rounded(chosen.p_B_m), rpy_rad.x(), rpy_rad.y(), rpy_rad.z());
    sensors.push_back(std::move(sensor));
  }
  return sensors;
}

Layout LayoutOf(const LayoutSearch& search, const Genes& genes,
                const std::vector<SensorDescription>& kept, const MachineModel& model) {
  std::vector<SensorDescription> sensors = kept;
  for (SensorDescription& sensor : SensorsOf(search, genes)) sensors.push_back(std::move(sensor));
  return LayoutOfSensors(std::move(sensors), model);
}

std::string RigYaml(const LayoutSearch& search, const Genes& genes, const std::string& kept_yaml) {
  std::string placed;
  for (std::size_t s = 0; s < search.slots.size(); ++s) {
    const Chosen chosen = ChosenOf(search, genes, s);
    if (!chosen.type) continue;
    placed += fmt::format(
        "  - {{name: {}, preset: \"{}\", link: {}, xyz_m: {}, rpy_deg: {}, cost: {:.9g}, "
        "power_w: {:.9g}}}\n",
        search.slots[s].name, PortableName(chosen.type->preset), chosen.mount->link,
        Triple(chosen.p_B_m), Triple(chosen.rpy_rad / kDeg), chosen.type->sensor.cost,
        chosen.type->sensor.power_w);
  }
  if (!kept_yaml.empty()) return kept_yaml + placed;
  return placed.empty() ? "sensors: []\n" : "sensors:\n" + placed;
}

}  // namespace tera
