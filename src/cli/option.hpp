// How an option of a command is declared.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "cli/exit_code.hpp"

namespace orrery {

/// `read` takes the option's text; its UsageError gets the option's name in front. `label` stands for the value in the
/// help.
template <class Read>
CLI::Option* add_option(CLI::App& app, const std::string& name, const std::string& label, const std::string& help,
                        Read read) {
    const auto named = [name, read](const std::string& text) {
        try {
            read(text);
        } catch (const UsageError& error) {
            throw CLI::ValidationError(name, error.what());
        }
    };
    return app.add_option_function<std::string>(name, named, help)->type_name(label);
}

}  // namespace orrery
