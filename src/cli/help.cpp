#include "cli/help.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <vector>

#include "system/printable.hpp"

namespace orrery {
namespace {

constexpr std::size_t narrowest = 20, usual = 80, widest = 100;
constexpr std::size_t longest_command = 4096;

std::optional<std::size_t> columns_of_environment() {
    const char* const set = std::getenv("COLUMNS");
    const std::string_view text = set != nullptr ? set : "";
    std::size_t columns = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), columns);
    if (error != std::errc() || end != text.data() + text.size() || columns == 0) return std::nullopt;
    return columns;
}

std::optional<std::size_t> columns_of_terminal() {
    winsize size = {};
    if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return std::nullopt;
    return size.ws_col;
}

/// A row of a table of names and what they mean.
struct Row {
    std::string name, meaning;
};

/// "-o,--output FILE", "SCENE FILE", "--quiet".
std::string full_name(const CLI::Option& option) {
    const std::string name = option.get_name(option.get_positional(), !option.get_positional());
    return option.get_type_name().empty() ? name : name + " " + option.get_type_name();
}

class HelpFormatter final : public CLI::FormatterBase {
public:
    explicit HelpFormatter(std::size_t columns) : columns_(columns) {}

    std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode) const override {
        std::string text;
        add_wrapped(text, app->get_description(), 0, 0, columns_);
        text += "\nUsage: ";
        add_wrapped(text, usage(*app, name), 7, 7, columns_);
        text += '\n';
        std::vector<std::string> groups;
        for (const CLI::Option* option : app->get_options())
            if (std::ranges::find(groups, option->get_group()) == groups.end()) groups.push_back(option->get_group());
        // The one that CLI11 gives to --help is declared first and read last.
        std::stable_partition(groups.begin(), groups.end(),
                              [](const std::string& group) { return group != "Options"; });
        std::vector<Row> commands;
        for (const CLI::App* command : app->get_subcommands({}))
            commands.push_back({command->get_name(), command->get_description()});
        add_table(text, "Commands", commands);
        for (const std::string& group : groups) {
            std::vector<Row> rows;
            for (const CLI::Option* option : app->get_options())
                if (option->get_group() == group) rows.push_back({full_name(*option), option->get_description()});
            add_table(text, group, rows);
        }
        add_footer(text, app->get_footer());
        return text;
    }

private:
    static std::string usage(const CLI::App& app, const std::string& name) {
        std::string text = name + " [OPTIONS]";
        for (const bool positional : {false, true})
            for (const CLI::Option* option : app.get_options())
                if (option->get_required() && option->get_positional() == positional)
                    text += " " + (positional ? option->get_name(true) : full_name(*option));
        return app.get_subcommands({}).empty() ? text : text + " COMMAND";
    }

    void add_table(std::string& text, const std::string& title, const std::vector<Row>& rows) const {
        if (rows.empty()) return;
        text += '\n';
        add_wrapped(text, title + ":", 0, 2, columns_);
        text += '\n';
        const std::size_t column = std::min<std::size_t>(columns_ * 2 / 5, 32);
        for (const auto& [name, meaning] : rows) {
            text += "  ";
            std::size_t used = add_wrapped(text, name, 2, 4, columns_);
            // Two blanks at least between a name and its meaning; where there is no room for them, another line.
            if (used + 2 > column) {
                text += '\n';
                used = 0;
            }
            text += std::string(column - used, ' ');
            add_wrapped(text, meaning, column, column, columns_);
            text += '\n';
        }
    }

    void add_footer(std::string& text, const std::string& footer) const {
        if (!footer.empty()) text += '\n';
        std::istringstream paragraphs(footer);
        for (std::string paragraph; std::getline(paragraphs, paragraph); text += '\n') {
            const std::size_t blanks = std::min(paragraph.find_first_not_of(' '), paragraph.size());
            text += std::string(blanks, ' ');
            add_wrapped(text, paragraph, blanks, 2 * blanks, columns_, blanks > 0 ? " \\" : "");
        }
    }

    std::size_t columns_;
};

}  // namespace

std::string typed_command() {
    const char* const typed = std::getenv("ORRERY_COMMAND");
    return typed != nullptr && *typed != '\0' ? printable(typed, longest_command) : "orrery";
}

std::size_t help_columns() {
    std::optional<std::size_t> columns = columns_of_environment();
    if (!columns) columns = columns_of_terminal();
    return std::clamp(columns.value_or(usual), narrowest, widest);
}

std::size_t add_wrapped(std::string& out, std::string_view text, std::size_t used, std::size_t indent,
                        std::size_t columns, std::string_view line_end) {
    const std::string all(text);
    std::vector<std::string> words;
    std::istringstream split(all);
    for (std::string word; split >> word;) words.push_back(std::move(word));
    bool begun = false;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::size_t behind = i + 1 < words.size() ? line_end.size() : 0;
        if (begun && used + 1 + words[i].size() + behind > columns) {
            out += std::string(line_end) + '\n' + std::string(indent, ' ');
            used = indent;
            begun = false;
        }
        if (begun) out += ' ', ++used;
        out += words[i];
        used += words[i].size();
        begun = true;
    }
    return used;
}

std::shared_ptr<CLI::FormatterBase> help_formatter(std::size_t columns) {
    return std::make_shared<HelpFormatter>(columns);
}

}  // namespace orrery
