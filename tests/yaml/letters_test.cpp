#include "yaml/letters.h"

#include <gtest/gtest.h>

namespace carom {
namespace {

TEST(Letters, AreCountedNotBytes) {
  EXPECT_EQ(letters_of(""), 0U);
  EXPECT_EQ(letters_of("Kugelstoß"), 9U);
  EXPECT_EQ(letters_of("10⁻⁶ m"), 6U);
}

TEST(Letters, OfATextThatIsTooLongEndInAnEllipsis) {
  EXPECT_EQ(shortened("Kugelstoß", 9), "Kugelstoß");
  EXPECT_EQ(shortened("Kugelstoß", 8), "Kugelst…");
  EXPECT_EQ(shortened("ßßß", 2), "ß…");
  EXPECT_EQ(shortened("ß", 1), "ß");
  EXPECT_EQ(shortened("ab", 1), "…");
  EXPECT_EQ(shortened("", 1), "");
}

}  // namespace
}  // namespace carom
