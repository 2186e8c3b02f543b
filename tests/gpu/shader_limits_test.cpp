// What a driver must not see: each text here took Mesa more than 10 s or ended it, or would on some driver.
#include "core/paths.h"
#include "gpu/shader_limits.h"
#include "support/errors.h"
#include "support/temp_folder.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

using namespace bounce;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

namespace {

std::string times(int count, const std::string& text) {
    std::string out;
    for (int i = 0; i < count; ++i)
        out += text;
    return out;
}

/// `count` lines, '%' replaced by 1, 2, … and '@' by the number before.
std::string numbered(int count, const std::string& text) {
    std::string out;
    for (int i = 1; i <= count; ++i)
        for (char c : text)
            out += c == '%' ? std::to_string(i) : c == '@' ? std::to_string(i - 1) : std::string(1, c);
    return out;
}

class Limits : public testing::Test {
  protected:
    ~Limits() override { set_shader_limits({}); }
    /// What is wrong, as the row of the Shaders panel has it: "main.comp:3: … (limit) …"; empty when nothing is.
    std::string problem(const std::string& text) {
        folder.write("main.comp", text);
        ShaderSource source = expand_shader("main.comp", folder.path(), {}, {});
        std::vector<ShaderError> errors = source.errors;
        if (errors.empty()) errors = check_shader_limits(source, folder.path());
        return errors.empty() ? "" : errors.front().text();
    }
    std::string in_main(const std::string& body) { return problem("void main() {\n" + body + "\n}\n"); }
    TempFolder folder;
};

} // namespace

/// What is left open at the end is the driver's to tell; going through it stays within the text (sanitizers hold it to
/// that).
TEST_F(Limits, TextThatEndsAnywhere) {
    const std::string whole =
        "struct S { float a[3]; } s; layout(std430) buffer own_B { S list[]; };\n"
        "float f(int n) { if (n <= 0) return 1.0; for (int i = 0; i < 4; ++i) { n += i; } return f(n - 1); }\n"
        "void main() { do { switch (1) { case 1: f(2); } } while (false); float x[] = float[](1.0); }\n";
    for (size_t length = 0; length <= whole.size(); ++length)
        EXPECT_EQ(problem(whole.substr(0, length)), "") << whole.substr(0, length);
    for (const char* body : {"if (depth <= 0.0> { f(1); }", "for (int i = 0; i < 3 { f(1);", "while (a[1) { f(2);",
                             "do { f(", "f((((", "switch (1 { case 1: f("})
        EXPECT_EQ(in_main(body), "") << body;
}

TEST_F(Limits, ArraysOfAMillionElements) {
    for (const char* declaration : {"float a[1000000];",
                                    "float[1000000] a;",
                                    "float[1000][1000] a;",
                                    "float a[1000][1000];",
                                    "float[1000] a[1000];",
                                    "float b = 1.0, a[1000000];",
                                    "float a[10 * (50000 + 50000)];",
                                    "float a[1 << 20];",
                                    "float a[0x100000];",
                                    "float a[1000000u];",
                                    "vec4 a[250000];",
                                    "mat4 a[62500];",
                                    "const float a[1000000];",
                                    "const int n = 1000 * 1000; float a[n];",
                                    "const int n = 1000; const int m = n * n; float a[m];",
                                    "struct S { float v[1000000]; }; S s;",
                                    "struct S { vec4 v[1000]; }; S s[1000];",
                                    "struct S { vec4 v; } s[1000000];",
                                    "float a = float[1000000](1.0)[0];",
                                    "for (float a[1000000]; false;) {}",
                                    "float a[int(1e6)];",
                                    "float a[true ? 1000000 : 1];",
                                    "float a[3000]; float b[3000];"})
        EXPECT_THAT(in_main(declaration), AllOf(StartsWith("main.comp:2: "), HasSubstr("(private_bytes)")))
            << declaration;
    for (const char* global :
         {"float a[1000000];", "in vec4 a[1000000];", "float[1000000] f() { }", "void f(float a[1000000]) { }",
          "void f(float[1000000]);", "struct S { float v[1000000]; }; S f() { }"})
        EXPECT_THAT(problem(global), AllOf(StartsWith("main.comp:1: "), HasSubstr("(private_bytes)"))) << global;
    EXPECT_THAT(problem("shared float a[1000000];"), HasSubstr("(shared_bytes)"));
    EXPECT_THAT(problem("shared vec4 a[1024];\n\nshared vec4 b[4096];"),
                AllOf(StartsWith("main.comp:3: "), HasSubstr("(shared_bytes)")));
    EXPECT_THAT(problem("uniform float a[1000000];"), HasSubstr("(uniform_bytes)"));
    EXPECT_THAT(problem("uniform sampler2D a_b[1000000];"), HasSubstr("(uniform_bytes)"));
    EXPECT_THAT(problem("uniform B { float a[1000000]; };"), HasSubstr("(uniform_bytes)"));
    EXPECT_THAT(problem("buffer b_c { float a[1000000000]; };"), HasSubstr("(buffer_bytes)"));
    EXPECT_THAT(problem("struct S { float v; };\nbuffer b_c { S a[1000000]; };"), HasSubstr("(interface_names)"));
    EXPECT_THAT(problem("struct S { float v; }; struct T { S s[1000]; }; uniform T t[1000];"),
                HasSubstr("(interface_names)"));
}

TEST_F(Limits, ThroughMacros) {
    EXPECT_THAT(in_main("#define N 1000000\nfloat a[N];"), StartsWith("main.comp:3: "));
    EXPECT_THAT(in_main("#define K 1000\n#define N (K * K)\nfloat a[N];"), StartsWith("main.comp:4: "));
    EXPECT_THAT(in_main("#define MAKE(n) float a[n]\nMAKE(1000 * 1000);"), StartsWith("main.comp:3: "));
    EXPECT_THAT(in_main("#define N(a, b) a ## b\nfloat a[N(1000, 000)];"), StartsWith("main.comp:3: "));
    EXPECT_THAT(in_main("#define N \\\n1000000\nfloat a[/* one */ N];"), StartsWith("main.comp:4: "));
    EXPECT_THAT(problem("uniform int n = 1000000; //! static n\nvoid main() { float a[n]; }"),
                StartsWith("main.comp:2: "));
    EXPECT_EQ(in_main("#define N 1000000\n#undef N\n#define N 4\nfloat a[N];"), "");
    EXPECT_EQ(in_main("#ifdef NEVER\nfloat a[1000000];\n#elif 0\nfloat a[1000000];\n#endif\n// float a[1000000];\n/* "
                      "float a[1000000]; */"),
              "");
    EXPECT_THAT(in_main("#if defined(NEVER) || 2 > 1\nfloat a[1000000];\n#endif"), StartsWith("main.comp:3: "));
}

TEST_F(Limits, LoopsWithConstantBounds) {
    for (const char* loop :
         {"for (int i = 0; i < 1000000000; ++i) x += 1.0;", "for (int i = 0; i <= 2000000; i++) {}",
          "for (int i = 1000000000; i > 0; --i) {}", "for (uint i = 0u; 4000000000u > i; i += 2u) {}",
          "for (float t = 0.0; t < 1e9; t += 0.5) {}",
          "for (int i = 0; i < 10000; i++) for (int j = 0; j < 10000; ++j) {}",
          "for (int i = 0; i < 1000; i++) { y(); for (int j = 0; j < 100; ++j) { for (int k = 0; k < 100; k = k + 1) "
          "{} } }",
          "const int n = 1 << 30; for (int i = 0; i < n; ++i) {}", "int i = 0; while (i < 1000000000) { ++i; }",
          "int i = 0; do { i += 1; } while (i < 1000000000);", "for (int i = 0, n = 3; i != 1000000000; ++i) {}"})
        EXPECT_THAT(in_main(loop), AllOf(StartsWith("main.comp:2: "), HasSubstr("(loop_iterations)"))) << loop;
    for (const char* loop :
         {"for (int i = 0; i < 4096; ++i) for (int j = 0; j < 16; ++j) {}", "for (int i = 0; i < n; ++i) {}",
          "for (int i = n; i < 1000000000; ++i) {}", "for (int i = 1; i < 1000000000; i *= 2) {}",
          "for (int i = 0; i < 1000000000; i += 1000000) {}", "for (;;) { break; }", "while (true) break;",
          "for (int i = 0; i < 1000; ++i) {} for (int i = 0; i < 1000; ++i) {} for (int i = 0; i < 1000; ++i) {}"})
        EXPECT_EQ(in_main(loop), "") << loop;
}

TEST_F(Limits, Nesting) {
    EXPECT_THAT(in_main("float a = " + times(5000, "(") + "1.0" + times(5000, ")") + ";"), HasSubstr("(nesting)"));
    EXPECT_THAT(in_main("float a = " + times(100000, "(")), HasSubstr("(nesting)")) << "not closed";
    EXPECT_THAT(in_main(times(5000, "{") + times(5000, "}")), HasSubstr("(nesting)"));
    EXPECT_THAT(in_main("a" + times(5000, "[0")), HasSubstr("(nesting)"));
    EXPECT_THAT(in_main(times(5000, "if (a) ") + "b;"), HasSubstr("(nesting)"));
    EXPECT_THAT(in_main(times(5000, "for (;;) ") + "b;"), HasSubstr("(nesting)"));
    EXPECT_THAT(in_main(times(5000, "if (a) b; else ") + "c;"), HasSubstr("(nesting)"));
    EXPECT_THAT(problem(times(5000, "#if 1\n") + times(5000, "#endif\n")), HasSubstr("(nesting)"));
    EXPECT_THAT(problem(times(200000, "#ifdef A\n")), HasSubstr("(nesting)"));
    EXPECT_THAT(in_main("#define B ((((((((((\n#define C B B B B B B B B B B\nfloat a = C C C C;"),
                HasSubstr("(nesting)"));
    EXPECT_EQ(in_main("float a = " + times(100, "(") + "1.0" + times(100, ")") + ";"), "");
}

TEST_F(Limits, LongExpressions) {
    EXPECT_THAT(in_main("float a = 1.0" + times(50000, " + 1.0") + ";"),
                AllOf(StartsWith("main.comp:2: "), HasSubstr("(operators)")));
    EXPECT_THAT(in_main("float a = " + times(50000, "-") + "1.0;"), HasSubstr("(operators)"));
    EXPECT_THAT(in_main("float a = " + times(50000, "!") + "b;"), HasSubstr("(operators)"));
    EXPECT_THAT(in_main("float a = b" + times(50000, ".x") + ";"), HasSubstr("(operators)"));
    EXPECT_THAT(in_main("float a = b" + times(50000, "[0]") + ";"), HasSubstr("(operators)"));
    EXPECT_THAT(in_main("a" + times(50000, " = a") + ";"), HasSubstr("(operators)"));
    EXPECT_THAT(in_main("float a = " + times(20000, "b ? c : ") + "d;"), HasSubstr("(operators)"));
    EXPECT_EQ(problem("const float table[4000] = float[](1.0 + 1.0" + times(3999, ", 2.0 * 3.0") + ");"), "")
        << "a long list is no deep tree";
    EXPECT_EQ(in_main(times(5000, "a = a + 1.0;\n")), "");
}

TEST_F(Limits, MacroBombs) {
    EXPECT_THAT(problem("#define A0 x\n" + numbered(60, "#define A% A@ A@\n") + "A60\n"),
                AllOf(StartsWith("main.comp:62: "), HasSubstr("(tokens)")));
    EXPECT_THAT(problem("#define A(x) x x x x x x x x x x\n" + times(30, "A(") + "1" + times(30, ")")),
                HasSubstr("(tokens)"));
    EXPECT_THAT(
        problem("#define A(x, y) x ## y ## x ## y\n#define B(x) A(x, x)\n" + times(30, "B(") + "1" + times(30, ")")),
        HasSubstr("("));
    EXPECT_THAT(problem("#if A\n#endif\n#define A0 1 +\n" + numbered(40, "#define A% A@ A@\n") + "#if A40 1\n#endif\n"),
                HasSubstr("(tokens)"));
    EXPECT_THAT(problem("#define A0 1\n" + numbered(20000, "#define A% A@\n") + "int a = A20000;\n"),
                HasSubstr("(macro_depth)"));
    EXPECT_THAT(problem(times(300000, "a ; ")), HasSubstr("(tokens)"));
    // What expands to itself stops.
    EXPECT_EQ(problem("#define A B B\n#define B A A\nvoid main() { A; }\n"), "");
    EXPECT_EQ(problem("#define f(x) f(x + f(x))\nvoid main() { f(f(f(1))); }\n"), "");
    EXPECT_EQ(problem("#define LONG " + times(20000, "x ") + "\nvoid main() {}\n"), "")
        << "40 kB in a line that nothing uses";
    EXPECT_EQ(problem("#define f(x) x\nint a = f(" + times(1000, "f ") + "1\n"), "")
        << "not closed: for the driver to tell";
}

TEST_F(Limits, FunctionsThatDouble) {
    EXPECT_THAT(problem("float f0() { return 1.0; }\n" + numbered(40, "float f%() { return f@() + f@(); }\n")),
                AllOf(StartsWith("main.comp:"), HasSubstr("(inlined_tokens)")));
    EXPECT_THAT(problem(numbered(40, "float f%();\n") + "float f0();\n" +
                        numbered(40, "float f@() { return f%() + f%(); }\n") + "float f40() { return 1.0; }\n"),
                HasSubstr("(inlined_tokens)"))
        << "from the last to the first";
    EXPECT_EQ(problem(numbered(4, "float f(vec% a) { return f(a.x) + f(a.y); }\n")), "")
        << "overloads are not one function";
    EXPECT_EQ(problem("float g(int n) { return g(n) + g(n); }\n"), "") << "recursion: for the driver to tell";
}

TEST_F(Limits, IncludesBombsCirclesAndLinks) {
    for (int i = 0; i < 300; ++i)
        folder.write(fmt::format("deep{}.glsl", i), fmt::format("#include \"deep{}.glsl\"\n", i + 1));
    folder.write("deep300.glsl", "float a;\n");
    EXPECT_THAT(problem("#include \"deep0.glsl\"\n"), HasSubstr("(include_depth)"));
    folder.write("circle.glsl", "#include \"circle.glsl\"\n#include \"main.comp\"\nfloat a;\n");
    EXPECT_EQ(problem("#include \"circle.glsl\"\nvoid main() {}\n"), "");
    std::filesystem::create_directory_symlink(folder.path(), folder / "loop");
    folder.write("linked.glsl", "#include \"loop/linked.glsl\"\nfloat linked;\n");
    EXPECT_EQ(problem("#include \"linked.glsl\"\nvoid main() {}\n"), "") << "by another name, but the same file";
    folder.write("large.glsl", times(300000, "// a line of text\n"));
    EXPECT_THAT(problem("#include \"large.glsl\"\n"), AllOf(StartsWith("main.comp:1: "), HasSubstr("(text_bytes)")));
}

TEST_F(Limits, ListsOfAHundredThousand) {
    EXPECT_THAT(problem(numbered(100000, "uniform float p% = 1.0; //! p\n")), HasSubstr("more than 500 parameters"));
    EXPECT_THAT(problem(numbered(100000, "uniform sampler2D a_%;\n")), HasSubstr("more than 500 samplers"));
    folder.write("main.comp", numbered(100000, "#include \"none%.glsl\"\n"));
    EXPECT_LT(expand_shader("main.comp", folder.path(), {}, {}).errors.size(), 100u);
}

TEST_F(Limits, AreParameters) {
    EXPECT_NE(in_main("float a[5000];"), "");
    set_shader_limit("private_bytes=100000");
    EXPECT_EQ(in_main("float a[5000];"), "");
    EXPECT_THAT(in_main("float a[30000];"), HasSubstr("at most 100000 (private_bytes)"));
    EXPECT_THAT(error_of([] { set_shader_limit("privat_bytes=1"); }), HasSubstr("did you mean 'private_bytes'?"));
    for (const char* bad :
         {"nesting", "nesting=", "nesting=0", "nesting=-1", "nesting=1x", "nesting=99999999999999999999"})
        EXPECT_THAT(error_of([&] { set_shader_limit(bad); }), HasSubstr("expected nesting=N")) << bad;
}

/// The shaders of the program need at most a quarter of each limit on what a driver sees.
TEST_F(Limits, LeaveTheProgramsOwnShadersRoom) {
    ShaderLimits quarter;
    for (auto limit : {&ShaderLimits::tokens, &ShaderLimits::nesting, &ShaderLimits::operators,
                       &ShaderLimits::inlined_tokens, &ShaderLimits::loop_iterations, &ShaderLimits::private_bytes,
                       &ShaderLimits::shared_bytes, &ShaderLimits::uniform_bytes, &ShaderLimits::interface_names})
        quarter.*limit /= 4;
    set_shader_limits(quarter);
    int stages = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(glsl_folder())) {
        std::string extension = entry.path().extension().string();
        if (!entry.is_regular_file() || extension == ".glsl") continue;
        ShaderSource source = expand_shader(entry.path().lexically_relative(glsl_folder()), glsl_folder(), {}, {});
        EXPECT_THAT(source.errors, IsEmpty()) << entry.path();
        for (const ShaderError& error : check_shader_limits(source, glsl_folder()))
            ADD_FAILURE() << error.text();
        ++stages;
    }
    EXPECT_GT(stages, 50);
}
