// SPDX-License-Identifier: MIT
#include "tests/driver/rewritten_shaders.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <stdexcept>
#include <vector>

namespace afterglow::test {

RewrittenShaders* RewrittenShaders::active = nullptr;

RewrittenShaders::RewrittenShaders(Rewrite rewrite)
    : rewrite_(std::move(rewrite)), source_(glad_glShaderSource, source) {
    active = this;
}

RewrittenShaders::~RewrittenShaders() {
    active = nullptr;
}

void RewrittenShaders::source(GLuint shader, GLsizei, const GLchar* const* texts, const GLint*) {
    std::array<char, 256> name{};
    glGetObjectLabel(GL_SHADER, shader, GLsizei(name.size()), nullptr, name.data());
    const std::string text = active->rewrite_(name.data(), texts[0]);
    active->changed_ += text != texts[0];
    const char* bytes = text.c_str();
    active->source_.before()(shader, 1, &bytes, nullptr);
}

std::string replaced(std::string text, std::string_view from, std::string_view to) {
    std::size_t at = text.find(from);
    if (at == std::string::npos)
        throw std::logic_error("the shader has no '" + std::string(from) + "'");
    for (; at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
    return text;
}

namespace {

/// Puts code before all other: after the #version line.
std::string prepended(std::string text, std::string_view code) {
    text.insert(text.find('\n', text.find("#version")) + 1, code);
    return text;
}

} // namespace

std::string withReversedGroups(std::string text) {
    bool uses = false;
    for (const auto& [from, to] :
         {std::pair{"gl_GlobalInvocationID",
                    "(reversedGroup() * gl_WorkGroupSize + gl_LocalInvocationID)"},
          {"gl_WorkGroupID", "reversedGroup()"}})
        if (text.find(from) != std::string::npos) {
            text = replaced(std::move(text), from, to);
            uses = true;
        }
    return uses ? prepended(std::move(text),
                            "uvec3 reversedGroup() {\n"
                            "    return gl_NumWorkGroups - 1u - gl_WorkGroupID;\n}\n")
                : text;
}

namespace {

// The product, and where it is not exact one of its two neighbors or itself, by how many products
// there were before it. Integers, and matrices times vectors as sums of products.
constexpr std::string_view kRough = R"(
uint roughCount = 0u;
float rough(float a, float b) {
    float product = a * b;
    roughCount = roughCount * 1664525u + 1013904223u;
    bool isExact = double(product) == double(a) * double(b) || isinf(product) || isnan(product);
    int way = isExact ? 0 : int(roughCount >> 16) % 3 - 1;
    return uintBitsToFloat(uint(int(floatBitsToUint(product)) + way));
}
int rough(int a, int b) { return a * b; }
uint rough(uint a, uint b) { return a * b; }
ivec2 rough(ivec2 a, ivec2 b) { return a * b; }
ivec2 rough(ivec2 a, int b) { return a * b; }
ivec2 rough(int a, ivec2 b) { return a * b; }
uvec2 rough(uvec2 a, uint b) { return a * b; }
uvec3 rough(uvec3 a, uvec3 b) { return a * b; }
vec2 rough(vec2 a, vec2 b) { return vec2(rough(a.x, b.x), rough(a.y, b.y)); }
vec3 rough(vec3 a, vec3 b) { return vec3(rough(a.xy, b.xy), rough(a.z, b.z)); }
vec4 rough(vec4 a, vec4 b) { return vec4(rough(a.xyz, b.xyz), rough(a.w, b.w)); }
vec2 rough(vec2 a, float b) { return rough(a, vec2(b)); }
vec3 rough(vec3 a, float b) { return rough(a, vec3(b)); }
vec4 rough(vec4 a, float b) { return rough(a, vec4(b)); }
vec2 rough(float a, vec2 b) { return rough(vec2(a), b); }
vec3 rough(float a, vec3 b) { return rough(vec3(a), b); }
vec4 rough(float a, vec4 b) { return rough(vec4(a), b); }
vec3 rough(mat3 m, vec3 v) { return rough(m[0], v.x) + rough(m[1], v.y) + rough(m[2], v.z); }
vec4 rough(mat4 m, vec4 v) {
    return rough(m[0], v.x) + rough(m[1], v.y) + rough(m[2], v.z) + rough(m[3], v.w);
}
float roughDot(vec2 a, vec2 b) { vec2 p = rough(a, b); return p.x + p.y; }
float roughDot(vec3 a, vec3 b) { vec3 p = rough(a, b); return p.x + p.y + p.z; }
float roughDot(vec4 a, vec4 b) { vec4 p = rough(a, b); return p.x + p.y + p.z + p.w; }
vec3 roughCross(vec3 a, vec3 b) { return rough(a.yzx, b.zxy) - rough(a.zxy, b.yzx); }
)";

bool isWord(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.';
}

/// Words, numbers with their points and exponents, and other characters one by one, but "*=" and
/// the like together. Comments and white space stay with the token before them.
struct Token {
    std::string text, space;
};

std::vector<Token> tokensOf(std::string_view code) {
    std::vector<Token> tokens(1);
    std::size_t at = 0;
    const auto skipSpace = [&] {
        const std::size_t begin = at;
        while (at < code.size())
            if (std::isspace(static_cast<unsigned char>(code[at])))
                ++at;
            else if (code.substr(at, 2) == "//")
                at = std::min(code.find('\n', at), code.size());
            else
                break;
        return std::string(code.substr(begin, at - begin));
    };
    tokens.front().space = skipSpace();
    while (at < code.size()) {
        const std::size_t begin = at;
        if (isWord(code[at]) && code[at] != '.') {
            const bool isNumber = std::isdigit(static_cast<unsigned char>(code[at]));
            while (at < code.size() && ((isWord(code[at]) && (isNumber || code[at] != '.')) ||
                                        (isNumber && (code[at] == '-' || code[at] == '+') &&
                                         code[at - 1] == 'e' && code.substr(begin, 2) != "0x")))
                ++at;
        } else {
            const bool isPair =
                at + 1 < code.size() && code[at + 1] == '=' &&
                std::string_view("*/+-%<>=!&|^").find(code[at]) != std::string_view::npos;
            at += isPair ? 2 : 1;
        }
        Token token{std::string(code.substr(begin, at - begin)), ""};
        token.space = skipSpace();
        tokens.push_back(std::move(token));
    }
    return tokens;
}

class RoughProducts {
public:
    explicit RoughProducts(std::vector<Token> tokens) : tokens_(std::move(tokens)) {}

    /// Statements up to the end, each with its products replaced, or as it is.
    std::string all() {
        std::string out;
        while (next_ < tokens_.size()) {
            const std::string& first = tokens_[next_].text;
            const bool isFixed = first == "const" || first == "precise" || first == "layout" ||
                                 first == "shared" || first == "struct";
            out += isFixed ? untouched() : sequence();
            if (next_ < tokens_.size())
                out += take(); // what ends a statement, or a bracket that nobody opened
        }
        return out;
    }

private:
    bool has(std::string_view text) const {
        return next_ < tokens_.size() && tokens_[next_].text == text;
    }
    std::string take() {
        const Token& token = tokens_[next_++];
        return token.text + token.space;
    }
    std::string untouched() {
        std::string out;
        while (next_ < tokens_.size() && !has(";"))
            out += take();
        return out;
    }
    static bool endsSequence(const std::string& text) {
        return text == ";" || text == "{" || text == "}" || text == ")" || text == "]";
    }
    /// Up to the end of a statement, or to the bracket that closes.
    std::string sequence() {
        std::string out;
        while (next_ < tokens_.size() && !endsSequence(tokens_[next_].text))
            out += startsOperand() && !has("return") ? chain() : take();
        return out;
    }
    bool startsOperand() const {
        const std::string& text = tokens_[next_].text;
        return !text.empty() && (isWord(text[0]) || text[0] == '(');
    }
    /// A word, a number or something in parentheses, with calls, indices and members behind it.
    std::string operand() {
        std::string out;
        if (has("dot") || has("cross")) {
            Token& name = tokens_[next_];
            out += (name.text == "dot" ? "roughDot" : "roughCross") + name.space;
            ++next_;
        } else if (!has("(")) {
            out += take();
        }
        while (next_ < tokens_.size())
            if (has("(") || has("[")) {
                out += take();
                out += sequence();
                while (has(";")) // in the head of a loop
                    out += take() + sequence();
                out += take();
            } else if (has(".")) {
                out += take();
                out += take();
            } else {
                break;
            }
        return out;
    }
    /// a * b / c: from the left, products as calls.
    std::string chain() {
        std::string out = operand();
        while (has("*") || has("/") || has("%")) {
            const bool isProduct = has("*");
            const std::string mark = take();
            std::string sign;
            while (has("-") || has("+"))
                sign += take();
            const std::string right = sign + operand();
            out = isProduct ? "rough(" + out + ", " + right + ")" : out + mark + right;
        }
        return out;
    }

    std::vector<Token> tokens_;
    std::size_t next_ = 0;
};

} // namespace

std::string withRoughProducts(std::string text) {
    // Lines for the preprocessor are no statements.
    std::string out, code;
    const auto flush = [&] {
        out += RoughProducts(tokensOf(code)).all();
        code.clear();
    };
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
        const std::string line = text.substr(at, end - at);
        if (line.starts_with('#')) {
            flush();
            out += line;
        } else {
            code += line;
        }
        at = end;
    }
    flush();
    return prepended(std::move(out), kRough);
}

} // namespace afterglow::test
