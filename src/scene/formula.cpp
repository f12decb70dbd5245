// muParser evaluates. What it accepts beyond the format (assignments, comparisons, several results) is refused before,
// by a pass over the tokens that also knows the place of each. All operators and functions are defined here, because
// those of muParser call <cmath>, whose last digits differ from machine to machine.
// Each of them counts its calls: with the order in which muParser calls them, the number of a call gives its place.
#include "scene/formula.h"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <numbers>

#include "numerics/degrees.h"
#include "numerics/power.h"
#include "scene/fields.h"
#include "std.h"
#include "yaml/diagnostics.h"
#include "yaml/document.h"
#include "yaml/values.h"

namespace carom {
namespace {

constexpr size_t deepest = 64;  // parentheses in one another
constexpr string_view operators = "+-*/^%";

/// Thrown through muParser by a function that has no value.
struct NoValue {
  string message, remedy;
};

/// The number of functions and operators called in this evaluation.
thread_local size_t calls = 0;

double finite(double value, string_view what) {
  ++calls;
  if (!std::isfinite(value))
    throw NoValue{fmt::format("{} makes a number too large for a double", what), "the largest is about 1.8e308"};
  return value;
}

[[noreturn]] void refuse(string message, string remedy = {}) {
  ++calls;
  throw NoValue{std::move(message), std::move(remedy)};
}

double plus(double a, double b) {
  return finite(a + b, "this sum");
}
double minus(double a, double b) {
  return finite(a - b, "this difference");
}
double times(double a, double b) {
  return finite(a * b, "this product");
}
double divide(double a, double b) {
  if (b == 0) refuse("division by zero", "expected a divisor other than 0");
  return finite(a / b, "this quotient");
}
double modulo(double a, double b) {
  if (b == 0) refuse("division by zero", "expected a divisor other than 0");
  const double rest = std::fmod(a, b);
  return finite(rest != 0 && (rest < 0) != (b < 0) ? rest + b : rest, "this remainder");
}
double raise(double a, double b) {
  if (a == 0 && b < 0) refuse("division by zero", "0 has no negative powers");
  const double result = power(a, b);
  if (std::isnan(result))
    refuse(fmt::format("{} has no power {}", a, b), "expected a whole exponent, or a base of at least 0");
  return finite(result, "this power");
}
double negative(double a) {
  return finite(-a, "");
}
double same(double a) {
  return finite(a, "");
}

double square_root_of(double x) {
  if (x < 0) refuse(fmt::format("the root of {}", x), "expected a number of at least 0");
  return finite(std::sqrt(x), "");
}
double magnitude(double x) {
  return finite(std::abs(x), "");
}
double round_down(double x) {
  return finite(std::floor(x), "");
}
double sine(double x) {
  return finite(sin_cos_degrees(x).sin, "");
}
double cosine(double x) {
  return finite(sin_cos_degrees(x).cos, "");
}
double tangent(double x) {
  const SinCos of = sin_cos_degrees(x);
  if (of.cos == 0) refuse(fmt::format("the tangent of {} degrees", x), "it is infinite");
  return finite(of.sin / of.cos, "");
}
double arc_sine(double x) {
  if (!(std::abs(x) <= 1)) refuse(fmt::format("no angle has the sine {}", x), "expected a number from -1 to 1");
  return finite(arc_sine_degrees(x), "");
}
double arc_cosine(double x) {
  if (!(std::abs(x) <= 1)) refuse(fmt::format("no angle has the cosine {}", x), "expected a number from -1 to 1");
  return finite(arc_cosine_degrees(x), "");
}
double arc_tangent_of(double y, double x) {
  return finite(arc_tangent_degrees(y, x), "");
}
double least(const double* values, int count) {
  return finite(*std::min_element(values, values + count), "");
}
double greatest(const double* values, int count) {
  return finite(*std::max_element(values, values + count), "");
}

struct Function {
  string_view name;
  size_t arguments;  // 0: one or more
  void (*define)(mu::ParserBase& parser, const string& name);
};

template <auto function>
void define(mu::ParserBase& parser, const string& name) {
  parser.DefineFun(name, function, false);
}

constexpr Function functions[] = {
    {"sqrt", 1, define<square_root_of>}, {"abs", 1, define<magnitude>},        {"min", 0, define<least>},
    {"max", 0, define<greatest>},        {"floor", 1, define<round_down>},     {"sin", 1, define<sine>},
    {"cos", 1, define<cosine>},          {"tan", 1, define<tangent>},          {"asin", 1, define<arc_sine>},
    {"acos", 1, define<arc_cosine>},     {"atan2", 2, define<arc_tangent_of>},
};

const Function* find_function(string_view name) {
  const auto found =
      std::find_if(std::begin(functions), std::end(functions), [&](const Function& f) { return f.name == name; });
  return found == std::end(functions) ? nullptr : found;
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_name_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '.' || is_digit(c);
}

/// The number at the start of a text, and its length. Length 0: there is none, or it is beyond the doubles.
size_t read_number(string_view text, double& value) {
  if (text.empty() || !(is_digit(text[0]) || (text[0] == '.' && text.size() > 1 && is_digit(text[1])))) return 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() ? static_cast<size_t>(end - text.data()) : 0;
}

/// The number at the start of a text as it stands there, also beyond the doubles.
string_view number_text(string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return text.substr(0, static_cast<size_t>(end - text.data()));
}

int take_number(const char* text, int* position, double* value) {
  const size_t length = read_number(text, *value);
  *position += static_cast<int>(length);
  return length > 0 ? 1 : 0;
}

/// Operators with precedence and side as the order of calls below has them.
class Parser : public mu::ParserBase {
 public:
  Parser() {
    EnableBuiltInOprt(false);
    EnableOptimizer(false);
    AddValIdent(take_number);
    InitCharSets();
    DefineOprt("+", plus, mu::prADD_SUB);
    DefineOprt("-", minus, mu::prADD_SUB);
    DefineOprt("*", times, mu::prMUL_DIV);
    DefineOprt("/", divide, mu::prMUL_DIV);
    DefineOprt("%", modulo, mu::prMUL_DIV);
    DefineOprt("^", raise, mu::prPOW, mu::oaRIGHT);
    DefineInfixOprt("-", negative, mu::prMUL_DIV, false);
    DefineInfixOprt("+", same, mu::prMUL_DIV, false);
    for (const Function& function : functions) function.define(*this, string(function.name));
    DefineConst("pi", std::numbers::pi);
  }

  void InitCharSets() override {
    DefineNameChars("0123456789_.abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ");
    DefineOprtChars("+-*/^%");
    DefineInfixOprtChars("+-");
  }
  void InitFun() override {}
  void InitConst() override {}
  void InitOprt() override {}
};

struct Token {
  enum class Sort : uint8_t { number, name, sign, open, close, comma, end };
  Sort sort;
  size_t at, length;
};

/// Checks an expression, and notes the order in which its operators and functions are called.
class Reader {
 public:
  Reader(string_view text, span<const string> names, string_view hint) : text_(text), names_(names), hint_(hint) {}

  void run() {
    if (text_.size() > longest_formula)
      fail({Token::Sort::end, 0, 1}, fmt::format("an expression of {} bytes", text_.size()),
           fmt::format("expected at most {}: give names to its parts in `let`", longest_formula));
    for (Token token = next();; token = next()) {
      if (expects_operand_)
        operand(token);
      else if (!after_operand(token))
        return;
    }
  }

  /// Names of the text, by index, with their first places.
  vector<std::pair<size_t, Token>> used;
  vector<Token> calls;  // in the order of evaluation

 private:
  /// An operator or function that waits for its operands, or an open parenthesis.
  struct Waiting {
    enum class Sort : uint8_t { binary, prefix, function, open };
    Sort sort;
    int precedence;
    Token token;
    size_t commas = 0;  // of a parenthesis
  };

  string_view of(const Token& token) const { return text_.substr(token.at, token.length); }

  [[noreturn]] static void fail(const Token& token, string message, string remedy) {
    throw FormulaError{token.at, std::max<size_t>(token.length, 1), std::move(message), std::move(remedy)};
  }

  Token next() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\n')) ++at_;
    const size_t at = at_;
    // The end of the expression is shown at its last character.
    if (at == text_.size()) return {Token::Sort::end, std::max<size_t>(text_.find_last_not_of(" \n") + 1, 1) - 1, 1};
    const char c = text_[at];
    if (is_digit(c) || (c == '.' && at + 1 < text_.size() && is_digit(text_[at + 1]))) return number();
    if (is_name_character(c) && c != '.') {
      while (at_ < text_.size() && is_name_character(text_[at_])) ++at_;
      return {Token::Sort::name, at, at_ - at};
    }
    ++at_;
    if (c == '(') return {Token::Sort::open, at, 1};
    if (c == ')') return {Token::Sort::close, at, 1};
    if (c == ',') return {Token::Sort::comma, at, 1};
    if (operators.find(c) != string_view::npos) return {Token::Sort::sign, at, 1};
    while (at_ < text_.size() && (text_[at_] & 0xC0) == 0x80) ++at_;  // the rest of a character
    const Token token{Token::Sort::end, at, at_ - at};
    const bool compares = string_view("<>=!&|?:").find(c) != string_view::npos;
    fail(token, fmt::format("{} in an expression", in_backticks(of(token))),
         compares ? "expressions have no comparisons and no assignments"
                  : "expected numbers, names, + - * / ^ %, parentheses and functions");
  }

  Token number() {
    double value = 0;
    const size_t at = at_, length = read_number(text_.substr(at), value);
    const Token token{Token::Sort::number, at, std::max<size_t>(length, 1)};
    if (length == 0) fail_beyond(at);
    if (text_[at] == '0' && length > 1 && is_digit(text_[at + 1]))
      fail(token, fmt::format("{} has a leading zero", in_backticks(of(token))), "write it without");
    at_ += length;
    return token;
  }

  [[noreturn]] void fail_beyond(size_t at) const {
    Node number;
    number.kind = Node::Kind::scalar;
    number.text = number_text(text_.substr(at));
    const Complaint complaint = explain_number(number, {"", "", "expected a number"});
    fail({Token::Sort::number, at, number.text.size()}, complaint.message, complaint.remedy);
  }

  void operand(const Token& token) {
    switch (token.sort) {
      case Token::Sort::number:
        expects_operand_ = false;
        return;
      case Token::Sort::name:
        return name(token);
      case Token::Sort::open:
        return open(token);
      case Token::Sort::sign:
        if (text_[token.at] == '+' || text_[token.at] == '-') {
          if (!waiting_.empty() && waiting_.back().sort == Waiting::Sort::prefix)
            fail(token, "two signs in a row", "expected one");
          waiting_.push_back({Waiting::Sort::prefix, mu::prMUL_DIV, token});
          return;
        }
        if (text_[token.at] == '*' && token.at > 0 && text_[token.at - 1] == '*')
          fail({token.sort, token.at - 1, 2}, "`**` is no operator", "a power is written with ^, as in r^2");
        break;
      default:
        break;
    }
    if (token.sort == Token::Sort::end && text_.find_first_not_of(" \n") == string_view::npos)
      fail({token.sort, 0, 1}, "an empty expression", "expected a number or a name after `=`");
    if (token.sort == Token::Sort::end)
      fail(token, "the expression ends too early", "expected a number or a name after it");
    fail(token, fmt::format("a number is missing before {}", in_backticks(of(token))), "expected a number or a name");
  }

  /// Returns false at the end.
  bool after_operand(const Token& token) {
    switch (token.sort) {
      case Token::Sort::sign: {
        const char c = text_[token.at];
        const int precedence = c == '^' ? mu::prPOW : c == '+' || c == '-' ? mu::prADD_SUB : mu::prMUL_DIV;
        apply_above(precedence, c == '^');
        waiting_.push_back({Waiting::Sort::binary, precedence, token});
        expects_operand_ = true;
        return true;
      }
      case Token::Sort::comma:
        comma(token);
        return true;
      case Token::Sort::close:
        close(token);
        return true;
      case Token::Sort::end:
        apply_above(0, false);
        if (waiting_.empty()) return false;
        fail(waiting_.back().token, "this parenthesis is not closed",
             "expected `)`; an expression with a comma needs quotes in a list");
      default:
        fail(token, fmt::format("an operator is missing before {}", in_backticks(of(token))),
             "a product is written with *, as in 2 * r");
    }
  }

  /// Calls what waits with a precedence of at least this one, down to the next open parenthesis.
  void apply_above(int precedence, bool from_right) {
    while (!waiting_.empty() && waiting_.back().sort != Waiting::Sort::open) {
      const Waiting& last = waiting_.back();
      const bool waits_on = last.precedence < precedence ||
                            (last.precedence == precedence && from_right && last.sort == Waiting::Sort::binary);
      if (waits_on) return;
      calls.push_back(last.token);
      waiting_.pop_back();
    }
  }

  void name(const Token& token) {
    const string_view name = of(token);
    if (find_function(name) != nullptr) {
      const Token after = next();
      if (after.sort != Token::Sort::open)
        fail(token, fmt::format("{} without parentheses", in_backticks(name)), fmt::format("expected {}(...)", name));
      waiting_.push_back({Waiting::Sort::function, 100, token});
      return open(after);
    }
    expects_operand_ = false;
    if (name == "pi") return;
    const string_view plain = name.starts_with("let.") ? name.substr(4) : name;
    const auto found = std::ranges::find(names_, plain);
    if (found == names_.end()) unknown(token, plain);
    const auto index = static_cast<size_t>(found - names_.begin());
    if (std::ranges::none_of(used, [&](const auto& use) { return use.first == index; }))
      used.emplace_back(index, token);
  }

  [[noreturn]] void unknown(const Token& token, string_view name) const {
    const size_t after = text_.find_first_not_of(' ', token.at + token.length);
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

  void open(const Token& token) {
    if (++depth_ > deepest)
      fail(token, fmt::format("parentheses are nested more than {} deep", deepest),
           "expected fewer: give names to parts in `let`");
    waiting_.push_back({Waiting::Sort::open, 0, token});
    expects_operand_ = true;
    const size_t after = text_.find_first_not_of(" \n", at_);
    if (after >= text_.size() || text_[after] != ')') return;
    if (is_argument_list())
      fail(waiting_[waiting_.size() - 2].token,
           fmt::format("{} has no argument", in_backticks(of(waiting_[waiting_.size() - 2].token))),
           "expected a number between the parentheses");
    fail(token, "nothing stands between these parentheses", "expected a number or a name");
  }

  /// Whether the last open parenthesis is that of a function.
  bool is_argument_list() const {
    return waiting_.size() > 1 && waiting_[waiting_.size() - 2].sort == Waiting::Sort::function;
  }

  void comma(const Token& token) {
    apply_above(0, false);
    if (waiting_.empty() || !is_argument_list())
      fail(token, "a comma outside of a function's arguments", "the decimal point is a point: 1.5, not 1,5");
    ++waiting_.back().commas;
    expects_operand_ = true;
  }

  void close(const Token& token) {
    apply_above(0, false);
    if (waiting_.empty()) fail(token, "this parenthesis was not opened", "remove it");
    --depth_;
    const bool is_call = is_argument_list();
    const size_t arguments = waiting_.back().commas + 1;
    waiting_.pop_back();
    if (!is_call) return;
    const Token call = waiting_.back().token;
    const size_t takes = find_function(of(call))->arguments;
    if (takes != 0 && takes != arguments)
      fail(call, fmt::format("{} has {} argument{}", in_backticks(of(call)), arguments, arguments == 1 ? "" : "s"),
           fmt::format("expected {}", takes == 1 ? "one" : "two"));
    calls.push_back(call);
    waiting_.pop_back();
  }

  string_view text_;
  span<const string> names_;
  string_view hint_;
  size_t at_ = 0, depth_ = 0;
  bool expects_operand_ = true;
  vector<Waiting> waiting_;
};

}  // namespace

struct Formula::Parts {
  Parser parser;
  vector<size_t> used;
  vector<Token> uses, calls;
  vector<double> values;  // of used names, where the parser reads them
};

Formula::Formula(string_view text, span<const string> names, string_view hint) : parts_(make_unique<Parts>()) {
  Reader reader(text, names, hint);
  reader.run();
  parts_->calls = std::move(reader.calls);
  parts_->values.resize(reader.used.size());
  for (size_t k = 0; k < reader.used.size(); ++k) {
    const auto& [index, token] = reader.used[k];
    parts_->used.push_back(index);
    parts_->uses.push_back(token);
    for (const char* start : {"", "let."}) parts_->parser.DefineVar(start + names[index], &parts_->values[k]);
  }
  parts_->parser.SetExpr(string(text));
}

Formula::~Formula() = default;
Formula::Formula(Formula&&) noexcept = default;

const vector<size_t>& Formula::used() const {
  return parts_->used;
}

FormulaError Formula::at_name(size_t name, string message, string remedy) const {
  const auto found = std::ranges::find(parts_->used, name);
  const Token& token = parts_->uses[static_cast<size_t>(found - parts_->used.begin())];
  return {token.at, token.length, std::move(message), std::move(remedy)};
}

double Formula::value(span<const double> values) const {
  for (size_t k = 0; k < parts_->used.size(); ++k) parts_->values[k] = values[parts_->used[k]];
  calls = 0;
  try {
    return parts_->parser.Eval();
  } catch (NoValue& error) {
    const Token& token = parts_->calls[calls - 1];
    throw FormulaError{token.at, token.length, std::move(error.message), std::move(error.remedy)};
  } catch (const mu::ParserError& error) {
    throw FormulaError{0, 1, fmt::format("this expression has no value: {}", error.GetMsg()), ""};
  }
}

vector<string_view> formula_functions() {
  vector<string_view> names;
  for (const Function& function : functions) names.push_back(function.name);
  return names;
}

bool is_formula_word(string_view name) {
  return name == "pi" || find_function(name) != nullptr;
}

}  // namespace carom
