#include "cli/option.hpp"

#include <sstream>

namespace orrery {

std::string wrapped(const std::string& text) {
    constexpr std::size_t help_column = 62;
    std::string lines;
    std::size_t used = 0;
    std::istringstream words(text);
    for (std::string word; words >> word; used += word.size()) {
        if (used > 0) {
            const bool fits = used + 1 + word.size() <= help_column;
            lines += fits ? ' ' : '\n';
            used = fits ? used + 1 : 0;
        }
        lines += word;
    }
    return lines;
}

}  // namespace orrery
