#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <new>
#include <sstream>

#include "cli/commands.hpp"
#include "cli/help.hpp"
#include "cli/process.hpp"
#include "scene/spelling.hpp"
#include "system/memory.hpp"
#include "system/printable.hpp"

namespace orrery {
namespace {

struct Command {
    const char* name;
    const char* description;
    Work (*add)(CLI::App&);
};

constexpr Command commands[] = {{"render", "Render a scene to an image", add_render},
                                {"info", "Show how a scene would be rendered, and why so", add_info},
                                {"develop", "Make images of films that render has kept", add_develop},
                                {"generate", "Write a scene of as many spheres as you like", add_generate},
                                {"compare", "Measure how much two images differ", add_compare}};

std::string a_command() {
    std::vector<std::string_view> names;
    for (const Command& command : commands) names.push_back(command.name);
    return fmt::format("a command, {} or {}", fmt::join(names.begin(), names.end() - 1, ", "), names.back());
}

/// The words that nobody knows, and what they could have meant. Empty where there is none.
std::string unknown_words(const CLI::App& app) {
    const std::vector<std::string> words = app.remaining();
    if (words.empty()) return "";
    // A misspelt option's value may be taken for the scene, and the scene is then among the rest.
    const auto option = std::ranges::find_if(words, [](const std::string& word) { return word.starts_with('-'); });
    const std::string& word = option != words.end() ? *option : words.front();
    std::vector<std::string> names;
    if (option != words.end()) {
        for (const CLI::Option* known : app.get_options()) {
            for (const std::string& name : known->get_lnames()) names.push_back("--" + name);
            for (const std::string& name : known->get_snames()) names.push_back("-" + name);
        }
    } else {
        for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
    }
    const std::vector<std::string_view> known(names.begin(), names.end());
    const std::string_view near = Spelling().likely(word.substr(0, word.find('=')), known);
    const std::string expected = option != words.end() ? "an option that --help names"
                                 : names.empty()       ? "no further argument"
                                                       : a_command();
    return fmt::format("found {}, expected {}{}", in_quotes(word), expected,
                       near.empty() ? "" : fmt::format("; did you mean {}?", near));
}

/// What is wrong with the command line.
std::string fault_in(const CLI::App& app, const CLI::ParseError& error) {
    const auto chosen = app.get_subcommands();
    std::string fault = unknown_words(chosen.empty() ? app : *chosen.front());
    // CLI11 says that a subcommand is required, not which there are.
    if (fault.empty() && chosen.empty() && error.get_name() == "RequiredError")
        fault = fmt::format("expected {}", a_command());
    if (fault.empty()) fault = printable_whole(error.what());
    const std::string command = chosen.empty() ? "" : " " + chosen.front()->get_name();
    return fmt::format("orrery: error: {}\nTry: {}{} --help\n", fault, typed_command(), command);
}

int run(int argc, const char* const* argv) {
    const std::string typed = typed_command();
    CLI::App app("Renders worlds of spheres: a scene file in, an image out.", typed);
    app.formatter(help_formatter(help_columns()));
    app.set_version_flag("--version", fmt::format("orrery {}", version()), "Print the version");
    app.set_help_flag("-h,--help", "Print this help");
    app.require_subcommand(1);
    app.footer(fmt::format("Help on a command:\n  {} render --help", typed));
    std::vector<std::pair<const CLI::App*, Work>> works;
    for (const Command& command : commands) {
        CLI::App* const chosen = app.add_subcommand(command.name, command.description);
        works.emplace_back(chosen, command.add(*chosen));
    }
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() != 0) {
            print_message(fault_in(app, error));
            return exit_code::misused;
        }
        std::ostringstream output, unused;
        app.exit(error, output, unused);  // help or version
        print_result(output.str());
        return exit_code::done;
    }
    return std::ranges::find_if(works, [](const auto& work) { return work.first->parsed(); })->second();
}

}  // namespace
}  // namespace orrery

int main(int argc, char** argv) {
    using namespace orrery;
    occupy_standard_descriptors();
    install_signal_handlers();
    keep_within_memory();
    try {
        return run(argc, argv);
    } catch (const UsageError& error) {
        print_error(error.what());
        return exit_code::misused;
    } catch (const std::bad_alloc&) {
        print_error("out of memory");
        return exit_code::failed;
    } catch (const std::exception& error) {
        print_error(error.what());
        return exit_code::failed;
    }
}
