// A setting of an output that is not written may still matter: pictures take values of each other. The outputs with and
// without the setting answer that. Keys for pictures alone matter only to outputs that are drawn. A mesh is one of them
// unless it has `fit`, which gives the body the mesh's volume: the motions with and without the setting then differ.
#include "commands/idle_settings.h"

#include <fmt/format.h>

#include <exception>

#include "commands/text.h"
#include "export/picture_streams.h"
#include "files/manifest.h"
#include "scene/motion_text.h"
#include "scene/output_kinds.h"
#include "scene/path_field.h"
#include "std.h"

namespace carom {
namespace {

const OutputKind* output_set(string_view path) {
  constexpr string_view outputs = "output.";
  if (!path.starts_with(outputs)) return nullptr;
  path.remove_prefix(outputs.size());
  const string_view name = path.substr(0, path.find('.'));
  const auto kinds = output_kinds();
  const auto found = ranges::find_if(kinds, [&](const OutputKind& k) { return k.name == name; });
  return found == kinds.end() ? nullptr : &*found;
}

/// The outputs with their settings, and what the sheet's pictures take from the others.
string written_text(const Scene& scene) {
  const string outputs = outputs_text(scene.output);
  if (!scene.output.sheet) return outputs;
  const PictureStream picture = still_stream(scene, 0);
  return fmt::format("{} {} {} {} {} {}", outputs, picture.size.width, picture.size.height, picture.samples,
                     picture.interval, picture.clock.speed());
}

bool draws(const Output& output) {
  const auto kinds = output_kinds();
  return any_of(kinds, [&](const OutputKind& k) { return k.draws && k.asked(output); });
}

}  // namespace

vector<string> idle_settings(const vector<string>& set, const Scene& written,
                             const function<Scene(const vector<string>& set)>& written_with) {
  vector<string> found;
  const auto report = [&](const string& setting, string_view why) {
    found.push_back(fmt::format("--set {} changes nothing: {}", printable(setting), why));
  };

  // Whether a text of the scene is the same without an option.
  const auto is_same_without = [&](size_t option, const function<string(const Scene&)>& text) {
    vector<string> others = set;
    others.erase(others.begin() + ptrdiff_t(option));
    try {
      return text(written_with(others)) == text(written);
    } catch (const std::exception&) {
      // Without it the scene is wrong, so it matters.
      return false;
    }
  };

  for (size_t i = 0; i < set.size(); ++i) {
    const string_view path = string_view(set[i]).substr(0, set[i].find('='));
    if (const OutputKind* kind = output_set(path); kind != nullptr && !kind->asked(written.output)) {
      if (is_same_without(i, written_text)) report(set[i], fmt::format("the output `{}` is not written", kind->name));
    } else if (is_drawn(path) && !draws(written.output)) {
      // With `fit` a mesh is the volume, too.
      if (path.find(".mesh") == string_view::npos ||
          is_same_without(i, [](const Scene& scene) { return motion_text(scene); }))
        report(set[i], "no output is drawn");
    }
  }
  return found;
}

}  // namespace carom
