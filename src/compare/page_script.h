#pragma once
// The script of a comparison's page, and the rules of style that no other page has.

#include "std.h"

namespace carom {

extern const string_view comparison_style;
extern const string_view comparison_script;

}  // namespace carom
