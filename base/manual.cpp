#include "base/manual.h"

#include "base/version.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <sstream>

namespace obscura {

namespace {

// As text that man shows as it is: a hyphen stays the one that people type, and no line is a
// request to man.
std::string plain(const std::string& text) {
    std::string escaped;
    for (const char c : text) {
        if ((c == '.' || c == '\'') && (escaped.empty() || escaped.back() == '\n'))
            escaped += "\\&";
        escaped += c == '\\' ? "\\e" : c == '-' ? "\\-" : std::string(1, c);
    }
    return escaped;
}

std::string bold(const std::string& text) { return "\\fB" + plain(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + plain(text) + "\\fR"; }

// Text whose lines begin anew, and whose empty lines part paragraphs.
std::string paragraphs(const std::string& text) {
    std::string lines;
    std::istringstream all(text);
    for (std::string line; std::getline(all, line);) {
        const bool begins = lines.empty() || lines.ends_with(".PP\n");
        lines += line.empty() ? ".PP\n" : (begins ? "" : ".br\n") + plain(line) + "\n";
    }
    return lines;
}

std::string sentence(std::string text) {
    if (text.empty())
        return text;
    text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
    return text + (std::string_view(".!?:").find(text.back()) == std::string_view::npos ? "." : "");
}

// "low,moderate,high" or "1 - 64" of "TEXT:{low,moderate,high}" and "INT:INT in [1 - 64]": what
// CLI11 says of the values that an option accepts, between two signs; "" where it says nothing.
std::string within(const std::string& type, const std::string& begin, char end) {
    const std::size_t at = type.find(begin);
    return at == type.npos ? ""
                           : type.substr(at + begin.size(), type.find(end, at) - at - begin.size());
}

// A declaration's own words for its value, "DIR=report", without blanks alone.
std::string ownText(const CLI::Option& option) {
    const std::string& text = option.get_option_text();
    return text == " " ? "" : text;
}

std::string placeholder(const CLI::Option& option) {
    const std::string type = option.get_type_name(), own = ownText(option);
    std::string words = within(type, "{", '}');
    std::replace(words.begin(), words.end(), ',', '|');
    std::string text = !own.empty()     ? italic(own.substr(0, own.find('=')))
                       : !words.empty() ? plain(words)
                                        : italic(type.substr(0, type.find(':')));
    if (option.get_items_expected_max() > 1)
        text += " ...";
    return option.get_items_expected_min() == 0 ? "[" + text + "]" : text;
}

std::string names(const std::set<CLI::Option*>& options) {
    std::set<std::string> sorted;
    for (const CLI::Option* option : options)
        sorted.insert(bold(option->get_name()));
    return fmt::format("{}", fmt::join(sorted, ", "));
}

// What is not in an option's help but in its declaration.
std::string conditions(const CLI::Option& option) {
    const std::string own = ownText(option);
    const std::size_t equals = own.find('=');
    std::string range = within(option.get_type_name(), " in [", ']');
    const std::string standard =
        equals == own.npos ? option.get_default_str() : own.substr(equals + 1);
    std::string said;
    if (option.get_required())
        said += " Required.";
    if (const std::size_t dash = range.find(" - "); dash != range.npos)
        said += " From " + plain(range.replace(dash, 3, " to ")) + ".";
    if (!standard.empty())
        said += " Default: " + plain(standard) + ".";
    if (!option.get_needs().empty())
        said += " Only with " + names(option.get_needs()) + ".";
    if (!option.get_excludes().empty())
        said += " Not with " + names(option.get_excludes()) + ".";
    return said;
}

std::string entryOf(const CLI::Option& option) {
    const bool positional = !option.nonpositional();
    std::string head = positional ? italic(option.get_name(true)) : "";
    if (!positional)
        for (const std::string& name : CLI::detail::split(option.get_name(false, true), ','))
            head += (head.empty() ? "" : ", ") + bold(name);
    if (!positional && option.get_items_expected_max() > 0)
        head += " " + placeholder(option);
    const std::string said = plain(sentence(option.get_description())) + conditions(option);
    return fmt::format(".TP\n{}\n{}\n", head, said.empty() ? "\\&" : said);
}

std::vector<const CLI::Option*> shown(const CLI::App& app) {
    return app.get_options([](const CLI::Option* option) { return !option->get_group().empty(); });
}

std::string entriesOf(const CLI::App& app) {
    std::string entries;
    for (const bool positional : {true, false})
        for (const CLI::Option* option : shown(app))
            if (option->nonpositional() != positional)
                entries += entryOf(*option);
    return entries;
}

// "obscura-bench sweep [OPTIONS] study"
std::string usageOf(const CLI::App& app, const std::string& name) {
    std::string usage = fmt::format("{} [{}]", bold(name), italic("OPTIONS"));
    for (const CLI::Option* option : shown(app))
        if (!option->nonpositional()) {
            const std::string text = italic(option->get_name(true)) +
                                     (option->get_items_expected_max() > 1 ? " ..." : "");
            usage += " " + (option->get_required() ? text : "[" + text + "]");
        }
    return usage + "\n";
}

} // namespace

std::string manualOf(const CLI::App& app, const std::string& about) {
    const std::string name = app.get_name();
    std::string upper = name;
    std::transform(upper.begin(), upper.end(), upper.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    std::string synopsis, commands;
    if (app.get_require_subcommand_min() == 0)
        synopsis += usageOf(app, name);
    for (const CLI::App* command : app.get_subcommands({})) {
        const std::string whole = name + " " + command->get_name();
        synopsis += (synopsis.empty() ? "" : ".br\n") + usageOf(*command, whole);
        commands +=
            fmt::format(".SS {}\n{}{}", plain(whole),
                        paragraphs(sentence(command->get_description())), entriesOf(*command));
    }
    std::string page = fmt::format(".TH {} 1 \"\" \"Obscura {}\" \"Obscura\"\n", plain(upper),
                                   plain(std::string(version())));
    page += fmt::format(".SH NAME\n{} \\- {}\n", plain(name), plain(about));
    page += fmt::format(".SH SYNOPSIS\n{}", synopsis);
    page += fmt::format(".SH DESCRIPTION\n{}", paragraphs(sentence(app.get_description())));
    page += fmt::format(".SH OPTIONS\n{}", entriesOf(app));
    if (!commands.empty())
        page += fmt::format(".SH COMMANDS\n{}", commands);
    if (!app.get_footer().empty())
        page += fmt::format(".SH NOTES\n{}", paragraphs(app.get_footer()));
    if (name != "obscura")
        page += ".SH SEE ALSO\n" + bold("obscura") + "(1)\n";
    return page;
}

} // namespace obscura
