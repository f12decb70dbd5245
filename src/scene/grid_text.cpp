// An option is divided at colons only behind a number, so that lists of values may have colons.
#include "scene/grid_text.h"

#include <fmt/format.h>

#include "scene/resolve.h"
#include "std.h"
#include "yaml/values.h"

namespace carom {
namespace {

struct GridWord {
  string path, values;
  /// The parts of from:to, from:to:count or from:to:log. Empty: a list of values.
  vector<string> parts{};

  bool is_log() const { return parts.size() == 3 && parts[2] == "log"; }
  bool is_open() const { return parts.size() == 2 || is_log(); }
};

GridWord grid_word(const string& word) {
  const size_t equals = word.find('=');
  GridWord out{word.substr(0, equals), equals == string::npos ? "" : word.substr(equals + 1)};
  const string& values = out.values;
  const size_t first = values.find(':');
  if (first == string::npos || !parse_number(values.substr(0, first))) return out;
  const size_t second = min(values.find(':', first + 1), values.size());
  out.parts = {values.substr(0, first), values.substr(first + 1, second - first - 1)};
  if (second < values.size()) out.parts.push_back(values.substr(second + 1));
  return out;
}

}  // namespace

bool is_open_range(const string& grid) {
  return grid_word(grid).is_open();
}

string grid_text(const string& base, const vector<string>& grids, const SweepOptions& options) {
  string grid, over;

  for (const string& word : grids) {
    const GridWord one = grid_word(word);
    if (one.is_open())
      over += fmt::format("  {}: {{from: {}, to: {}{}}}\n", one.path, one.parts[0], one.parts[1],
                          one.is_log() ? ", log: true" : "");
    else if (!one.parts.empty())
      grid +=
          fmt::format("  {}: {{from: {}, to: {}, count: {}}}\n", one.path, one.parts[0], one.parts[1], one.parts[2]);
    else
      grid += fmt::format("  {}: [{}]\n", one.path, one.values);
  }

  string text = fmt::format("sweep: 1\nbase: {}\n", in_quotes(base));
  if (!grid.empty()) text += "grid:\n" + grid;
  if (options.random) text += fmt::format("random: {}\n", *options.random);
  if (options.latin) text += fmt::format("latin: {}\n", *options.latin);
  if (!over.empty()) text += "over:\n" + over;
  return text;
}

}  // namespace carom
