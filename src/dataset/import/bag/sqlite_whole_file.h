#pragma once

#include <sqlite3.h>

namespace tera {

/// Name of an SQLite access (VFS) to a read-only database in one unchanging file, for
/// sqlite3_open_v2.
///
/// Model   SQLite's default access follows no links, and looks for a journal and locks next to the
///         file. Here the path may be that of an UnpackedFile, which links to a file without a
///         name.
const char* SqliteWholeFile();

}  // namespace tera
