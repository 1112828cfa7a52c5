#include "base/argument_table.h"

#include "base/csv.h"
#include "base/error.h"
#include "base/files.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace obscura {

namespace fs = std::filesystem;

namespace {

const std::vector<std::string> columns{"kind", "command", "name", "values", "takes", "about"};
constexpr std::array<const char*, 4> kinds{"program", "command", "option", "positional"};

std::string lineOf(const Argument& argument) {
    return fmt::format("{},{},{},{},{},{}\n", kinds[static_cast<std::size_t>(argument.kind)],
                       csvCell(argument.command), csvCell(argument.name), argument.values,
                       csvCell(argument.takes), csvCell(argument.about));
}

Argument argumentOf(const CLI::Option& option, const std::string& command) {
    const bool positional = !option.nonpositional();
    return {positional ? Argument::Kind::positional : Argument::Kind::option,
            command,
            positional                     ? option.get_name(true)
            : !option.get_lnames().empty() ? "--" + option.get_lnames().front()
                                           : "-" + option.get_snames().front(),
            option.get_items_expected_max(),
            takenBy(option),
            option.get_description()};
}

std::string linesOf(const CLI::App& app, const std::string& command) {
    std::string lines;
    for (const CLI::Option* option : app.get_options())
        if (!option->get_group().empty())
            lines += lineOf(argumentOf(*option, command));
    return lines;
}

Argument argumentOf(const CsvRecord& record, const std::string& file) {
    const Place place{file, record.line, 0, {}};
    if (const std::string fault = faultOf(record, columns.size()); !fault.empty())
        throw Error(place, fault);
    const auto& cells = record.cells;
    const auto kind = std::find(kinds.begin(), kinds.end(), cells[0]);
    Argument argument{static_cast<Argument::Kind>(kind - kinds.begin()),
                      cells[1],
                      cells[2],
                      0,
                      cells[4],
                      cells[5]};
    if (kind == kinds.end() || !readCell(cells[3], argument.values))
        throw Error(place, "expected a row that a program's --describe-into writes");
    return argument;
}

} // namespace

std::string takenBy(const CLI::Option& option) {
    if (option.get_items_expected_max() == 0)
        return "";
    // "TEXT:{low,moderate,high}", "DIR", "INT:INT in [1 - 64]"
    const std::string type = option.get_type_name();
    if (const std::size_t brace = type.find('{'); brace != type.npos) {
        std::string words = type.substr(brace + 1, type.find('}') - brace - 1);
        std::replace(words.begin(), words.end(), ',', ' ');
        return words;
    }
    for (const std::string& said : {type, option.get_option_text()})
        for (const char* what : {"PROTOCOL", "FILE", "DIR"})
            if (said.starts_with(what))
                return what;
    // Paths are text to CLI11, and what says more of itself than that is none.
    const bool isText =
        type == "TEXT" && (option.get_option_text().empty() || option.get_option_text() == " ");
    return isText ? "FILE" : "";
}

std::string argumentTable(const CLI::App& app, const std::string& about) {
    std::string table = fmt::format("{}\n", fmt::join(columns, ","));
    table += lineOf({Argument::Kind::program, "", app.get_name(), 0, "", about});
    table += linesOf(app, "");
    for (const CLI::App* command : app.get_subcommands({}))
        table += lineOf({Argument::Kind::command, "", command->get_name(), 0, "",
                         command->get_description()}) +
                 linesOf(*command, command->get_name());
    return table;
}

std::vector<Argument> readArgumentTable(const fs::path& file) {
    std::vector<Argument> table;
    const std::vector<CsvRecord> records = splitCsv(readFile(file));
    checkHeader(records.empty() ? CsvRecord() : records.front(), columns, file.string());
    for (std::size_t i = 1; i < records.size(); ++i)
        table.push_back(argumentOf(records[i], file.string()));
    return table;
}

fs::path argumentTableFile(const fs::path& shipped, const std::string& program) {
    return shipped / "programs" / (program + ".csv");
}

} // namespace obscura
