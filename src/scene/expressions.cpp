// Expressions are replaced by the shortest text of their number, before anything else reads the tree. All later steps
// then see a scene without expressions: checks, decoding, the resolved scene. The place of a value stays that of its
// expression, so that an error about a number out of range points there.
#include "scene/expressions.h"

#include <fmt/format.h>

#include "std.h"
#include "yaml/values.h"

namespace carom {
namespace {

/// Expressions search names one by one, and circles are found by recursion.
constexpr size_t most_names = 1000;

string hint_for(const NamedNumbers& numbers) {
  return numbers.names.empty()
             ? "numbers have names in `let`, such as let: {r: 0.05}, and indices in things with `repeat`"
             : "";
}

/// Evaluates `let` in the order of its dependences.
class LetReader {
 public:
  LetReader(Node& let, optional<uint64_t> seed, Diagnostics& diagnostics) : let_(let), diagnostics_(diagnostics) {
    numbers_.seed = seed;
  }

  NamedNumbers run() {
    if (let_.keys.size() > most_names) {
      diagnostics_.add(let_.keys[most_names].place, fmt::format("`let` has {} names", let_.keys.size()),
                       fmt::format("expected at most {}", most_names));
      let_.bad = true;
    }

    for (size_t i = 0; i < min(let_.keys.size(), most_names); ++i) {
      check_name(let_.keys[i]);
      numbers_.add(let_.keys[i].text, 0);
      numbers_.known.back() = false;
    }

    states_.resize(numbers_.names.size(), State::fresh);
    for (size_t i = 0; i < states_.size(); ++i) settle(i);
    return std::move(numbers_);
  }

 private:
  enum class State : uint8_t { fresh, open, done };

  void check_name(const Key& key) {
    const string shown = in_backticks(key.text);
    if (!is_name(key.text) || key.text.find('-') != string::npos)
      diagnostics_.add(key.place, fmt::format("{} is not a name for a number", shown),
                       "expected letters, digits and _, a letter or _ first");
    else if (is_formula_word(key.text))
      diagnostics_.add(key.place,
                       fmt::format("{} is a {} of expressions", shown, key.text == "pi" ? "number" : "function"),
                       "expected another name");
  }

  void settle(size_t i) {
    if (states_[i] != State::fresh) return;
    states_[i] = State::open;
    path_.push_back(i);
    evaluate(i);
    path_.pop_back();
    states_[i] = State::done;
  }

  void evaluate(size_t i) {
    Node& node = let_.items[i];
    if (!is_expression(node)) {
      const optional<double> value = node.is_scalar() && !node.quoted ? parse_number(node.text) : nullopt;
      if (value) set(i, *value);
      return;
    }

    try {
      const Formula formula(string_view(node.text).substr(1), numbers_.names);
      for (const size_t used : formula.used()) {
        if (states_[used] == State::open)
          throw formula.at_name(used, circle(used), "expected numbers without a circle");
        settle(used);
        if (!numbers_.known[used]) node.bad = true;
      }

      if (node.bad) return;
      set(i, formula.value(numbers_.values, numbers_.seed));
      node.text = shortest(numbers_.values[i]);
      node.quoted = false;
    } catch (const FormulaError& error) {
      diagnostics_.add(place_in(node, 1, error), error.message, error.remedy);
      node.bad = true;
    }
  }

  void set(size_t i, double value) {
    numbers_.values[i] = value;
    numbers_.known[i] = true;
  }

  string circle(size_t from) const {
    string names;
    for (auto at = ranges::find(path_, from); at != path_.end(); ++at) names += numbers_.names[*at] + " -> ";
    return fmt::format("{} depends on itself: {}{}", in_backticks(numbers_.names[from]), names, numbers_.names[from]);
  }

  Node& let_;
  Diagnostics& diagnostics_;
  NamedNumbers numbers_;
  vector<State> states_;
  vector<size_t> path_;  // of dependences
};

}  // namespace

void NamedNumbers::add(string name, double value) {
  names.push_back(std::move(name));
  values.push_back(value);
  known.push_back(true);
}

bool NamedNumbers::has(string_view name) const {
  return contains(names, name);
}

bool is_expression(const Node& node) {
  return node.is_scalar() && node.text.starts_with('=');
}

bool has_braces(const Node& node) {
  return node.is_scalar() && node.text.find('{') != string::npos;
}

NamedNumbers read_let(Node& let, optional<uint64_t> seed, Diagnostics& diagnostics) {
  return LetReader(let, seed, diagnostics).run();
}

Place place_in(const Node& node, size_t at, const FormulaError& error) {
  // An escaped or folded text has no place for each character.
  const size_t quotes = node.quoted ? 2 : 0;
  if (node.place.length != node.text.size() + quotes) return node.place;
  // What is missing at the end of a text is shown at its last character.
  const size_t offset = min(at + error.offset, max<size_t>(node.text.size(), 1) - 1);
  return {node.place.source, uint32_t(node.place.offset + quotes / 2 + offset), uint32_t(error.length)};
}

optional<Slot> Slot::of(Node& node, const NamedNumbers& numbers, Diagnostics& diagnostics) {
  Slot slot(node);
  size_t at = 0;
  try {
    const string_view text = node.text;
    const string hint = hint_for(numbers);

    if (is_expression(node)) {
      at = 1;
      slot.pieces_.push_back({"", at, Formula(text.substr(at), numbers.names, hint)});
      return slot;
    }

    slot.is_name_ = true;
    for (size_t i = 0; i < text.size();) {
      const size_t open = text.find('{', i), close = text.find('}', i);
      if (open == string_view::npos) {
        slot.pieces_.push_back({string(text.substr(i)), 0, nullopt});
        break;
      }

      at = open + 1;
      if (close == string_view::npos || close < open)
        throw FormulaError{0, 1, "this brace is not closed", "expected an expression in braces, as in ball.{i}"};
      slot.pieces_.push_back(
          {string(text.substr(i, open - i)), at, Formula(text.substr(at, close - at), numbers.names, hint)});
      i = close + 1;
    }

    return slot;
  } catch (const FormulaError& error) {
    diagnostics.add(place_in(node, at, error), error.message, error.remedy);
    node.bad = true;
    return nullopt;
  }
}

size_t Slot::length() const {
  return node_->text.size();
}

optional<double> Slot::evaluate(const Piece& piece, const NamedNumbers& numbers, Diagnostics& diagnostics) {
  for (const size_t used : piece.formula->used())
    if (!numbers.known[used]) return nullopt;  // its error was reported
  try {
    const double value = piece.formula->value(numbers.values, numbers.seed);
    if (!is_name_ || (floor(value) == value && std::abs(value) < 1e15)) return value;
    throw FormulaError{0, 1, fmt::format("the number in this name is {}", shortest(value)), "expected a whole number"};
  } catch (const FormulaError& error) {
    diagnostics.add(place_in(original_, piece.at, error), error.message, error.remedy);
    return nullopt;
  }
}

bool Slot::fill(const NamedNumbers& numbers, Diagnostics& diagnostics) {
  string text;
  for (const Piece& piece : pieces_) {
    text += piece.before;
    if (!piece.formula) continue;

    const optional<double> value = evaluate(piece, numbers, diagnostics);
    if (!value) {
      node_->bad = true;
      return false;
    }
    text += is_name_ ? fmt::format("{}", static_cast<long long>(*value)) : shortest(*value);
  }

  node_->text = std::move(text);
  node_->quoted = false;
  return true;
}

}  // namespace carom
