// Decodes what a film has besides its pictures: a title card, and a chart.
#include <fmt/format.h>

#include "scene/decode.h"
#include "scene/film_layout.h"
#include "scene/scene.h"
#include "std.h"
#include "yaml/values.h"

namespace carom {
namespace {

// In the order of Quantity.
constexpr string_view quantities = "x|y|z|vx|vy|vz|speed|kinetic";

optional<ChartSubject> decode_chart(const Node& node, const Inventory& inventory, Diagnostics& diagnostics) {
  if (node.text == "energy") return ChartSubject{ChartSubject::Kind::energy};
  if (node.text == "momentum") return ChartSubject{ChartSubject::Kind::momentum};

  const size_t open = node.text.find('(');
  const vector<string_view> names = parts_of(quantities);
  const auto quantity = ranges::find(names, string_view(node.text).substr(0, open));
  if (open == string::npos || !node.text.ends_with(')') || quantity == names.end()) {
    diagnostics.add(node.place, fmt::format("{} is no chart", in_backticks(node.text)),
                    fmt::format("expected energy, momentum, or {} of a body, such as x(red)", listed(names)));
    return nullopt;
  }

  Node name = node;
  name.text = node.text.substr(open + 1, node.text.size() - open - 2);
  const auto range = find_range(name, inventory, Sought::bodies, diagnostics);
  if (!range || !inventory.fits) return nullopt;

  if (range->first >= inventory.body_count || range->count != 1) {
    diagnostics.add(node.place,
                    fmt::format("{} {}", in_backticks(name.text),
                                range->first < inventory.body_count || range->count == 0
                                    ? fmt::format("stands for {} bodies: a chart shows one", range->count)
                                    : fmt::format("is {}: a chart shows a body", inventory.word_for(*range))),
                    "expected a ball, body or member (gas.3)");
    return nullopt;
  }

  return ChartSubject{ChartSubject::Kind::body, Quantity(quantity - names.begin()), range->first};
}

}  // namespace

void decode_film_parts(const View& part, const Inventory& inventory, const string& title, VideoOutput& video,
                       Diagnostics& diagnostics) {
  if (video.title && title.empty())
    diagnostics.add(part.place("title"), "the film is to begin with the scene's title, and the scene has none",
                    "expected a `title` of the scene, or `title: false` here");

  const Node* beside = part.given("beside");
  if (beside == nullptr || beside->bad || !beside->is_scalar()) return;
  video.chart = decode_chart(*beside, inventory, diagnostics);
  if (video.size.width < least_with_chart.width || video.size.height < least_with_chart.height)
    diagnostics.add(
        part.place("size"),
        fmt::format("a film of {} x {} pixels has no room for a chart", video.size.width, video.size.height),
        fmt::format("expected at least {} x {}, or no `beside`", least_with_chart.width, least_with_chart.height));
}

}  // namespace carom
