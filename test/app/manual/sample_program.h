#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "app/arguments/argument_checks.h"

namespace tera {

/// A program with two commands, one with two subcommands.
class SampleProgram {
 public:
  SampleProgram() {
    app_.require_subcommand(1);
    CLI::App* dig = app_.add_subcommand("dig", "Dig a hole that's \\deep [m]: -1 or so");
    dig->add_option("PLACE", place_, "Where")->required();
    dig->add_option("--soil", soil_, "What the ground is")
        ->required()
        ->transform(OneOf<Soil>({{"clay", Soil::kClay}, {"sand", Soil::kSand}}));
    dig->add_option("-n,--times", times_, "How often")->check(WholeNumberFrom0());
    dig->add_option("--with", tools_, "OLD=NEW, may be repeated")->take_all();
    dig->add_flag("--deep", deep_, "Go on until there is rock");
    CLI::App* plan = app_.add_subcommand("plan", "What next?");
    plan->require_subcommand(1);
    plan->add_subcommand("dig", "Plan a hole")
        ->add_option("SOIL", planned_, "Of the hole")
        ->required()
        ->transform(OneOf<Soil>({{"clay", Soil::kClay}, {"sand", Soil::kSand}}));
    plan->add_subcommand("rest", "Plan a rest");
    plan->add_subcommand("give-up", "Not in the help")->group("");
  }
  const CLI::App& app() const { return app_; }

 private:
  enum class Soil { kClay, kSand };
  CLI::App app_{"Works on the ground", "tera"};
  std::filesystem::path place_;
  Soil soil_ = Soil::kClay, planned_ = Soil::kClay;
  int times_ = 1;
  std::vector<std::string> tools_;
  bool deep_ = false;
};

}  // namespace tera
