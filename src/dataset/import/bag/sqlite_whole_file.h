#pragma once

#include <sqlite3.h>

namespace tera {

/// Name of an SQLite VFS (file access layer) for sqlite3_open_v2. It reads a database from a single
/// file that does not change.
///
/// Model   SQLite's default VFS does not follow links, and searches for a journal and locks next to
///         the file. Neither works with the path of an UnpackedFile, which is a link to an unnamed
///         file.
const char* SqliteWholeFile();

}  // namespace tera
