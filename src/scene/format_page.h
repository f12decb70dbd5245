#pragma once
// The table of fields as a Markdown page.
#include <string>

namespace carom {

/// The reference of scene and sweep files in Markdown, one section for each kind.
std::string format_page();

}  // namespace carom
