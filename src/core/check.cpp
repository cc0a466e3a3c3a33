#include "core/check.h"

#include <fmt/format.h>

#include "core/error.h"

namespace tera {

void FailCheck(const char* condition, const char* file, int line, const std::string& values) {
  throw InternalError(fmt::format("{}:{}: broken invariant: {}{}{}", file, line, condition,
                                  values.empty() ? "" : "; values:", values));
}

}  // namespace tera
