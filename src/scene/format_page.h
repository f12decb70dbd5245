#pragma once
// The table of fields as a page to read.
#include <string>

namespace carom {

/// The reference of scene and sweep files in Markdown, a section a kind.
std::string format_page();

}  // namespace carom
