#include "cli/options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "scene/settings.hpp"
#include "system/printable.hpp"

namespace orrery {
namespace {

/// A decimal number and what is behind it. Empty where there is none, or a sign or an exponent.
std::optional<std::pair<double, std::string_view>> number_and_rest(std::string_view text) {
    double value = 0;
    if (text.empty() || (text.front() != '.' && (text.front() < '0' || text.front() > '9'))) return std::nullopt;
    const char* const behind = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data(), behind, value, std::chars_format::fixed);
    if (error != std::errc()) return std::nullopt;
    return std::pair{value, std::string_view(end, static_cast<std::size_t>(behind - end))};
}

}  // namespace

UsageError unexpected(std::string_view found, std::string_view expected) {
    return UsageError(fmt::format("found {}, expected {}", in_quotes(found), expected));
}

std::uint32_t parse_integer(std::string_view text, std::uint32_t low, std::uint32_t high) {
    if (const auto value = whole_number(text, low, high)) return *value;
    throw unexpected(text, fmt::format("a whole number from {} to {}", low, high));
}

double parse_limit(std::string_view text) {
    double value = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    // from_chars reads "inf" and "nan", too; no limit is either.
    if (error == std::errc() && stop == end && std::isfinite(value) && !std::signbit(value)) return value;
    throw unexpected(text, "a number >= 0");
}

Window parse_window(std::string_view text) {
    std::uint32_t numbers[4] = {};
    std::string_view rest = text;
    bool good = true;
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t end = i < 3 ? std::min(rest.find(','), rest.size()) : rest.size();
        const auto number = whole_number(rest.substr(0, end), 0, std::numeric_limits<std::uint32_t>::max());
        good = good && number;
        numbers[i] = number.value_or(0);
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    const Window window{numbers[0], numbers[1], numbers[2], numbers[3]};
    if (good && window.x0 < window.x1 && window.y0 < window.y1) return window;
    throw unexpected(text, "X0,Y0,X1,Y1 in pixels with X0 < X1 and Y0 < Y1, such as 0,0,640,480");
}

std::string text_of(const Window& window) {
    return fmt::format("{},{},{},{}", window.x0, window.y0, window.x1, window.y1);
}

double parse_exposure(std::string_view text) {
    const bool negative = text.starts_with('-');
    if (const auto number = number_and_rest(text.substr(negative ? 1 : 0)))
        if (number->second.empty() && number->first <= 100) return negative ? -number->first : number->first;
    throw unexpected(text, "a number from -100 to 100");
}

double parse_share(std::string_view text) {
    if (const auto number = number_and_rest(text)) {
        const auto& [value, rest] = *number;
        const double share = rest == "%" ? value / 100 : value;
        if ((rest.empty() || rest == "%") && share >= 1e-6 && share <= 1) return share;
    }
    throw unexpected(text, "a share such as 1% or 0.01, from 0.0001% to 100%");
}

double parse_duration(std::string_view text) {
    if (const auto number = number_and_rest(text)) {
        const auto& [value, unit] = *number;
        const double seconds = unit == "ms"  ? value / 1000
                               : unit == "s" ? value
                               : unit == "m" ? value * 60
                               : unit == "h" ? value * 3600
                                             : -1;
        if (seconds >= 1e-3 && seconds <= 366.0 * 24 * 3600) return seconds;
    }
    throw unexpected(text, "a time such as 30s, 2m, 1.5h or 500ms");
}

Shard parse_shard(std::string_view text) {
    constexpr std::uint32_t most = 1u << 20;
    const std::size_t slash = std::min(text.find('/'), text.size());
    const auto of = whole_number(text.substr(std::min(slash + 1, text.size())), 1, most);
    const auto number = whole_number(text.substr(0, slash), 1, of.value_or(1));
    if (number && of) return {*number, *of};
    throw unexpected(text, "K/N, the K-th of N parts, such as 1/4");
}

Isa parse_isa(std::string_view text) {
    if (text == "auto") return best_isa();
    const std::optional<Isa> isa = isa_from_name(text);
    if (isa && isa_supported(*isa)) return *isa;
    throw unexpected(text, fmt::format("auto or an instruction set this machine supports: {}", supported_isas()));
}

std::size_t parse_word(std::string_view text, std::span<const std::string_view> words) {
    const auto word = std::ranges::find(words, text);
    if (word != words.end()) return static_cast<std::size_t>(word - words.begin());
    throw unexpected(text, fmt::format("{}", fmt::join(words, "|")));
}

std::string supported_isas() {
    std::string names;
    for (const Isa isa : all_isas)
        if (isa_supported(isa)) names += (names.empty() ? "" : ", ") + std::string(isa_name(isa));
    return names;
}

}  // namespace orrery
