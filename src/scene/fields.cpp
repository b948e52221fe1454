#include "scene/fields.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "system/printable.hpp"

namespace orrery {
namespace {

/// The integer a JSON number stands for. 512.0 is one, as in JSON Schema; 0.5 and 1e30 are not.
std::optional<std::int64_t> as_integer(const Json& value) {
    constexpr double exact = 9007199254740992.0;  // 2^53: every integer below is a double
    if (!value.is_number()) return std::nullopt;
    const auto number = value.get<double>();
    if (std::abs(number) > exact || number != std::floor(number)) return std::nullopt;
    return static_cast<std::int64_t>(number);
}

}  // namespace

Fields::Fields(const Node& node, std::string_view expected, Report& report_to) : node_(node), report_(report_to) {
    constexpr std::size_t many = 8;
    known_.reserve(many);
    if (!is_object()) report_unexpected(node_, expected);
}

const Json* Fields::ask(std::string_view key) {
    if (std::ranges::find(known_, key) == known_.end()) known_.push_back(key);
    if (!is_object()) return nullptr;
    const auto member = node_.value().find(key);
    return member != node_.value().end() ? &*member : nullptr;
}

template <class Expected>
const Json* Fields::require(std::string_view key, const Expected& expected) {
    const Json* value = ask(key);
    if (!value && is_object()) {
        report(node_.where(), fmt::format("found no {}, expected {}", in_quotes(key), expected()));
    }
    return value;
}

std::optional<double> Fields::number(std::string_view key, const Range& range) {
    const Json* value = require(key, [&] { return describe(range); });
    return value ? number_at(Node(node_, key, *value), range) : std::nullopt;
}

std::optional<glm::dvec3> Fields::triple(std::string_view key, const Range& range) {
    constexpr std::string_view expected = "a list of 3 numbers";
    const Json* value = require(key, [&] { return expected; });
    if (!value) return std::nullopt;
    const Node node(node_, key, *value);
    if (!node.is_list() || node.size() != 3) {
        report_unexpected(node, expected);
        return std::nullopt;
    }
    // All three are looked at, so that each fault gets its message.
    const auto x = number_at(Node(node, 0), range), y = number_at(Node(node, 1), range),
               z = number_at(Node(node, 2), range);
    return x && y && z ? std::optional(glm::dvec3(*x, *y, *z)) : std::nullopt;
}

std::optional<std::uint32_t> Fields::integer(std::string_view key, std::uint32_t low, std::uint32_t high) {
    const Json* value = require(key, [] { return "an integer"; });
    return value ? integer_at(Node(node_, key, *value), low, high) : std::nullopt;
}

std::optional<std::array<std::uint32_t, 2>> Fields::integer_pair(std::string_view key, std::uint32_t low,
                                                                 std::uint32_t high) {
    constexpr std::string_view expected = "a list of 2 integers";
    const Json* value = require(key, [&] { return expected; });
    if (!value) return std::nullopt;
    const Node node(node_, key, *value);
    if (!node.is_list() || node.size() != 2) {
        report_unexpected(node, expected);
        return std::nullopt;
    }
    const auto x = integer_at(Node(node, 0), low, high), y = integer_at(Node(node, 1), low, high);
    return x && y ? std::optional(std::array{*x, *y}) : std::nullopt;
}

std::optional<std::string_view> Fields::text(std::string_view key, std::string_view expected) {
    const std::optional<Node> node = any(key, expected);
    if (node && !node->text()) report_unexpected(*node, expected);
    return node ? node->text() : std::nullopt;
}

std::optional<Node> Fields::list(std::string_view key, std::string_view expected) {
    std::optional<Node> node = any(key, expected);
    if (node && !node->is_list()) {
        report_unexpected(*node, expected);
        return std::nullopt;
    }
    return node;
}

std::optional<Node> Fields::any(std::string_view key, std::string_view expected) {
    const Json* value = require(key, [&] { return expected; });
    return value ? std::optional(Node(node_, key, *value)) : std::nullopt;
}

void Fields::finish() {
    if (!is_object()) return;
    for (const auto& [key, value] : node_.value().get_ref<const Json::object_t&>()) {
        if (std::ranges::find(known_, key) != known_.end()) continue;
        const std::string_view near = report_.spelling().likely(key, known_);
        warn(key, fmt::format("found the unknown key {}, which is ignored{}", in_quotes(key),
                              near.empty() ? "" : fmt::format("; did you mean {}?", in_quotes(near))));
    }
}

void Fields::fault(std::string_view key, std::string message) { report(node_.where(key), std::move(message)); }

void Fields::fault_at(const Node& node, std::string message) { report(node.where(), std::move(message)); }

void Fields::warn(std::string_view key, std::string message) {
    report_.add(Severity::warning, node_.where(key), std::move(message));
}

std::optional<std::size_t> Fields::word(std::string_view key, std::span<const std::string_view> words) {
    const auto expected = [&] { return fmt::format("one of \"{}\"", fmt::join(words, "\", \"")); };
    const Json* value = require(key, expected);
    if (!value) return std::nullopt;
    const Node node(node_, key, *value);
    const auto text = node.text();
    if (!text) {
        report_unexpected(node, expected());
        return std::nullopt;
    }
    const auto found = std::ranges::find(words, *text);
    if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
    const std::string_view near = report_.spelling().nearest(*text, words);
    fault(key, fmt::format("found {}, expected {}{}", in_quotes(*text), expected(),
                           near.empty() ? "" : fmt::format("; the nearest is {}", in_quotes(near))));
    return std::nullopt;
}

std::optional<double> Fields::number_at(const Node& node, const Range& range) {
    if (!node.value().is_number()) {
        report_unexpected(node, describe(range));
        return std::nullopt;
    }
    const auto number = node.value().get<double>();
    if (const auto expected = expectation(range, number)) {
        report_unexpected(node, *expected);
        return std::nullopt;
    }
    return number;
}

std::optional<std::uint32_t> Fields::integer_at(const Node& node, std::uint32_t low, std::uint32_t high) {
    const std::optional<std::int64_t> integer = as_integer(node.value());
    if (!integer || *integer < low || *integer > high) {
        report_unexpected(node, fmt::format("an integer from {} to {}", low, high));
        return std::nullopt;
    }
    return static_cast<std::uint32_t>(*integer);
}

void Fields::report(std::string where, std::string message) {
    if (severity_ == Severity::warning) message += " (in an entry that the scene does not use)";
    report_.add(severity_, std::move(where), std::move(message));
}

void Fields::report_unexpected(const Node& node, std::string_view expected) {
    report(node.where(), fmt::format("found {}, expected {}", node.describe(), expected));
}

}  // namespace orrery
