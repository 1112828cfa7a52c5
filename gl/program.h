#pragma once

#include "gl/object.h"

#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace obscura::gl {

// Shader text put together from files and generated parts. Remembers which assembled line came
// from where, because drivers report assembled lines only.
class ShaderText {
  public:
    ShaderText(); // begins with the version line

    // `file` is what errors name: a path, or "(generated settings)".
    void add(const std::string& part, const std::string& file, int fileLine = 1);
    // The file `name` of the shader folder. Its lines `#include "other.glsl"` are replaced by those
    // files, each once.
    void addFile(const std::filesystem::path& folder, const std::string& name);

    const std::string& text() const { return text_; }
    // The driver's log with its line numbers turned into files and lines.
    std::string inOriginalFiles(const std::string& log) const;

  private:
    struct Part {
        int firstLine; // in the assembled text
        int fileLine;  // that it stands at in its file
        std::string file;
    };
    std::string text_;
    int lines_ = 0;
    std::vector<Part> parts_;
    std::set<std::string> included_;
};

// A linked program of a vertex and a fragment shader, or of a compute shader. A shader that does
// not compile is an Error with the file and line of each complaint.
class Program {
  public:
    Program(const std::string& label, const ShaderText& vertex, const ShaderText& fragment);
    Program(const std::string& label, const ShaderText& compute);

    void use() const;
    // Sets a uniform of this program; a name it does not have is an assertion.
    void set(const char* uniform, int value) const;
    void set(const char* uniform, float value) const;
    void set(const char* uniform, std::span<const float, 3> value) const;
    void set(const char* uniform, std::span<const float, 4> value) const;
    void setMatrix(const char* uniform, std::span<const float, 16> columns) const;

  private:
    void link();
    int location(const char* uniform) const;

    std::string label_;
    ProgramObject program_;
};

} // namespace obscura::gl
