// Paths are replaced when a scene is loaded, because a resolved scene has no `defaults`, to which a path may lead.
// What changes during a run stays a name.
#include "scene/caption.h"

#include <fmt/format.h>

#include "scene/field.h"
#include "scene/value_at.h"
#include "scene/view.h"
#include "std.h"
#include "yaml/values.h"

namespace carom {
namespace {

bool is_run_name(string_view name) {
  const vector<string_view> names = parts_of(caption_names);
  return contains(names, name);
}

/// Text in which braces are not read as names.
string with_double_braces(string_view text) {
  string out;
  for (const char c : text) {
    out += c;
    if (c == '{' || c == '}') out += c;
  }
  return out;
}

/// The place of a part of a scalar. That of the scalar, if its text is not verbatim in the file.
Place place_in(const Node& node, size_t at, size_t length) {
  const size_t size = node.text.size();
  if (node.place.length != size && node.place.length != size + 2) return node.place;
  const size_t quote = node.place.length == size ? 0 : 1;
  return {node.place.source, uint32_t(node.place.offset + quote + at), uint32_t(length)};
}

/// Names are replaced by the values at their paths, except those that a run fills in.
class CaptionDecoder {
 public:
  CaptionDecoder(const Node& root, const Node& node, Diagnostics& diagnostics)
      : root_(root), node_(node), diagnostics_(diagnostics) {}

  string run() {
    string out;
    for (const CaptionPart& part : parts_of_caption(node_.text)) {
      if (part.kind == CaptionPart::Kind::text) out += with_double_braces(part.text);
      if (part.kind == CaptionPart::Kind::unclosed)
        diagnostics_.add(place_in(node_, part.at, 1), "a brace is not closed", "expected {name}, or {{ for a brace");
      if (part.kind == CaptionPart::Kind::unopened)
        diagnostics_.add(place_in(node_, part.at, 1), "a brace is not opened", "expected {name}, or }} for a brace");
      if (part.kind == CaptionPart::Kind::name) out += value_of(part);
    }
    return out;
  }

 private:
  string value_of(const CaptionPart& part) {
    if (is_run_name(part.text)) return fmt::format("{{{}}}", part.text);
    const ValueAtPath found =
        part.text.empty() ? ValueAtPath{"", "there is no name between the braces", ""} : value_at(root_, part.text);
    if (found.problem.empty()) return with_double_braces(found.text);
    const string near = nearest(part.text, parts_of(caption_names));
    string remedy = near.empty() ? found.remedy : fmt::format("did you mean {}?", in_backticks(near));
    // The keys of the whole scene are too many to help.
    const size_t list = remedy.starts_with("expected ") ? 0 : remedy.find("\nexpected ");
    if (part.text.find('.') == string::npos && list != string::npos) remedy.erase(list);
    diagnostics_.add(
        place_in(node_, part.at, part.text.size() + 2), found.problem,
        remedy + (remedy.empty() ? "" : "\n") +
            "expected {title}, {time}, {run}, {collisions}, {slow} or a path such as {restitution.default}");
    return "";
  }

  const Node& root_;
  const Node& node_;
  Diagnostics& diagnostics_;
};

}  // namespace

vector<CaptionPart> parts_of_caption(string_view caption) {
  vector<CaptionPart> parts;
  const auto add = [&](char c, size_t at) {
    if (parts.empty() || parts.back().kind != CaptionPart::Kind::text)
      parts.push_back({CaptionPart::Kind::text, "", at});
    parts.back().text += c;
  };

  for (size_t i = 0; i < caption.size(); ++i) {
    const char c = caption[i];
    const bool twice = i + 1 < caption.size() && caption[i + 1] == c;

    // Braces that close nothing.
    if (c == '}' && !twice) {
      parts.push_back({CaptionPart::Kind::unopened, "}", i});
      continue;
    }

    // Text, in which two braces are one.
    if (c != '{' || twice) {
      add(c, i);
      if ((c == '{' || c == '}') && twice) ++i;
      continue;
    }

    // A name, up to the next brace.
    const size_t end = caption.find('}', i);
    if (end == string_view::npos) {
      parts.push_back({CaptionPart::Kind::unclosed, string(caption.substr(i + 1)), i});
      break;
    }
    parts.push_back({CaptionPart::Kind::name, string(caption.substr(i + 1, end - i - 1)), i});
    i = end;
  }

  return parts;
}

bool has_name(string_view caption, string_view name) {
  const vector<CaptionPart> parts = parts_of_caption(caption);
  return any_of(parts,
                [&](const CaptionPart& part) { return part.kind == CaptionPart::Kind::name && part.text == name; });
}

string caption_text(string_view caption, const CaptionValues& values) {
  string text;
  bool has_slow = values.slow.empty();
  for (const CaptionPart& part : parts_of_caption(caption)) {
    if (part.kind != CaptionPart::Kind::name) {
      text += part.text;
      continue;
    }

    text += part.text == "title"  ? values.title
            : part.text == "time" ? values.time
            : part.text == "run"  ? values.run
            : part.text == "slow" ? values.slow
                                  : values.collisions;
    has_slow = has_slow || part.text == "slow";
  }

  return has_slow ? text : text + (text.empty() ? "" : "   ") + values.slow;
}

string decode_caption(const Node& root, Diagnostics& diagnostics) {
  const Node* node = root.find("caption");
  if (node == nullptr || node->bad || !node->is_scalar()) return "";
  if (!node->quoted && (node->text == "true" || node->text == "false"))
    return node->text == "true" ? string(usual_caption) : "";
  return CaptionDecoder(root, *node, diagnostics).run();
}

}  // namespace carom
