#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <string>

#include "app/commands.h"
#include "core/error.h"
#include "dataset/export/stamp_text.h"
#include "dataset/import/import_csv.h"
#include "dataset/import/suggest/suggest.h"
#include "physics/actuation/joint_of_stroke.h"

namespace tera {
namespace {

CylinderStroke StrokeOf(const ConfigMap& machine, const ConfigMap& joint) {
  const auto model = std::make_shared<const MachineModel>(ReadMachine(machine));
  const std::string name = joint.Text("name");
  for (const Cylinder& cylinder : model->cylinders) {
    if (model->joints[cylinder.joint].name != name) continue;
    const StrokeRange strokes = StrokesOf(*model, cylinder);
    return {
        [model, &cylinder](double stroke_m) { return JointOfStroke(*model, cylinder, stroke_m); },
        strokes.least_m, strokes.most_m};
  }
  joint.Fault("stroke", {FaultKind::kNoSuchName,
                         "no cylinder of the machine model moves a joint '" + name + "'"});
  return {};
}

std::string RateText(const ImportedChannel& channel) {
  if (channel.interval_ns == 0) return "";
  return fmt::format("{:.4g} Hz", 1 / ToSeconds(channel.interval_ns));
}

void PrintNotes(const ImportedChannel& channel) {
  if (channel.left_out > 0) {
    fmt::print("  {} rows left out, the first: {}\n", channel.left_out, channel.first_fault);
  }
  if (channel.irregular > 0) {
    fmt::print(
        "  {} intervals differ from the usual one by more than half of it, the longest is "
        "{:.3g} s\n",
        channel.irregular, ToSeconds(channel.longest_gap_ns));
  }
  if (channel.clamped_levers > 0) {
    fmt::print("  {} lever values slightly beyond full, taken as full\n", channel.clamped_levers);
  }
  if (channel.levers_beyond_full > 0) {
    fmt::print(
        "  {} lever values beyond full, up to {:.4g}: are they in per cent, or not lever values?\n",
        channel.levers_beyond_full, channel.largest_lever);
  }
  if (channel.strokes_beyond > 0) {
    fmt::print(
        "  {} strokes beyond the joint's travel, by up to {:.3g} m: are unit, offset and machine "
        "right?\n",
        channel.strokes_beyond, channel.furthest_beyond_m);
  }
  if (channel.too_fast > 0) {
    fmt::print(
        "  {} rates beyond {} rad/s, up to {:.4g} rad/s of {}: is it in degrees, or does it "
        "jump?\n",
        channel.too_fast, kFastestJoint_radps, channel.fastest_radps, channel.fastest_joint);
  }
  for (const std::string& remark : channel.remarks) fmt::print("  {}\n", remark);
}

/// Prints clock differences, and the mapping entries that correct them.
void PrintClocks(const ImportReport& report) {
  for (const ClockDifference& d : report.clocks) {
    fmt::print(
        "clock of {}: {:.4f} +- {:.4f} s ahead of that of {} at {:.3f} s, and {} {:.1f} +- {:.1f} "
        "ppm\n  from {} of the first and {} of the second, with correlation {:.2f}; {} stretches; "
        "the recording is unchanged\n",
        d.channel, d.ahead_s, d.ahead_bound_s, d.reference, ToSeconds(d.from_ns),
        d.drift < 0 ? "loses" : "gains", 1e6 * std::abs(d.drift), 1e6 * d.drift_bound, d.what,
        d.reference_what, d.correlation, d.stretches);
  }
}

void PrintReport(const ImportReport& report) {
  fmt::print("{:<32} {:>9} {:>11} {:>12} {:>12}  {}\n", "channel", "rows", "rate", "from s", "to s",
             "file");
  for (const ImportedChannel& channel : report.channels) {
    fmt::print("{:<32} {:>9} {:>11} {:>12.3f} {:>12.3f}  {}\n", channel.path, channel.rows,
               RateText(channel), ToSeconds(channel.first_ns), ToSeconds(channel.last_ns),
               channel.file);
    PrintNotes(channel);
  }
  if (report.zero_ns != 0) {
    fmt::print("times count from {} s of the files\n", SecondsText(report.zero_ns));
  }
  if (report.epoch) {
    fmt::print("epoch: {} s since 1970, of {}\n", SecondsText(report.epoch->since_1970_ns),
               TextOf(report.epoch->clock));
  }
  PrintClocks(report);
}

}  // namespace

void AddImportCommand(CLI::App* app) {
  struct Arguments {
    std::string mapping, out, suggested;
    ImportOptions options;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app->add_subcommand(
      "import", "Turn logs of a real machine (CSV, ROS bags, NMEA, ...) into TERA's format");
  CLI::Option* mapping = command->add_option("MAPPING", arguments->mapping,
                                             "Mapping file (YAML, see docs/reference/dataset.md)");
  CLI::Option* out =
      command->add_option("--out", arguments->out, "Directory of the recording; new or empty");
  CLI::Option* check = command->add_flag("--check", arguments->options.checks_only,
                                         "Read everything, print rates and gaps, write nothing");
  check->excludes(out);
  command
      ->add_option("--suggest", arguments->suggested,
                   "Print a first mapping of this log or folder instead")
      ->excludes(mapping)
      ->excludes(out)
      ->excludes(check);
  command->add_flag("--skip-bad-rows", arguments->options.skips_bad_rows,
                    "Skip and count rows and messages that cannot be read");
  command
      ->add_option("--set", arguments->options.overrides,
                   "key.path=value instead of the mapping's, above all file=recording.csv")
      ->take_all();
  command->callback([arguments] {
    if (!arguments->suggested.empty()) {
      fmt::print("{}", SuggestMapping(arguments->suggested, arguments->options.overrides));
      return;
    }
    if (arguments->mapping.empty()) {
      throw InputError("MAPPING",
                       {FaultKind::kMissing,
                        "is missing; name the mapping's file, or create one with --suggest LOG"});
    }
    if (arguments->out.empty() && !arguments->options.checks_only) {
      throw InputError("--out", {FaultKind::kMissing,
                                 "is missing; name the recording's new directory, or use --check"});
    }
    arguments->options.cylinder_stroke = StrokeOf;
    PrintReport(ImportCsv(arguments->mapping, arguments->out, arguments->options));
  });
}

}  // namespace tera
