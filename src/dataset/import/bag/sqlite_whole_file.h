#pragma once

#include <sqlite3.h>

namespace tera {

/// SQLite's access to a database of one whole file that nobody changes, by its path as it is, for
/// sqlite3_open_v2 to read only.
///
/// Model   SQLite's own access follows no links, and looks for a journal and for locks beside the
///         file. Here the path may be one of UnpackedFile, which leads to a file without a name.
const char* SqliteWholeFile();

}  // namespace tera
