#include "core/beside.h"

#include <gtest/gtest.h>

#include <latch>
#include <stdexcept>
#include <string>

namespace tera {
namespace {

// Each waits for the other: in sequence they would wait for ever.
TEST(Beside, GoesOnWhileTheCallerDoes) {
  std::latch both(2);
  auto other = Beside([&] {
    both.arrive_and_wait();
    return std::string("done");
  });
  both.arrive_and_wait();
  EXPECT_EQ(other.get(), "done");
}

TEST(Beside, ThrowsWhereItIsAskedFor) {
  auto other = Beside([]() -> int { throw std::runtime_error("broken"); });
  EXPECT_THROW(other.get(), std::runtime_error);
}

}  // namespace
}  // namespace tera
