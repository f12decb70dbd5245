#pragma once
// Templates of captions: text with names in braces, such as "{title}  t = {time} s, e = {restitution.default}".
// `{{` and `}}` are braces.

#include "std.h"
#include "yaml/diagnostics.h"
#include "yaml/document.h"

namespace carom {

/// What a run fills in, separated by |. Any other name is a path into the scene.
inline constexpr string_view caption_names = "title|time|run|collisions|slow";

/// The template of `caption: true`.
inline constexpr string_view usual_caption = "{title}   {time} s";

struct CaptionPart {
  // unclosed: a brace without its end, and what follows; unopened: a brace without its start
  enum class Kind { text, name, unclosed, unopened };
  Kind kind = Kind::text;
  string text;    // without braces; of a text, with its double braces made single
  size_t at = 0;  // bytes from the start of the template to the part
};
vector<CaptionPart> parts_of_caption(string_view caption);

/// Whether the template has this name.
bool has_name(string_view caption, string_view name);

/// The caption of one picture.
struct CaptionValues {
  string title, time, run, collisions;
  string slow{};  // "1/8 speed"; empty: the film is not slow
};
/// A caption without {slow} ends with it.
string caption_text(string_view caption, const CaptionValues& values);

/// The template of the scene's key `caption`, with the values of paths in place of their names. Empty: none is wanted.
/// Names that the scene lacks are errors at their place.
string decode_caption(const Node& root, Diagnostics& diagnostics);

}  // namespace carom
