#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace tera {

/// A file whose form is identified by its beginning.
struct ForeignFile {
  std::string name;    ///< "a pcapng capture of a network", as after "is"
  std::string remedy;  ///< conversion to a readable form, with a command if there is one
};

/// Identifies the form of `file` by its beginning: stand-ins (Git LFS, git-annex), archives,
/// documents, pictures, logs of CAN buses and networks, binary tables, receiver observations, bags
/// and point clouds. Returns nothing for unknown forms, such as text tables. A reader checks its
/// own form first.
///
/// Throws  InputError if the file cannot be read.
std::optional<ForeignFile> ForeignFileOf(const std::filesystem::path& file);
/// Identifies a form by its first bytes; about 4000 suffice. `name` appears in the commands.
std::optional<ForeignFile> ForeignFileOf(std::string_view first, const std::filesystem::path& name);

/// Throws InputError if ForeignFileOf identifies the file: its name, its form, `need` (as in "need
/// a table in text"), and the remedy.
void RefuseForeignFile(const std::filesystem::path& file, std::string_view need);

}  // namespace tera
