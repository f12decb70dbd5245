// Errors as a terminal shows them: place, line of the file, caret, remedy.
// Columns count characters, while the caret's position counts terminal cells, so that wide characters do not shift it.
// Names are suggested by optimal string alignment distance, which counts a swap of two letters as one edit.
#include "yaml/diagnostics.h"

#include <fmt/format.h>

#include <tuple>

#include "std.h"
#include "yaml/joined.h"
#include "yaml/letters.h"
#include "yaml/lookalikes.h"
#include "yaml/printable.h"

namespace carom {
namespace {

constexpr size_t max_shown = 50;   // errors
constexpr size_t max_width = 100;  // characters shown of a line
constexpr size_t lead_width = 60;  // characters before the caret, at most

/// Cells that a character takes on a terminal: 2 for wide East Asian characters, 0 for combining ones.
int cells(char32_t c) {
  if ((c >= 0x0300 && c <= 0x036F) || (c >= 0x200B && c <= 0x200F) || (c >= 0x20D0 && c <= 0x20FF) ||
      (c >= 0xFE00 && c <= 0xFE0F)) {
    return 0;
  }
  const bool wide = (c >= 0x1100 && c <= 0x115F) || (c >= 0x2E80 && c <= 0xA4CF) || (c >= 0xAC00 && c <= 0xD7A3) ||
                    (c >= 0xF900 && c <= 0xFAFF) || (c >= 0xFE30 && c <= 0xFE6F) || (c >= 0xFF00 && c <= 0xFF60) ||
                    (c >= 0xFFE0 && c <= 0xFFE6) || (c >= 0x1F300 && c <= 0x1FAFF) || (c >= 0x20000 && c <= 0x3FFFD);
  return wide ? 2 : 1;
}

struct Character {
  // As shown, with '?' for an unprintable character.
  string text;
  int width;  // cells
  size_t at;  // byte offset in the line
};

vector<Character> characters(string_view line) {
  vector<Character> out;
  for (size_t i = 0; i < line.size();) {
    char32_t code = 0;
    const int length = utf8_length(line, i, code);

    if (length == 0 || is_unprintable(code)) {
      out.push_back({code == '\t' ? " " : "?", 1, i});
      i += size_t(max(length, 1));
    } else {
      out.push_back({string(line.substr(i, size_t(length))), cells(code), i});
      i += size_t(length);
    }
  }
  return out;
}

/// The number of bytes at the start of `text` that belong to a character cut off in front of it.
size_t first_whole_character(string_view text) {
  size_t i = 0;
  while (i < min<size_t>(text.size(), 3) && (static_cast<unsigned char>(text[i]) & 0xC0) == 0x80) ++i;
  return i;
}

string paint(string_view text, string_view code, bool color) {
  return color ? fmt::format("\x1b[{}m{}\x1b[0m", code, text) : string(text);
}

/// The same for messages at one place that differ by numbers alone.
string alike(const Place& place, string_view text) {
  string out = fmt::format("{}:{}:", place.source, place.offset);
  const auto is_digit = [&](size_t i) { return i < text.size() && text[i] >= '0' && text[i] <= '9'; };
  for (size_t i = 0; i < text.size();) {
    const bool begins_number = is_digit(i) || (text[i] == '-' && is_digit(i + 1));
    if (!begins_number) out += text[i];
    i = begins_number ? min(text.find_first_not_of("0123456789.eE+-", i), text.size()) : i + 1;
  }
  return out;
}

/// The edit distance of `a` and `b`: letters inserted, removed, replaced or swapped with a neighbour.
/// This is the optimal string alignment distance.
size_t edits(string_view a, string_view b) {
  vector<size_t> before(b.size() + 1), last(b.size() + 1), now(b.size() + 1);
  for (size_t j = 0; j <= b.size(); ++j) last[j] = j;

  for (size_t i = 1; i <= a.size(); ++i) {
    now[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const bool same = a[i - 1] == b[j - 1];
      now[j] = min({last[j] + 1, now[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        now[j] = min(now[j], before[j - 2] + 1);
      }
    }
    before.swap(last);
    last.swap(now);
  }
  return last[b.size()];
}

/// A place as line and column, and the parts of its line before and after it.
struct LineSpot {
  size_t line, column;
  string_view before, after;
};

LineSpot spot_of(const Source& source, const Place& place) {
  const string_view text = source.text;
  const size_t offset = min<size_t>(place.offset, text.size());
  const size_t begin = offset == 0 ? 0 : text.rfind('\n', offset - 1) + 1;  // npos + 1 is 0
  const size_t end = min(text.find('\n', offset), text.size());
  const auto line = 1 + std::count(text.begin(), text.begin() + ptrdiff_t(begin), '\n');
  const string_view before = text.substr(begin, offset - begin);
  return {size_t(line), 1 + count_characters(before), before, text.substr(offset, end - offset)};
}

}  // namespace

string in_backticks(string_view text) {
  constexpr size_t longest = 60;
  const vector<Character> all = characters(text);
  string out = "`";
  for (size_t i = 0; i < min(all.size(), longest); ++i) out += all[i].text;
  return out + (all.size() > longest ? "...`" : "`");
}

string suggestion_in(string_view text) {
  constexpr string_view lead = "did you mean `";
  const size_t at = text.find(lead);
  if (at == string_view::npos) return {};
  text.remove_prefix(at + lead.size());
  return string(text.substr(0, text.find('`')));
}

string nearest(string_view name, const vector<string_view>& candidates) {
  if (name.empty() || name.size() > 64) return {};

  size_t best = min<size_t>(3, (name.size() + 2) / 3);
  string_view found;
  for (const string_view candidate : candidates) {
    if (candidate.size() > name.size() + best || name.size() > candidate.size() + best) continue;

    const size_t distance = edits(in_lower_case(name), in_lower_case(candidate));
    const bool nothing_kept = distance >= max(name.size(), candidate.size());
    if (!nothing_kept && (distance < best || (distance == best && found.empty()))) {
      best = distance;
      found = candidate;
    }
  }
  return string(found);
}

string names_text(const vector<string_view>& names, size_t most) {
  vector<string_view> shown;
  for (const string_view name : names) {
    const size_t dot = min(name.rfind('.'), name.size());
    const bool is_member = dot + 1 < name.size() && name.find_first_not_of("0123456789", dot + 1) == name.npos;
    const string_view whole = is_member ? name.substr(0, dot) : name;
    if (shown.empty() || shown.back() != whole) shown.push_back(whole);
  }

  const size_t count = shown.size() > most ? most : shown.size();
  string text;
  for (size_t i = 0; i < count; ++i) {
    const bool last = i + 1 == shown.size();
    text += (i == 0 ? "" : last ? " and " : ", ") + in_backticks(shown[i]);
  }
  return shown.size() > count ? fmt::format("{} and {} more", text, shown.size() - count) : text;
}

string suggest_name(string_view name, const vector<string_view>& candidates) {
  constexpr size_t most = 10;
  const string near = nearest(name, candidates);
  if (!near.empty()) return fmt::format("did you mean {}?", in_backticks(near));
  if (candidates.empty()) return {};
  const string names = names_text(candidates, most);
  const bool one = names.find(" and ") == string::npos;
  return fmt::format("there {} {}", one ? "is" : "are", names);
}

TextRemedy fault_and_remedy(string_view text) {
  for (const string_view between : {"\n  ", ". Remedy: "})
    if (const size_t at = text.find(between); at != text.npos)
      return {string(text.substr(0, at)), string(text.substr(at + between.size()))};
  return {string(text), {}};
}

void Diagnostics::add(Place place, string message, string remedy) {
  if (add_member(place, message)) return;
  ++added_;
  const string_view text = sources_[place.source].text;
  const string lookalike = lookalike_in(text.substr(min<size_t>(place.offset, text.size()), place.length));
  if (!lookalike.empty()) remedy = remedy.empty() ? lookalike : fmt::format("{}\n{}", lookalike, remedy);

  if (repeated_.contains({place.source, place.offset})) first_of_alike_.emplace(alike(place, message), errors_.size());
  errors_.push_back({true, place, {}, std::move(message), std::move(remedy)});
}

bool Diagnostics::add_member(Place place, string_view message) {
  if (!repeated_.contains({place.source, place.offset})) return false;
  const auto first = first_of_alike_.find(alike(place, message));
  if (first == first_of_alike_.end()) return false;
  ++added_;
  ++errors_[first->second].members;
  return true;
}

void Diagnostics::add_unplaced(string name, string message, string remedy) {
  ++added_;
  errors_.push_back({false, {}, std::move(name), std::move(message), std::move(remedy)});
}

void Diagnostics::mark_repeated(Place place) {
  repeated_.insert({place.source, place.offset});
}

string Diagnostics::remedy_of(const Error& error) {
  if (error.members == 1) return error.remedy;
  const string members = fmt::format("in {} members, of which this is the first", error.members);
  return error.remedy.empty() ? members : fmt::format("{}\n{}", members, error.remedy);
}

string Diagnostics::show(const Error& error, bool color) const {
  const string label = paint("error:", "1;31", color);
  string gutter = "   ";
  string out;

  if (!error.placed) {
    out = fmt::format("{}: {} {}\n", paint(printable(error.name), "1", color), label, error.message);
  } else {
    const Source& source = sources_[error.place.source];
    const auto [line_number, column, before, after] = spot_of(source, error.place);

    // A long line is shown through a window around the caret. Characters outside it are only counted.
    const string_view near = before.substr(before.size() - min(before.size(), 4 * max_width));
    vector<Character> left = characters(near.substr(first_whole_character(near)));
    vector<Character> right = characters(after.substr(0, 4 * max_width));

    const string where =
        source.option ? printable(source.name) : fmt::format("{}:{}:{}", printable(source.name), line_number, column);
    out = fmt::format("{}: {} {}\n", paint(where, "1", color), label, error.message);

    const bool fits =
        near.size() == before.size() && after.size() <= 4 * max_width && left.size() + right.size() <= max_width;
    const bool cut_left = !fits && (near.size() < before.size() || left.size() > lead_width);
    if (cut_left) left.erase(left.begin(), left.end() - ptrdiff_t(min(left.size(), lead_width)));
    const size_t room = max_width - min(left.size(), lead_width);
    const bool cut_right = !fits && (after.size() > 4 * max_width || right.size() > room);
    if (cut_right) right.resize(min(right.size(), room));

    string shown = cut_left ? "..." : "", under = cut_left ? "   " : "", marks;
    for (const Character& c : left) {
      shown += c.text;
      under.append(size_t(c.width), ' ');
    }

    // The caret and its line stand below what is marked.
    for (const Character& c : right) {
      shown += c.text;
      if (c.at < error.place.length) marks.append(size_t(c.width), '~');
    }
    if (cut_right) shown += "...";
    if (marks.empty()) marks = "~";
    marks[0] = '^';

    const string number = source.option ? "" : to_string(line_number);
    gutter = string(max<size_t>(number.size(), 4), ' ');
    out += fmt::format("{:>4} | {}\n", number, shown);
    out += fmt::format("{} | {}{}\n", gutter, under, paint(marks, "1;32", color));
  }

  const string remedy = remedy_of(error);
  for (size_t i = 0; i < remedy.size();) {
    const size_t end = min(remedy.find('\n', i), remedy.size());
    out += fmt::format("{} = {}\n", gutter, string_view(remedy).substr(i, end - i));
    i = end + 1;
  }
  return out;
}

vector<const Diagnostics::Error*> Diagnostics::in_order() const {
  vector<const Error*> order;
  for (const Error& error : errors_) order.push_back(&error);
  // The order: errors of the file as a whole, then the file's in its order, then those of each --set.
  ranges::stable_sort(order, [](const Error* a, const Error* b) {
    return std::tuple(a->placed, a->place.source, a->place.offset) <
           std::tuple(b->placed, b->place.source, b->place.offset);
  });
  return order;
}

string Diagnostics::text(bool color) const {
  const vector<const Error*> order = in_order();
  string out;
  for (size_t i = 0; i < min(order.size(), max_shown); ++i) out += show(*order[i], color);
  if (order.size() > max_shown)
    out += fmt::format("and {}\n", how_many(order.size() - max_shown, "more error", "more errors"));
  return out;
}

vector<ErrorRecord> Diagnostics::records() const {
  vector<const Error*> order = in_order();
  order.resize(min(order.size(), max_shown));

  vector<ErrorRecord> records;
  for (const Error* error : order) {
    ErrorRecord record{error->name, 0, 0, error->message, remedy_of(*error), suggestion_in(error->remedy)};

    if (error->placed) {
      const Source& source = sources_[error->place.source];
      record.file = source.name;
      const LineSpot spot = spot_of(source, error->place);
      if (!source.option) tie(record.line, record.column) = pair(spot.line, spot.column);
    }
    records.push_back(std::move(record));
  }
  return records;
}

}  // namespace carom
