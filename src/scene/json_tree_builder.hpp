// Makes a JsonTree from a parser's events.
#pragma once

#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>

#include "scene/json_tree.hpp"

namespace orrery {

/// Deepest nesting of lists and objects accepted. A scene needs five; the limit keeps whatever walks the value
/// recursively, a parser for one, within the stack.
inline constexpr std::size_t deepest_nesting = 100;

/// Takes the events of one JSON text in their order, which must be that of the grammar.
class JsonTreeBuilder {
public:
    void null() { put(JsonKind::null, 0); }
    void boolean(bool value) { put(JsonKind::boolean, value); }
    void negative(std::int64_t value) { put(JsonKind::negative, static_cast<std::uint64_t>(value)); }
    void natural(std::uint64_t value) { put(JsonKind::natural, value); }
    void real(double value) { put(JsonKind::real, std::bit_cast<std::uint64_t>(value)); }
    void text(std::string_view value) { put(JsonKind::text, static_cast<std::uint32_t>(tree_.names_.number(value))); }

    /// False where that nests too deep; nothing may follow then.
    bool open_list() { return open(JsonKind::list); }
    bool open_object() { return open(JsonKind::object); }
    void close();

    /// False where the innermost object has that key already: the value to come takes the place of the one it has.
    bool key(std::string_view text);

    /// RFC 6901 pointer to the value that is being read.
    std::string where() const;

    JsonTree take() { return std::move(tree_); }

private:
    using Places = std::unordered_map<std::uint32_t, std::size_t>;

    /// A list or an object that is open.
    struct Frame {
        JsonKind kind;
        std::size_t base;                ///< where its children begin in values_
        Name key = {};                   ///< object: of the value to come
        std::size_t place = 0;           ///< object: where in values_ that value goes
        std::unique_ptr<Places> places;  ///< object of many members: key -> place
    };

    bool open(JsonKind kind);
    void put(JsonKind kind, std::uint64_t bits, std::uint32_t size = 0);
    std::size_t place_of(Frame& object);

    JsonTree tree_;
    std::vector<Frame> frames_;      ///< outermost first
    std::vector<JsonValue> values_;  ///< children of open frames that are complete
};

}  // namespace orrery
