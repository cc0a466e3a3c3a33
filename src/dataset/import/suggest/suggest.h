#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tera {

/// A first mapping (YAML) of a log, for `tera import`: a bag by its topics' types, logs of known
/// form and folders of data by theirs, a text table by its columns' names and numbers. What is a
/// guess stands with a remark "guessed:" that says why; what is not known is left out as a remark.
/// `overrides` are key.path=value texts as of --set, which say how a text table is written
/// (`csv.skip_lines=3`); others are a fault. Throws InputError where the log cannot be read.
std::string SuggestMapping(const std::filesystem::path& log,
                           const std::vector<std::string>& overrides = {});

// The mapping of each kind of log.
std::string SuggestForBag(const std::filesystem::path& log);
/// The mapping of a capture of a network, by the ports that lidars send to.
std::string SuggestForCapture(const std::filesystem::path& log);
std::string SuggestForTable(const std::filesystem::path& log,
                            const std::vector<std::string>& overrides);
/// The mapping of a log of PX4, by its topics.
std::string SuggestForUlog(const std::filesystem::path& log);
/// The mapping of a log whose type foreign_log.h has.
std::string SuggestForLog(const std::filesystem::path& log);
/// The mapping of a text file of poses in the form of TUM, EuRoC or KITTI; nothing for others.
std::optional<std::string> SuggestForTrajectory(const std::filesystem::path& log);
/// The mapping of a drive of KITTI's raw data, or of files NAME/data.csv in EuRoC's form.
std::string SuggestForFolder(const std::filesystem::path& folder);

}  // namespace tera
