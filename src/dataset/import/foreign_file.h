#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace tera {

/// A file format that the import does not read, recognised by the file's first bytes.
struct ForeignFile {
  std::string name;    ///< description that completes "it is ...", such as "a pcapng capture of a
                       ///< network"
  std::string remedy;  ///< conversion to a readable format, with a command if there is one
};

/// Recognises the format of `file`: placeholders (Git LFS, git-annex), archives, documents, images,
/// logs of CAN buses and networks, binary tables, receiver observations, bags and point clouds.
/// Returns nullopt for unknown formats, including text tables. A reader must check its own format
/// first.
///
/// Throws  InputError if the file cannot be read.
std::optional<ForeignFile> ForeignFileOf(const std::filesystem::path& file);
/// Recognises a format by the first bytes of a file; about 4000 suffice. `name` is used in the
/// commands.
std::optional<ForeignFile> ForeignFileOf(std::string_view first, const std::filesystem::path& name);

/// Throws InputError if the file has a format that ForeignFileOf recognises. The message has the
/// file name, its format, `need` (such as "need a table in text") and the remedy.
void RefuseForeignFile(const std::filesystem::path& file, std::string_view need);

}  // namespace tera
