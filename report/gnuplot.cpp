#include "report/gnuplot.h"

#include "base/error.h"
#include "report/html.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string_view>

namespace obscura {

namespace {

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using Scratch = std::unique_ptr<std::FILE, CloseFile>;

// A nameless file: unlike a pipe it cannot block either side, and leaves nothing behind.
Scratch scratch(std::string_view content = "") {
    Scratch file(std::tmpfile());
    if (!file || std::fwrite(content.data(), 1, content.size(), file.get()) != content.size())
        throw Error(fmt::format("no temporary file for gnuplot: {}", std::strerror(errno)));
    std::rewind(file.get());
    return file;
}

std::string contentOf(const Scratch& file) {
    std::string content;
    char buffer[65536];
    std::rewind(file.get());
    while (const std::size_t count = std::fread(buffer, 1, sizeof buffer, file.get()))
        content.append(buffer, count);
    return content;
}

// Exit status, or -1 when the program ended by a signal.
int run(const char* const* command, const Scratch& in, const Scratch& out, const Scratch& errors) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, fileno(in.get()), STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, fileno(out.get()), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, fileno(errors.get()), STDERR_FILENO);
    pid_t process = 0;
    const int failure = posix_spawnp(&process, command[0], &actions, nullptr,
                                     const_cast<char* const*>(command), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (failure == ENOENT)
        throw Error(fmt::format("{} is not installed and draws the chart; on Debian: apt-get "
                                "install gnuplot-nox",
                                command[0]));
    if (failure)
        throw Error(fmt::format("{} cannot be started: {}", command[0], std::strerror(failure)));
    int status = 0;
    while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

// Free of meaning within single quotes: gnuplot's markup is escaped, lines are joined.
std::string literal(const std::string& text) {
    constexpr std::string_view markup = "\\{}_^@&~";
    std::string result;
    for (const char c : text) {
        if (markup.find(c) != markup.npos)
            result += '\\';
        if (c == '\'')
            result += '\'';
        result += c == '\n' || c == '\r' ? ' ' : c;
    }
    return result;
}

// What it prints, from `mark` on.
std::string printed(const std::string& script, std::string_view mark) {
    const Scratch in = scratch(script), out = scratch(), errors = scratch();
    const char* const command[] = {"gnuplot", "-d", "-", nullptr}; // -d: no settings of the user's
    const int status = run(command, in, out, errors);
    std::string content = contentOf(out);
    const std::size_t begin = content.find(mark);
    if (status != 0 || begin == content.npos)
        throw Error(fmt::format("gnuplot failed (status {}): {}", status, contentOf(errors)));
    return content.substr(begin);
}

} // namespace

std::string gnuplotSvg(const std::string& script, const std::string& title) {
    std::string svg = printed(script, "<svg");
    constexpr std::string_view itsTitle = "<title>Gnuplot</title>";
    if (const std::size_t at = svg.find(itsTitle); at != svg.npos)
        svg.replace(at, itsTitle.size(), fmt::format("<title>{}</title>", escaped(title)));
    return svg;
}

// Without the time of day, which cairo writes: equal figures are equal files. A PDF has a table of
// places in it, so that the text must keep its length.
std::string gnuplotPdf(const std::string& script) {
    constexpr std::string_view key = "/CreationDate (D:", date = "19800101000000";
    std::string pdf = printed(script, "%PDF");
    if (const std::size_t at = pdf.find(key); at != pdf.npos)
        for (std::size_t i = at + key.size(), n = 0; i < pdf.size() && pdf[i] != ')'; ++i, ++n)
            if (pdf[i] >= '0' && pdf[i] <= '9')
                pdf[i] = n < date.size() ? date[n] : '0';
    return pdf;
}

std::string gnuplotText(const std::string& text) { return fmt::format("'{}'", literal(text)); }

std::string gnuplotBold(const std::string& text) {
    return fmt::format("'{{/:Bold {}}}'", literal(text));
}

} // namespace obscura
