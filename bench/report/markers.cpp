#include <fmt/format.h>

#include <stdexcept>

#include "bench/report/page.hpp"

namespace orrery::bench {

std::string with_blocks(std::string page, const std::map<std::string, std::string>& blocks) {
    for (const auto& [name, block] : blocks) {
        const std::string begin = fmt::format("<!-- begin {} -->\n", name);
        const std::string end = fmt::format("<!-- end {} -->", name);
        const std::size_t start = page.find(begin);
        if (start == std::string::npos) throw std::runtime_error(fmt::format("the page has no place for '{}'", name));
        const std::size_t first = start + begin.size();
        const std::size_t last = page.find(end, first);
        if (last == std::string::npos) throw std::runtime_error(fmt::format("'{}' begins and does not end", name));
        page.replace(first, last - first, block);
    }
    return page;
}

}  // namespace orrery::bench
