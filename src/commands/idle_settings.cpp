// A setting of an output that is not written may still matter: a video takes values of `frames`. The outputs with and
// without the setting answer that. The appearance matters only to outputs that are drawn.
#include "commands/idle_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <string_view>

#include "commands/text.h"
#include "files/manifest.h"
#include "scene/fields.h"
#include "scene/output_kinds.h"

namespace carom {
namespace {

/// Keys of the scene on which pictures depend and the motion does not.
constexpr std::string_view appearance = "camera|lights|background";

/// The words of the path of "path=value".
std::vector<std::string_view> words_of(std::string_view setting) {
  std::vector<std::string_view> words;
  std::string_view rest = setting.substr(0, setting.find('='));
  for (std::size_t dot = 0; dot != std::string_view::npos; rest.remove_prefix(dot + 1)) {
    dot = rest.find('.');
    words.push_back(rest.substr(0, dot));
    if (dot == std::string_view::npos) break;
  }
  return words;
}

const OutputKind* output_set(const std::vector<std::string_view>& words) {
  if (words.size() < 2 || words[0] != "output") return nullptr;
  const auto kinds = output_kinds();
  const auto found = std::find_if(kinds.begin(), kinds.end(), [&](const OutputKind& k) { return k.name == words[1]; });
  return found == kinds.end() ? nullptr : &*found;
}

bool sets_appearance(const std::vector<std::string_view>& words) {
  const std::vector<std::string_view> keys = parts_of(appearance);
  return words.back() == "color" || std::find(keys.begin(), keys.end(), words.front()) != keys.end();
}

bool draws(const Output& output) {
  const auto kinds = output_kinds();
  return std::any_of(kinds.begin(), kinds.end(), [&](const OutputKind& k) { return k.draws && k.asked(output); });
}

}  // namespace

std::vector<std::string> idle_settings(const std::vector<std::string>& set, const Output& written,
                                       const std::function<Output(const std::vector<std::string>& set)>& written_with) {
  std::vector<std::string> found;
  const auto report = [&](const std::string& setting, std::string_view why) {
    found.push_back(fmt::format("--set {} changes nothing: {}", printable(setting), why));
  };
  for (std::size_t i = 0; i < set.size(); ++i) {
    const std::vector<std::string_view> words = words_of(set[i]);
    if (const OutputKind* kind = output_set(words); kind != nullptr && !kind->asked(written)) {
      std::vector<std::string> others = set;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
      try {
        if (outputs_text(written_with(others)) != outputs_text(written)) continue;
      } catch (const std::exception&) {
        // Without it the scene is wrong, so it matters.
        continue;
      }
      report(set[i], fmt::format("the output `{}` is not written", kind->name));
    } else if (sets_appearance(words) && !draws(written)) {
      report(set[i], "no output is drawn");
    }
  }
  return found;
}

}  // namespace carom
