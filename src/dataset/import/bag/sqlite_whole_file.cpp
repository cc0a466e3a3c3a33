#include "dataset/import/bag/sqlite_whole_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

// Source  sqlite.org, "The SQLite OS Interface or VFS" and sqlite3.h: sqlite3_vfs,
//         sqlite3_io_methods.

namespace tera {
namespace {

struct OpenFile : sqlite3_file {
  int descriptor;
};

int DescriptorOf(sqlite3_file* file) { return static_cast<OpenFile*>(file)->descriptor; }

int Close(sqlite3_file* file) { return ::close(DescriptorOf(file)), SQLITE_OK; }

/// SQLite requires that bytes beyond the end of the file read as 0.
int Read(sqlite3_file* file, void* to, int count, sqlite3_int64 at) {
  char* bytes = static_cast<char*>(to);
  while (count > 0) {
    const ssize_t read = ::pread(DescriptorOf(file), bytes, static_cast<std::size_t>(count), at);
    if (read < 0 && errno == EINTR) continue;
    if (read < 0) return SQLITE_IOERR_READ;
    if (read == 0) {
      std::memset(bytes, 0, static_cast<std::size_t>(count));
      return SQLITE_IOERR_SHORT_READ;
    }
    bytes += read;
    at += read;
    count -= static_cast<int>(read);
  }
  return SQLITE_OK;
}

int Size(sqlite3_file* file, sqlite3_int64* bytes) {
  *bytes = ::lseek(DescriptorOf(file), 0, SEEK_END);
  return *bytes < 0 ? SQLITE_IOERR_FSTAT : SQLITE_OK;
}

const sqlite3_io_methods kReading = {
    .iVersion = 1,
    .xClose = Close,
    .xRead = Read,
    .xWrite = [](sqlite3_file*, const void*, int, sqlite3_int64) { return SQLITE_READONLY; },
    .xTruncate = [](sqlite3_file*, sqlite3_int64) { return SQLITE_READONLY; },
    .xSync = [](sqlite3_file*, int) { return SQLITE_OK; },
    .xFileSize = Size,
    .xLock = [](sqlite3_file*, int) { return SQLITE_OK; },
    .xUnlock = [](sqlite3_file*, int) { return SQLITE_OK; },
    .xCheckReservedLock = [](sqlite3_file*, int* locked) { return *locked = 0, SQLITE_OK; },
    .xFileControl = [](sqlite3_file*, int, void*) { return SQLITE_NOTFOUND; },
    .xSectorSize = [](sqlite3_file*) { return 0; },
    .xDeviceCharacteristics = [](sqlite3_file*) { return SQLITE_IOCAP_IMMUTABLE; },
};

/// Opens the database. Temporary files for sorting use SQLite's default VFS.
int Open(sqlite3_vfs*, const char* path, sqlite3_file* file, int flags, int* done_flags) {
  if ((flags & SQLITE_OPEN_MAIN_DB) == 0) {
    sqlite3_vfs* own = sqlite3_vfs_find(nullptr);
    return own->xOpen(own, path, file, flags, done_flags);
  }
  file->pMethods = nullptr;  // without methods, SQLite does not try to close the file
  const int descriptor = ::open(path, O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return SQLITE_CANTOPEN;
  static_cast<OpenFile*>(file)->descriptor = descriptor;
  file->pMethods = &kReading;
  if (done_flags != nullptr) *done_flags = SQLITE_OPEN_READONLY | SQLITE_OPEN_MAIN_DB;
  return SQLITE_OK;
}

int SamePath(sqlite3_vfs*, const char* path, int size, char* full) {
  const int length = std::snprintf(full, static_cast<std::size_t>(size), "%s", path);
  return length < size ? SQLITE_OK : SQLITE_CANTOPEN;
}

sqlite3_vfs Access() {
  sqlite3_vfs access = *sqlite3_vfs_find(nullptr);
  access.zName = "tera_whole_file";
  access.szOsFile = std::max(access.szOsFile, static_cast<int>(sizeof(OpenFile)));
  access.xOpen = Open;
  access.xFullPathname = SamePath;
  return access;
}

}  // namespace

const char* SqliteWholeFile() {
  // SQLite keeps a pointer to the registered VFS.
  static sqlite3_vfs access = Access();
  static const int status = sqlite3_vfs_register(&access, /*makeDflt=*/0);
  return status == SQLITE_OK ? access.zName : nullptr;
}

}  // namespace tera
