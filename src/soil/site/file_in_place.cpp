#include "soil/site/file_in_place.h"

#include <fmt/format.h>

#include <system_error>

#include "core/error.h"

namespace tera {

void PutInPlace(
    const std::filesystem::path& file,
    const std::function<std::optional<std::string>(const std::filesystem::path& part)>& write) {
  const std::filesystem::path part = file.string() + ".part";
  std::error_code error;
  if (const auto reason = write(part)) {
    std::filesystem::remove(part, error);
    throw InputError(
        file.string(),
        {FaultKind::kUnwritable,
         fmt::format(
             "cannot be written ({}); check the folder, its permissions and the space on the disk",
             *reason)});
  }
  std::filesystem::rename(part, file, error);
  if (error) {
    throw InputError(file.string(), {FaultKind::kUnwritable,
                                     fmt::format("cannot be put in place ({})", error.message())});
  }
}

}  // namespace tera
