// Precedence climbing to a postfix program. Every function is computed here or by numerics/, because the last digits of
// <cmath> differ from machine to machine.
#include "scene/formula.h"

#include <fmt/format.h>

#include <charconv>
#include <numbers>

#include "numerics/degrees.h"
#include "numerics/elementary.h"
#include "numerics/power.h"
#include "numerics/random.h"
#include "scene/fields.h"
#include "std.h"
#include "yaml/diagnostics.h"
#include "yaml/document.h"
#include "yaml/values.h"

namespace carom {

/// An operator between two numbers, or a function.
struct Formula::Operation {
  string_view name;
  size_t arguments;                        // 0: one or more
  double (*value)(span<const double> of);  // null: a number drawn by the seed
  string_view noun = {};                   // of an operator's result
  int precedence = 0;                      // of an operator
};

namespace {

using Numbers = span<const double>;
using Operation = Formula::Operation;

constexpr size_t deepest = 64;  // parentheses in one another
constexpr string_view if_word = "if", if_form = "if(a < b, x, y)";

/// Thrown without its place, which value() knows.
[[noreturn]] double refuse(string message, string remedy) {
  throw FormulaError{0, 1, std::move(message), std::move(remedy)};
}

double divisor(double value) {
  return value == 0 ? refuse("division by zero", "expected a divisor other than 0") : value;
}

double remainder_of(Numbers x) {
  const double rest = std::fmod(x[0], divisor(x[1]));
  return rest != 0 && (rest < 0) != (x[1] < 0) ? rest + x[1] : rest;
}

double raised(Numbers x) {
  if (x[0] == 0 && x[1] < 0) refuse("division by zero", "0 has no negative powers");
  const double result = power(x[0], x[1]);
  return std::isnan(result) ? refuse(fmt::format("{} has no power {}", x[0], x[1]),
                                     "expected a whole exponent, or a base of at least 0")
                            : result;
}

double root_of(Numbers x) {
  return x[0] < 0 ? refuse(fmt::format("the root of {}", x[0]), "expected a number of at least 0") : sqrt(x[0]);
}

double tangent(Numbers x) {
  const SinCos of = sin_cos_degrees(x[0]);
  return of.cos == 0 ? refuse(fmt::format("the tangent of {} degrees", x[0]), "it is infinite") : of.sin / of.cos;
}

/// A sine or a cosine.
double ratio(double value, string_view name) {
  return std::abs(value) <= 1
             ? value
             : refuse(fmt::format("no angle has the {} {}", name, value), "expected a number from -1 to 1");
}

double log_of(Numbers x) {
  return x[0] > 0 ? logarithm(x[0]) : refuse(fmt::format("the logarithm of {}", x[0]), "expected a number above 0");
}

/// The number i of the scene's stream of this name. 0 <= u < 1.
double drawn(optional<uint64_t> seed, double i) {
  if (floor(i) != i || std::abs(i) > 0x1p53)
    refuse(fmt::format("rand of {}", i), "expected a whole number, up to 2^53, such as an index: rand(i)");
  if (!seed) refuse("`rand` draws by the seed, which is an expression", "expected a number after `seed`");
  return Random(*seed, "rand").skip(uint64_t(int64_t(i))).uniform();
}

constexpr Operation functions[] = {
    {"sqrt", 1, root_of},
    {"abs", 1, [](Numbers x) { return std::abs(x[0]); }},
    {"min", 0, [](Numbers x) { return *ranges::min_element(x); }},
    {"max", 0, [](Numbers x) { return *ranges::max_element(x); }},
    {"floor", 1, [](Numbers x) { return floor(x[0]); }},
    {"sin", 1, [](Numbers x) { return sin_cos_degrees(x[0]).sin; }},
    {"cos", 1, [](Numbers x) { return sin_cos_degrees(x[0]).cos; }},
    {"tan", 1, tangent},
    {"asin", 1, [](Numbers x) { return arc_sine_degrees(ratio(x[0], "sine")); }},
    {"acos", 1, [](Numbers x) { return arc_cosine_degrees(ratio(x[0], "cosine")); }},
    {"atan2", 2, [](Numbers x) { return arc_tangent_degrees(x[0], x[1]); }},
    {"exp", 1, [](Numbers x) { return exponential(x[0]); }, "exponential"},
    {"log", 1, log_of},
    {"rand", 1, nullptr},
};

/// Between the two numbers of a condition.
constexpr Operation comparisons[] = {
    {"<", 2, [](Numbers x) { return x[0] < x[1] ? 1.0 : 0.0; }},
    {"<=", 2, [](Numbers x) { return x[0] <= x[1] ? 1.0 : 0.0; }},
    {">", 2, [](Numbers x) { return x[0] > x[1] ? 1.0 : 0.0; }},
    {">=", 2, [](Numbers x) { return x[0] >= x[1] ? 1.0 : 0.0; }},
    {"==", 2, [](Numbers x) { return x[0] == x[1] ? 1.0 : 0.0; }},
    {"!=", 2, [](Numbers x) { return x[0] != x[1] ? 1.0 : 0.0; }},
};

constexpr int highest = 3;  // precedence; its operators group from the right
constexpr Operation operators[] = {
    {"+", 2, [](Numbers x) { return x[0] + x[1]; }, "sum", 1},
    {"-", 2, [](Numbers x) { return x[0] - x[1]; }, "difference", 1},
    {"*", 2, [](Numbers x) { return x[0] * x[1]; }, "product", 2},
    {"/", 2, [](Numbers x) { return x[0] / divisor(x[1]); }, "quotient", 2},
    {"%", 2, remainder_of, "remainder", 2},
    {"^", 2, raised, "power", highest},
};
constexpr Operation opposite = {"-", 1, [](Numbers x) { return -x[0]; }};

const Operation* find(span<const Operation> all, string_view name) {
  const auto found = ranges::find(all, name, &Operation::name);
  return found == all.end() ? nullptr : &*found;
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_name_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '.' || is_digit(c);
}

struct Token {
  char sort;  // '0' of a number, 'a' of a name, '<' of a comparison, 0 at the end, otherwise the character itself
  size_t at, length = 1;
  double value = 0;  // of a number
};

/// Reads an expression, in which each error is that of the first token that is wrong.
class Reader {
 public:
  Reader(string_view text, span<const string> names, string_view hint) : text_(text), names_(names), hint_(hint) {}

  void run() {
    if (text_.size() > longest_formula)
      fail({0, 0}, fmt::format("an expression of {} bytes", text_.size()),
           fmt::format("expected at most {}: give names to its parts in `let`", longest_formula));
    expression(1);
    if (after_.sort != 0) fail_after_operand();
  }

  /// Names of the text, by index, in the order of their first places.
  vector<size_t> used;
  vector<Formula::Step> steps;

 private:
  string_view of(const Token& token) const { return text_.substr(token.at, token.length); }

  [[noreturn]] static void fail(const Token& token, string message, string remedy) {
    throw FormulaError{token.at, max<size_t>(token.length, 1), std::move(message), std::move(remedy)};
  }

  Token next() {
    at_ = min(text_.find_first_not_of(" \n", at_), text_.size());
    const size_t at = at_;
    // The end of the expression is shown at its last character.
    if (at == text_.size()) return {0, max<size_t>(text_.find_last_not_of(" \n") + 1, 1) - 1};

    const char c = text_[at];
    if (is_digit(c) || (c == '.' && at + 1 < text_.size() && is_digit(text_[at + 1]))) return number();
    if (is_name_character(c) && c != '.') {
      while (at_ < text_.size() && is_name_character(text_[at_])) ++at_;
      return {'a', at, at_ - at};
    }

    ++at_;
    if (string_view("(),").find(c) != string_view::npos || find(operators, text_.substr(at, 1))) return {c, at};
    for (const size_t length : {2, 1}) {
      if (find(comparisons, text_.substr(at, length)) == nullptr) continue;
      at_ = at + length;
      return {'<', at, length};
    }
    fail_at_sign(at);
  }

  [[noreturn]] void fail_at_sign(size_t at) {
    while (at_ < text_.size() && (text_[at_] & 0xC0) == 0x80) ++at_;  // the rest of a character
    const Token token{text_[at], at, at_ - at};
    const string_view decides = "!&|?:";
    fail(token, fmt::format("{} in an expression", in_backticks(of(token))),
         token.sort == '=' ? fmt::format("equality is ==, in the condition of {}", if_form)
         : decides.find(token.sort) != string_view::npos
             ? fmt::format("one condition decides, as in {}; `if` may stand in `if`", if_form)
             : "expected numbers, names, + - * / ^ %, parentheses and functions");
  }

  Token number() {
    Token token{'0', at_};
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), token.value);
    at_ = size_t(end - text_.data());
    token.length = at_ - token.at;

    if (error != std::errc()) {
      Node number;
      number.kind = Node::Kind::scalar;
      number.text = of(token);
      const Complaint complaint = explain_number(number, {"", "", "expected a number"});
      fail(token, complaint.message, complaint.remedy);
    }
    if (text_[token.at] == '0' && token.length > 1 && is_digit(text_[token.at + 1]))
      fail(token, fmt::format("{} has a leading zero", in_backticks(of(token))), "write it without");
    return token;
  }

  /// The first character of the next token. 0: there is none.
  char ahead() const {
    const size_t at = text_.find_first_not_of(" \n", at_);
    return at < text_.size() ? text_[at] : '\0';
  }

  void call(const Operation& operation, const Token& token, size_t arguments) {
    steps.push_back({token.at, token.length, 0, {}, &operation, arguments});
  }

  /// Reads an operand, and all after it that binds at least as strongly, and the token after that.
  void expression(int precedence) {
    operand(next());
    while (const Operation* sign = find(operators, of(after_))) {
      if (sign->precedence < precedence) return;
      const Token token = after_;
      expression(min(sign->precedence + 1, highest));
      call(*sign, token, 2);
    }
  }

  void operand(const Token& token) {
    switch (token.sort) {
      case '0':
        steps.push_back({token.at, token.length, token.value});
        break;
      case 'a':
        name(token);
        break;
      case '(':
        parentheses(token);
        break;

      case '+':
      case '-':
        if (ahead() == '+' || ahead() == '-') fail(next(), "two signs in a row", "expected one");
        expression(highest);
        if (token.sort == '-') call(opposite, token, 1);
        return;
      default:
        fail_without_operand(token);
    }
    after_ = next();
  }

  [[noreturn]] void fail_without_operand(const Token& token) const {
    if (token.sort == '*' && token.at > 0 && text_[token.at - 1] == '*')
      fail({'*', token.at - 1, 2}, "`**` is no operator", "a power is written with ^, as in r^2");
    if (token.sort != 0)
      fail(token, fmt::format("a number is missing before {}", in_backticks(of(token))), "expected a number or a name");
    if (text_.find_first_not_of(" \n") == string_view::npos)
      fail({0, 0}, "an empty expression", "expected a number or a name after `=`");
    fail(token, "the expression ends too early", "expected a number or a name after it");
  }

  [[noreturn]] void fail_after_operand() const {
    if (after_.sort == ',')
      fail(after_, "a comma outside of a function's arguments", "the decimal point is a point: 1.5, not 1,5");
    if (after_.sort == ')') fail(after_, "this parenthesis was not opened", "remove it");
    if (after_.sort == '<')
      fail(after_, "a comparison outside of a condition", fmt::format("expected one comparison, as in {}", if_form));
    fail(after_, fmt::format("an operator is missing before {}", in_backticks(of(after_))),
         "a product is written with *, as in 2 * r");
  }

  void name(const Token& token) {
    const string_view name = of(token);
    if (name == if_word) return choice(token);
    if (const Operation* function = find(functions, name)) return arguments(*function, token);
    if (name == "pi") return steps.push_back({token.at, token.length, std::numbers::pi});

    const string_view plain = name.starts_with("let.") ? name.substr(4) : name;
    const auto found = ranges::find(names_, plain);
    if (found == names_.end()) unknown(token, plain);
    const auto index = size_t(found - names_.begin());
    if (!contains(used, index)) used.push_back(index);
    steps.push_back({token.at, token.length, 0, index});
  }

  [[noreturn]] void unknown(const Token& token, string_view name) const {
    const size_t after = text_.find_first_not_of(' ', at_);
    const bool is_call = after < text_.size() && text_[after] == '(';
    vector<string_view> known = formula_functions();
    if (!is_call) {
      known.assign(names_.begin(), names_.end());
      if (name.size() > 1) known.emplace_back("pi");
    }

    const string near = nearest(name, known);
    const string any = !is_call && !hint_.empty() ? string(hint_)
                       : known.empty()            ? "expected pi"
                                                  : "expected " + listed(known);
    fail(token, fmt::format("no {} is named {}", is_call ? "function" : "number", in_backticks(name)),
         near.empty() ? any : fmt::format("did you mean {}?", in_backticks(near)));
  }

  void arguments(const Operation& function, const Token& token) {
    const Token open = opening(token, fmt::format("{}(...)", function.name));
    const size_t count = parentheses(open, &token), takes = function.arguments;
    if (takes != 0 && takes != count)
      fail(token, fmt::format("{} has {} argument{}", in_backticks(function.name), count, count == 1 ? "" : "s"),
           fmt::format("expected {}", takes == 1 ? "one" : "two"));
    call(function, token, count);
  }

  /// Reads the parenthesis after a function's name. `form`: of a call.
  Token opening(const Token& function, const string& form) {
    const Token open = next();
    if (open.sort != '(')
      fail(function, fmt::format("{} without parentheses", in_backticks(of(function))),
           fmt::format("expected {}", form));
    return open;
  }

  void descend(const Token& open) {
    if (++depth_ > deepest)
      fail(open, fmt::format("parentheses are nested more than {} deep", deepest),
           "expected fewer: give names to parts in `let`");
  }

  /// Reads if(a < b, x, y). The steps are those of the condition, of x and of y, with skips between them.
  void choice(const Token& token) {
    const Token open = opening(token, string(if_form));
    descend(open);
    if (ahead() == ')') fail(token, "`if` has no argument", fmt::format("expected {}", if_form));

    // The condition.
    expression(1);
    const Operation* comparison = after_.sort == '<' ? find(comparisons, of(after_)) : nullptr;
    if (comparison == nullptr && (after_.sort == ',' || after_.sort == ')'))
      fail(token, "`if` has no comparison", fmt::format("expected < <= > >= == or != first, as in {}", if_form));
    if (comparison == nullptr) end_of_argument(open, token);
    const Token sign = after_;
    expression(1);
    call(*comparison, sign, 2);
    end_of_argument(open, token, ',');

    // Each branch, whose skip leads behind it.
    const size_t unless = skip(token, true);
    expression(1);
    end_of_argument(open, token, ',');
    const size_t otherwise = skip(token, false);
    steps[unless].skips = steps.size() - unless - 1;
    expression(1);
    end_of_argument(open, token, ')');
    steps[otherwise].skips = steps.size() - otherwise - 1;
    --depth_;
  }

  /// Adds a skip of a length that is not known yet. Returns its number.
  size_t skip(const Token& token, bool is_condition) {
    steps.push_back({token.at, token.length, 0, {}, nullptr, 0, 1, is_condition});
    return steps.size() - 1;
  }

  /// An argument of `if` has been read. Fails unless `sort` is behind it.
  void end_of_argument(const Token& open, const Token& token, char sort = 0) const {
    if (sort != 0 && after_.sort == sort) return;
    if (after_.sort == 0) fail_unclosed(open);
    if (after_.sort == ',' || after_.sort == ')')
      fail(token, fmt::format("`if` has {} arguments than three", after_.sort == ',' ? "more" : "fewer"),
           fmt::format("expected {}", if_form));
    fail_after_operand();
  }

  [[noreturn]] static void fail_unclosed(const Token& open) {
    fail(open, "this parenthesis is not closed", "expected `)`; an expression with a comma needs quotes in a list");
  }

  /// Reads the arguments of a function, or one expression. Returns their number.
  size_t parentheses(const Token& open, const Token* function = nullptr) {
    descend(open);
    if (ahead() == ')' && function != nullptr)
      fail(*function, fmt::format("{} has no argument", in_backticks(of(*function))),
           "expected a number between the parentheses");
    if (ahead() == ')') fail(open, "nothing stands between these parentheses", "expected a number or a name");

    size_t count = 1;
    for (expression(1); after_.sort == ',' && function != nullptr; expression(1)) ++count;
    if (after_.sort == 0) fail_unclosed(open);
    if (after_.sort != ')') fail_after_operand();
    --depth_;
    return count;
  }

  string_view text_;
  span<const string> names_;
  string_view hint_;
  size_t at_ = 0, depth_ = 0;
  Token after_{0, 0};  // the token after the last operand
};

}  // namespace

Formula::Formula(string_view text, span<const string> names, string_view hint) {
  Reader reader(text, names, hint);
  reader.run();
  used_ = std::move(reader.used);
  steps_ = std::move(reader.steps);
}

FormulaError Formula::at_name(size_t name, string message, string remedy) const {
  const Step& step = *ranges::find(steps_, optional(name), &Step::name);
  return {step.at, step.length, std::move(message), std::move(remedy)};
}

bool Formula::draws() const {
  return any_of(steps_, [](const Step& step) { return step.operation != nullptr && step.operation->value == nullptr; });
}

double Formula::value(span<const double> values, optional<uint64_t> seed) const {
  vector<double> stack;
  for (size_t at = 0; at < steps_.size(); ++at) {
    const Step& step = steps_[at];
    if (step.skips > 0) {
      if (!step.is_condition || stack.back() == 0) at += step.skips;
      if (step.is_condition) stack.pop_back();
      continue;
    }

    if (step.operation == nullptr) {
      stack.push_back(step.name ? values[*step.name] : step.number);
      continue;
    }

    const size_t first = stack.size() - step.arguments;
    try {
      const double result = step.operation->value == nullptr ? drawn(seed, stack[first])
                                                             : step.operation->value(span(stack).subspan(first));
      if (!isfinite(result))
        refuse(fmt::format("this {} makes a number too large for a double", step.operation->noun),
               "the largest is about 1.8e308");

      stack.resize(first);
      stack.push_back(result);
    } catch (FormulaError& error) {
      error.offset = step.at;
      error.length = step.length;
      throw;
    }
  }
  return stack.front();
}

vector<string_view> formula_functions() {
  vector<string_view> names;
  for (const Operation& function : functions) names.push_back(function.name);
  names.push_back(if_word);
  return names;
}

bool is_formula_word(string_view name) {
  return name == "pi" || name == if_word || find(functions, name) != nullptr;
}

}  // namespace carom
