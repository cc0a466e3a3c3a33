#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tera {

/// Suggests a mapping (YAML) for a log, as input of `tera import`. A bag is analysed by topic
/// types, a known log or folder by its format, and a text table by column names and numbers. Each
/// guess has a remark "guessed:" with its reason. Unknown items appear only as remarks. `overrides`
/// are texts key.path=value that define the syntax of a text table (`csv.skip_lines=3`); any other
/// key is a fault. Throws InputError if the log cannot be read.
std::string SuggestMapping(const std::filesystem::path& log,
                           const std::vector<std::string>& overrides = {});

// One function per kind of log.
std::string SuggestForBag(const std::filesystem::path& log);
/// For a network capture, by the ports to which lidars send.
std::string SuggestForCapture(const std::filesystem::path& log);
std::string SuggestForTable(const std::filesystem::path& log,
                            const std::vector<std::string>& overrides);
/// For a PX4 log, by its topics.
std::string SuggestForUlog(const std::filesystem::path& log);
/// For a log with a type of foreign_log.h.
std::string SuggestForLog(const std::filesystem::path& log);
/// For a text file of poses in TUM, EuRoC or KITTI format; nullopt for any other file.
std::optional<std::string> SuggestForTrajectory(const std::filesystem::path& log);
/// For a drive of KITTI's raw data, or a folder of NAME/data.csv files in EuRoC format.
std::string SuggestForFolder(const std::filesystem::path& folder);

}  // namespace tera
