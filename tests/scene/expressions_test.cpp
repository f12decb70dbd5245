// `let`, and expressions wherever a number may stand.
#include <clocale>

#include "physics/world.h"
#include "scene/formula.h"
#include "scene/marked_errors.h"
#include "scene/motion_text.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

double value_of(const string& text) {
  const vector<string> names = {"r", "i", "big"};
  const double values[] = {0.5, -3, 1e300};
  return Formula(text, names).value(values, 7);
}

TEST(Formulas, KnowPrecedenceAndSides) {
  EXPECT_EQ(value_of("2 + 3 * 4"), 14);
  EXPECT_EQ(value_of("(2 + 3) * 4"), 20);
  EXPECT_EQ(value_of("7 - 2 - 1"), 4);
  EXPECT_EQ(value_of("16 / 4 / 2"), 2);
  EXPECT_EQ(value_of("2 ^ 3 ^ 2"), 512);
  EXPECT_EQ(value_of("-2 ^ 2"), -4);
  EXPECT_EQ(value_of("2 ^ -1 * 3"), 1.5);
  EXPECT_EQ(value_of("2 * -3"), -6);
  EXPECT_EQ(value_of("1 - -r"), 1.5);
  EXPECT_EQ(value_of("+r"), 0.5);
  EXPECT_EQ(value_of(" 1.5e1+.5 "), 15.5);
  EXPECT_EQ(value_of("let.r + r"), 1);
}

TEST(Formulas, HaveTheFunctionsInDegrees) {
  EXPECT_EQ(value_of("sin(30)"), 0.5);
  EXPECT_EQ(value_of("cos(90)"), 0);
  EXPECT_EQ(value_of("tan(45)"), 1);
  EXPECT_EQ(value_of("tan(-135)"), 1);
  EXPECT_EQ(value_of("asin(r)"), 30);
  EXPECT_EQ(value_of("acos(-r)"), 120);
  EXPECT_EQ(value_of("atan2(1, -1)"), 135);
  EXPECT_EQ(value_of("sqrt(16) + abs(i) + floor(-0.5)"), 6);
  EXPECT_EQ(value_of("min(3, 1, 2) + max(r)"), 1.5);
  EXPECT_EQ(value_of("pi"), 3.141592653589793);
}

TEST(Formulas, HaveExponentialAndLogarithm) {
  EXPECT_EQ(value_of("exp(0) + log(1)"), 1);
  EXPECT_DOUBLE_EQ(value_of("exp(1)"), 2.718281828459045);
  EXPECT_DOUBLE_EQ(value_of("log(10)"), 2.302585092994046);
  EXPECT_DOUBLE_EQ(value_of("log(exp(-700.5))"), -700.5);
  EXPECT_EQ(value_of("exp(-1e6)"), 0);
}

TEST(Formulas, ChooseByAComparison) {
  EXPECT_EQ(value_of("if(r < 1, 2, 3)"), 2);
  EXPECT_EQ(value_of("if(r > 1, 2, 3) * 10"), 30);
  EXPECT_EQ(value_of("if(1 <= 1, 2, 3) + if(1 >= 2, 20, 30)"), 32);
  EXPECT_EQ(value_of("if(i == -3, 2, 3) + if(i != -3, 20, 30)"), 32);
  EXPECT_EQ(value_of("if(i + 2 < -r, if(r < 0, 1, 2), 3)"), 2);
  EXPECT_EQ(value_of("1 + if(2 < 1, if(r < 0, 1, 2), if(0 < 1, max(3, 4), 5)) + 1"), 6);
  EXPECT_EQ(value_of("if (2*r==1,1,0)"), 1);
}

TEST(Formulas, DoNotComputeWhatTheConditionExcludes) {
  EXPECT_EQ(value_of("if(r == 0, 1 / 0, r)"), 0.5);
  EXPECT_EQ(value_of("if(i < 0, 0, sqrt(i))"), 0);
  EXPECT_EQ(value_of("max(1, if(i < 0, 2, log(i)), 3)"), 3);
}

TEST(Formulas, DrawByTheSeedAndTheNumberAlone) {
  // SplitMix64, computed by a few lines of Python.
  EXPECT_EQ(value_of("rand(0)"), 0.5936079187902369);
  EXPECT_EQ(value_of("rand(i)"), 0.21631137802298572);
  EXPECT_EQ(value_of("rand(2^53)"), 0.7331888571830131);
  EXPECT_EQ(value_of("rand(-0) - rand(0)"), 0);
  const vector<string> names = {"i"};
  const Formula formula("rand(i)", names);
  EXPECT_TRUE(formula.draws());
  EXPECT_EQ(formula.value(vector<double>{1}, 0), 0.052014636229316125);

  // Uniform: the mean of 10^5 is that of [0, 1) to 3 of its standard deviations, and neighbours do not correlate.
  double sum = 0, products = 0, before = 0.5;
  constexpr int n = 100'000;
  for (int k = 0; k < n; ++k) {
    const double x = formula.value(vector<double>{double(k)}, 7);
    EXPECT_TRUE(x >= 0 && x < 1);
    sum += x - 0.5;
    products += (x - 0.5) * (before - 0.5);
    before = x;
  }
  EXPECT_LT(std::abs(sum / n), 3 * sqrt(1.0 / 12 / n));
  EXPECT_LT(std::abs(products / n), 3 * (1.0 / 12) / sqrt(double(n)));
}

TEST(Formulas, TakeTheRemainderWithTheSignOfTheDivisor) {
  EXPECT_EQ(value_of("i % 2"), 1);
  EXPECT_EQ(value_of("7 % 3"), 1);
  EXPECT_EQ(value_of("7 % -3"), -2);
  EXPECT_EQ(value_of("-6 % 3"), 0);
  EXPECT_EQ(value_of("5.5 % 2"), 1.5);
}

TEST(Formulas, AllowABlankBeforeParentheses) {
  EXPECT_EQ(value_of("sqrt (4)"), 2);
}

TEST(Formulas, MayHoldLongNames) {
  const vector<string> names = {string(200, 'n')};
  EXPECT_EQ(Formula("2 * let." + names[0], names).value(vector<double>{3}), 6);
}

TEST(Formulas, DoNotDependOnTheLocale) {
  const string before = std::setlocale(LC_ALL, nullptr);
  for (const char* locale : {"de_DE.UTF-8", "C.UTF-8"}) {
    if (std::setlocale(LC_ALL, locale) == nullptr) continue;
    EXPECT_EQ(value_of("1.5 + max(0.25, 0.125)"), 1.75);
  }
  std::setlocale(LC_ALL, before.c_str());
}

/// "marked text: message" of the error in an expression.
string fault_of(const string& text) {
  try {
    value_of(text);
    return "";
  } catch (const FormulaError& error) {
    return text.substr(error.offset, error.length) + ": " + error.message;
  }
}

/// Texts, each with the part that its error points at, and what that says.
const pair<const char*, const char*> faults[] = {
    {"", ": an empty expression"},
    {"  ", " : an empty expression"},
    {"1 +", "+: the expression ends too early"},
    {"* 2", "*: a number is missing before `*`"},
    {"1 2", "2: an operator is missing before `2`"},
    {"2r", "r: an operator is missing before `r`"},
    {"2(r)", "(: an operator is missing before `(`"},
    {"(1 + 2", "(: this parenthesis is not closed"},
    {"1)", "): this parenthesis was not opened"},
    {"()", "(: nothing stands between these parentheses"},
    {"1, 2", ",: a comma outside of a function's arguments"},
    {"(1, 2)", ",: a comma outside of a function's arguments"},
    {"2 ** 3", "**: `**` is no operator"},
    {"--2", "-: two signs in a row"},
    {"sqrt", "sqrt: `sqrt` without parentheses"},
    {"1 + sqrt 2", "sqrt: `sqrt` without parentheses"},
    {"sqrt()", "sqrt: `sqrt` has no argument"},
    {"sqrt(1, 2)", "sqrt: `sqrt` has 2 arguments"},
    {"atan2(1)", "atan2: `atan2` has 1 argument"},
    {"rr + 1", "rr: no number is named `rr`"},
    {"sqr(2)", "sqr: no function is named `sqr`"},
    {"rnd(1)", "rnd: no function is named `rnd`"},
    {"_pi", "_pi: no number is named `_pi`"},
    {"r = 2", "=: `=` in an expression"},
    {"if(r = 2, 1, 2)", "=: `=` in an expression"},
    {"if(r ! 2, 1, 2)", "!: `!` in an expression"},
    {"if(r < 2 & i < 1, 1, 2)", "&: `&` in an expression"},
    {"r < 2", "<: a comparison outside of a condition"},
    {"(r <= 2) * 3", "<=: a comparison outside of a condition"},
    {"if((r < 2), 1, 2)", "<: a comparison outside of a condition"},
    {"if(1 < r < 2, 1, 2)", "<: a comparison outside of a condition"},
    {"if(r < 2, 1 < 2, 2)", "<: a comparison outside of a condition"},
    {"if(< 2, 1, 2)", "<: a number is missing before `<`"},
    {"if(r, 1, 2)", "if: `if` has no comparison"},
    {"1 + if(r)", "if: `if` has no comparison"},
    {"if()", "if: `if` has no argument"},
    {"if + 1", "if: `if` without parentheses"},
    {"if(r < 2, 1)", "if: `if` has fewer arguments than three"},
    {"if(r < 2)", "if: `if` has fewer arguments than three"},
    {"if(r < 2, 1, 2, 3)", "if: `if` has more arguments than three"},
    {"if(r < 2, 1, 2", "(: this parenthesis is not closed"},
    {"if(r", "(: this parenthesis is not closed"},
    {"if(r 2, 1, 2)", "2: an operator is missing before `2`"},
    {"if(r < 2, 1 / 0, 2)", "/: division by zero"},
    {"log(0)", "log: the logarithm of 0"},
    {"exp(710)", "exp: this exponential makes a number too large for a double"},
    {"rand(0.5)", "rand: rand of 0.5"},
    {"rand(1e300)", "rand: rand of 1e+300"},
    {"r ? 1 : 2", "?: `?` in an expression"},
    {"\"x\"", "\": `\"` in an expression"},
    {"r²", "²: `²` in an expression"},
    {"0x10", "x10: an operator is missing before `x10`"},
    {"007", "007: `007` has a leading zero"},
    {"1e999", "1e999: `1e999` is too large for a double"},
    {"r + 1e-400", "1e-400: `1e-400` is too small for a double"},
    {"1 / (r - 0.5)", "/: division by zero"},
    {"1 / (1 / (r - r))", "/: division by zero"},
    {"2 * (3 - 4 / (1 - 1)) / 5", "/: division by zero"},
    {"5 % 0", "%: division by zero"},
    {"0 ^ -1", "^: division by zero"},
    {"big * big", "*: this product makes a number too large for a double"},
    {"big + 1 - big * 1e9 / 2", "*: this product makes a number too large for a double"},
    {"10 ^ 400", "^: this power makes a number too large for a double"},
    {"i ^ 0.5", "^: -3 has no power 0.5"},
    {"sqrt(4) + sqrt(i)", "sqrt: the root of -3"},
    {"asin(2)", "asin: no angle has the sine 2"},
    {"acos(i)", "acos: no angle has the cosine -3"},
    {"tan(90)", "tan: the tangent of 90 degrees"},
};

TEST(Formulas, PointAtTheirErrors) {
  for (const auto& [text, expected] : faults) EXPECT_EQ(fault_of(text), expected) << text;
  const string tiny = "0." + string(400, '0') + "1";
  const string fault = fault_of(tiny + " + r");
  EXPECT_TRUE(fault.starts_with(tiny + ": ") && fault.ends_with(" is too small for a double")) << fault;

  // The second of two equal functions.
  try {
    value_of("sqrt(4) + sqrt(i)");
  } catch (const FormulaError& error) {
    EXPECT_EQ(error.offset, 10u);
  }
}

TEST(Formulas, RefuseTheNumbersThatPlainValuesRefuse) {
  for (const string number : {"1e-400", "1e400", "2e-324"}) {
    const string plain = errors_of(start + "gravity: [0, " + number + ", 0]\n");
    const string fault = plain.substr(plain.find("error: "), plain.find('\n') - plain.find("error: "));
    EXPECT_NE(fault.find("for a double"), string::npos) << plain;
    const string expression = errors_of(start + "gravity: [0, '= " + number + "', 0]\n");
    EXPECT_NE(expression.find(fault), string::npos) << expression;
    const string limit = plain.substr(plain.rfind("; the "));
    EXPECT_NE(expression.find(limit), string::npos) << expression;
  }
  EXPECT_EQ(value_of("5e-324"), 5e-324);
}

TEST(Formulas, AreBounded) {
  const string deep = string(200, '(') + "1" + string(200, ')');
  EXPECT_EQ(fault_of(deep), "(: parentheses are nested more than 64 deep");
  EXPECT_EQ(value_of(string(64, '(') + "1" + string(64, ')')), 1);
  EXPECT_EQ(fault_of("1" + string(1000, '+')), "1: an expression of 1001 bytes");
}

constexpr const char* with_expressions = R"(scene: 1
seed: = 2 ^ 40
let: {gap: '= r / 10', r: 0.05, a: 20, n: 12}
gravity: [= 9.8 * sin(a), '= -9.8 * cos(a)', 0]
restitution: = 3 / 4
defaults: {ball: {mass: "= 2 * r", radius: = r}}
balls:
  red: {position: [= gap, = 2 * r + gap, 0], velocity: [-1, 0, '= -r'], color: [= r, 0.5, 1]}
groups:
  gas: {count: = n, in: {min: [1, 1, 1], max: [= 1 + n, 5, 5]}, ball: {restitution: '= min(r, 1)'}}
walls:
  fence: {center: [5, 1, 0], normal: [= -cos(a), = sin(a), 0], size: [= 2 * r, 2]}
forces:
  - {drag: {linear: = r / 100}, from: = r, until: '= 10 * r'}
simulate: {duration: = 40 * r, engine: exact}
camera: {eye: [0, 3, -5], target: [0, 0, 0], fov: = 2 * a}
title: = a title
output:
  trajectory: {every: = 1 / 60}
  frames: {fps: = n, size: [= 20 * n, = 10 * n], samples: = n / 3, until: = r}
)";

constexpr const char* with_numbers = R"(scene: 1
seed: 1099511627776
gravity: [3.3517974045915535, -9.208987683701903, 0]
restitution: {default: 0.75}
defaults: {ball: {mass: 0.1, radius: 0.05}}
balls:
  red: {position: [0.005, 0.10500000000000001, 0], velocity: [-1, 0, -0.05], color: [0.05, 0.5, 1]}
groups:
  gas: {count: 12, in: {min: [1, 1, 1], max: [13, 5, 5]}, ball: {restitution: 0.05}}
walls:
  fence: {center: [5, 1, 0], normal: [-0.9396926207859084, 0.3420201433256687, 0], size: [0.1, 2]}
forces:
  - {drag: {linear: 5e-04}, from: 0.05, until: 0.5}
simulate: {duration: 2, engine: exact}
camera: {eye: [0, 3, -5], target: [0, 0, 0], fov: 40}
title: = a title
output:
  trajectory: {every: 0.016666666666666666}
  frames: {fps: 12, size: [240, 120], samples: 4, until: 0.05}
)";

/// The resolved text without its line `let`.
string without_let(const Scene& scene) {
  const size_t at = scene.resolved.find("\nlet: ");
  if (at == string::npos) return scene.resolved;
  return scene.resolved.substr(0, at) + scene.resolved.substr(scene.resolved.find('\n', at + 1));
}

TEST(Expressions, AreTheSceneWithItsNumbersWrittenOut) {
  const Scene scene = load_text(with_expressions), plain = load_text(with_numbers);
  EXPECT_EQ(motion_text(scene), motion_text(plain));
  EXPECT_EQ(without_let(scene), plain.resolved);
  EXPECT_NE(scene.resolved.find("let: {gap: 0.005, r: 0.05, a: 20, \"n\": 12}"), string::npos);
  EXPECT_EQ(scene.title, "= a title");
  const Scene again = load_text(scene.resolved);
  EXPECT_EQ(again.resolved, scene.resolved);
  EXPECT_EQ(motion_text(again), motion_text(scene));
}

TEST(Expressions, FollowSettingsOfLet) {
  LoadOptions options;
  options.set = {"let.r=0.1", "balls.red.mass== 3 * r", "let.n=6"};
  const Scene scene = load_text(with_expressions, options);
  EXPECT_EQ(scene.world.radius[0], 0.1);
  EXPECT_EQ(scene.world.mass[0], 0.1 * 3);
  EXPECT_EQ(scene.world.mass[1], 0.2);
  EXPECT_EQ(scene.initial.position[0].x(), 0.01);
  EXPECT_EQ(scene.world.body_count(), 7u);
  options.set = {"let.r='= a / 100'"};
  EXPECT_EQ(load_text(with_expressions, options).world.radius[0], 0.2);
}

TEST(Expressions, KeepTheTextsOfWhatFollowsFromLet) {
  const Scene scene = load_text(with_expressions);
  const auto text = [&](const string& path) {
    const auto found = scene.made_from.expressions.find(path);
    return found == scene.made_from.expressions.end() ? "" : found->second;
  };
  EXPECT_EQ(text("let.gap"), "= r / 10");
  EXPECT_EQ(text("balls.red.position.y"), "= 2 * r + gap");
  EXPECT_EQ(text("balls.red.radius"), "= r");
  EXPECT_EQ(text("groups.gas.ball.mass"), "= 2 * r");
  EXPECT_EQ(text("walls.fence.size.width"), "= 2 * r");
  EXPECT_EQ(text("forces.0.drag.linear"), "= r / 100");
  EXPECT_EQ(text("title"), "");
}

TEST(Expressions, DrawByTheSeedWhateverTheyStandIn) {
  const string text = start +
                      "seed: 7\nlet: {a: '= rand(0)'}\n"
                      "balls:\n"
                      "  row: {repeat: 2, mass: '= 1 + a', radius: 0.1, position: ['= 2 * i + rand(i)', 0, 0]}\n";
  const Scene scene = load_text(text);
  EXPECT_EQ(scene.world.mass[0], 1 + 0.5936079187902369);
  EXPECT_EQ(scene.initial.position[0].x(), 0.5936079187902369);

  // Another seed, by an option or a setting, is another draw. The resolved scene has numbers.
  LoadOptions option, setting;
  option.seed = 0;
  setting.set = {"seed=0"};
  EXPECT_EQ(load_text(text, option).world.mass[0], 1 + 0.28865318502595894);
  EXPECT_EQ(load_text(text, setting).world.mass[0], 1 + 0.28865318502595894);
  EXPECT_EQ(load_text(scene.resolved, setting).world.mass[0], scene.world.mass[0]);

  // As a sweep sets it.
  setting.set = {"let.a== 2 * rand(0)"};
  EXPECT_EQ(load_text(text, setting).world.mass[0], 1 + 2 * 0.5936079187902369);
}

TEST(ExpressionErrors, ASeedThatIsAnExpressionDrawsNothing) {
  EXPECT_EQ(
      in_parts(errors_of(start + "seed: = 3 + 4\nlet: {a: = rand(0)}\n")),
      (Parts{{"4:12 rand", "`rand` draws by the seed, which is an expression", "expected a number after `seed`"}}));
  EXPECT_EQ(marked_errors(start + "seed: -1\nlet: {a: = rand(0)}\n"), (Marked{{"-1", "`seed` is -1"}}));
}

TEST(ExpressionErrors, PointIntoTheExpression) {
  const string start_r = "scene: 1\nsimulate: {duration: 1}\nlet: {r: 0.05}\n";
  EXPECT_EQ(
      in_parts(errors_of(start_r + "balls:\n  red: {mass: \"= 2 * rr\", radius: = r / 0, position: [0, 0, 0]}\n")),
      (Parts{{"5:22 rr", "no number is named `rr`", "did you mean `r`?"},
             {"5:39 /", "division by zero", "expected a divisor other than 0"}}));
  EXPECT_EQ(marked_errors(start_r + "balls: {a: {mass: = -r, radius: '= -r', position: [= r, = q, 0]}}\n"),
            (Marked{{"= -r", "`mass` is -0.05"}, {"'= -r'", "`radius` is -0.05"}, {"q", "no number is named `q`"}}));

  EXPECT_EQ(marked_errors(start_r + "groups:\n  gas:\n    count: = 5 / 2\n    in: {min: [0, 0, 0], max: [1, 1, 1]}\n"
                                    "    ball: {mass: 1, radius: 0.01}\n"),
            (Marked{{"= 5 / 2", "`count` is 2.5"}}));
  EXPECT_EQ(marked_errors(start_r, "simulate.duration== 2 * q"), (Marked{{"q", "no number is named `q`"}}));
  EXPECT_EQ(marked_errors(start_r, "let.q=1"), (Marked{{"q", "`let` has no `q`"}}));
  // A comma ends a plain text in a list.
  EXPECT_NE(errors_of(start_r + "gravity: [= min(r, 1), 0, 0]\n").find("an expression with a comma needs quotes"),
            string::npos);
  // A folded text has no place for each of its characters.
  EXPECT_EQ(marked_errors(start_r + "gravity: [\"= r +\n  q\", 0, 0]\n"), (Marked{{"\"", "no number is named `q`"}}));
}

TEST(ExpressionErrors, OfLet) {
  EXPECT_EQ(marked_errors(start + "let: {a: = b + 1, b: '= 2 * c', c: = a}\n"),
            (Marked{{"a", "`a` depends on itself: a -> b -> c -> a"}}));
  EXPECT_EQ(marked_errors(start + "let: {a: = a}\n"), (Marked{{"a", "`a` depends on itself: a -> a"}}));
  EXPECT_EQ(marked_errors(start + "let: {sin: 1, pi: 3, my-r: 2, 3x: 1}\n"),
            (Marked{{"sin", "`sin` is a function of expressions"},
                    {"pi", "`pi` is a number of expressions"},
                    {"my-r", "`my-r` is not a name for a number"},
                    {"3x", "`3x` is not a name for a number"}}));

  EXPECT_EQ(marked_errors(start + "let: {a: big, b: '3', c: [1], d: , e: = }\n"),
            (Marked{{"big", "`big` is not a number"},
                    {"'3'", "`3` in quotes is text, not a number"},
                    {"[", "`c` is a list"},
                    {"d", "`d` has no value"},
                    {"=", "an empty expression"}}));
  EXPECT_EQ(marked_errors(start + "let: 5\n"), (Marked{{"5", "`let` is `5`"}}));
  // What depends on a wrong number has no error of its own.
  EXPECT_EQ(marked_errors(start + "let: {a: big, b: = a}\nseed: = b\n"), (Marked{{"big", "`big` is not a number"}}));
}

TEST(Expressions, StandInCaptionsByTheirNames) {
  const string scene = start +
                       "let: {r: 0.05, a: = 2 * r}\n"
                       "balls: {row: {repeat: 2, mass: = a, radius: = r, position: [= i, 0, 0]}}\n";
  EXPECT_EQ(errors_of(scene + "caption: \"{let.a} {balls.row.1.mass}\"\n"), "");
  EXPECT_EQ(marked_errors(scene + "caption: \"{let.q}\"\n"), (Marked{{"{let.q}", "`let` has no `q`"}}));
  EXPECT_EQ(marked_errors(scene + "caption: \"{balls.row.mass}\"\n"),
            (Marked{{"{balls.row.mass}", "`row` has no member `mass`"}}));
}

TEST(Expressions, ThatNothingUsesAreAllowed) {
  EXPECT_EQ(errors_of(start + "let: {a: 1, b: = a}\n"), "");
  EXPECT_EQ(errors_of(start + "let: {}\n"), "");
}

TEST(Defaults, AreCancelledByNone) {
  const Scene scene = load_text(start + R"(
defaults: {ball: {mass: 1, radius: 0.1, color: red, restitution: 0.5, velocity: [1, 0, 0]}}
balls:
  a: {mass: none, density: 700, color: none, velocity: none, restitution: none, position: [0, 0, 0]}
  b: {position: [1, 0, 0]}
)");

  EXPECT_NEAR(scene.world.mass[0], 700 * 4.0 / 3 * 3.141592653589793 * 0.001, 1e-14);
  EXPECT_EQ(scene.world.restitution, (vector<double>{1, 0.5}));
  EXPECT_EQ(scene.initial.velocity[0], Vec3(0, 0, 0));
  EXPECT_NE(scene.roster.bodies[0].color, scene.roster.bodies[1].color);
  EXPECT_EQ(load_text(scene.resolved).resolved, scene.resolved);
  EXPECT_EQ(marked_errors(start + "defaults: {ball: {mass: 1}}\nballs: {a: {mass: none, radius: 1, position: none}}\n"),
            (Marked{{"a", "ball `a` has no `mass` and no `density`"}, {"a", "ball `a` has no `position`"}}));
}

TEST(Restitution, MayBeANumber) {
  EXPECT_NE(load_text(start + "restitution: 0.3\n").resolved.find("restitution: {default: 0.3, combine: average}"),
            string::npos);
  LoadOptions options;
  options.set = {"restitution.combine=minimum"};
  EXPECT_NE(load_text(start + "restitution: 0.3\n", options).resolved.find("{default: 0.3, combine: minimum}"),
            string::npos);
  options.set = {"restitution=0.5", "restitution.combine=minimum"};
  EXPECT_NE(load_text(start, options).resolved.find("{default: 0.5, combine: minimum}"), string::npos);
  EXPECT_EQ(marked_errors(start + "restitution: -1\n"), (Marked{{"-1", "`default` is -1"}}));
}

}  // namespace
}  // namespace carom
