// A word may be a kind, a key at several places and an absent word. All its meanings are printed, because the program
// cannot choose between them.
#include "commands/commands.h"

#include <fmt/format.h>
#include <unistd.h>

#include "commands/report.h"
#include "commands/text.h"
#include "scene/absent_words.h"
#include "scene/field_places.h"
#include "scene/format_page.h"
#include "std.h"
#include "yaml/diagnostics.h"
#include "yaml/joined.h"
#include "yaml/value_json.h"

namespace carom {

using Json = nlohmann::ordered_json;

namespace {

vector<string> strings(const vector<string_view>& views) {
  return {views.begin(), views.end()};
}

// "one of a or b", "a number above 0 in kg".
string value_text(const Field& field) {
  return (field.type == Type::choice ? "one of " : "") + expected(field);
}

bool has_defaults(const FieldPlaces& row) {
  return any_of(row.kinds, [](const Kind* kind) { return !kind->defaults.empty(); });
}

// The keys of which one is needed; empty: none.
vector<string> needed_keys(const Field& field, const Kind& kind) {
  return strings(need_with(kind, field));
}

vector<string> needed_keys(const FieldPlaces& row) {
  return needed_keys(*row.field, *row.kinds.front());
}

string needed_text(const FieldPlaces& row) {
  const vector<string> keys = needed_keys(row);
  if (keys.empty()) return "no";
  string text = "yes";
  if (keys.size() > 1) {
    text = fmt::format("one of {}", listed(keys, keys.size()));
  }
  return has_defaults(row) ? text + ", here or in `defaults`" : text;
}

/// A line for each key or kind with its meaning.
string key_list(const vector<pair<string_view, string>>& rows) {
  constexpr size_t column = 20;
  const size_t width = terminal_width(STDOUT_FILENO);
  string text;
  for (const auto& [name, doc] : rows)
    text += fmt::format("    {:{}}{}\n", name, column - 4, wrapped(doc, column, width));
  return text;
}

/// "kg; mass or density needed", "m/s; default [0, 0, 0]": follows the meaning of a key in a list.
string facts_text(const Field& field, const Kind& kind) {
  vector<string> facts;
  if (!field.unit.empty()) facts.emplace_back(field.unit);
  if (field.type == Type::choice) facts.push_back(expected(field));
  const vector<string> needed = needed_keys(field, kind);
  if (needed.size() == 1) facts.emplace_back("needed");
  if (needed.size() > 1) facts.push_back(listed(vector<string_view>(needed.begin(), needed.end())) + " needed");
  if (!field.initial.empty()) facts.push_back(fmt::format("default {}", field.initial));
  return facts.empty() ? "" : fmt::format(" ({})", joined(facts, "; "));
}

string keys_text(const Kind& kind) {
  vector<pair<string_view, string>> rows;
  for (const Field& field : kind.fields) rows.emplace_back(field.key, string(field.doc) + facts_text(field, kind));
  if (kind.also != nullptr) rows.emplace_back(kind.also->key, kind.also->doc);
  return key_list(rows);
}

string row_text(const FieldPlaces& row, const Options& options) {
  const Field& field = *row.field;
  Block block(options);
  block.heading(field.key, title_of(field) + (field.unit.empty() ? "" : fmt::format(" ({})", field.unit)));
  block.line("meaning", field.doc);
  block.line("value", value_text(field));
  if (!field.initial.empty()) block.line("default", field.initial);
  if (!field.example.empty()) block.line("example", fmt::format("{}: {}", field.key, field.example));

  block.line("needed", needed_text(row));
  if (const auto others = rivals(field); !others.empty())
    block.line("excludes", listed(strings(others), others.size()));
  if (!field.with.empty()) block.line("requires", field.with);
  if (!field.engines.empty()) block.line("engines", fmt::format("{} only", listed(parts_of(field.engines))));
  block.line("stands at", listed(row.paths, row.paths.size()));

  const Kind* held = field.held;
  if (held == nullptr) return block.text();
  block.line("keys", holds_map(field) ? "those below" : fmt::format("of each {}, those below", held->name));
  return block.text() + keys_text(*held);
}

string kind_text(const Kind& kind, const Options& options) {
  Block block(options);
  block.heading(kind.name, kind.doc);
  vector<string> paths = paths_of(kind);
  std::stable_partition(paths.begin(), paths.end(), [](const string& path) { return !path.starts_with("defaults."); });
  if (!paths.empty()) block.line("stands at", listed(paths, paths.size()));
  block.line("keys", "those below");
  return block.text() + keys_text(kind);
}

/// `is_key`: the format has a key or a kind of this name too.
string word_text(const AbsentWord& word, bool is_key, const Options& options) {
  Block block(options);
  block.heading(parts_of(word.words).front(), is_key ? "other meanings" : "no key of the format");
  block.line("instead", word.meaning);
  if (!word.see.empty()) block.line("see", commands_of(word));
  return block.text();
}

Json word_json(const AbsentWord& word) {
  return {{"word", parts_of(word.words).front()}, {"instead", word.meaning}, {"see", parts_of(word.see)}};
}

Json range_json(const Range& range) {
  Json out = Json::object();
  if (isfinite(range.min)) out[range.above_min ? "above" : "from"] = number_json(range.min);
  if (isfinite(range.max)) out[range.below_max ? "below" : "to"] = number_json(range.max);
  return out;
}

Json text_or_null(string_view text) {
  return text.empty() ? Json(nullptr) : Json(text);
}

Json keys_json(const Kind& kind) {
  Json keys = Json::array();
  for (const Field& field : kind.fields) keys.push_back(field.key);
  if (kind.also != nullptr) keys.push_back(kind.also->key);
  return keys;
}

Json row_json(const FieldPlaces& row) {
  const Field& field = *row.field;
  return {{"key", field.key},
          {"title", title_of(field)},
          {"meaning", field.doc},
          {"value", value_text(field)},
          {"unit", text_or_null(field.unit)},
          {"range", range_json(limited_range(field))},
          {"choices", field.type == Type::choice ? Json(choices(field)) : Json(nullptr)},
          {"default", field.initial.empty() ? Json(nullptr) : json_of_yaml(field.initial)},
          {"example", field.example.empty() ? Json(nullptr) : json_of_yaml(field.example)},
          // What must be there with it, or must not.
          {"needed", !needed_keys(row).empty()},
          {"one_of", needed_keys(row).size() > 1 ? Json(needed_keys(row)) : Json::array()},
          {"excludes", rivals(field)},
          {"beside", text_or_null(field.with)},
          {"engines", parts_of(field.engines)},
          {"paths", row.paths},
          {"keys", field.held == nullptr ? Json::array() : keys_json(*field.held)}};
}

Json kind_json(const Kind& kind) {
  return {{"kind", kind.name}, {"meaning", kind.doc}, {"keys", keys_json(kind)}};
}

/// All kinds of maps, a file's own first.
string overview() {
  string text;
  for (const auto family : families()) {
    vector<pair<string_view, string>> rows;
    for (const Kind& kind : family) rows.emplace_back(kind.name, kind.doc);
    text += fmt::format("Kinds of maps in a {} file:\n", family.front().name) + key_list(rows) + "\n";
  }
  return text + "`carom explain KEY` explains a key (rest_speed, balls.red.mass) or a kind (ball).\n";
}

/// Whether every path of the row is below `defaults`.
bool is_default_alone(const FieldPlaces& row) {
  return all_of(row.paths, [](const string& path) { return path.starts_with("defaults."); });
}

/// Several operands may be one term: `carom explain slow motion`.
vector<string> words_of(const vector<string>& operands) {
  const string term = joined(operands, " ");
  return operands.size() > 1 && find_absent_word(term) != nullptr ? vector<string>{term} : operands;
}

[[noreturn]] void refuse(const string& key) {
  const string near = suggest_place(key);
  const size_t line = near.find('\n');
  throw UsageError(fmt::format("the format has no {}{}", in_backticks(key),
                               near.empty() ? "; `carom explain` lists its kinds" : "; " + near.substr(0, line)));
}

int explain(const Options& options) {
  if (options.page) {
    if (!options.operands.empty()) throw UsageError("--page prints the whole format and takes no key");
    write_out(format_page());
    return 0;
  }

  vector<string> texts;
  Json fields = Json::array(), all = Json::array(), words = Json::array();

  for (const string& key : words_of(options.operands)) {
    const AbsentWord* word = find_absent_word(key);
    const Kind* kind = find_kind(key);
    vector<FieldPlaces> rows = find_places(key);
    // `ball` is the kind, not the key of `defaults` with the same name.
    if (kind != nullptr) std::erase_if(rows, is_default_alone);
    if (rows.empty() && kind == nullptr && word == nullptr) refuse(key);
    if (word != nullptr) {
      texts.push_back(word_text(*word, !rows.empty() || kind != nullptr, options));
      words.push_back(word_json(*word));
    }

    // The kind comes first. A key that is called like its kind shows the kind's keys itself.
    const bool shown = any_of(rows, [&](const FieldPlaces& row) { return row.field->held == kind; });
    if (kind != nullptr && !shown) {
      texts.push_back(kind_text(*kind, options));
      all.push_back(kind_json(*kind));
    }
    for (const FieldPlaces& row : rows) {
      texts.push_back(row_text(row, options));
      fields.push_back(row_json(row));
    }
  }

  if (options.operands.empty()) {
    texts.push_back(overview());
    for (const auto family : families()) {
      for (const Kind& kind : family) all.push_back(kind_json(kind));
    }
  }

  return print_end(options, 0, {{"fields", fields}, {"kinds", all}, {"words", words}}, joined(texts, "\n"));
}

}  // namespace

const Command explain_command = {
    "explain",
    explain,
    "explains a key of the format",
    "  carom explain simulate.rest_speed\n"
    "  carom explain restitution                             every place with such a key\n"
    "  carom explain balls.red.mass                          a path as in --set\n"
    "  carom explain friction                                what the format has instead\n"
    "  carom explain                                         the kinds of maps in a scene\n"
    "  carom explain --page > format.md                      all keys on a page\n",
    "Exit codes: 0 done, 2 there is no such key.",
    {{"--page"}},
    "KEY",
    "a key, a path, a kind of map or another word",
    "",
    0};

}  // namespace carom
