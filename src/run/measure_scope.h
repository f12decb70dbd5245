#pragma once
// The names in measures to the bodies, fixed things and strings of a scene.

#include "physics/extremes.h"
#include "physics/watched_impulse.h"
#include "run/measure.h"
#include "std.h"

namespace carom {

struct Scene;

/// A span of a part's text in the text of the whole. An empty one: the whole part.
TextSpan within(const TextSpan& part, const TextSpan& span);

/// "; did you mean `red`?", or empty.
string near_name(string_view word, const vector<string_view>& names);

/// Whether a thing has this name, or is one of several that have it: gas.3, room.x_min, posts.2.
bool is_named(string_view thing, string_view name);

/// The bodies of a measure of a quantity: one, the members of a group, or all; none of `repeat: 0`. Throws
/// MeasureError.
EntityRange bodies_of(const Measure& measure, const Scene& scene);

/// What a measure's name stands for: bodies, members of a group, fixed things, the room or one of its sides, strings.
/// Empty: a thing with `repeat: 0`. Throws MeasureError.
vector<EntityRange> things_named(string_view name, const Measure& measure, const Scene& scene);

/// The window of a measure, with the numbers that it may name. Throws MeasureError.
TimeWindow window_of(const Measure& measure, const map<string, double>& numbers);

/// The regions of a measure of regions: one, or all members of a repeated one, perhaps none; ascending. Throws
/// MeasureError.
vector<uint32_t> regions_named(const Measure& measure, const Scene& scene);

/// Throws MeasureError unless the scene has all that the measure names.
void check_names(const Measure& measure, const Scene& scene);

}  // namespace carom
