// Measures by their grammar. An expression is read from left to right; each measure in it becomes a part, and `m0`,
// `m1`, ... take their places. What is left is arithmetic (scene/formula.h).
#include <fmt/format.h>

#include <cctype>

#include "run/measure.h"
#include "run/measure_scope.h"
#include "scene/formula.h"
#include "std.h"
#include "yaml/diagnostics.h"
#include "yaml/joined.h"
#include "yaml/values.h"

namespace carom {
namespace {

constexpr size_t longest = 4096;  // letters of a measure

bool is_letter(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_';
}
bool is_digit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}
bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

string_view trimmed(string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

struct Call {
  string_view name;
  MeasureForm form;
  string_view example;
};

constexpr array<Call, 9> calls = {{{"max", MeasureForm::greatest, "max(balls.NAME.y_m)"},
                                   {"min", MeasureForm::least, "min(balls.NAME.y_m)"},
                                   {"time_of_max", MeasureForm::greatest_time, "time_of_max(balls.NAME.y_m)"},
                                   {"time_of_min", MeasureForm::least_time, "time_of_min(balls.NAME.y_m)"},
                                   {"mean", MeasureForm::mean, "mean(balls.NAME.y_m)"},
                                   {"first", MeasureForm::first_hit, "first(red, blue)"},
                                   {"hits", MeasureForm::hits, "hits(red, blue)"},
                                   {"impulse", MeasureForm::impulse, "impulse(red, floor)"},
                                   {"count", MeasureForm::count, "count(y_m < 0)"}}};

struct RegionText {
  string_view name;
  MeasureForm form;
};

constexpr array<RegionText, 4> of_regions = {{{"entries", MeasureForm::entries},
                                              {"inside", MeasureForm::inside},
                                              {"first_s", MeasureForm::first_entry},
                                              {"first", MeasureForm::first_entrant}}};

struct RelationText {
  string_view sign;
  Relation relation;
};

// A longer sign comes before its beginning.
constexpr array<RelationText, 4> relations = {
    {{"<=", Relation::at_most}, {">=", Relation::at_least}, {"<", Relation::less}, {">", Relation::greater}}};

const Call* find_call(string_view name) {
  const auto found = ranges::find_if(calls, [&](const Call& call) { return call.name == name; });
  return found == calls.end() ? nullptr : &*found;
}

bool is_kind(string_view word) {
  return word == "balls" || word == "bodies" || word == "groups";
}

optional<Quantity> find_quantity(string_view name) {
  for (int k = 0; k <= int(Quantity::kinetic); ++k)
    if (name_of(static_cast<Quantity>(k)) == name) return static_cast<Quantity>(k);
  return nullopt;
}

Quantity quantity_named(string_view name, string_view whole) {
  if (const auto quantity = find_quantity(name)) return *quantity;
  vector<string_view> names;
  for (int k = 0; k <= int(Quantity::kinetic); ++k) names.push_back(name_of(static_cast<Quantity>(k)));
  const string near = near_name(name, names);
  throw MeasureError(fmt::format("{}: no quantity {}{}", in_backticks(whole), in_backticks(name),
                                 near.empty() ? fmt::format("; the quantities are {}", joined(names, ", ")) : near));
}

/// "balls.red.y_m" into the measure, or "y_m" for all bodies. `one`: it must be one body.
void read_quantity(string_view text, bool one, Measure& measure) {
  const size_t first = text.find('.'), last = text.rfind('.');
  if (first == string_view::npos && !one) {
    measure.quantity = quantity_named(text, measure.name);
    return;
  }

  measure.kind = text.substr(0, first);
  if (!is_kind(measure.kind))
    throw MeasureError(fmt::format("{}: expected a quantity such as balls.NAME.y_m, not {}", in_backticks(measure.name),
                                   in_backticks(text)));
  if (first == last)
    throw MeasureError(fmt::format("{} has no quantity: expected one such as {}.NAME.speed_m_per_s",
                                   in_backticks(measure.name), measure.kind));
  measure.body = text.substr(first + 1, last - first - 1);
  measure.quantity = quantity_named(text.substr(last + 1), measure.name);
}

vector<string_view> arguments_of(string_view text) {
  vector<string_view> parts;
  int depth = 0;
  size_t begin = 0;
  for (size_t i = 0; i < text.size(); ++i) {
    depth += text[i] == '(' ? 1 : text[i] == ')' ? -1 : 0;
    if (text[i] != ',' || depth != 0) continue;
    parts.push_back(trimmed(text.substr(begin, i - begin)));
    begin = i + 1;
  }
  parts.push_back(trimmed(text.substr(begin)));
  return parts;
}

/// "from" or "until" of an argument such as "from: 1", and its value. Empty: it is another argument.
pair<string_view, string_view> window_end(string_view argument) {
  const size_t colon = argument.find(':');
  const string_view key = trimmed(argument.substr(0, min(colon, argument.size())));
  if (colon == string_view::npos || (key != "from" && key != "until")) return {};
  return {key, trimmed(argument.substr(colon + 1))};
}

/// Takes the arguments that are ends of a window into the measure, and out of the list.
void read_window(vector<string_view>& arguments, Measure& measure) {
  std::erase_if(arguments, [&](string_view argument) {
    const auto [key, value] = window_end(argument);
    if (key.empty()) return false;
    if (measure.form == MeasureForm::count)
      throw MeasureError(fmt::format("{}: bodies are counted at the end of the run; remove {}",
                                     in_backticks(measure.name), in_backticks(argument)));

    string& end = key == "from" ? measure.from : measure.until;
    if (!end.empty()) throw MeasureError(fmt::format("{} has {} twice", in_backticks(measure.name), in_backticks(key)));
    const bool named = value.starts_with("let.") && value.size() > 4;
    if (!named && !parse_number(value))
      throw MeasureError(fmt::format("{}: {} is no time; expected {}: and seconds, such as {}: 1.5, or let.NAME",
                                     in_backticks(measure.name), in_backticks(value), key, key));
    end = value;
    return true;
  });
}

/// Ends of a window as text, after other arguments.
string window_text(const Measure& measure) {
  return (measure.from.empty() ? "" : ", from: " + measure.from) +
         (measure.until.empty() ? "" : ", until: " + measure.until);
}

/// The end of what opens at `open`, a parenthesis: the place of the one that closes it.
size_t closing_of(string_view text, size_t open) {
  int depth = 0;
  for (size_t i = open; i < text.size(); ++i) {
    depth += text[i] == '(' ? 1 : text[i] == ')' ? -1 : 0;
    if (depth == 0) return i;
  }
  throw MeasureError(
      fmt::format("{} lacks a closing parenthesis; in YAML, a measure with a comma needs quotes", in_backticks(text)));
}

/// Reads an expression, and takes the measures in it as parts.
class FormulaParts {
 public:
  /// `from`: bytes before the expression in the text of the measure.
  FormulaParts(string_view text, size_t from, span<const string> own, Measure& measure)
      : text_(text), from_(from), own_(own), measure_(measure) {}

  void read() {
    while (at_ < text_.size()) {
      if (is_letter(text_[at_]))
        word();
      else if (is_digit(text_[at_]) || text_[at_] == '.')
        number();
      else
        take(at_ + 1);
    }
  }

  /// Where a span of the formula stands in the text of the measure.
  TextSpan place(const TextSpan& span) const {
    const size_t begin = min(span.at, places_.size() - 1),
                 last = min(span.at + max<size_t>(span.length, 1), places_.size()) - 1;
    return {places_[begin].at, places_[last].at + places_[last].length - places_[begin].at};
  }

 private:
  /// Copies the text up to here into the formula.
  void take(size_t end) {
    for (; at_ < end; ++at_) {
      measure_.formula += text_[at_];
      places_.push_back({from_ + at_, 1});
    }
  }

  size_t end_of_word(size_t from) const {
    while (from < text_.size() && (is_letter(text_[from]) || is_digit(text_[from]))) ++from;
    return from;
  }

  /// Digits, so that the e of 1e3 is no name.
  void number() {
    size_t end = at_;
    while (end < text_.size() && (is_digit(text_[end]) || text_[end] == '.')) ++end;
    if (end < text_.size() && (text_[end] == 'e' || text_[end] == 'E')) {
      size_t after = end + 1;
      if (after < text_.size() && (text_[after] == '+' || text_[after] == '-')) ++after;
      if (after < text_.size() && is_digit(text_[after])) end = end_of_word(after);
    }
    take(end);
  }

  void word() {
    const size_t end = end_of_word(at_);
    const string_view word = text_.substr(at_, end - at_);
    if (end < text_.size() && text_[end] == '.') return part(end_of_path(end));

    // A call, a column, or a measure of the scene.
    size_t open = end;
    while (open < text_.size() && is_blank(text_[open])) ++open;
    if (open < text_.size() && text_[open] == '(' && find_call(word) != nullptr) {
      const size_t close = closing_of(text_, open);
      auto arguments = arguments_of(text_.substr(open + 1, close - open - 1));
      std::erase_if(arguments, [](string_view argument) { return !window_end(argument).first.empty(); });
      const bool arithmetic =
          (word == "max" || word == "min") &&
          (arguments.size() > 1 || (!arguments.empty() && arguments.front().find('(') != string_view::npos));
      if (!arithmetic) return part(close + 1);
    } else if (find_summary_column(word) != nullptr || contains(own_, word)) {
      return part(end);
    }

    take(end);
  }

  /// The end of "balls.red.y_m", "groups.gas.17.x_m", "regions.left-pocket.entries", "let.h". Names may have hyphens,
  /// the last word has none.
  size_t end_of_path(size_t dot) const {
    size_t end = dot + 1;
    if (text_.substr(at_, dot - at_) != "let")
      while (end < text_.size() && (is_letter(text_[end]) || is_digit(text_[end]) || text_[end] == '-')) ++end;
    else
      end = end_of_word(end);
    while (end + 1 < text_.size() && text_[end] == '.') end = end_of_word(end + 1);
    return end;
  }

  void part(size_t end) {
    const TextSpan span{from_ + at_, end - at_};
    Measure part;
    try {
      part = parse_measure(text_.substr(at_, end - at_), own_);
    } catch (const MeasureError& error) {
      throw MeasureError(error.what(), within(span, error.span));
    }

    if (part.is_text())
      throw MeasureError(
          fmt::format("{} is a name, not a number, and cannot stand in an expression", in_backticks(part.name)), span);

    part.span = span;
    measure_.formula += fmt::format("m{}", measure_.parts.size());
    places_.resize(measure_.formula.size(), span);
    measure_.parts.push_back(std::move(part));
    at_ = end;
  }

  string_view text_;
  size_t from_;
  span<const string> own_;
  Measure& measure_;
  size_t at_ = 0;
  vector<TextSpan> places_;  // by byte of the formula
};

/// "m0", "m1", ...
vector<string> names_of_parts(const Measure& measure) {
  vector<string> names;
  for (size_t k = 0; k < measure.parts.size(); ++k) names.push_back(fmt::format("m{}", k));
  return names;
}

/// `from`: bytes before it in the text of the measure.
void read_formula(string_view text, size_t from, span<const string> own, Measure& measure) {
  FormulaParts parts(text, from, own, measure);
  parts.read();
  try {
    const Formula checked(measure.formula, names_of_parts(measure), "expected a measure, let.NAME or a number");
    if (checked.draws())
      throw MeasureError(
          fmt::format("{}: a measure draws no numbers; expected `rand` in `let`", in_backticks(measure.name)));
  } catch (const FormulaError& error) {
    throw MeasureError(fmt::format("{}: {}{}{}", in_backticks(measure.name), error.message,
                                   error.remedy.empty() ? "" : "; ", error.remedy),
                       measure.formula.empty() ? TextSpan{} : parts.place({error.offset, error.length}));
  }
}

/// `whole`: the text of the measure, of which `inside` is a part.
void read_count(string_view inside, string_view whole, span<const string> own, Measure& measure) {
  for (const RelationText& text : relations) {
    const size_t at = inside.find(text.sign);
    if (at == string_view::npos) continue;
    const string_view quantity = trimmed(inside.substr(0, at)), limit = trimmed(inside.substr(at + text.sign.size()));
    measure.relation = text.relation;
    read_quantity(quantity, false, measure);
    if (limit.empty()) break;
    read_formula(limit, size_t(limit.data() - whole.data()), own, measure);
    measure.name = fmt::format("count({} {} {})", quantity, text.sign, limit);
    return;
  }
  throw MeasureError(fmt::format("{}: expected a comparison, such as count(y_m < 0)", in_backticks(measure.name)));
}

/// `whole`: the text of the measure, of which `inside` is a part.
void read_call(const Call& call, string_view inside, string_view whole, span<const string> own, Measure& measure) {
  measure.form = call.form;
  vector<string_view> arguments = arguments_of(inside);
  read_window(arguments, measure);
  if (call.form == MeasureForm::count) return read_count(trimmed(inside), whole, own, measure);

  // One or two names, or a quantity.
  const bool of_things =
      call.form == MeasureForm::first_hit || call.form == MeasureForm::hits || call.form == MeasureForm::impulse;
  const bool empty = any_of(arguments, [](string_view text) { return text.empty(); });
  if (empty || arguments.empty() || arguments.size() > (of_things ? 2 : 1))
    throw MeasureError(fmt::format("{}: expected {}, such as {}", in_backticks(measure.name),
                                   of_things ? "one or two names" : "one quantity", call.example));
  measure.name = fmt::format("{}({}{})", call.name, joined(arguments, ", "), window_text(measure));
  if (!of_things) return read_quantity(arguments.front(), false, measure);
  measure.things.assign(arguments.begin(), arguments.end());
}

void read_region(string_view text, Measure& measure) {
  const size_t last = text.rfind('.');
  const string_view word = text.substr(last + 1);
  const auto found = ranges::find_if(of_regions, [&](const auto& of) { return of.name == word; });
  constexpr string_view begin = "regions.";
  if (found == of_regions.end() || last < begin.size()) {
    vector<string_view> names;
    for (const RegionText& of : of_regions) names.push_back(of.name);
    throw MeasureError(fmt::format("{}: of a region there are {}, such as regions.NAME.entries", in_backticks(text),
                                   joined(names, ", ")));
  }
  measure.form = found->form;
  measure.things = {string(text.substr(begin.size(), last - begin.size()))};
}

[[noreturn]] void refuse_name(string_view name, span<const string> own) {
  vector<string_view> names(own.begin(), own.end());
  for (const SummaryColumn& column : summary_columns())
    if (!column.is_text()) names.push_back(column.name);
  for (const Call& call : calls) names.push_back(call.name);
  const string near = near_name(name, names);
  throw MeasureError(fmt::format(
      "no measure {}{}", in_backticks(name),
      near.empty() ? "; a measure is a numeric column of summary.csv, a quantity such as balls.NAME.speed_m_per_s, an "
                     "extreme such as max(balls.NAME.y_m), hits(a, b), regions.NAME.entries or `= expression`"
                   : near));
}

}  // namespace

double formula_value(const Measure& measure, span<const double> parts) {
  constexpr double undefined = numeric_limits<double>::quiet_NaN();
  if (!all_of(parts, [](double value) { return isfinite(value); })) return undefined;
  try {
    return Formula(measure.formula, names_of_parts(measure)).value(parts);
  } catch (const FormulaError&) {
    return undefined;
  }
}

Measure parse_measure(string_view text, span<const string> own) {
  const string_view name = trimmed(text);
  if (name.size() > longest) throw MeasureError(fmt::format("a measure has at most {} letters", longest));
  Measure measure;
  measure.name = name;

  if (name.starts_with('=')) {
    measure.form = MeasureForm::expression;
    const string_view formula = trimmed(name.substr(1));
    read_formula(formula, size_t(formula.data() - text.data()), own, measure);
    return measure;
  }

  measure.column = find_summary_column(name);
  if (measure.column != nullptr) {
    if (measure.column->is_text())
      throw MeasureError(fmt::format("{} of summary.csv is text, not a measure", in_backticks(name)));
    return measure;
  }

  const size_t open = name.find('(');
  if (open != string_view::npos) {
    const Call* call = find_call(trimmed(name.substr(0, open)));
    if (call == nullptr) refuse_name(name, own);
    const size_t close = closing_of(name, open);
    if (close + 1 != name.size())
      throw MeasureError(fmt::format("{}: arithmetic begins with `=`, such as '= {}'", in_backticks(name), name));
    read_call(*call, name.substr(open + 1, close - open - 1), text, own, measure);
    return measure;
  }

  // Names with a dot, and those that the scene defines.
  if (name.starts_with("regions.")) {
    read_region(name, measure);
    return measure;
  }
  if (name.starts_with("let.") && name.find('.', 4) == string_view::npos && name.size() > 4) {
    measure.form = MeasureForm::given;
    measure.things = {string(name.substr(4))};
    return measure;
  }

  if (contains(own, name)) {
    measure.form = MeasureForm::own;
    measure.things = {string(name)};
    return measure;
  }

  // What is left is a quantity of one body.
  if (!is_kind(name.substr(0, name.find('.'))) || name.find('.') == string_view::npos) refuse_name(name, own);
  measure.form = MeasureForm::at_end;
  read_quantity(name, true, measure);
  return measure;
}

string measure_text(const string& text) {
  const bool is_name = all_of(text, [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
  if (is_name) return text;
  try {
    parse_measure(text);
    return text;
  } catch (const MeasureError&) {
    return "= " + text;
  }
}

}  // namespace carom
