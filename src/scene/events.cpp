// Equal events are one trigger: what waits for it has a delay of its own.
#include "scene/events.h"

#include <fmt/format.h>

#include "physics/world.h"
#include "scene/member.h"
#include "scene/scene.h"
#include "std.h"
#include "yaml/printable.h"
#include "yaml/values.h"

namespace carom {

WindowEnd EventDecoder::end(const View& view, string_view key, double time) {
  const Node* const given = view.given(key);
  if (given == nullptr || !given->is_map()) return {time};

  const View event = view.part(key);
  const optional<Trigger> trigger = trigger_of(event);
  if (!trigger) return {not_yet};

  vector<Trigger>& all = scene_.world.triggers.all;
  const auto known = ranges::find(all, *trigger);
  const auto number = uint32_t(known - all.begin());
  if (known == all.end()) {
    all.push_back(*trigger);
    scene_.roster.events.push_back(event_text(event));
  }
  return {not_yet, number, event.number("after").value_or(0)};
}

bool EventDecoder::check(const View& view, const WindowEnd& from, const WindowEnd& until, string_view text) {
  const bool both = from.trigger && from.trigger == until.trigger;
  if (both ? from.after < until.after : from.time == not_yet || until.time == not_yet || from.time < until.time)
    return true;

  const string_view when = both ? " s after the event" : "";
  diagnostics_.add(view.place(view.given(text) != nullptr ? text : "from"),
                   fmt::format("`{}` is {}{} but `from` is {}{}", text, shortest(both ? until.after : until.time), when,
                               shortest(both ? from.after : from.time), when),
                   fmt::format("expected from < {}", text));
  return false;
}

void EventDecoder::wait(TriggeredEnd::Of of, size_t index, const WindowEnd& from, const WindowEnd& until,
                        size_t window) {
  for (const bool ends : {false, true})
    if (const WindowEnd& end = ends ? until : from; end.trigger)
      scene_.world.triggers.ends.push_back({of, uint32_t(index), uint32_t(window), ends, *end.trigger, end.after});
}

optional<Trigger> EventDecoder::trigger_of(const View& event) {
  const auto keys = filled<EventKeys>(event);
  if (keys.region != nullptr && !keys.region->bad) {
    const optional<EntityRange> regions = find_regions(*keys.region, scene_, diagnostics_);
    return regions ? optional(Trigger{.regions = *regions}) : nullopt;
  }
  if (keys.collision != nullptr && !keys.collision->bad) return collision_of(*keys.collision);
  return nullopt;
}

optional<Trigger> EventDecoder::collision_of(const Node& names) {
  const span<const Node> all = names.is_sequence() ? span<const Node>(names.items) : span(&names, 1);
  vector<EntityRange> found;
  for (const Node& name : all) {
    const auto range = find_range(name, inventory_, Sought::anything, diagnostics_);
    if (!range) return nullopt;
    found.push_back({range->first, range->count});
  }
  if (found.size() == 1) return Trigger{.a = found.front(), .b = {0, no_entity}};

  // Two things that can meet.
  const auto [a, b] = pair(found[0], found[1]);
  const Entity bodies = inventory_.body_count;
  const bool both_fixed = a.count > 0 && b.count > 0 && a.first >= bodies && b.first >= bodies;
  const bool is_alone = a.count == 1 && a == b;
  if (!both_fixed && !is_alone) return Trigger{.a = a, .b = b};
  diagnostics_.add(names.place,
                   both_fixed ? fmt::format("{} and {} are fixed things or strings, which never meet",
                                            in_backticks(all[0].text), in_backticks(all[1].text))
                              : fmt::format("{} does not meet itself", in_backticks(all[0].text)),
                   both_fixed ? "expected at least one ball, body or group" : "expected two names, or one");
  return nullopt;
}

string event_text(const View& event) {
  const auto keys = filled<EventKeys>(event);
  if (keys.region != nullptr) return fmt::format("{{region: {}}}", printable(keys.region->text));
  string names;
  if (keys.collision->is_scalar()) names = printable(keys.collision->text);
  for (const Node& name : keys.collision->items) names += (names.empty() ? "" : ", ") + printable(name.text);
  return fmt::format("{{collision: [{}]}}", names);
}

}  // namespace carom
