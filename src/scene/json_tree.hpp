// A JSON value, packed: 16 bytes a value and every string once. What a scene of a million spheres is read through.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "scene/names.hpp"

namespace orrery {

enum class JsonKind : std::uint8_t { null, boolean, negative, natural, real, text, list, object };

/// One value. Lists and objects hold their children side by side in the tree.
struct JsonValue {
    JsonKind kind : 3 = JsonKind::null;
    std::uint32_t key : 29 = 0;  ///< of the member it is: a Name; nothing in a list
    std::uint32_t size = 0;      ///< how many children
    std::uint64_t bits = 0;      ///< truth, integer, bits of the double, Name, or place of the first child

    bool is_number() const { return kind == JsonKind::negative || kind == JsonKind::natural || kind == JsonKind::real; }
    /// Of a number of any kind.
    double number() const {
        if (kind == JsonKind::real) return std::bit_cast<double>(bits);
        return kind == JsonKind::negative ? static_cast<double>(static_cast<std::int64_t>(bits))
                                          : static_cast<double>(bits);
    }
    bool is_text() const { return kind == JsonKind::text; }
    Name name() const { return Name{static_cast<std::uint32_t>(bits)}; }  ///< of a text
    Name key_name() const { return Name{key}; }                           ///< of a member
};
static_assert(sizeof(JsonValue) == 16);

/// Text below this many bytes has fewer distinct strings than JsonValue::key can number: each takes three bytes at
/// least, and only few are that short.
inline constexpr std::size_t largest_json = std::size_t{1} << 31;

class JsonTree {
public:
    const JsonValue& root() const { return root_; }
    const Names& names() const { return names_; }

    /// Child `i` of a list or an object.
    const JsonValue& child(const JsonValue& parent, std::size_t i) const {
        const std::uint64_t at = parent.bits + i;
        return blocks_[at / block][at % block];
    }

private:
    friend class JsonTreeBuilder;

    // Blocks instead of one array: growing never copies, and never holds both copies.
    static constexpr std::size_t block = 4096;
    std::vector<std::unique_ptr<JsonValue[]>> blocks_;
    std::uint64_t count_ = 0;
    JsonValue root_;
    Names names_;
};

}  // namespace orrery
