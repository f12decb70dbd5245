// A sweep file's tree, checked against the table of fields, to a Sweep.
#include <fmt/format.h>

#include "scene/check.h"
#include "scene/grid_text.h"
#include "scene/path_field.h"
#include "scene/resolve.h"
#include "scene/samples.h"
#include "scene/sweep.h"
#include "scene/view.h"
#include "std.h"
#include "yaml/decimal.h"
#include "yaml/document.h"
#include "yaml/joined.h"
#include "yaml/letters.h"
#include "yaml/source.h"
#include "yaml/value_json.h"
#include "yaml/values.h"

namespace carom {
namespace {

using Axis = SweepAxis;

/// Whether two values of a path are equal: numbers by value, all else by text.
bool same_value(const string& a, const string& b) {
  if (a == b || cell_text(a) == cell_text(b)) return true;
  const optional<double> x = parse_number(a), y = parse_number(b);
  return x && y && *x == *y;
}

class SweepReader {
 public:
  SweepReader(vector<Source>& sources, const Node& root, const SweepOptions& options, Diagnostics& diagnostics)
      : sources_(sources), root_(root), options_(options), diagnostics_(diagnostics) {}

  Sweep run() {
    const View whole(&root_, kind_named("sweep"), Place{});
    sweep_.title = whole.text("title").value_or("");
    sweep_.base = beneath_folder(whole.text("base").value_or(""));

    if (const Node* set = usable(root_.find("set"))) {
      for (size_t i = 0; i < set->keys.size(); ++i)
        sweep_.set_values.push_back({set->keys[i].text + "=" + flow_text(set->items[i]), where(set->keys[i].place)});
    }

    const Node* base = usable(root_.find("base"));
    if (base != nullptr && !sources_.front().option) {
      if (const string why = why_no_file(sweep_.base); !why.empty())
        diagnostics_.add(base->place, fmt::format("{} {}", why, in_backticks(base->text)),
                         "expected the path of a scene file, relative to the folder of this file");
    }

    sweep_.skip_invalid = whole.flag("skip_invalid").value_or(false);
    seed_ = options_.seed.value_or(whole.whole("seed").value_or(0));

    blocks();
    unused_seed();
    repeat();

    if (const Node* only = usable(root_.find("only"))) {
      for (const Node& item : only->items) sweep_.only.push_back({item.text, where(item.place)});
    }
    compare();
    if (sweep_.size() > most_runs) refuse_runs(root_.keys.front().place);
    return std::move(sweep_);
  }

 private:
  static const Node* usable(const Node* node) { return node != nullptr && !node->bad ? node : nullptr; }

  string beneath_folder(const string& path) const {
    const size_t slash = sources_.front().name.rfind('/');
    return beneath(slash == string::npos ? "" : sources_.front().name.substr(0, slash + 1), path);
  }

  /// "file:line:column"
  string where(const Place& place) const {
    if (sources_.front().option) return sources_.front().name;
    // A file may be one line of a million values, or have as many lines.
    // Counting therefore continues from the last place.
    const string_view text = sources_.front().text;
    const size_t offset = min<size_t>(place.offset, text.size());
    if (offset < counted_) counted_ = 0, line_ = column_ = 1;
    const string_view between = text.substr(counted_, offset - counted_);
    const size_t last = between.rfind('\n');
    if (last == string_view::npos) {
      column_ += count_characters(between);
    } else {
      line_ += size_t(ranges::count(between, '\n'));
      column_ = 1 + count_characters(between.substr(last + 1));
    }
    counted_ = offset;
    return fmt::format("{}:{}:{}", sources_.front().name, line_, column_);
  }

  /// As many as there are paths: it is none of them.
  size_t index_of(string_view path) const { return size_t(ranges::find(sweep_.paths, path) - sweep_.paths.begin()); }

  uint32_t path(const string& text) {
    const size_t index = index_of(text);
    if (index == sweep_.paths.size()) sweep_.paths.push_back(text);
    return uint32_t(index);
  }

  void blocks() {
    const Node* runs = root_.find("runs");
    if (runs == nullptr) {
      block(root_);
      return;
    }
    for (const string_view key : {"grid", "zip", "list", "random", "latin", "over", "skip"}) {
      if (const Key* beside = root_.find_key(key))
        diagnostics_.add(beside->place, fmt::format("{} stands beside `runs`", in_backticks(key)),
                         "expected it in an entry of `runs`");
    }
    for (const Node& item : runs->items)
      if (sweep_.size() <= most_runs) block(item);
  }

  /// Reads the axes of one block.
  void block(const Node& node) {
    if (node.bad || !node.is_map()) return;
    SweepBlock block;
    uint64_t runs = 1;
    taken_.clear();
    if (const Node* grid = usable(node.find("grid"))) {
      for (size_t i = 0; i < grid->keys.size(); ++i) {
        Axis axis{Axis::Kind::grid, {}};
        for (SweepValue& value : values(grid->keys[i], grid->items[i]))
          axis.cases.push_back({{{path(grid->keys[i].text), std::move(value)}}});
        take(grid->keys[i]);
        if (axis.cases.empty()) continue;
        runs *= axis.cases.size();
        block.axes.push_back(std::move(axis));
        // Stop before the next axis is expanded. Forty axes of a million values each would take all memory.
        if (runs > most_runs) return refuse_runs(grid->keys[i].place);
      }
    }
    if (const Node* zip = usable(node.find("zip"))) {
      block.axes.push_back(zipped(*zip));
      // Already reported.
      if (block.axes.back().cases.empty()) return;
    }
    if (const Node* list = usable(node.find("list"))) {
      Axis axis{Axis::Kind::list, {}};
      map<string, const Key*> keys;
      for (const Node& item : list->items) axis.cases.push_back(one_case(item));
      for (const Node& item : list->items)
        for (const Key& key : item.keys) keys.emplace(key.text, &key);
      for (const auto& [text, key] : keys) take(*key);
      block.axes.push_back(std::move(axis));
    }
    if (const Node* over = usable(node.find("over"))) {
      block.axes.push_back(sampled(node, *over, block));
      // Already reported.
      if (block.axes.back().cases.empty()) return;
    }
    if (&node == &root_ && block.axes.empty() && root_.find("repeat") == nullptr && !options_.repeat &&
        diagnostics_.empty())
      diagnostics_.add(root_.keys.front().place, "the sweep varies nothing",
                       "expected `grid`, `zip`, `list`, `random`, `latin` or `runs`, or `repeat`");
    keep(block, usable(node.find("skip")), node);
    sweep_.blocks.push_back(std::move(block));
  }

  /// Marks a path as varied. It may vary only once in a block.
  void take(const Key& key) {
    if (taken_.emplace(key.text, &key).second) return;
    diagnostics_.add(key.place, fmt::format("{} is varied twice", in_backticks(key.text)), "remove one of them");
  }

  SweepCase one_case(const Node& map) {
    SweepCase one;
    for (size_t i = 0; i < map.keys.size(); ++i)
      one.values.emplace_back(path(map.keys[i].text), SweepValue{flow_text(map.items[i]), where(map.keys[i].place)});
    return one;
  }

  Axis zipped(const Node& zip) {
    Axis axis{Axis::Kind::zip, {}};
    for (size_t i = 0; i < zip.keys.size(); ++i) {
      const Key& key = zip.keys[i];
      vector<SweepValue> column = values(key, zip.items[i]);
      if (i == 0) axis.cases.resize(column.size());

      if (zip.keys.size() * axis.cases.size() > most_values) {
        diagnostics_.add(key.place,
                         fmt::format("{} of {}", how_many(axis.cases.size(), "value", "values"),
                                     how_many(zip.keys.size(), "path", "paths")),
                         fmt::format("expected at most {} values in all", most_values));
        return {Axis::Kind::zip, {}};
      }

      if (column.size() != axis.cases.size()) {
        diagnostics_.add(
            key.place,
            fmt::format("{} has {}, {} has {}", in_backticks(key.text), how_many(column.size(), "value", "values"),
                        in_backticks(zip.keys.front().text), axis.cases.size()),
            "expected as many for each path: they vary in step");
        column.resize(axis.cases.size());
      }

      for (size_t k = 0; k < column.size(); ++k) axis.cases[k].values.emplace_back(path(key.text), column[k]);
      take(key);
    }
    return axis;
  }

  /// One case for each of the numbers drawn from every range.
  Axis sampled(const Node& node, const Node& over, SweepBlock& block) {
    Axis axis{Axis::Kind::samples, {}};
    const bool latin = node.find("latin") != nullptr;
    const char* key = latin ? "latin" : "random";
    const Node* number = usable(node.find(key));
    if (number == nullptr || !over.is_map()) return axis;

    const uint64_t count = parse_whole(number->text).value_or(1);
    if (over.keys.size() * count > most_values) {
      diagnostics_.add(node.find_key(key)->place,
                       fmt::format("{} values of {}", count, how_many(over.keys.size(), "path", "paths")),
                       fmt::format("expected at most {} values in all", most_values));
      return axis;
    }

    axis.cases.resize(count);
    for (size_t i = 0; i < over.keys.size(); ++i) {
      const Key& its = over.keys[i];
      take(its);
      // The same path in another block draws other numbers.
      Random random(seed_, fmt::format("samples {} {}", sweep_.blocks.size(), its.text));

      const optional<SampledRange> range = span(its, over.items[i]);
      vector<string> drawn;
      if (range) drawn = samples(*range, latin ? Sampling::latin : Sampling::random, count, random);
      if (range && drawn.empty())
        diagnostics_.add(its.place, fmt::format("the numbers of {} have more than 15 digits", in_backticks(its.text)),
                         "expected ends that differ more, or have fewer digits");

      drawn.resize(count);
      const string place = where(its.place);
      const uint32_t path_number = path(its.text);
      for (size_t k = 0; k < count; ++k)
        axis.cases[k].values.emplace_back(path_number, SweepValue{std::move(drawn[k]), place});
    }

    block.samples = fmt::format("    {}: {}\n    over:\n", key, count);
    for (size_t i = 0; i < over.keys.size(); ++i)
      block.samples += fmt::format("      {}: {}\n", over.keys[i].text, flow_text(over.items[i]));
    sweep_.seed = seed_;
    return axis;
  }

  /// None: it is wrong, which is reported.
  optional<SampledRange> span(const Key& key, const Node& node) {
    if (node.bad || !node.is_map()) return nullopt;
    const auto given = ends(node);
    if (!given) return nullopt;

    const auto& [from, to] = *given;
    const View view(&node, kind_named("span"), key.place);
    SampledRange range{from, to, view.flag("log").value_or(false)};
    const Field* field = field_at(key.text);
    range.whole = field != nullptr && holds_whole_numbers(*field);

    const double low = parse_number(node.find("from")->text).value_or(0),
                 high = parse_number(node.find("to")->text).value_or(0);
    const auto refuse = [&](const char* end, const string& message, const char* remedy) {
      diagnostics_.add(node.find(end)->place, message, remedy);
      return nullopt;
    };

    if (!(low < high))
      return refuse("to", fmt::format("no number lies between {} and {}", to_text(from), to_text(to)),
                    "expected `from` below `to`");
    if (range.log && !(low > 0))
      return refuse("from", fmt::format("{} has no logarithm", to_text(from)), "expected `from` above 0, or no `log`");
    if (range.whole && (from.places > 0 || to.places > 0))
      return refuse(from.places > 0 ? "from" : "to", fmt::format("{} takes whole numbers", in_backticks(key.text)),
                    "expected whole ends");
    return range;
  }

  /// A seed without samples would seem to be the scene's.
  void unused_seed() {
    const Key* seed = root_.find_key("seed");
    if (seed == nullptr || sweep_.seed || !diagnostics_.empty()) return;
    diagnostics_.add(seed->place, "`seed` is that of `random` and `latin`, and there are none",
                     "expected `set: {seed: ...}` for the seed of the scene, or `repeat` for several seeds");
  }

  /// None: it has too many digits, which is reported.
  optional<Decimal> decimal(const Node& value) {
    const optional<Decimal> number = parse_decimal(value.text);
    if (!number)
      diagnostics_.add(value.place, fmt::format("{} has more than 18 digits", in_backticks(value.text)),
                       "list such values one by one");
    return number;
  }

  /// None: an end is absent or wrong, which is reported.
  optional<pair<Decimal, Decimal>> ends(const Node& range) {
    const Node *from = range.find("from"), *to = range.find("to");
    if (any_of(range.items, &Node::bad) || from == nullptr || to == nullptr) return nullopt;
    const optional<Decimal> first = decimal(*from), last = decimal(*to);
    return first && last ? optional(pair(*first, *last)) : nullopt;
  }

  /// The values of a list or a range.
  vector<SweepValue> values(const Key& key, const Node& node) {
    vector<SweepValue> out;
    if (node.bad) return out;
    if (node.is_sequence()) {
      for (const Node& item : node.items) out.push_back({flow_text(item), where(item.place)});
      return out;
    }
    for (string& text : range(key, node)) out.push_back({std::move(text), where(key.place)});
    return out;
  }

  vector<string> range(const Key& key, const Node& node) {
    const auto given = ends(node);
    if (!given) return {};
    const auto& [from, to] = *given;

    if (const Node* count = node.find("count")) {
      const uint64_t n = parse_whole(count->text).value_or(1);
      if (n == 1 && to_text(from) != to_text(to))
        diagnostics_.add(count->place, "a single value cannot have two ends",
                         "expected `from` equal to `to`, or more values");
      return spread(from, to, n);
    }

    const Node* step = node.find("step");
    const optional<Decimal> width = step == nullptr ? nullopt : decimal(*step);
    if (!width) return {};

    vector<string> out = steps(from, to, *width, most_runs);
    if (out.empty())
      diagnostics_.add(step->place,
                       fmt::format("a step of {} does not lead from {} to {}", step->text, to_text(from), to_text(to)),
                       "expected a step that does");
    if (out.size() > most_runs) {
      diagnostics_.add(key.place, fmt::format("{} has more than {} values", in_backticks(key.text), most_runs),
                       "expected a longer step");
      out.clear();
    }
    return out;
  }

  void refuse_runs(const Place& place) {
    diagnostics_.add(place, fmt::format("more than {} runs", most_runs), fmt::format("expected at most {}", most_runs));
  }

  /// Determines which combinations are kept.
  void keep(SweepBlock& block, const Node* skip, const Node& node) {
    uint64_t count = 1;
    for (const Axis& axis : block.axes) {
      count *= axis.cases.size();
      if (count > most_runs) return refuse_runs(node.keys.front().place);
    }

    if (skip != nullptr) block.skip = flow_text(*skip);
    vector<size_t> skipped(skip == nullptr ? 0 : skip->items.size());
    vector<const SweepValue*> values(sweep_.paths.size());

    for (uint32_t k = 0; k < count; ++k) {
      size_t rest = k;
      for (size_t a = block.axes.size(); a-- > 0;) {
        const auto& cases = block.axes[a].cases;
        for (const auto& [number, value] : cases[rest % cases.size()].values) values[number] = &value;
        rest /= cases.size();
      }

      bool left = true;
      for (size_t s = 0; s < skipped.size(); ++s) {
        if (!matches(skip->items[s], values)) continue;
        ++skipped[s];
        left = false;
      }
      if (left) block.kept.push_back(k);
      ranges::fill(values, nullptr);
    }

    for (size_t s = 0; s < skipped.size(); ++s) {
      const Node& entry = skip->items[s];
      if (skipped[s] > 0 || entry.bad || !diagnostics_.empty()) continue;
      diagnostics_.add(entry.keys.front().place, "no run has these values", "expected paths and values of this block");
    }

    if (block.kept.empty() && diagnostics_.empty())
      diagnostics_.add(skip->items.front().keys.front().place, "every run is left out",
                       "expected at least one run to remain");
  }

  bool matches(const Node& entry, const vector<const SweepValue*>& values) const {
    if (!entry.is_map()) return false;
    for (size_t i = 0; i < entry.keys.size(); ++i) {
      const size_t index = index_of(entry.keys[i].text);
      const SweepValue* value = index < values.size() ? values[index] : nullptr;
      if (value == nullptr) return false;

      const Node& wanted = entry.items[i];
      const bool same = same_value(flow_text(wanted), value->text);
      const bool any = wanted.is_sequence() &&
                       any_of(wanted.items, [&](const Node& one) { return same_value(flow_text(one), value->text); });
      if (!same && !any) return false;
    }
    return true;
  }

  void repeat() {
    const Node* node = usable(root_.find("repeat"));
    const bool given = node != nullptr && node->is_map();
    if (!given && !options_.repeat) return;

    const View view(given ? node : nullptr, kind_named("repeat"), Place{});
    sweep_.seeds = options_.repeat.value_or(view.whole("seeds").value_or(1));
    sweep_.first_seed = view.whole("first");
    if (sweep_.first_seed.value_or(0) > numeric_limits<uint64_t>::max() - sweep_.seeds)
      diagnostics_.add(node->find_key("first")->place, "there are too few seeds after this one",
                       "expected a smaller `first`");

    if (index_of("seed") < sweep_.paths.size()) {
      diagnostics_.add(given ? root_.find_key("repeat")->place : root_.keys.front().place,
                       "`seed` is varied twice: here and by `repeat`", "remove one of them");
      return;
    }
    sweep_.paths.emplace_back("seed");
  }

  void compare() {
    const Node* node = usable(root_.find("compare"));
    if (node == nullptr || !node->is_map()) return;

    if (const Node* measures = usable(node->find("measures"))) {
      for (const Node& item : measures->items) sweep_.measures.push_back({item.text, where(item.place)});
    }
    sweep_.collisions = as_flag(usable(node->find("collisions"))).value_or(false);

    const Node* charts = usable(node->find("charts"));
    if (charts == nullptr) return;
    for (const Node& item : charts->items) {
      if (item.bad) continue;
      const View view(&item, kind_named("chart"), item.place);
      sweep_.charts.push_back(
          {view.text("x").value_or(""), view.text("y").value_or(""), view.text("by").value_or(""), where(item.place)});
    }
  }

  vector<Source>& sources_;
  const Node& root_;
  const SweepOptions& options_;
  Diagnostics& diagnostics_;
  Sweep sweep_;
  uint64_t seed_ = 0;              // of samples
  map<string, const Key*> taken_;  // the paths of this block
  // How far where() has counted lines and characters.
  mutable size_t counted_ = 0, line_ = 1, column_ = 1;
};

void stop_if_wrong(const Diagnostics& diagnostics, bool color) {
  if (!diagnostics.empty()) throw SceneError(diagnostics, color);
}

Sweep read(vector<Source>& sources, Diagnostics& diagnostics, const SweepOptions& options) {
  const bool color = options.color;
  optional<Node> root;
  if (check_text(sources[0], 0, diagnostics)) root = parse_document(sources, 0, 0, diagnostics);

  if (!root) stop_if_wrong(diagnostics, color);
  if (!root->is_map()) {
    diagnostics.add(root->place, root->is_null() ? "this file holds no sweep" : "this is not a sweep",
                    "expected a map of keys, such as `sweep: 1`");
  } else if (root->find("sweep") == nullptr && root->find("scene") != nullptr) {
    diagnostics.add(root->find_key("scene")->place, "this is a scene, not a sweep",
                    "expected a sweep file, or a scene with --grid, such as --grid balls.red.mass=1:2:3");
  } else {
    check_sweep(*root, diagnostics);
    Sweep sweep = SweepReader(sources, *root, options, diagnostics).run();
    stop_if_wrong(diagnostics, color);
    sweep.file = sources[0].name;
    return sweep;
  }

  stop_if_wrong(diagnostics, color);
  return {};
}

}  // namespace

Sweep load_sweep(const string& path, const SweepOptions& options) {
  vector<Source> sources(1);
  Diagnostics diagnostics(sources);
  if (!read_source(path, sources[0], diagnostics)) stop_if_wrong(diagnostics, options.color);
  return read(sources, diagnostics, options);
}

Sweep grid_sweep(const string& base, const vector<string>& grids, const SweepOptions& options) {
  vector<Source> sources(1);
  sources[0] = {"--grid", grid_text(base, grids, options), true};
  Diagnostics diagnostics(sources);
  Sweep sweep = read(sources, diagnostics, options);
  sweep.file = base;
  sweep.base = base;
  return sweep;
}

bool is_sweep_file(const string& path) {
  vector<Source> sources(1);
  Diagnostics diagnostics(sources);
  optional<Node> root;
  if (read_source(path, sources[0], diagnostics) && check_text(sources[0], 0, diagnostics))
    root = parse_document(sources, 0, 0, diagnostics);
  return root && root->is_map() && root->find("sweep") != nullptr && root->find("scene") == nullptr;
}

}  // namespace carom
