#pragma once

#include <filesystem>
#include <string>

namespace tera {

/// A first mapping (YAML) of a log, for `tera import`: a bag by its topics' types, logs of known
/// form and folders of data by theirs, a text table by its columns' names and numbers. What is a
/// guess stands with a remark "guessed:" that says why; what is not known is left out as a remark.
/// Throws InputError where the log cannot be read.
std::string SuggestMapping(const std::filesystem::path& log);

// Of each kind of log.
std::string SuggestForBag(const std::filesystem::path& log);
std::string SuggestForTable(const std::filesystem::path& log);
/// Of PX4, by its topics.
std::string SuggestForUlog(const std::filesystem::path& log);
/// Of a type of foreign_log.h.
std::string SuggestForLog(const std::filesystem::path& log);
/// Of a drive of KITTI's raw data, or of files NAME/data.csv in EuRoC's form.
std::string SuggestForFolder(const std::filesystem::path& folder);

}  // namespace tera
