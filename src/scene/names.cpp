#include "scene/names.hpp"

#include <algorithm>
#include <cstring>

#include "scene/keyed_hash.hpp"

namespace orrery {

Name Names::number(std::string_view text) {
    const auto next = static_cast<std::uint32_t>(texts_.size());
    const std::uint32_t found =
        index_.find_or_insert(keyed_hash(text), next, [&](std::uint32_t i) { return texts_[i] == text; });
    if (found == next) texts_.push_back(store(text));
    return Name{found};
}

std::string_view Names::store(std::string_view text) {
    constexpr std::size_t block = std::size_t{1} << 16;
    if (text.size() > free_bytes_) {
        free_bytes_ = std::max(block, text.size());
        blocks_.push_back(std::make_unique_for_overwrite<char[]>(free_bytes_));
        free_ = blocks_.back().get();
    }
    const std::string_view stored(free_, text.size());
    if (!text.empty()) std::memcpy(free_, text.data(), text.size());
    free_ += text.size();
    free_bytes_ -= text.size();
    return stored;
}

}  // namespace orrery
