#include "scratch_folder.h"

#include <fmt/format.h>
#include <unistd.h>

namespace tera::bench {

ScratchFolder::ScratchFolder(const std::string& name)
    : path_(std::filesystem::temp_directory_path() /
            fmt::format("tera_bench_{}_{}", name, getpid())) {
  Empty();
}

ScratchFolder::~ScratchFolder() { std::filesystem::remove_all(path_); }

void ScratchFolder::Empty() const {
  std::filesystem::remove_all(path_);
  std::filesystem::create_directories(path_);
}

}  // namespace tera::bench
