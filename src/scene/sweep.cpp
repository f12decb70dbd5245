// Computes run i of a sweep from its number alone: blocks, then combinations, then seeds as the fastest digit.
// The list of runs is never stored, so a sweep of many runs costs little memory and shards need no shared state.
#include "scene/sweep.h"

#include <fmt/format.h>

#include "scene/resolve.h"
#include "std.h"

namespace carom {

size_t Sweep::size() const {
  size_t count = 0;
  for (const SweepBlock& block : blocks) count += block.kept.size();
  return count * max<uint64_t>(seeds, 1);
}

string Sweep::id(size_t number) const {
  return fmt::format("r{:04}", number + 1);
}

SweepRun Sweep::run(size_t number) const {
  SweepRun run;
  run.id = id(number);
  run.values.resize(paths.size());
  for (const SweepValue& value : set_values) run.settings.push_back({value.text, value.where});

  // The combination, whose digits are the cases of the axes.
  const size_t repeats = max<uint64_t>(seeds, 1);
  size_t combination = number / repeats;
  const SweepBlock* block = blocks.data();
  for (; combination >= block->kept.size(); ++block) combination -= block->kept.size();

  // The case of each axis: the last one varies fastest.
  size_t rest = block->kept[combination];
  vector<const SweepCase*> cases(block->axes.size());
  for (size_t a = block->axes.size(); a-- > 0;) {
    const vector<SweepCase>& all = block->axes[a].cases;
    cases[a] = &all[rest % all.size()];
    rest /= all.size();
  }

  for (const SweepCase* one : cases) {
    for (const auto& [path, value] : one->values) {
      run.values[path] = value.text;
      run.settings.push_back({paths[path] + "=" + value.text, value.where});
    }
  }

  if (seeds > 0) {
    // Without repeats the paths contain no seed.
    const string of_run = to_string(first_seed.value_or(0) + number % repeats);
    run.values.back() = of_run;
    run.settings.push_back({"seed=" + of_run, file});
  }

  return run;
}

namespace {

/// "path: [value, value]" of each path of a grid's or a zip's axis.
string columns(const SweepAxis& axis, const vector<string>& paths) {
  string out;
  for (size_t column = 0; column < axis.cases.front().values.size(); ++column) {
    string values;
    for (const SweepCase& one : axis.cases) values += (values.empty() ? "" : ", ") + one.values[column].second.text;
    out += fmt::format("      {}: [{}]\n", paths[axis.cases.front().values[column].first], values);
  }
  return out;
}

string lines(const SweepAxis& axis, const vector<string>& paths) {
  string out;
  for (const SweepCase& one : axis.cases) {
    string values;
    for (const auto& [path, value] : one.values)
      values += fmt::format("{}{}: {}", values.empty() ? "" : ", ", paths[path], value.text);
    out += "      - {" + values + "}\n";
  }
  return out;
}

string block_text(const SweepBlock& block, const vector<string>& paths) {
  string grid, zip, list;
  for (const SweepAxis& axis : block.axes) {
    if (axis.kind == SweepAxis::Kind::grid) grid += columns(axis, paths);
    if (axis.kind == SweepAxis::Kind::zip) zip += columns(axis, paths);
    if (axis.kind == SweepAxis::Kind::list) list += lines(axis, paths);
  }

  string out;
  const auto add = [&](string_view key, const string& text) {
    if (!text.empty()) out += fmt::format("    {}:\n{}", key, text);
  };

  add("grid", grid);
  add("zip", zip);
  add("list", list);
  out += block.samples;
  if (!block.skip.empty()) out += fmt::format("    skip: {}\n", block.skip);

  if (out.empty()) return "  - {}\n";
  out[2] = '-';
  return out;
}

}  // namespace

string Sweep::resolved(string_view base_name) const {
  string out = fmt::format("sweep: 1\ntitle: {}\nbase: {}\n", in_quotes(title), in_quotes(base_name));
  if (!set_values.empty()) out += "set:\n";
  for (const SweepValue& value : set_values) {
    const size_t equals = value.text.find('=');
    out += fmt::format("  {}: {}\n", value.text.substr(0, equals), value.text.substr(equals + 1));
  }

  if (seed) out += fmt::format("seed: {}\n", *seed);
  if (skip_invalid) out += "skip_invalid: true\n";
  out += "runs:\n";
  for (const SweepBlock& block : blocks) out += block_text(block, paths);

  if (seeds > 0) out += fmt::format("repeat: {{seeds: {}, first: {}}}\n", seeds, first_seed.value_or(0));
  if (!only.empty()) {
    string names;
    for (const SweepValue& name : only) names += (names.empty() ? "" : ", ") + in_quotes(name.text);
    out += fmt::format("only: [{}]\n", names);
  }

  // What the comparison shows.
  if (measures.empty() && charts.empty() && !collisions) return out;
  out += "compare:\n";
  if (!measures.empty()) out += "  measures:\n";
  for (const SweepMeasure& measure : measures) out += fmt::format("    - {}\n", in_quotes(measure.name));
  if (collisions) out += "  collisions: true\n";

  if (!charts.empty()) out += "  charts:\n";
  for (const SweepChart& chart : charts) {
    out += fmt::format("    - {{x: {}, {}: {}", in_quotes(chart.x), key_text("y"), in_quotes(chart.y));
    out += chart.by.empty() ? "}\n" : fmt::format(", by: {}}}\n", in_quotes(chart.by));
  }
  return out;
}

}  // namespace carom
