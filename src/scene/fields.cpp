#include "scene/fields.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "scene/printable.hpp"

namespace orrery {
namespace {

/// The integer a JSON number stands for. 512.0 is one, as in JSON Schema; 0.5 and 1e30 are not.
std::optional<std::int64_t> as_integer(const Json& value) {
    constexpr double exact = 9007199254740992.0;  // 2^53: every integer below is a double
    if (!value.is_number()) return std::nullopt;
    const double number = value.get<double>();
    if (std::abs(number) > exact || number != std::floor(number)) return std::nullopt;
    return static_cast<std::int64_t>(number);
}

std::string found_but_expected(const Json& found, std::string_view expected) {
    return fmt::format("found {}, expected {}", describe(found), expected);
}

}  // namespace

Fields::Fields(const Node& node, std::string_view expected, Report& report_to, Severity severity)
    : node_(node), report_(report_to), severity_(severity) {
    if (!is_object()) report(node.where(), found_but_expected(node.value(), expected));
}

bool Fields::has(std::string_view key) {
    if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.push_back(key);
    return is_object() && node_.value().contains(key);
}

std::optional<double> Fields::number(std::string_view key, const Range& range) {
    const Json* value = find(key, describe(range));
    return value ? number_at(Node(node_, key, *value), range) : std::nullopt;
}

std::optional<glm::dvec3> Fields::triple(std::string_view key, const Range& range) {
    const Json* value = find(key, "a list of 3 numbers");
    if (!value) return std::nullopt;
    const Node node(node_, key, *value);
    if (!value->is_array() || value->size() != 3) {
        report(node.where(), found_but_expected(*value, "a list of 3 numbers"));
        return std::nullopt;
    }
    // All three are looked at, so that each fault gets its message.
    const auto x = number_at(Node(node, 0), range), y = number_at(Node(node, 1), range),
               z = number_at(Node(node, 2), range);
    return x && y && z ? std::optional(glm::dvec3(*x, *y, *z)) : std::nullopt;
}

std::optional<std::uint32_t> Fields::integer(std::string_view key, std::uint32_t low, std::uint32_t high) {
    const Json* value = find(key, "an integer");
    return value ? integer_at(Node(node_, key, *value), low, high) : std::nullopt;
}

std::optional<std::array<std::uint32_t, 2>> Fields::integer_pair(std::string_view key, std::uint32_t low,
                                                                 std::uint32_t high) {
    const Json* value = find(key, "a list of 2 integers");
    if (!value) return std::nullopt;
    const Node node(node_, key, *value);
    if (!value->is_array() || value->size() != 2) {
        report(node.where(), found_but_expected(*value, "a list of 2 integers"));
        return std::nullopt;
    }
    const auto x = integer_at(Node(node, 0), low, high), y = integer_at(Node(node, 1), low, high);
    return x && y ? std::optional(std::array{*x, *y}) : std::nullopt;
}

const std::string* Fields::text(std::string_view key, std::string_view expected) {
    const Json* value = find(key, expected);
    if (!value) return nullptr;
    const auto* text = value->get_ptr<const std::string*>();
    if (!text) fault(key, found_but_expected(*value, expected));
    return text;
}

std::optional<Node> Fields::list(std::string_view key, std::string_view expected) {
    const std::optional<Node> node = any(key, expected);
    if (node && !node->value().is_array()) {
        report(node->where(), found_but_expected(node->value(), expected));
        return std::nullopt;
    }
    return node;
}

std::optional<Node> Fields::any(std::string_view key, std::string_view expected) {
    const Json* value = find(key, expected);
    return value ? std::optional(Node(node_, key, *value)) : std::nullopt;
}

void Fields::finish() {
    if (!is_object()) return;
    for (const auto& [key, value] : node_.value().items()) {
        if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
        const std::string_view near = report_.spelling().likely(key, known_);
        report_.add(Severity::warning, node_.where(key),
                    fmt::format("found the unknown key {}, which is ignored{}", in_quotes(key),
                                near.empty() ? "" : fmt::format("; did you mean {}?", in_quotes(near))));
    }
}

void Fields::fault(std::string_view key, std::string message) { report(node_.where(key), std::move(message)); }

void Fields::fault_at(const Node& node, std::string message) { report(node.where(), std::move(message)); }

void Fields::warn(std::string_view key, std::string message) {
    report_.add(Severity::warning, node_.where(key), std::move(message));
}

std::optional<std::size_t> Fields::choice_index(std::string_view key, std::span<const std::string_view> words) {
    const std::string expected = fmt::format("one of \"{}\"", fmt::join(words, "\", \""));
    const std::string* word = text(key, expected);
    if (!word) return std::nullopt;
    const auto found = std::find(words.begin(), words.end(), *word);
    if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
    const std::string_view near = report_.spelling().nearest(*word, words);
    fault(key, fmt::format("found {}, expected {}{}", in_quotes(*word), expected,
                           near.empty() ? "" : fmt::format("; the nearest is {}", in_quotes(near))));
    return std::nullopt;
}

const Json* Fields::find(std::string_view key, std::string_view expected) {
    if (has(key)) return &*node_.value().find(key);
    if (is_object()) report(node_.where(), fmt::format("found no {}, expected {}", in_quotes(key), expected));
    return nullptr;
}

void Fields::report(std::string where, std::string message) {
    if (severity_ == Severity::warning) message += " (in an entry that the scene does not use)";
    report_.add(severity_, std::move(where), std::move(message));
}

std::optional<double> Fields::number_at(const Node& node, const Range& range) {
    const Json& value = node.value();
    if (!value.is_number()) {
        report(node.where(), found_but_expected(value, describe(range)));
        return std::nullopt;
    }
    const double number = value.get<double>();
    if (const auto expected = expectation(range, number)) {
        report(node.where(), found_but_expected(value, *expected));
        return std::nullopt;
    }
    return number;
}

std::optional<std::uint32_t> Fields::integer_at(const Node& node, std::uint32_t low, std::uint32_t high) {
    const std::optional<std::int64_t> integer = as_integer(node.value());
    if (!integer || *integer < low || *integer > high) {
        report(node.where(), found_but_expected(node.value(), fmt::format("an integer from {} to {}", low, high)));
        return std::nullopt;
    }
    return static_cast<std::uint32_t>(*integer);
}

}  // namespace orrery
