#pragma once
// What an author should know of letters in a scene's pictures.

#include "std.h"

namespace carom {

struct Scene;

/// Sentences on letters that the text of the scene's pictures has, and no font of the system, and on those of scripts
/// that join letters or run from right to left, which are drawn one by one from left to right. Empty: all is right, or
/// the scene has no text in pictures.
vector<string> text_notes(const Scene& scene);
/// The same of some texts. `where`: what shows them, such as "pictures". `alone`: they are in DejaVu Sans, and no other
/// font helps.
vector<string> text_notes(string_view where, const vector<string>& texts, bool alone = false);

}  // namespace carom
