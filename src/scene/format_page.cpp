// Writes a section for each kind from the table of fields. A page written by hand could differ from the loader.
#include "scene/format_page.h"

#include <fmt/format.h>

#include "physics/bounds.h"
#include "scene/budget.h"
#include "scene/field_places.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

constexpr string_view introduction =
    R"(# The format of scene and sweep files

This page is made from the loader's table of keys. `carom explain KEY` prints one key, `carom schema` the table as a
JSON Schema. Editors with a YAML language server complete and check a scene whose first line is
`# yaml-language-server: $schema=scene.schema.json`, if that file lies beside it. `carom new NAME` writes both.

SI units: m, kg, s, N, J; angles in degrees. Right-handed axes, y is up.

A file is one YAML document, a map of keys. Numbers are decimal: `2`, `-0.5`, `.5`, `1e-3`; a leading zero (`010`), a unit,
quotes, `_` between digits, `.inf` and `.nan` are errors. YAML 1.1 readers take `1e-3` for text and an unquoted key `on`
for `true`: write `1.0e-3` and `"on"` for them. A flag is `true` or `false`. Names match `[A-Za-z_][A-Za-z0-9_-]*` and are
unique in a scene. An unknown or repeated key, an alias, an anchor, a tag, `<<`, a tab and a second document are errors.

Wherever a scene takes a number, a text that begins with `=` is an expression: `= r * sin(30)`. It has + - * / ^ %,
parentheses, `pi`, names of `let`, indices of `repeat`, and the functions sqrt, abs, min, max, floor, sin, cos, tan, asin,
acos, atan2, exp, log, rand and if. `a % b` has the sign of b. `rand(i)` is a number from 0 to below 1, by the scene's
`seed` and the whole number i. `if(a < b, x, y)` is x or y; it compares by < <= > >= == !=. A name of a thing may
contain expressions in braces: `'ball.{i + 1}'`. The word `none` in place of a value cancels that of `defaults`.

In paths NAME stands for a name, and N for the index of a list's entry, from 0. A key in bold is needed, here or in
`defaults`. Of bold keys that replace one another, one is needed.

)";

string quoted_list(const vector<string_view>& keys) {
  vector<string> marked;
  for (const string_view key : keys) marked.push_back(fmt::format("`{}`", key));
  return listed({marked.begin(), marked.end()});
}

string value_text(const Field& field) {
  if (field.type == Type::choice) return quoted_list(choices(field));
  const Kind* held = field.held;
  if (held == nullptr) return expected(field);
  const string link = fmt::format("[{}](#{})", held->name, held->name);

  switch (field.type) {
    case Type::part:
      return "a map: " + link;
    case Type::part_or_flag:
      return "`true`, `false` or a map: " + link;
    case Type::color_or_part:
    case Type::file_or_part:
    case Type::number_or_part: {
      const string text = expected(field);
      return text.substr(0, text.rfind(',')) + " or a map: " + link;
    }

    case Type::named:
      return "by name: " + link;
    case Type::list:
      return field.plain.empty() ? "a list: " + link
                                 : fmt::format("a list of {} or maps: {}", quoted_list(parts_of(field.plain)), link);
    default:
      return expected(field) + ": " + link;
  }
}

string meaning(const Field& field) {
  string text(field.doc);
  if (!rivals(field).empty()) text += fmt::format(" Not with {}.", quoted_list(rivals(field)));
  if (!field.with.empty()) text += " " + condition_text(field);
  if (!field.engines.empty()) text += fmt::format(" Only with engine {}.", listed(parts_of(field.engines)));
  return text;
}

string code(string_view text) {
  return text.empty() ? "" : fmt::format("`{}`", text);
}

string section(const Kind& kind, bool is_file) {
  string text = fmt::format("## {}\n\n{}\n\n", kind.name, kind.doc);
  if (!is_file) {
    string paths;
    for (const string& path : paths_of(kind)) paths += fmt::format("{}`{}`", paths.empty() ? "" : ", ", path);
    text += fmt::format("At {}.", paths);
    if (!kind.defaults.empty())
      text += fmt::format(" A key left out takes its value from `defaults.{}`.", kind.defaults);
    if (!kind.any_of.empty()) text += fmt::format(" One of {} is needed.", quoted_list(parts_of(kind.any_of)));
    text += "\n\n";
  }

  // A row for each key.
  text += "| key | value | default | example | meaning |\n| --- | --- | --- | --- | --- |\n";
  const auto row = [&](const Field& field, string_view more) {
    const string_view bold = !need_with(kind, field).empty() ? "**" : "";
    text += fmt::format("| {}`{}`{} | {} | {} | {} | {}{} |\n", bold, field.key, bold, value_text(field),
                        code(field.initial), code(field.example), meaning(field), more);
  };

  for (const Field& field : kind.fields) row(field, "");
  if (kind.also != nullptr) row(*kind.also, " Stands among the names.");
  return text + "\n";
}

/// The section on limits of numbers, distances and runs.
string limits() {
  const Budget budget;
  string text =
      "## Limits\n\n"
      "The limits keep energies, distances and their powers within the range of doubles.\n\n"
      "| unit | smallest, if it must be above 0 | largest |\n| --- | --- | --- |\n";

  for (const UnitLimit& limit : unit_limits())
    text +=
        fmt::format("| {} | {:g} | {:g} |\n", limit.unit.empty() ? "none" : limit.unit, limit.smallest, limit.largest);

  // Of scenes and runs.
  text += fmt::format(
      "\nThe smallest size is the smallest radius, height or edge of a body, an obstacle or a wall. Nothing lies "
      "farther\n"
      "from the origin than {0:g} times that size, and no starting speed times the duration is longer. A body that "
      "gets\n"
      "farther, or faster than {1:g} m/s, ends the run. Uniform forces accelerate a body by at most {2:g} m/s^2.\n\n"
      "A run has a budget. `carom check` compares the scene with it, and `--force` lifts it:\n\n"
      "| of a run | at most |\n| --- | --- |\n"
      "| bodies | {3} |\n| pictures | {4} |\n| rows of a table | {5} |\n| time steps | {6} |\n"
      "| time steps, times bodies | {7} |\n\n",
      farthest_by_size, largest_speed, largest_acceleration, budget.bodies, budget.frames, budget.rows, budget.steps,
      budget.body_steps);
  return text;
}

}  // namespace

string format_page() {
  string page(introduction);
  page += limits();
  for (const span<const Kind> family : families()) {
    for (const Kind& kind : family) page += section(kind, &kind == &family.front());
  }
  page.pop_back();
  return page;
}

}  // namespace carom
