#pragma once
// The table of fields as a Markdown page.

#include "std.h"

namespace carom {

/// The reference of scene and sweep files in Markdown, one section for each kind.
string format_page();

}  // namespace carom
