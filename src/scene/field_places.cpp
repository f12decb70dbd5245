// Lists every path of the format once, by walking the table from the root of each file, and searches this list.
// A path in the list has NAME and N in place of names and numbers of entries.
// A query may omit them, so that `carom explain balls.mass` and `balls.red.mass` find the same row.
#include "scene/field_places.h"

#include <fmt/format.h>

#include "scene/absent_words.h"
#include "scene/check.h"
#include "std.h"
#include "yaml/diagnostics.h"
#include "yaml/joined.h"
#include "yaml/values.h"

namespace carom {
namespace {

constexpr string_view any_name = "NAME", any_entry = "N";

struct Spot {
  const Kind* kind;
  const Field* field;
  vector<string_view> steps;
};

/// The step below a value of this field that a query may omit. Empty: none.
string_view any_step(const Field& field) {
  switch (facts_of(field.type).inside) {
    case Inside::values:
    case Inside::named:
    case Inside::paths:
      return any_name;
    case Inside::list:
      return any_entry;
    default:
      return {};
  }
}

/// Collects every place of every key of a map of `kind`, in the order of the table. `steps`: the path of the map.
void collect(const Kind& kind, const vector<string_view>& steps, vector<Spot>& found) {
  for (const Field& field : kind.fields) {
    // Defaults are those of each member.
    if (field.type == Type::repeat && !steps.empty() && steps.front() == "defaults") continue;

    vector<string_view> here = steps;
    here.push_back(field.key);
    found.push_back({&kind, &field, here});

    // What stands below it.
    const Kind* held = field.held;
    if (held != nullptr && held->also != nullptr) {
      found.push_back({held, held->also, here});
      found.back().steps.push_back(held->also->key);
    }

    if (const string_view step = any_step(field); !step.empty()) here.push_back(step);
    if (held != nullptr)
      collect(*held, here, found);
    else if (facts_of(field.type).inside == Inside::values)
      found.push_back({&kind, &field, here});
  }
}

const vector<Spot>& all_spots() {
  static const vector<Spot> all = [] {
    vector<Spot> found;
    for (const span<const Kind> family : families()) collect(family.front(), {}, found);
    return found;
  }();
  return all;
}

vector<string_view> steps_of(string_view path) {
  vector<string_view> steps;
  for (size_t i = 0; i <= path.size();) {
    const size_t end = min(path.find('.', i), path.size());
    steps.push_back(path.substr(i, end - i));
    i = end + 1;
  }
  return steps;
}

using Steps = span<const string_view>;

/// Whether `given` is the path `steps`. Names and numbers may be omitted.
bool is_path(Steps given, Steps steps) {
  if (steps.empty()) return given.empty();
  const bool any = steps.front() == any_name || steps.front() == any_entry;
  if (any && is_path(given, steps.subspan(1))) return true;
  if (given.empty()) return false;
  const bool fits = given.front() == steps.front() || (steps.front() == any_name && is_name(given.front())) ||
                    (steps.front() == any_entry && parse_index(given.front()));
  return fits && is_path(given.subspan(1), steps.subspan(1));
}

/// Whether `given` is the end of the path.
bool is_end(Steps given, Steps steps) {
  for (size_t i = 1; i < steps.size(); ++i) {
    if (steps[i] != any_name && steps[i] != any_entry && is_path(given, steps.subspan(i))) return true;
  }
  return false;
}

bool is_of_kind(Steps given, const Spot& spot) {
  return given.size() == 2 && given[0] == spot.kind->name && given[1] == spot.field->key;
}

/// Whether two rows are equal.
bool are_equal(const Field& a, const Field& b) {
  return a.key == b.key && a.type == b.type && a.unit == b.unit && a.range.min == b.range.min &&
         a.range.max == b.range.max && a.range.above_min == b.range.above_min &&
         a.range.below_max == b.range.below_max && a.range.even == b.range.even && a.initial == b.initial &&
         a.of == b.of && a.one_of == b.one_of && a.needed == b.needed && a.doc == b.doc && a.example == b.example;
}

string path_text(const vector<string_view>& steps) {
  return joined(steps, ".");
}

/// The paths as texts, each once.
vector<string> texts_of(const vector<Spot>& spots) {
  vector<string> texts;
  for (const Spot& spot : spots) {
    string text = path_text(spot.steps);
    if (!contains(texts, text)) texts.push_back(std::move(text));
  }
  return texts;
}

template <typename Fits>
vector<FieldPlaces> select(const Fits& fits) {
  vector<FieldPlaces> found;
  for (const Spot& spot : all_spots()) {
    if (!fits(spot)) continue;
    auto row = ranges::find_if(found, [&](const FieldPlaces& other) { return are_equal(*other.field, *spot.field); });
    if (row == found.end()) row = found.insert(found.end(), {spot.field, {}, {}});
    if (!contains(row->kinds, spot.kind)) row->kinds.push_back(spot.kind);
    row->paths.push_back(path_text(spot.steps));
  }
  return found;
}

vector<FieldPlaces> find_steps(Steps given) {
  // A single word matches at every place.
  const bool bare = given.size() == 1;
  vector<FieldPlaces> found;
  if (!bare) found = select([&](const Spot& spot) { return is_path(given, spot.steps); });
  if (found.empty())
    found = select([&](const Spot& spot) {
      return (bare && is_path(given, spot.steps)) || is_end(given, spot.steps) || is_of_kind(given, spot);
    });
  return found;
}

}  // namespace

vector<FieldPlaces> find_places(string_view key) {
  const vector<string_view> given = steps_of(key);
  vector<FieldPlaces> found = find_steps(given);
  if (!found.empty() || given.size() < 2) return found;
  // A component such as in balls.red.position.x.
  found = find_steps(Steps(given).first(given.size() - 1));
  std::erase_if(found,
                [&](const FieldPlaces& row) { return !has_part(facts_of(row.field->type).components, given.back()); });
  return found;
}

vector<string> plain_paths() {
  vector<Spot> spots;
  collect(families().front().front(), {}, spots);
  for (Spot& spot : spots)
    std::erase_if(spot.steps, [](string_view step) { return step == any_name || step == any_entry; });
  return texts_of(spots);
}

vector<string> settable_paths() {
  vector<Spot> spots;
  collect(families().front().front(), {}, spots);
  std::erase_if(spots, [](const Spot& spot) {
    return spot.field->held != nullptr ||
           any_of(spot.steps, [](auto step) { return step == any_name || step == any_entry; });
  });
  return texts_of(spots);
}

vector<string> paths_of(const Kind& kind) {
  vector<string> paths;
  for (const Spot& spot : all_spots()) {
    if (spot.field->held != &kind) continue;
    string path = path_text(spot.steps);
    if (const string_view step = any_step(*spot.field); !step.empty()) path += fmt::format(".{}", step);
    paths.push_back(std::move(path));
  }
  return paths;
}

string suggest_place(string_view key) {
  const vector<string_view> given = steps_of(key);
  // The longest valid start of the path determines the kind that lacks the next step.
  for (size_t count = given.size() - 1; count > 0; --count) {
    const vector<FieldPlaces> found = find_steps(Steps(given).first(count));
    const Kind* held = found.empty() ? nullptr : found.front().field->held;
    if (held == nullptr) continue;
    return fmt::format("in {}: {}", in_backticks(held->name), suggest_key(given[count], *held));
  }

  vector<string_view> known;
  for (const Spot& spot : all_spots()) known.push_back(spot.field->key);
  for (const span<const Kind> family : families()) {
    for (const Kind& kind : family) known.push_back(kind.name);
  }
  for (const AbsentWord& word : absent_words())
    for (const string_view name : parts_of(word.words)) known.push_back(name);

  const string near = nearest(given.front(), known);
  return near.empty() ? "" : fmt::format("did you mean {}?", in_backticks(near));
}

}  // namespace carom
