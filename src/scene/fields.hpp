// One JSON object being read field by field.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/json_node.hpp"
#include "scene/range.hpp"
#include "scene/report.hpp"

namespace orrery {

/// A word a field may hold, and what it stands for.
template <class Value>
struct Choice {
    std::string_view word;
    Value value;
};

/// Reads the fields of an object. Each reader reports what is missing or wrong and then returns empty. The keys asked
/// for are the known ones: finish() names all others, so no list of keys can drift from the code that reads them.
class Fields {
public:
    /// A `node` that is no object is reported as not being `expected`; all its fields then read as empty in silence.
    Fields(const Node& node, std::string_view expected, Report& report);
    Fields(const Fields&) = delete;
    Fields& operator=(const Fields&) = delete;

    /// With which severity faults are reported from here on: warnings in a registry entry that the composition does
    /// not use. Errors unless told.
    void judge(Severity severity) { severity_ = severity; }

    bool is_object() const { return node_.is_object(); }

    /// Whether the key is there; for optional fields.
    bool has(std::string_view key) { return ask(key) != nullptr; }

    std::optional<double> number(std::string_view key, const Range& range);
    std::optional<glm::dvec3> triple(std::string_view key, const Range& range);
    std::optional<std::uint32_t> integer(std::string_view key, std::uint32_t low, std::uint32_t high);
    std::optional<std::array<std::uint32_t, 2>> integer_pair(std::string_view key, std::uint32_t low,
                                                             std::uint32_t high);
    std::optional<std::string_view> text(std::string_view key, std::string_view expected);
    std::optional<Node> list(std::string_view key, std::string_view expected);
    std::optional<Node> any(std::string_view key, std::string_view expected);

    /// Which of the words stands there.
    std::optional<std::size_t> word(std::string_view key, std::span<const std::string_view> words);

    template <class Value, std::size_t N>
    std::optional<Value> choice(std::string_view key, const Choice<Value> (&choices)[N]) {
        std::array<std::string_view, N> words;
        for (std::size_t i = 0; i < N; ++i) words[i] = choices[i].word;
        const std::optional<std::size_t> found = word(key, words);
        return found ? std::optional(choices[*found].value) : std::nullopt;
    }

    /// Declares a key known that is not read.
    void ignore(std::string_view key) { ask(key); }

    /// Warns about every key nobody asked for.
    void finish();

    /// Reports a fault at a key of this object, or at a node below it, with this object's severity.
    void fault(std::string_view key, std::string message);
    void fault_at(const Node& node, std::string message);

    /// Reports what is no fault but worth a warning.
    void warn(std::string_view key, std::string message);

private:
    const Json* ask(std::string_view key);
    /// The value of a key that has to be there; `expected()` says what it should be where it is not.
    template <class Expected>
    const Json* require(std::string_view key, const Expected& expected);
    std::optional<double> number_at(const Node& node, const Range& range);
    std::optional<std::uint32_t> integer_at(const Node& node, std::uint32_t low, std::uint32_t high);
    void report(std::string where, std::string message);
    void report_unexpected(const Node& node, std::string_view expected);

    Node node_;
    Report& report_;
    Severity severity_ = Severity::error;
    std::vector<std::string_view> known_;  ///< the keys asked for
};

}  // namespace orrery
