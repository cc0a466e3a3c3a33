#include "blind/maker.h"

#include "blind/cases/recording_files.h"
#include "blind/mujoco/cases/whole_case.h"
#include "core/check.h"

namespace tera::blind {
namespace {

constexpr double kOwnDuration_s = 45;

Maker Own(const ProveOptions& options) {
  PlainMachine nominal = PlainMachine::Read(options.machine_yaml);
  if (!options.real_csv.empty()) nominal.real = RealDrive::Read(options.real_csv);
  const double duration_s = options.duration_s.value_or(kOwnDuration_s);
  return
      [nominal, seed = options.seed, duration_s](int number, const std::filesystem::path& folder) {
        BenchmarkCase c = DrawCase(seed, number, nominal, duration_s);
        CaseRecording recording = Record(&c, seed);
        WriteCase(c, recording, folder);
        return MadeCase{std::move(c), std::move(recording)};
      };
}

Maker Mujoco(const ProveOptions& options) {
  TERA_CHECK(!options.machines.empty());
  std::vector<mujoco::OwnersMachine> machines;
  for (const auto& [machine, rig] : options.machines) {
    machines.push_back({machine, rig, mujoco::MachineNumbers::Read(machine, rig)});
  }
  return [machines, seed = options.seed, reserve = options.reserve,
          duration_s = options.duration_s](int number, const std::filesystem::path& folder) {
    const mujoco::OwnersMachine& machine =
        machines[mujoco::MachineOfCase(seed, number, machines.size())];
    mujoco::WholeCase c = mujoco::DrawWholeCase(seed, number, machine.numbers, reserve, duration_s);
    mujoco::WholeRecording recording = mujoco::RecordWholeCase(&c, machine.numbers, seed);
    mujoco::WriteWholeCase(c, machine, recording.measured, folder);
    return MadeCase{std::move(c.about), std::move(recording.marks)};
  };
}

}  // namespace

Maker MakerFor(const ProveOptions& options) {
  return options.maker == MakerKind::kOwn ? Own(options) : Mujoco(options);
}

}  // namespace tera::blind
