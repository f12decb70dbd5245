// An option is divided at colons only behind a number, so that lists of values may have colons.
#include "scene/grid_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "scene/resolve.h"
#include "yaml/values.h"

namespace carom {
namespace {

struct GridWord {
  std::string path, values;
  /// The parts of from:to, from:to:count or from:to:log. Empty: a list of values.
  std::vector<std::string> parts{};

  bool is_log() const { return parts.size() == 3 && parts[2] == "log"; }
  bool is_open() const { return parts.size() == 2 || is_log(); }
};

GridWord grid_word(const std::string& word) {
  const std::size_t equals = word.find('=');
  GridWord out{word.substr(0, equals), equals == std::string::npos ? "" : word.substr(equals + 1)};
  const std::string& values = out.values;
  const std::size_t first = values.find(':');
  if (first == std::string::npos || !parse_number(values.substr(0, first))) return out;
  const std::size_t second = std::min(values.find(':', first + 1), values.size());
  out.parts = {values.substr(0, first), values.substr(first + 1, second - first - 1)};
  if (second < values.size()) out.parts.push_back(values.substr(second + 1));
  return out;
}

}  // namespace

bool is_open_range(const std::string& grid) {
  return grid_word(grid).is_open();
}

std::string grid_text(const std::string& base, const std::vector<std::string>& grids, const SweepOptions& options) {
  std::string grid, over;
  for (const std::string& word : grids) {
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
  std::string text = fmt::format("sweep: 1\nbase: {}\n", in_quotes(base));
  if (!grid.empty()) text += "grid:\n" + grid;
  if (options.random) text += fmt::format("random: {}\n", *options.random);
  if (options.latin) text += fmt::format("latin: {}\n", *options.latin);
  if (!over.empty()) text += "over:\n" + over;
  return text;
}

}  // namespace carom
