// The strings of a scene file by number: ids are compared and looked up as integers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "scene/hash_index.hpp"

namespace orrery {

/// A string of a Names. Equal names are equal strings.
enum class Name : std::uint32_t {};

/// Every distinct string once, numbered from 0 in order of arrival.
class Names {
public:
    Name number(std::string_view text);
    std::string_view text(Name name) const { return texts_[static_cast<std::uint32_t>(name)]; }
    std::size_t size() const { return texts_.size(); }

private:
    std::string_view store(std::string_view text);

    std::vector<std::unique_ptr<char[]>> blocks_;
    char* free_ = nullptr;        ///< the rest of the last block
    std::size_t free_bytes_ = 0;  ///< how much that is
    std::vector<std::string_view> texts_;
    HashIndex index_;
};

class NameSet {
public:
    /// Whether it is new.
    bool insert(Name name) {
        const auto i = static_cast<std::uint32_t>(name);
        if (i >= members_.size()) members_.resize(std::size_t{i} + 1);
        if (members_[i]) return false;
        return members_[i] = true;
    }
    bool contains(Name name) const {
        const auto i = static_cast<std::uint32_t>(name);
        return i < members_.size() && members_[i];
    }

private:
    std::vector<bool> members_;
};

/// Name -> place in some array.
class NameMap {
public:
    /// Keeps the place it has; whether it had none.
    bool insert(Name name, std::uint32_t place) {
        const auto i = static_cast<std::uint32_t>(name);
        if (i >= places_.size()) places_.resize(std::size_t{i} + 1, none);
        if (places_[i] != none) return false;
        places_[i] = place;
        return true;
    }
    std::optional<std::uint32_t> find(Name name) const {
        const auto i = static_cast<std::uint32_t>(name);
        return i < places_.size() && places_[i] != none ? std::optional(places_[i]) : std::nullopt;
    }

private:
    static constexpr std::uint32_t none = 0xFFFFFFFF;
    std::vector<std::uint32_t> places_;
};

}  // namespace orrery
