// How an option is declared, and how its value is read: text of the command line -> value, or a message that says what
// was expected.
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "cli/process.hpp"
#include "film/film_state.hpp"
#include "kernels/isa.hpp"
#include "scene/scene.hpp"

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

/// Whole numbers are decimal digits alone: no sign, no blanks, no 0x, nothing after them. Throws UsageError.
std::uint32_t parse_integer(std::string_view text, std::uint32_t low, std::uint32_t high);

/// A finite decimal number >= 0, with or without fraction and exponent, nothing before or after it. Throws UsageError.
double parse_limit(std::string_view text);

/// "0,0,640,480": columns and rows of which there is one at least. Throws UsageError.
Window parse_window(std::string_view text);
std::string text_of(const Window& window);

/// A decimal number from -100 to 100. Throws UsageError.
double parse_exposure(std::string_view text);

/// "1%" or "0.01", from 0.0001 % to 100 %: 0.01. Throws UsageError.
double parse_share(std::string_view text);

/// "30s", "2m", "1.5h" or "500ms", from a millisecond to a year: seconds. Throws UsageError.
double parse_duration(std::string_view text);

/// "2/8": which of how many parts. Throws UsageError.
Shard parse_shard(std::string_view text);

/// An instruction set this machine runs; "auto" is the best of them. Throws UsageError naming those it runs.
Isa parse_isa(std::string_view text);

/// "scalar, sse2, avx2": what this machine runs.
std::string supported_isas();

/// For whoever throws: "found "x", expected y".
UsageError unexpected(std::string_view found, std::string_view expected);

/// Which of the words it is. Throws UsageError.
std::size_t parse_word(std::string_view text, std::span<const std::string_view> words);

inline constexpr std::string_view on_off[] = {"on", "off"};

}  // namespace orrery
