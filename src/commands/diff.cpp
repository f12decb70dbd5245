// Describes the differences found by study/run_difference.h. Numbers have all their digits, since two runs may differ
// in the last one only.
#include "commands/commands.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "commands/error_list.h"
#include "commands/report.h"
#include "commands/text.h"
#include "files/run_folder.h"
#include "scene/load.h"
#include "std.h"
#include "study/run_difference.h"
#include "yaml/value_json.h"

namespace carom {

using Json = nlohmann::ordered_json;

namespace {

constexpr size_t most_shown = 20;  // values, bodies

string exact(double value) {
  return fmt::format("{}",
                     value == 0 ? 0.0 : value);  // shortest digits that read back: two runs may differ in the last one
}

string collision_text(const optional<CollisionFacts>& collision) {
  if (!collision) return "no more collisions";
  const string bodies = collision->b.empty() ? collision->a : fmt::format("{} and {}", collision->a, collision->b);
  return fmt::format("{} at {} s ({})", bodies, exact(collision->time), collision->kind);
}

/// The number, from 1, of the collision in which the runs part. None: they part in a row of kind `rest`.
optional<uint64_t> part_number(const CollisionDifference& difference) {
  const auto is_collision = [](const optional<CollisionFacts>& row) { return row && !row->is_rest(); };
  if (!is_collision(difference.next_a) && !is_collision(difference.next_b)) return nullopt;
  return difference.same + 1;
}

string count_text(const CollisionDifference& difference) {
  if (!difference.part)
    return difference.same == 0 ? "none in both" : fmt::format("{}, the same in both", grouped(difference.same));
  const string all = fmt::format("{} and {}", grouped(difference.count_a), grouped(difference.count_b));
  return difference.same == 0 ? all : fmt::format("{}, the first {} the same", all, grouped(difference.same));
}

string end_text(const RunDifference& difference) {
  if (!difference.end)
    return fmt::format("not known: {} has no trajectory.csv; run its scene again with the output `trajectory`",
                       printable(difference.no_end));
  const EndDifference& end = *difference.end;
  string text = end.bodies == 0     ? string("no body is in both")
                : end.greatest == 0 ? string("all bodies at the same positions")
                                    : fmt::format("at most {} m apart: {}", exact(end.greatest), end.body);
  if (end.time_a != end.time_b)
    text += fmt::format("; the ends are at {} s and {} s", exact(end.time_a), exact(end.time_b));
  for (const auto& [names, id] : {pair(&end.only_a, &difference.a.id), pair(&end.only_b, &difference.b.id)})
    if (!names->empty()) text += fmt::format("; only in {}: {}", printable(*id), listed(*names, most_shown));
  return text;
}

void describe(Block& block, const RunDifference& difference) {
  const string a = printable(difference.a.id), b = printable(difference.b.id);
  block.heading(fmt::format("{} and {}", a, b), "");
  if (difference.equal()) block.line("equal", "scenes, collisions and final positions");
  block.line("scenes", difference.values.empty()       ? "the same values"
                       : difference.values.size() == 1 ? "1 value differs"
                                                       : grouped(difference.values.size()) + " values differ");

  // The values that differ.
  vector<vector<string>> rows = {{"", a, b}};
  for (const ValueDifference& value : difference.values) {
    if (rows.size() > most_shown) break;
    const string name = value.unit.empty() ? value.path : fmt::format("{} ({})", value.path, value.unit);
    rows.push_back(
        {"  " + name, value.a.empty() ? "-" : printable(value.a), value.b.empty() ? "-" : printable(value.b)});
  }
  if (rows.size() > 1) block.table(rows);
  if (difference.values.size() >= rows.size())
    block.line("", fmt::format("and {} more: --json has all", difference.values.size() - rows.size() + 1));

  const CollisionDifference& collisions = difference.collisions;
  block.line("collisions", count_text(collisions));
  if (collisions.outcome) {
    const bool by_speed = collisions.outcome_a.separation_speed != collisions.outcome_b.separation_speed;
    const string how =
        by_speed ? fmt::format("they leave at {} m/s in {}, {} m/s in {}", exact(collisions.outcome_a.separation_speed),
                               a, exact(collisions.outcome_b.separation_speed), b)
                 : fmt::format("{} is {} in {}, {} in {}", collisions.column, printable(collisions.cell_a), a,
                               printable(collisions.cell_b), b);

    const string which = collisions.outcome_a.is_rest()
                             ? fmt::format("after {}", counted(*collisions.outcome, "collision", "collisions"))
                             : fmt::format("collision {}", grouped(*collisions.outcome + 1));
    block.line("outcome", fmt::format("{}, {}, differs: {}", which, collision_text(collisions.outcome_a), how));
  }

  if (collisions.part)
    block.line("diverge",
               fmt::format("{}: {}: {}; {}: {}",
                           part_number(collisions) ? fmt::format("in collision {}", grouped(*part_number(collisions)))
                                                   : "after " + counted(collisions.same, "collision", "collisions"),
                           a, collision_text(collisions.next_a), b, collision_text(collisions.next_b)));
  block.line("end", end_text(difference));
}

Json collision_json(const optional<CollisionFacts>& collision) {
  if (!collision) return nullptr;
  return {{"time_s", collision->time},
          {"kind", collision->kind},
          {"a", collision->a},
          {"b", collision->b},
          {"separation_speed_m_per_s", collision->separation_speed}};
}

/// Null for an empty text: the scene lacks the value.
Json value_json(const string& text) {
  if (text.empty()) return nullptr;
  const Json number = json_of_text(text);
  return number.is_number() ? number : Json(text);
}

Json difference_json(const RunDifference& difference) {
  Json json = {{"a", difference.a.folder}, {"b", difference.b.folder}, {"equal", difference.equal()}};
  json["values"] = Json::array();
  for (const ValueDifference& value : difference.values)
    json["values"].push_back(
        {{"path", value.path}, {"unit", value.unit}, {"a", value_json(value.a)}, {"b", value_json(value.b)}});

  const CollisionDifference& c = difference.collisions;
  json["collisions"] = {{"a", c.count_a}, {"b", c.count_b}, {"same", c.same}, {"part", nullptr}, {"outcome", nullptr}};
  if (c.part)
    json["collisions"]["part"] = {{"number", part_number(c) ? Json(*part_number(c)) : Json()},
                                  {"a", collision_json(c.next_a)},
                                  {"b", collision_json(c.next_b)}};
  if (c.outcome)
    json["collisions"]["outcome"] = {{"number", c.outcome_a.is_rest() ? Json() : Json(*c.outcome + 1)},
                                     {"column", c.column},
                                     {"a", collision_json(c.outcome_a)},
                                     {"b", collision_json(c.outcome_b)}};

  json["end"] = nullptr;
  if (const auto& end = difference.end) {
    json["end"] = {{"time_a_s", end->time_a}, {"time_b_s", end->time_b}, {"bodies", end->bodies}};
    json["end"]["greatest_distance_m"] = end->bodies > 0 ? Json(end->greatest) : Json();
    json["end"]["body"] = end->bodies > 0 ? Json(end->body) : Json();
    json["end"]["only_a"] = end->only_a;
    json["end"]["only_b"] = end->only_b;
  }
  return json;
}

int show_difference(const Options& options) {
  try {
    const RunDifference difference = difference_of(options.operands[0], options.operands[1]);
    Json json = {{"status", "done"}};
    json.update(difference_json(difference));
    Block block(options);
    describe(block, difference);
    return print_end(options, 0, json, block.text());
  } catch (const ExportError& error) {
    return print_refusal(options, error.what(), Json::object(), error_of_text(error.what()));
  } catch (const SceneError& error) {
    return print_refusal(options, error.what(), Json::object(), error.records);
  }
}

}  // namespace

const Command diff_command = {
    "diff",
    show_difference,
    "shows where two runs diverge, and how far apart they end",
    "  carom diff output/half output/full\n"
    "  carom diff output/falls/runs/r0001 output/falls/runs/r0002 --json\n",
    "Scenes are compared value by value, collisions by kind, bodies and time. Both runs need\n"
    "collisions.csv, and trajectory.csv for their ends. Nothing is written.\n\n"
    "Exit codes: 0 done, whether equal or not, 2 the command line or a folder is wrong.",
    {},
    "DIR",
    "two runs' folders",
    "name two runs' folders: carom {} output/half output/full",
    2,
    2};

}  // namespace carom
