#include "gl/program.h"

#include "base/error.h"
#include "base/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <regex>
#include <sstream>

namespace obscura::gl {

ShaderText::ShaderText() { add("#version 450 core\n", "(version)"); }

void ShaderText::add(const std::string& part, const std::string& file, int fileLine) {
    parts_.push_back({lines_ + 1, fileLine, file});
    text_ += part;
    if (!part.empty() && part.back() != '\n')
        text_ += '\n';
    lines_ = static_cast<int>(std::count(text_.begin(), text_.end(), '\n'));
}

void ShaderText::addFile(const std::filesystem::path& folder, const std::string& name) {
    if (!included_.insert(name).second)
        return;
    const std::string path = (folder / name).string();
    static const std::regex include(R"re(#include "([^"]+)")re");
    std::istringstream lines(readFile(path));
    std::string line, pending;
    int number = 0, pendingFrom = 1;
    std::smatch match;
    while (std::getline(lines, line)) {
        ++number;
        if (!std::regex_match(line, match, include)) {
            pending += line + "\n";
            continue;
        }
        add(pending, path, pendingFrom);
        addFile(folder, match[1].str());
        pending.clear();
        pendingFrom = number + 1;
    }
    add(pending, path, pendingFrom);
}

std::string ShaderText::inOriginalFiles(const std::string& log) const {
    // Mesa writes "0:12(3): error", NVIDIA "0(12) : error": file 0, then the assembled line.
    static const std::regex pattern(R"(\b0[:(](\d+)[)(:]?(\d*\)?)?)");
    std::string result;
    auto rest = log.cbegin();
    std::smatch match;
    while (std::regex_search(rest, log.cend(), match, pattern)) {
        const int line = std::stoi(match[1].str());
        const auto after =
            std::upper_bound(parts_.begin(), parts_.end(), line,
                             [](int value, const Part& part) { return value < part.firstLine; });
        const Part& part = *(after == parts_.begin() ? after : after - 1);
        result.append(rest, match[0].first);
        result += fmt::format("{}:{}", part.file, line - part.firstLine + part.fileLine);
        rest = match[0].second;
    }
    return result.append(rest, log.cend());
}

namespace {

ShaderObject compile(GLenum stage, const ShaderText& text, const std::string& label) {
    ShaderObject shader(stage);
    const char* source = text.text().c_str();
    glShaderSource(shader.name(), 1, &source, nullptr);
    glCompileShader(shader.name());
    GLint compiled = GL_FALSE, length = 0;
    glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &compiled);
    if (compiled)
        return shader;
    glGetShaderiv(shader.name(), GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
    glGetShaderInfoLog(shader.name(), length, nullptr, log.data());
    log.resize(log.find_last_not_of(std::string_view("\0\n", 2)) + 1);
    throw Error(
        fmt::format("shader \"{}\" does not compile:\n{}", label, text.inOriginalFiles(log)));
}

} // namespace

Program::Program(const std::string& label, const ShaderText& vertex, const ShaderText& fragment)
    : label_(label), program_(GL_NONE) {
    const ShaderObject vertexShader = compile(GL_VERTEX_SHADER, vertex, label);
    const ShaderObject fragmentShader = compile(GL_FRAGMENT_SHADER, fragment, label);
    glAttachShader(program_.name(), vertexShader.name());
    glAttachShader(program_.name(), fragmentShader.name());
    link();
}

Program::Program(const std::string& label, const ShaderText& compute)
    : label_(label), program_(GL_NONE) {
    const ShaderObject shader = compile(GL_COMPUTE_SHADER, compute, label);
    glAttachShader(program_.name(), shader.name());
    link();
}

void Program::link() {
    glLinkProgram(program_.name());
    glObjectLabel(GL_PROGRAM, program_.name(), -1, label_.c_str());
    GLint linked = GL_FALSE;
    glGetProgramiv(program_.name(), GL_LINK_STATUS, &linked);
    if (!linked) {
        char log[4096] = {};
        glGetProgramInfoLog(program_.name(), sizeof log, nullptr, log);
        throw Error(fmt::format("shader \"{}\" does not link: {}", label_, log));
    }
}

void Program::use() const { glUseProgram(program_.name()); }

int Program::location(const char* uniform) const {
    const int result = glGetUniformLocation(program_.name(), uniform);
    assert(result >= 0 && "no such uniform");
    return result;
}

void Program::set(const char* uniform, int value) const {
    glProgramUniform1i(program_.name(), location(uniform), value);
}
void Program::set(const char* uniform, float value) const {
    glProgramUniform1f(program_.name(), location(uniform), value);
}
void Program::set(const char* uniform, std::span<const float, 3> value) const {
    glProgramUniform3fv(program_.name(), location(uniform), 1, value.data());
}
void Program::set(const char* uniform, std::span<const float, 4> value) const {
    glProgramUniform4fv(program_.name(), location(uniform), 1, value.data());
}
void Program::setMatrix(const char* uniform, std::span<const float, 16> columns) const {
    glProgramUniformMatrix4fv(program_.name(), location(uniform), 1, GL_FALSE, columns.data());
}

} // namespace obscura::gl
