// Paths are replaced when a scene is loaded, because a resolved scene has no `defaults`, to which a path may lead.
// What changes during a run stays a name.
#include "scene/caption.h"

#include <fmt/format.h>

#include <algorithm>

#include "scene/fields.h"
#include "scene/value_at.h"
#include "scene/view.h"
#include "yaml/values.h"

namespace carom {
namespace {

bool is_run_name(std::string_view name) {
  const std::vector<std::string_view> names = parts_of(caption_names);
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Text in which braces are not read as names.
std::string with_double_braces(std::string_view text) {
  std::string out;
  for (const char c : text) {
    out += c;
    if (c == '{' || c == '}') out += c;
  }
  return out;
}

/// The place of a part of a scalar. That of the scalar, if its text is not verbatim in the file.
Place place_in(const Node& node, std::size_t at, std::size_t length) {
  const std::size_t size = node.text.size();
  if (node.place.length != size && node.place.length != size + 2) return node.place;
  const std::size_t quote = node.place.length == size ? 0 : 1;
  return {node.place.source, static_cast<std::uint32_t>(node.place.offset + quote + at),
          static_cast<std::uint32_t>(length)};
}

/// Names are replaced by the values at their paths, except those that a run fills in.
class CaptionDecoder {
 public:
  CaptionDecoder(const Node& root, const Node& node, Diagnostics& diagnostics)
      : root_(root), node_(node), diagnostics_(diagnostics) {}

  std::string run() {
    std::string out;
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
  std::string value_of(const CaptionPart& part) {
    if (is_run_name(part.text)) return fmt::format("{{{}}}", part.text);
    const ValueAtPath found =
        part.text.empty() ? ValueAtPath{"", "there is no name between the braces", ""} : value_at(root_, part.text);
    if (found.problem.empty()) return with_double_braces(found.text);
    const std::string near = nearest(part.text, parts_of(caption_names));
    std::string remedy = near.empty() ? found.remedy : fmt::format("did you mean {}?", in_backticks(near));
    // The keys of the whole scene are too many to help.
    const std::size_t list = remedy.starts_with("expected ") ? 0 : remedy.find("\nexpected ");
    if (part.text.find('.') == std::string::npos && list != std::string::npos) remedy.erase(list);
    diagnostics_.add(place_in(node_, part.at, part.text.size() + 2), found.problem,
                     remedy + (remedy.empty() ? "" : "\n") +
                         "expected {title}, {time}, {run}, {collisions} or a path such as {restitution.default}");
    return "";
  }

  const Node& root_;
  const Node& node_;
  Diagnostics& diagnostics_;
};

}  // namespace

std::vector<CaptionPart> parts_of_caption(std::string_view caption) {
  std::vector<CaptionPart> parts;
  const auto add = [&](char c, std::size_t at) {
    if (parts.empty() || parts.back().kind != CaptionPart::Kind::text)
      parts.push_back({CaptionPart::Kind::text, "", at});
    parts.back().text += c;
  };
  for (std::size_t i = 0; i < caption.size(); ++i) {
    const char c = caption[i];
    const bool twice = i + 1 < caption.size() && caption[i + 1] == c;
    if (c == '}' && !twice) {
      parts.push_back({CaptionPart::Kind::unopened, "}", i});
      continue;
    }
    if (c != '{' || twice) {
      add(c, i);
      if ((c == '{' || c == '}') && twice) ++i;
      continue;
    }
    const std::size_t end = caption.find('}', i);
    if (end == std::string_view::npos) {
      parts.push_back({CaptionPart::Kind::unclosed, std::string(caption.substr(i + 1)), i});
      break;
    }
    parts.push_back({CaptionPart::Kind::name, std::string(caption.substr(i + 1, end - i - 1)), i});
    i = end;
  }
  return parts;
}

bool has_name(std::string_view caption, std::string_view name) {
  const std::vector<CaptionPart> parts = parts_of_caption(caption);
  return std::any_of(parts.begin(), parts.end(), [&](const CaptionPart& part) {
    return part.kind == CaptionPart::Kind::name && part.text == name;
  });
}

std::string caption_text(std::string_view caption, const CaptionValues& values) {
  std::string text;
  for (const CaptionPart& part : parts_of_caption(caption)) {
    if (part.kind != CaptionPart::Kind::name)
      text += part.text;
    else
      text += part.text == "title"  ? values.title
              : part.text == "time" ? values.time
              : part.text == "run"  ? values.run
                                    : values.collisions;
  }
  return text;
}

std::string decode_caption(const Node& root, Diagnostics& diagnostics) {
  const Node* node = root.find("caption");
  if (node == nullptr || node->bad || !node->is(Node::Kind::scalar)) return "";
  if (!node->quoted && (node->text == "true" || node->text == "false"))
    return node->text == "true" ? std::string(usual_caption) : "";
  return CaptionDecoder(root, *node, diagnostics).run();
}

}  // namespace carom
