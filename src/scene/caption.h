#pragma once
// Templates of captions: text with names in braces, such as "{title}  t = {time} s, e = {restitution.default}".
// `{{` and `}}` are braces.
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "yaml/diagnostics.h"
#include "yaml/document.h"

namespace carom {

/// What a run fills in, separated by |. Any other name is a path into the scene.
inline constexpr std::string_view caption_names = "title|time|run|collisions";

/// The template of `caption: true`.
inline constexpr std::string_view usual_caption = "{title}   {time} s";

struct CaptionPart {
  // unclosed: a brace without its end, and what follows; unopened: a brace without its start
  enum class Kind { text, name, unclosed, unopened };
  Kind kind = Kind::text;
  std::string text;    // without braces; of a text, with its double braces made single
  std::size_t at = 0;  // bytes from the start of the template to the part
};
std::vector<CaptionPart> parts_of_caption(std::string_view caption);

/// Whether the template has this name.
bool has_name(std::string_view caption, std::string_view name);

/// The caption of one picture.
struct CaptionValues {
  std::string title, time, run, collisions;
};
std::string caption_text(std::string_view caption, const CaptionValues& values);

/// The template of the scene's key `caption`, with the values of paths in place of their names. Empty: none is wanted.
/// Names that the scene lacks are errors at their place.
std::string decode_caption(const Node& root, Diagnostics& diagnostics);

}  // namespace carom
