#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tera {

/// A first mapping (YAML) of a log for `tera import`. A bag is analysed by its topics' types, logs
/// of known form and folders by theirs, a text table by its columns' names and numbers. A guess has
/// a remark "guessed:" with its reason; unknown items are remarks only. `overrides` are
/// key.path=value texts in --set's syntax for the syntax of a text table (`csv.skip_lines=3`);
/// others are a fault. Throws InputError if the log cannot be read.
std::string SuggestMapping(const std::filesystem::path& log,
                           const std::vector<std::string>& overrides = {});

// The mapping of each kind of log.
std::string SuggestForBag(const std::filesystem::path& log);
/// The mapping of a capture of a network, by the ports that lidars send to.
std::string SuggestForCapture(const std::filesystem::path& log);
std::string SuggestForTable(const std::filesystem::path& log,
                            const std::vector<std::string>& overrides);
/// The mapping of a PX4 log, by its topics.
std::string SuggestForUlog(const std::filesystem::path& log);
/// The mapping of a log with a type in foreign_log.h.
std::string SuggestForLog(const std::filesystem::path& log);
/// The mapping of a pose text file in the form of TUM, EuRoC or KITTI; nothing for others.
std::optional<std::string> SuggestForTrajectory(const std::filesystem::path& log);
/// The mapping of a drive of KITTI's raw data, or of files NAME/data.csv in EuRoC's form.
std::string SuggestForFolder(const std::filesystem::path& folder);

}  // namespace tera
