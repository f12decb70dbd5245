// Reads a CSV file (RFC 4180, without line breaks in cells) into the tree. All that follows, from the check of overlaps
// to the resolved scene, then knows single balls with numbers alone. A run's folder thus needs no copy of the file, and
// a run is up to date as long as the numbers are the same.
#include "scene/table.h"

#include <fmt/format.h>

#include "scene/check.h"
#include "scene/decode.h"
#include "scene/fields.h"
#include "scene/view.h"
#include "std.h"
#include "yaml/joined.h"
#include "yaml/source.h"
#include "yaml/values.h"

namespace carom {
namespace {

/// As many values as a file may have (document.cpp).
constexpr double most_values = 6e6;
/// Of one file. Then its reading ends.
constexpr size_t most_errors = 20;

/// A column that has a meaning, and the key of a ball that it fills, or a part of one.
struct TableColumn {
  string_view name, key;
  bool needed = false;
};

constexpr TableColumn table_columns[] = {
    {"x_m", "position", true},  {"y_m", "position", true},  {"z_m", "position", true}, {"vx_m_per_s", "velocity"},
    {"vy_m_per_s", "velocity"}, {"vz_m_per_s", "velocity"}, {"radius_m", "radius"},    {"mass_kg", "mass"},
};
constexpr size_t table_column_count = std::size(table_columns);

struct TableCell {
  string_view text;  // without quotes and blanks around it
  Place place;
};

/// A line's cells. Quotes that are doubled stay so: no number has any.
vector<TableCell> cells_of(string_view line, uint32_t source, size_t at) {
  vector<TableCell> cells;
  for (size_t i = 0; i <= line.size();) {
    bool quoted = false;
    size_t end = i;
    for (; end < line.size() && (quoted || line[end] != ','); ++end) quoted = quoted != (line[end] == '"');

    size_t from = i, to = end;
    const auto is_around = [&](size_t k) { return line[k] == ' ' || line[k] == '\t' || line[k] == '"'; };
    while (from < to && is_around(from)) ++from;
    while (to > from && is_around(to - 1)) --to;
    cells.push_back({line.substr(from, to - from), {source, uint32_t(at + from), uint32_t(max<size_t>(to - from, 1))}});
    i = end + 1;
  }
  return cells;
}

class TableReader {
 public:
  TableReader(const vector<Source>& sources, uint32_t index, Diagnostics& diagnostics)
      : text_(sources[index].text), index_(index), diagnostics_(diagnostics) {}

  /// The balls, a list of maps as `members` has it. None: an error was added.
  optional<Node> run(Place where) {
    const size_t errors = diagnostics_.added();
    Node members;
    members.kind = Node::Kind::sequence;
    members.place = where;

    for (size_t at = 0; at < text_.size() && diagnostics_.added() < errors + most_errors;) {
      const size_t end = min(text_.find('\n', at), text_.size());
      const string_view line = text_.substr(at, end - at);
      const bool is_blank = line.find_first_not_of(" \t\r") == string_view::npos;
      if (!is_blank && header_.empty()) {
        if (!read_header(line, at)) return nullopt;
      } else if (!is_blank) {
        members.items.push_back(ball(line, at));
        if (double(members.items.size()) * values_a_ball_ > most_values) return too_many(members);
      }
      at = end + 1;
    }

    if (diagnostics_.added() > errors) return nullopt;
    if (!members.items.empty()) return members;
    diagnostics_.add({index_, 0, 1}, "the table has no balls",
                     "expected a line with the names of the columns, and a line for each ball");
    return nullopt;
  }

  bool has(string_view key) const {
    for (size_t k = 0; k < table_column_count; ++k)
      if (table_columns[k].key == key && at_[k]) return true;
    return false;
  }

 private:
  bool read_header(string_view line, size_t at) {
    // Some programs write the names as a comment.
    const size_t mark = line.find_first_not_of("# \t");
    header_ = cells_of(line.substr(mark), index_, at + mark);
    vector<string_view> names;
    for (size_t i = 0; i < header_.size(); ++i) {
      const auto column = ranges::find(table_columns, header_[i].text, &TableColumn::name);
      names.push_back(header_[i].text);
      if (column == std::end(table_columns)) continue;
      optional<size_t>& known = at_[size_t(column - table_columns)];
      if (known) return refuse_name(header_[i], "the table has the column {} twice", "remove one of them");
      known = i;
    }

    for (size_t k = 0; k < table_column_count; ++k) {
      const bool is_vector = table_columns[k].key == "position" || has(table_columns[k].key);
      if (!at_[k] && is_vector) return refuse_missing(table_columns[k].name, line, at, names);
    }
    values_a_ball_ = 1 + 4 + (has("velocity") ? 4 : 0) + (has("radius") ? 1 : 0) + (has("mass") ? 1 : 0);
    return true;
  }

  bool refuse_name(const TableCell& cell, const char* message, string remedy) {
    diagnostics_.add(cell.place, fmt::format(fmt::runtime(message), in_backticks(cell.text)), std::move(remedy));
    return false;
  }

  bool refuse_missing(string_view name, string_view line, size_t at, const vector<string_view>& names) {
    vector<string_view> unknown;
    for (const string_view other : names)
      if (ranges::find(table_columns, other, &TableColumn::name) == std::end(table_columns)) unknown.push_back(other);
    const string near = nearest(name, unknown);
    const bool other_comma = line.find(',') == string_view::npos && line.find_first_of(";\t") != string_view::npos;
    const Place place{index_, uint32_t(at), uint32_t(max<size_t>(line.size(), 1))};
    diagnostics_.add(place, fmt::format("the table has no column {}", in_backticks(name)),
                     other_comma     ? "columns are separated by commas, and the decimal point is a point"
                     : !near.empty() ? fmt::format("expected this name in place of {}", in_backticks(near))
                                     : "expected the columns x_m, y_m, z_m, and where present vx_m_per_s, vy_m_per_s, "
                                       "vz_m_per_s, radius_m, mass_kg");
    return false;
  }

  /// The ball of a line, with an error for each cell that is wrong.
  Node ball(string_view line, size_t at) {
    const vector<TableCell> cells = cells_of(line, index_, at);
    Node ball;
    ball.kind = Node::Kind::map;
    ball.place = {index_, uint32_t(at), uint32_t(line.size())};
    if (cells.size() != header_.size()) {
      diagnostics_.add(ball.place,
                       fmt::format("this line has {}, and the first line has {}",
                                   how_many(cells.size(), "cell", "cells"), header_.size()),
                       "expected a cell for each column; the decimal point is a point: 1.5, not 1,5");
      return ball;
    }

    for (size_t k = 0; k < table_column_count; ++k) {
      if (!at_[k]) continue;
      const Field& field = *find_field(kind_named("placed"), table_columns[k].key);
      Node number = cell_number(cells[*at_[k]], table_columns[k].name, field);
      if (field.type != Type::vector) {
        set_key(ball, field.key, std::move(number));
        continue;
      }

      Node* vector = ball.find(field.key);
      if (vector == nullptr) {
        Node whole;
        whole.kind = Node::Kind::sequence;
        whole.place = number.place;
        set_key(ball, field.key, std::move(whole));
        vector = ball.find(field.key);
      }
      vector->items.push_back(std::move(number));
    }
    return ball;
  }

  Node cell_number(const TableCell& cell, string_view name, const Field& field) {
    Node node;
    node.kind = Node::Kind::scalar;
    node.text = cell.text;
    node.place = cell.place;

    // A vector's row says the form of all its numbers.
    Field one = field;
    one.type = Type::number;
    const string required = fmt::format("expected {}", expected(one));
    const optional<double> value = parse_number(cell.text);
    const Range limits = limited_range(one);

    if (!value && cell.text.empty()) {
      diagnostics_.add(cell.place, fmt::format("{} has no value", in_backticks(name)), required);
    } else if (!value) {
      Complaint complaint = explain_number(node, {name, field.unit, required});
      diagnostics_.add(cell.place, fmt::format("{} in the column {}", complaint.message, in_backticks(name)),
                       std::move(complaint.remedy));
    } else if (!contains(field.range, *value) || !contains(limits, *value)) {
      diagnostics_.add(cell.place, fmt::format("{} is {}", in_backticks(name), cell.text),
                       contains(field.range, *value) ? limit_text(limits, field.unit) : required);
    }
    return node;
  }

  optional<Node> too_many(const Node& members) {
    diagnostics_.add(members.items.back().place,
                     fmt::format("with {} lines the scene has more than {} values", members.items.size(), most_values),
                     "expected fewer balls");
    return nullopt;
  }

  const string_view text_;
  const uint32_t index_;  // of the source
  Diagnostics& diagnostics_;
  vector<TableCell> header_;
  array<optional<size_t>, table_column_count> at_{};  // the place in a line, by column
  double values_a_ball_ = 0;
};

/// What a table gives in place of the group's own keys.
class TableGroups {
 public:
  TableGroups(Node& root, const string& folder, vector<Source>& sources, MadeFrom& made_from, Diagnostics& diagnostics)
      : root_(root), folder_(folder), sources_(sources), made_from_(made_from), diagnostics_(diagnostics) {}

  void run() {
    Node* groups = root_.find("groups");
    if (groups == nullptr || !groups->is_map()) return;
    for (size_t i = 0; i < groups->keys.size(); ++i)
      if (groups->items[i].is_map()) group(groups->keys[i], groups->items[i]);
  }

 private:
  void group(const Key& key, Node& node) {
    const Kind& kind = kind_named("group");
    const Field& field = *find_field(kind, "table");
    const View view = thing_view(root_, key, node, kind);
    const Node* table = view.given(field);
    if (table == nullptr || !table->is_scalar() || table->text.empty() || table->text == "none") return;

    // The check reports a key that excludes the table.
    const vector<string_view> others = rivals(field);
    const string path = beneath(folder_, table->text);
    if (any_of(others, [&](auto other) { return node.find(other) != nullptr && node.find(other)->text != "none"; }))
      return;
    const Place where = table->place;
    const bool can_be_read = why_no_file(path).empty();
    const optional<Node>& members = can_be_read ? read(path, where) : nothing_;
    if (!members) return failed(view, node, can_be_read);

    const bool has_velocity = members->items.front().find("velocity") != nullptr;
    const Node* velocity = view.given("velocity");
    if (velocity != nullptr && velocity->is_scalar() && velocity->text == "none") velocity = nullptr;
    // The check reports a wrong one, at its own place.
    if (velocity != nullptr && !as_vector(velocity)) return failed(view, node, true);
    Node list = *members;
    list.place = where;
    for (Node& ball : list.items)
      if (!has_velocity && velocity != nullptr) set_key(ball, "velocity", *velocity);

    complete_ball(view, list.items.front(), node);
    Node count;
    count.kind = Node::Kind::scalar;
    count.text = to_string(list.items.size());
    count.place = where;
    remove_key(node, "table");
    remove_key(node, "velocity");
    set_key(node, "count", std::move(count));
    set_key(node, "members", std::move(list));
  }

  /// A group whose table has errors stays without balls, and its ball has no error.
  void failed(const View& view, Node& node, bool was_read) {
    for (const string_view key : {"table", "ball"}) {
      // The check reports a file that cannot be read.
      if (key == "table" && !was_read) continue;
      const Node* given = view.given(key);
      Node bad;
      if (given != nullptr) bad = *given;
      if (given == nullptr) bad.place = view.where();
      bad.bad = true;
      set_key(node, key, std::move(bad));
    }
  }

  /// A radius or a mass that the ball lacks is that of the first line.
  void complete_ball(const View& view, const Node& first, Node& node) {
    const View each = member_view(root_, view);
    const Node* given = view.given("ball");
    if (given != nullptr && !given->is_map()) return;

    Node ball;
    if (given != nullptr) ball = *given;
    ball.kind = Node::Kind::map;
    if (given == nullptr) ball.place = view.where();
    const bool has_mass = each.given("mass") != nullptr || each.given("density") != nullptr;
    if (each.given("radius") == nullptr && first.find("radius") != nullptr)
      set_key(ball, "radius", *first.find("radius"));
    if (!has_mass && first.find("mass") != nullptr) set_key(ball, "mass", *first.find("mass"));
    set_key(node, "ball", std::move(ball));
  }

  /// Each file is read once. None: it has errors, which were reported.
  const optional<Node>& read(const string& path, Place where) {
    const auto [entry, is_new] = tables_.try_emplace(path);
    if (!is_new) return entry->second;
    made_from_.tables.push_back(path);

    Source source;
    if (!read_source(path, source, diagnostics_)) return entry->second;
    sources_.push_back(std::move(source));
    TableReader reader(sources_, uint32_t(sources_.size() - 1), diagnostics_);
    return entry->second = reader.run(where);
  }

  Node& root_;
  const string& folder_;
  vector<Source>& sources_;
  MadeFrom& made_from_;
  Diagnostics& diagnostics_;
  map<string, optional<Node>> tables_;  // by path
  const optional<Node> nothing_{};
};

}  // namespace

void apply_tables(Node& root, const string& folder, vector<Source>& sources, MadeFrom& made_from,
                  Diagnostics& diagnostics) {
  TableGroups(root, folder, sources, made_from, diagnostics).run();
}

}  // namespace carom
