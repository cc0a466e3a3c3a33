#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace tera {

/// A file of a form that is known by its beginning.
struct ForeignFile {
  std::string name;    ///< "a pcapng capture of a network", as after "is"
  std::string remedy;  ///< how to come to something that TERA reads, with a command where one does
};

/// The known form that the beginning of `file` has: stand-ins (Git LFS, git-annex), archives,
/// documents, pictures, logs of CAN buses and networks, binary tables, observations of receivers,
/// bags and point clouds. Nothing where the form is not known, as that of any table in text.
/// A reader asks for its own form before it asks for these.
///
/// Throws  InputError where the file cannot be read.
std::optional<ForeignFile> ForeignFileOf(const std::filesystem::path& file);
/// By its first bytes, of which some 4000 tell every form; `name` stands in the commands.
std::optional<ForeignFile> ForeignFileOf(std::string_view first, const std::filesystem::path& name);

/// Throws InputError where ForeignFileOf knows the file: its name, what it is, `need`, as in "need
/// a table in text", and the remedy.
void RefuseForeignFile(const std::filesystem::path& file, std::string_view need);

}  // namespace tera
