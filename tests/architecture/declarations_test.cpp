// cpp_declarations.h on small texts and on every file of the program.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "architecture/cpp_declarations.h"
#include "architecture/cpp_tokens.h"
#include "architecture/source_tree.h"

namespace carom::testing {
namespace {

std::string words_of(const std::string& text) {
  std::string words;
  for (const Token& token : tokens_of(text)) {
    words += (words.empty() ? "" : " ") + token.text;
  }
  return words;
}

/// "class::function" in the order of the text.
std::vector<std::string> functions_of(const std::string& text) {
  std::vector<std::string> names;
  for (const FunctionDefinition& function : declarations_of(text).functions) {
    names.push_back(function.class_name.empty() ? function.name : function.class_name + "::" + function.name);
  }
  return names;
}

std::size_t lines_of(const std::string& text) {
  const Declarations found = declarations_of(text);
  return found.functions.size() == 1 ? found.functions.front().lines : 0;
}

/// The number of data members of a class with this body.
std::size_t members_of(const std::string& members) {
  const Declarations found = declarations_of("class C {\n" + members + "\n};");
  return found.matched && !found.types.empty() ? found.types.back().data_members : 99;
}

using Names = std::vector<std::string>;

TEST(Tokens, HaveNoCommentsAndNoDirectives) {
  EXPECT_EQ(words_of("a // {\nb /* { \n } */ c"), "a b c");
  EXPECT_EQ(words_of("#define X { \\\n  {\na\n  #if 0\nb\n#endif"), "a b");
  EXPECT_EQ(words_of("a # b"), "a # b");
}

TEST(Tokens, HaveNothingOfWhatStringsHold) {
  EXPECT_EQ(words_of(R"x(f("{ // \" }", '{', '\'', L"{", u8"\\"))x"), R"(f ( "" , '' , '' , "" , "" ))");
  EXPECT_EQ(words_of("R\"({ \" } \\)\" u8R\"ab(})\" )ab\" ;"), "\"\" \"\" ;");
  EXPECT_EQ(words_of("R + \"}\""), "R + \"\"");
}

TEST(Tokens, KeepNumbersWhole) {
  EXPECT_EQ(words_of("1'000'000 + 0x1p-3-1e+5 - .5f"), "1'000'000 + 0x1p-3 - 1e+5 - .5f");
  EXPECT_EQ(words_of("x.e-1"), "x . e - 1");
}

TEST(Tokens, HaveTheirLines) {
  const std::vector<Token> tokens = tokens_of("a\n/*\n*/ b R\"(\n\n)\" c\n#x \\\n\nd");
  ASSERT_EQ(tokens.size(), 5u);
  EXPECT_EQ(tokens[1].line, 3u);
  EXPECT_EQ(tokens[2].line, 3u);
  EXPECT_EQ(tokens[3].line, 5u);
  EXPECT_EQ(tokens[4].line, 8u);
}

TEST(Declarations, FunctionsAreThoseWithABody) {
  EXPECT_EQ(functions_of("int f(); int f() { return g(); } int x = g(); int y{1}; auto z = [] { return 1; };"),
            Names{"f"});
  EXPECT_EQ(functions_of("std::map<int, std::vector<int>> C::f(int (*g)(int), char c = '(') const noexcept {}"),
            Names{"C::f"});
  EXPECT_EQ(functions_of("template <typename T>\nauto A<T>::B::f() -> std::pair<T, T> { if (a) {} }"),
            Names{"A::B::f"});
  EXPECT_EQ(functions_of("namespace a::b { namespace { void f() {} } void g() {} } extern \"C\" { void h() {} }"),
            (Names{"f", "g", "h"}));
  EXPECT_EQ(functions_of("std::string (f)();"), Names{});
}

TEST(Declarations, FunctionsOfAClassAreItsOwn) {
  EXPECT_EQ(functions_of("class C : public B<int> { public: C() : a_(1), b_{2} {} ~C() { f(); } int f() const { return "
                         "1; } C(C&&) = default; virtual int g() = 0; struct D { void h() {} }; };"),
            (Names{"C::C", "C::~C", "C::f", "C::D::h"}));
  EXPECT_EQ(functions_of("struct C { bool operator()(int) const { return 1; } bool operator<(C) { return 0; } operator "
                         "bool() const { return 1; } C& operator=(C) { return *this; } };"),
            (Names{"C::operator()", "C::operator<", "C::operatorbool", "C::operator="}));
  EXPECT_EQ(functions_of("C::C(int a) : B<int>(a), b_{1, 2} { f(); } C::~C() {} bool C::operator()(int) {}"),
            (Names{"C::C", "C::~C", "C::operator()"}));
}

TEST(Declarations, AFunctionOfARequirementIsFound) {
  EXPECT_EQ(functions_of("template <typename T>\nrequires(is_a<T> || is_b<T>) void f(T) {}"), Names{"f"});
  EXPECT_EQ(functions_of("template <typename T>\nrequires std::integral<T> && B<T>\nvoid f(T) {}"), Names{"f"});
}

TEST(Declarations, AFunctionBeginsWithItsFirstWordAndEndsWithItsBrace) {
  EXPECT_EQ(lines_of("// of f\nint f() { return 1; }\n"), 1u);
  EXPECT_EQ(lines_of("int f(int a,\n      int b) {\n  if (a) {\n  }\n  return \"}\";  // }\n}\n\nint x;\n"), 6u);
  EXPECT_EQ(lines_of("template <typename T>\n[[nodiscard]] static T f() {\n}\n"), 3u);
  EXPECT_EQ(lines_of("CAROM_END_TARGET\n\nvoid f() {\n}\n"), 2u);
  EXPECT_EQ(lines_of("C::C()\n  : a(1),\n  b{[] { return 1; }()} {\n}\n"), 4u);
}

TEST(Declarations, DataMembersAreCountedOneByOne) {
  EXPECT_EQ(members_of(""), 0u);
  EXPECT_EQ(members_of("int a; int b, c = 1; double d{2}, e[3] = {1, 2, 3};"), 5u);
  EXPECT_EQ(members_of("std::map<int, std::pair<int, int>> a; std::function<void(int, int)> b; int* c; const D& d;"),
            4u);
  EXPECT_EQ(members_of("std::pair<int, int> a = std::pair<int, int>(), b; bool c = x < y, d = z > 1;"), 4u);
  EXPECT_EQ(members_of("void (*f)(int, int) = nullptr; unsigned a : 3, b : 4; mutable int c; alignas(64) int d;"), 5u);
  EXPECT_EQ(members_of("struct { int a, b; }; union { int c; double d; };"), 4u);
  EXPECT_EQ(members_of("struct D { int a, b; } d; enum E { f, g } e; struct stat s;"), 3u);
  EXPECT_EQ(members_of("static int a; static inline std::string b = \"x\";"), 2u);
}

TEST(Declarations, WhatIsNoDataMemberIsNotCounted) {
  EXPECT_EQ(members_of("static constexpr int a = 1, b = 2; static const std::string c;"), 0u);
  EXPECT_EQ(members_of("int f(int a, int b); int g() { int x; int y; return x; } C(); ~C(); C& operator=(C);"), 0u);
  EXPECT_EQ(members_of("using A = int; typedef int B; struct D; friend class E; enum class F { a, b };"), 0u);
  EXPECT_EQ(members_of("public: struct D { int a; }; template <typename T> void f(T t = T{}); static_assert(1 < 2);"),
            0u);
}

TEST(Declarations, TypesAreThoseDefined) {
  const Declarations found = declarations_of(
      "namespace a { class X; struct X final : Y<1> { struct In { int i; }; using T = int; }; namespace { enum class E "
      "{ "
      "p }; } "
      "using Z = std::map<int, E>; using std::move; using namespace b; typedef void (*F)(int); "
      "template <typename T> class V {}; template <> struct std::hash<X> {}; struct X::Impl { int i; }; "
      "template <typename T> requires(C<T>) struct W {}; namespace fs = std::filesystem; }");
  EXPECT_TRUE(found.matched);
  std::string all;
  for (const TypeDefinition& type : found.types) {
    all += type.scope + " " + type.name + (type.nested ? " nested" : "") + (type.is_template ? " template" : "") +
           (type.is_specialization ? " specialization" : "") + "\n";
  }
  EXPECT_EQ(all,
            "a X::In nested\na X::T nested\na X\na::(anonymous) E\na Z\na F\na V template\n"
            "a std::hash nested specialization\na X::Impl nested\na W template\n");
}

TEST(Declarations, UnclosedBracketsAreReported) {
  for (const char* text : {"void f() {", "class C { int a;", "void f( {}", "int a[3 = {1};", "}", "namespace a {",
                           "template <typename T void f() {}"}) {
    EXPECT_FALSE(declarations_of(text).matched) << text;
  }
}

TEST(Declarations, EveryFileOfTheProgramIsReadToItsEnd) {
  std::size_t types = 0, functions = 0;
  for (const SourceFile& file : program_files()) {
    const Declarations found = declarations_of(file.text);
    EXPECT_TRUE(found.matched) << file.path;
    types += found.types.size();
    functions += found.functions.size();
  }
  EXPECT_GT(types, 400u);
  EXPECT_GT(functions, 2000u);
}

}  // namespace
}  // namespace carom::testing
