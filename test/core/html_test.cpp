#include "core/html.h"

#include <gtest/gtest.h>

namespace tera {
namespace {

TEST(Escaped, LeavesNoCharacterThatHtmlOrAnAttributeReserves) {
  EXPECT_EQ(Escaped("boom's <b> & \"arm\", 3 m"),
            "boom&#39;s &lt;b&gt; &amp; &quot;arm&quot;, 3 m");
}

}  // namespace
}  // namespace tera
